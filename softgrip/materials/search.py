"""The least value of a function of one parameter that may have several valleys."""

from collections.abc import Callable

import numpy as np
from scipy.optimize import minimize_scalar

from softgrip.errors import InvalidInputError
from softgrip.materials.arrays import Floats


def least(misfit: Callable[[float], float], scan: Floats, *, name: str) -> float:
    """Return where `misfit` is least: scan it, refine every valley, keep the deepest.

    Parameters
    ----------
    misfit
        Function to make least.
    scan
        Rising parameter values, shape (N,), so dense that each valley spans three of them.
    name
        What the parameter is called in the error.

    Raises
    ------
    InvalidInputError
        If the least value is at an end of the scan: the data do not fix the parameter within it.

    Examples
    --------
    >>> round(least(lambda x: (x - 0.3) ** 2, np.linspace(0, 1, 11), name="x"), 6)
    0.3
    """
    found = np.array([misfit(float(p)) for p in scan])
    valleys = 1 + np.flatnonzero((found[1:-1] <= found[:-2]) & (found[1:-1] <= found[2:]))
    ends = [
        minimize_scalar(
            misfit, bounds=(scan[i - 1], scan[i + 1]), method="bounded", options={"xatol": 1e-10}
        )
        for i in valleys
    ]
    deepest = min(ends, key=lambda end: float(end.fun), default=None)
    if deepest is None or deepest.fun > min(found[0], found[-1]):
        raise InvalidInputError(
            "strain, stress",
            expected=f"a curve that is best fitted by {name} from {scan[0]:g} to {scan[-1]:g}",
            got=f"one best fitted at or beyond {scan[np.argmin(found)]:g}",
        )
    return float(deepest.x)
