"""What every page shares: exhibits, claims with their verdicts, and how they are shown."""

from book.companion.absent import absent
from book.companion.chips import (
    show_assumptions,
    show_bases,
    show_counts,
    show_errata,
    show_filter,
    show_verdicts,
)
from book.companion.show import show
from book.companion.what_if import what_if

__all__ = [
    "absent",
    "show",
    "show_assumptions",
    "show_bases",
    "show_counts",
    "show_errata",
    "show_filter",
    "show_verdicts",
    "what_if",
]
