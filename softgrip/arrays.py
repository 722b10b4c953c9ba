"""Array types of the material laws, and the checks that the laws share."""

from collections.abc import Iterator
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.errors import InvalidInputError

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Value = TypeVar("Value", float, Floats)
"""A float or an array: a law returns what it was given."""
Number = Any
"""A float, an array or a CasADi symbol: a law returns what it was given, and broadcasts."""


def read_only(values: ArrayLike) -> Floats:
    """Copy values into a float array that cannot be written to."""
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


def check_positive(**values: ArrayLike) -> None:
    """Raise InvalidInputError for the first value, number or array, not finite and above zero."""
    for name, value in values.items():
        array = np.asarray(value, dtype=np.float64)
        if not (np.isfinite(array).all() and (array > 0).all()):
            raise InvalidInputError(name, expected="a finite number > 0", got=value)


def check_stretch(stretch: float | Floats) -> None:
    """Raise InvalidInputError if a stretch is not above zero: no body has a length of zero."""
    least = float(np.min(stretch))
    if not least > 0:
        raise InvalidInputError("stretch", expected="numbers > 0 (1 + strain)", got=least)


def tensile_curve(strain: ArrayLike, stress: ArrayLike, *, at_least: int) -> tuple[Floats, Floats]:
    """Check a measured curve of a pull test and return it as two float arrays.

    Args:
        strain: Engineering strain, shape (N,), finite, >= 0, not all equal.
        stress: Engineering stress, shape (N,), Pa, finite, at least one value above zero.
        at_least: Smallest N that the caller can use.

    Raises:
        InvalidInputError: If one of these does not hold.
    """
    e, s = np.asarray(strain, dtype=np.float64), np.asarray(stress, dtype=np.float64)
    if e.ndim != 1 or e.shape != s.shape or e.size < at_least:
        raise InvalidInputError(
            "strain, stress",
            expected=f"two arrays of one shape (N,) with N >= {at_least}",
            got=(e.shape, s.shape),
        )
    if not (np.isfinite(e).all() and np.isfinite(s).all()):
        raise InvalidInputError("strain, stress", expected="finite numbers", got="NaN or infinity")
    if e.min() < 0 or np.ptp(e) == 0:
        raise InvalidInputError(
            "strain",
            expected="values >= 0 that are not all equal",
            got=f"values from {e.min():g} to {e.max():g}",
        )
    if s.max() <= 0:
        raise InvalidInputError(
            "stress", expected="at least one value > 0", got=f"a largest value of {s.max():g}"
        )
    return e, s


def chunks(runs: int, bytes_per_run: float, *, limit: float = 64e6) -> Iterator[slice]:
    """Cut a batch into pieces whose output fits into memory.

    Args:
        runs: Number of runs, >= 1.
        bytes_per_run: Size of the output of one run.
        limit: Largest output held at a time, bytes.

    >>> [(part.start, part.stop) for part in chunks(5, 8.0, limit=16.0)]
    [(0, 2), (2, 4), (4, 5)]
    """
    if runs < 1 or not bytes_per_run > 0:
        raise InvalidInputError("runs", expected=">= 1, of more than 0 bytes", got=runs)
    size = max(1, int(limit // bytes_per_run))
    for start in range(0, runs, size):
        yield slice(start, min(start + size, runs))
