"""What the study of drift keeps, looked up by layers, setting and method."""

from book.beyond.drift.study import DRAWN, FITTED, KEPT, SPREADS, Outcome
from softgrip.errors import UnknownNameError
from softgrip.reads import remembered


@remembered
def kept() -> tuple[Outcome, ...]:
    """Return all rows of the kept table."""
    return KEPT.read()


def row(method: str, layers: str = FITTED, setting: str = "wandering") -> Outcome:
    """Return a row of the kept table.

    Raises:
        UnknownNameError: If there is none.
    """
    for one in kept():
        if (one.layers, one.setting, one.method) == (layers, setting, method):
            return one
    raise UnknownNameError("row of the study of drift", f"{layers}, {setting}, {method}", [])


def enough(layers: str, setting: str, share: float) -> int | None:
    """Return the fewest weights, spread over a session, with which most reach the printed accuracy.

    Args:
        layers, setting: As of `row`.
        share: Of the sessions, that must reach it.

    Returns:
        int | None: None if none of the numbers that were tried is enough.
    """
    tried = {one.method: one for one in kept() if (one.layers, one.setting) == (layers, setting)}
    return next(
        (n for n, name in SPREADS.items() if name in tried and tried[name].reached >= share), None
    )


LAYERS = {FITTED: "fitted layer", DRAWN: "drawn layers"}
"""As the page names them."""
