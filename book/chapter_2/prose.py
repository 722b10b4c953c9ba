"""Computed numbers in the prose of Chapter 2."""

from softgrip.tactile.element_sensitivity import equal_cut

WORDS = {
    # Where pyramid and hemisphere give way alike by Eq. (2.1), with one width of the base.
    "cut": lambda: f"{equal_cut():.2f}",
}
