"""Several unequal fingers on one pump: plant, reachable targets, stable inversion, robustness."""
