"""The printed measurements as one question to the simulated rig: targets, space, experiments."""
