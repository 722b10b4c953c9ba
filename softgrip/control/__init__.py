"""Controllers, and the sampled loop that they run in."""
