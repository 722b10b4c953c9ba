"""How fast the package is: ``python -m tests.bench`` measures it, against plain SciPy."""
