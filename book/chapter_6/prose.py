"""Computed numbers in the prose of Chapter 6."""

from book.chapter_6.figures_study import PAIRS

WORDS = {"pairs": lambda: f"{PAIRS:,}"}
