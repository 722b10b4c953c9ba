"""What a figure draws, read back from it: for the words that say what its curves show."""

from functools import cache

import pandas as pd

from book.companion.exhibit import exhibit
from book.companion.save import make, numbers
from softgrip.arrays import Floats
from softgrip.errors import UnknownNameError


@cache
def _numbers(title: str) -> pd.DataFrame:
    return numbers(make(exhibit(title)).shown)


def drawn(title: str, series: str, panel: str = "") -> tuple[Floats, Floats]:
    """Return x and y of a series of a figure, as its axes have them.

    Args:
        title: Of the figure, such as ``Figure 2.3``.
        series: Its label.
        panel: How the title of its panel begins, if several have such a series.

    Raises:
        UnknownNameError: If there is no such series; the message lists those that are.
    """
    rows = _numbers(title)
    inside = rows[rows["panel"].str.startswith(panel)]
    found = inside[inside["series"] == series]
    if found.empty:
        raise UnknownNameError(f"series of {title}", series, sorted(set(inside["series"])))
    return found["x"].to_numpy(), found["y"].to_numpy()
