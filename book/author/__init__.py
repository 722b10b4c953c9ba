"""What the author published elsewhere: his scripts recomputed, his force readings."""
