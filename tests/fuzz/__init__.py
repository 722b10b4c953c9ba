"""Damaged files by the million, outside the test run: ``python -m tests.fuzz --help``."""
