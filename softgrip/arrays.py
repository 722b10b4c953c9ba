"""Array types, numbers from outside, and the checks that the material laws share."""

from collections.abc import Iterable, Iterator
from functools import reduce
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


def is_symbol(value: object) -> bool:
    """Tell whether a value is a symbol of CasADi, which has no range that could be checked."""
    return type(value).__module__.startswith("casadi")


def chosen(condition: Number, one: Number, other: Number) -> Number:
    """Return one where a condition holds, else the other: `numpy.where`, for symbols too.

    >>> chosen(np.array([0.0, 1.0]) > 0, 3.0, 4.0).tolist()
    [4.0, 3.0]
    """
    if is_symbol(condition):
        from casadi import if_else

        return if_else(condition, one, other)
    if isinstance(condition, bool | np.bool | float):
        return one if condition else other  # many times as fast
    return np.where(condition, one, other)


def largest_of(values: Iterable[Number]) -> Number:
    """Return the largest: `max`, for symbols too.

    >>> largest_of([1.0, 3.0, 2.0])
    3.0
    """
    return reduce(lambda most, value: chosen(value > most, value, most), values)


def least_of(values: Iterable[Number]) -> Number:
    """Return the least: `min`, for symbols too."""
    return reduce(lambda least, value: chosen(value < least, value, least), values)


LARGEST_STRAIN = 20.0
"""Of a rubber: 2,000 %."""
ROUNDING = 1e-6
"""Of a period: the times are decimals, whose difference is not exactly the period."""


def read_only(values: ArrayLike) -> Floats:
    """Copy values into a float array that cannot be written to."""
    array = floats(values=values)[0].copy()
    array.setflags(write=False)
    return array


def floats(**values: ArrayLike) -> tuple[Floats, ...]:
    """Return what a reader hands over as float arrays: all numbers from outside come in here.

    As for NumPy, None among others is a number that is missing (NaN), and digits in words are one.

    Raises:
        InvalidInputError: If a value is no number, or numbers in rows of one length. What NumPy
            would take half of is refused, too: imaginary parts, dates, masks, units of `pint`.

    >>> [array.tolist() for array in floats(time=[0, 1], level="2.5")]
    [[0.0, 1.0], 2.5]
    """
    found: list[Any] = []
    for name, value in values.items():
        if is_symbol(value):
            found.append(value)
            continue
        try:
            if value is None or hasattr(value, "magnitude"):
                raise TypeError
            array = np.asarray(value)
            if array.dtype.kind in "bcmM":
                raise TypeError
            found.append(np.asarray(array, dtype=np.float64))
        except (TypeError, ValueError, OverflowError):
            expected = "real numbers without a unit, in rows of one length"
            raise InvalidInputError(name, expected=expected, got=value) from None
    return tuple(found)


def one_number(**values: float) -> tuple[float, ...]:
    """Return values that are a finite number each.

    Raises:
        InvalidInputError: If one is none, or several.
    """
    arrays = floats(**values)
    for (name, value), array in zip(values.items(), arrays, strict=True):
        if is_symbol(array):
            continue
        if array.ndim or not np.isfinite(array):
            raise InvalidInputError(name, expected="a finite number", got=value)
    return tuple(array if is_symbol(array) else float(array) for array in arrays)  # type: ignore[misc]


def check_positive(**values: ArrayLike) -> None:
    """Raise InvalidInputError for the first value, number or array, not finite and above zero."""
    for name, value in values.items():
        if isinstance(value, float) and 0 < value < np.inf:
            continue  # without NumPy, many times as fast
        (array,) = floats(**{name: value})
        if is_symbol(array):
            continue
        if not (array.size and np.isfinite(array).all() and (array > 0).all()):
            raise InvalidInputError(name, expected="a finite number > 0", got=value)


def check_stretch(stretch: float | Floats) -> None:
    """Raise InvalidInputError if a stretch is not above zero: no body has a length of zero."""
    (array,) = floats(stretch=stretch)
    if not (array.size and np.isfinite(array).all() and (array > 0).all()):
        raise InvalidInputError("stretch", expected="numbers > 0 (1 + strain)", got=stretch)


def tensile_curve(strain: ArrayLike, stress: ArrayLike, *, at_least: int) -> tuple[Floats, Floats]:
    """Check a measured curve of a pull test and return it as two float arrays.

    Args:
        strain: Engineering strain, shape (N,), 0 to `LARGEST_STRAIN`, not all equal.
        stress: Engineering stress, shape (N,), Pa, finite, at least one value above zero.
        at_least: Smallest N that the caller can use.

    Raises:
        InvalidInputError: If one of these does not hold.
    """
    e, s = floats(strain=strain, stress=stress)
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
    if e.max() > LARGEST_STRAIN:
        raise InvalidInputError(
            "strain",
            expected=f"a share, up to {LARGEST_STRAIN:g} for a rubber, not per cent",
            got=f"values up to {e.max():g}",
        )
    if s.max() <= 0:
        raise InvalidInputError(
            "stress", expected="at least one value > 0", got=f"a largest value of {s.max():g}"
        )
    return e, s


def intervals(time: ArrayLike, period: float) -> Floats:
    """Return the time from each row to the next in periods, shape (N - 1,).

    A whole number where only the rounding of decimals parts it from one: sums over an even log are
    then exact.

    Args:
        time: s, shape (N,), increasing.
        period: s, > 0.

    >>> intervals([0.025, 0.05, 0.125, 0.151], 0.025).round(6).tolist()
    [1.0, 3.0, 1.04]
    """
    (t,) = floats(time=time)
    check_positive(period=period)
    if t.ndim != 1 or not np.isfinite(t).all() or np.ndim(period):
        raise InvalidInputError("time, period", expected="finite, (N,) and a number", got=t.shape)
    found = np.diff(t) / float(period)
    whole = np.rint(found)
    return np.where(np.abs(found - whole) < ROUNDING, whole, found)


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
