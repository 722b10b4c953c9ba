"""Every figure and table of the book: one function each, one file a chapter."""

from softgrip.figures.exhibit import exhibit, figure, table
from softgrip.figures.show import show
from softgrip.figures.verdicts import show_counts, show_verdicts

__all__ = ["exhibit", "figure", "show", "show_counts", "show_verdicts", "table"]
