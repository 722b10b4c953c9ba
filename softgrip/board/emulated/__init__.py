"""The firmware on an emulated ATmega2560, with simulated physics at its pins."""
