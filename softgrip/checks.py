"""Checks of input; they look at floats and arrays alike. See also `softgrip.arrays`."""

from collections.abc import Collection
from dataclasses import fields

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive
from softgrip.errors import InvalidInputError, NotFiniteError


def check_not_negative(**values: ArrayLike) -> None:
    """Raise InvalidInputError for the first value that is not all finite and >= 0."""
    for name, value in values.items():
        array = np.asarray(value, dtype=np.float64)
        if not (np.isfinite(array).all() and (array >= 0).all()):
            raise InvalidInputError(name, expected="finite numbers >= 0", got=value)


def check_fields(
    parameters: object, *, zero: Collection[str] = (), other: Collection[str] = ()
) -> None:
    """Raise InvalidInputError unless the fields of a dataclass are finite and above zero.

    Args:
        parameters: The dataclass; each field is a number or numbers.
        zero: Names of fields that may be zero.
        other: Names of fields that are no numbers.
    """
    for entry in fields(parameters):  # type: ignore[arg-type]
        if entry.name not in other:
            check = check_not_negative if entry.name in zero else check_positive
            check(**{entry.name: getattr(parameters, entry.name)})


def check_finite(**values: ArrayLike) -> None:
    """Raise InvalidInputError for the first value that holds NaN or infinity."""
    for name, value in values.items():
        if not np.isfinite(np.asarray(value, dtype=np.float64)).all():
            raise InvalidInputError(name, expected="finite numbers", got=value)


def samples(**values: ArrayLike) -> tuple[Floats, ...]:
    """Return what a controller, differentiator or filter is given at one time, as float arrays.

    It is called before anything is kept: one NaN in a sum, or a filter, would stay in it for good.

    Raises:
        NotFiniteError: If a value is no number, NaN or infinite.

    >>> [y.tolist() for y in samples(measurement=0.5, reference=[1, 2])]
    [0.5, [1.0, 2.0]]
    """
    found = []
    for name, value in values.items():
        try:
            array = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError):
            raise NotFiniteError(name, got=value) from None
        if not np.isfinite(array).all():
            raise NotFiniteError(name, got=array.tolist())
        found.append(array)
    return tuple(found)


def record(*, at_least: int, **columns: ArrayLike) -> tuple[Floats, ...]:
    """Return the columns of a record as float arrays of one shape (N,), N >= `at_least`.

    Raises:
        InvalidInputError: If the shapes differ, a record is too short, or a value is not finite.
    """
    arrays = tuple(np.asarray(column, dtype=np.float64) for column in columns.values())
    shape = arrays[0].shape
    if len(shape) != 1 or shape[0] < at_least or any(a.shape != shape for a in arrays):
        raise InvalidInputError(
            ", ".join(columns),
            expected=f"arrays of one shape (N,) with N >= {at_least}",
            got=tuple(a.shape for a in arrays),
        )
    if not all(np.isfinite(a).all() for a in arrays):
        raise InvalidInputError(", ".join(columns), expected="finite numbers", got="NaN or inf")
    return arrays
