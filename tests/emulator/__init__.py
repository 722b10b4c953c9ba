"""The board of the rig, emulated: the real firmware on simavr, in virtual time."""
