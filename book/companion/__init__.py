"""What every page shares: exhibits, sliders, claims with their verdicts, and how they are shown."""

from book.companion.chips import (
    show_assumptions,
    show_bases,
    show_counts,
    show_errata,
    show_verdicts,
)
from book.companion.explorer import explore
from book.companion.show import show
from book.companion.sliders import Slider, slider

__all__ = [
    "Slider",
    "explore",
    "show",
    "show_assumptions",
    "show_bases",
    "show_counts",
    "show_errata",
    "show_verdicts",
    "slider",
]
