"""Numbers in the prose of Chapter 6."""

from book.chapter_6.figures_study import PAIRS


def pairs() -> str:
    """Return how many pairs of fingers are drawn."""
    return f"{PAIRS:,}"
