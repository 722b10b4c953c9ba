"""The pages of the rig: a live run, commissioning, the protocol."""
