"""Numbers in the prose of Chapter 2."""

from softgrip.tactile.element_sensitivity import equal_cut


def cut() -> str:
    """Return the cut at which pyramid and hemisphere give way alike by Eq. (2.1), one width."""
    return f"{equal_cut():.2f}"
