"""The rig: one interface to drive, over a simulated one, a replayed log, and a board."""
