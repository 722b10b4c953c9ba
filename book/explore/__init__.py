"""Figures with sliders: laws that the page computes itself, and frames where it cannot."""

from book.explore.explorer import explore
from book.explore.sliders import Range, Slider

__all__ = ["Range", "Slider", "explore"]
