"""Drift of the force layer without the four weights before each run."""
