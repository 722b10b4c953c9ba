"""The board of a rig: protocol, line, firmware, and the same firmware emulated."""
