"""The three open problems of Section 7.2, solved on the simulated rig."""
