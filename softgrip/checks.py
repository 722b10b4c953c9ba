"""Checks of input; they look at floats and arrays alike. See also `softgrip.arrays`."""

from collections.abc import Callable, Collection
from dataclasses import fields
from functools import wraps
from inspect import signature
from math import isfinite
from typing import Any, Literal, ParamSpec, TypeVar, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, Value, check_positive, floats, is_symbol, one_number
from softgrip.errors import InvalidInputError, NotFiniteError

Given = ParamSpec("Given")
Returned = TypeVar("Returned")


def takes_numbers(function: Callable[Given, Returned]) -> Callable[Given, Returned]:
    """Make a function refuse, by name, what is not of the kind that it says it takes.

    What is annotated as ``float`` must be one finite number, as ``int`` a whole one, as an array
    or a value numbers of any shape, which come in as `floats`, and as ``Literal`` one of its words;
    None where it may be None. Ranges and shapes are the function's own.

    >>> @takes_numbers
    ... def mean(values: ArrayLike, *, weight: float = 1.0) -> float:
    ...     return weight * float(np.mean(values))
    >>> mean([1, 2], weight="2")
    3.0
    >>> mean([1, 2], weight="twice")
    Traceback (most recent call last):
    softgrip.errors.InvalidInputError: weight: expected real numbers without a unit, in rows of \
one length, got 'twice'
    """
    kinds = _hints(function)
    readers = {name: found for name, kind in kinds.items() if (found := _reader(kind))}
    # By place: to bind a signature takes longer than many a law.
    places = [(name, readers.get(name)) for name in signature(function).parameters]

    @wraps(function)
    def checked(*args: Given.args, **kwargs: Given.kwargs) -> Returned:
        read = [
            reader(name, value) if reader else value
            for (name, reader), value in zip(places, args, strict=False)
        ]
        named = {
            name: readers[name](name, value) if name in readers else value
            for name, value in kwargs.items()
        }
        return function(*read, *args[len(places) :], **named)  # type: ignore[arg-type]

    return checked


def _hints(function: Callable[..., Any]) -> dict[str, Any]:
    """Return the annotations of a function; Any for what is imported for its types alone."""
    unknown: dict[str, Any] = {}
    while True:
        try:
            return get_type_hints(function, localns=unknown)
        except NameError as error:
            unknown[str(error.name)] = Any


def _reader(kind: Any) -> Callable[[str, Any], Any] | None:
    """Return what reads an argument that is annotated so; None if that says nothing of numbers."""
    if kind is float:
        return lambda name, value: one_number(**{name: value})[0]
    if kind is int:
        return _whole
    if kind in (ArrayLike, Floats):
        return lambda name, value: floats(**{name: value})[0]
    if kind is Value:
        return _value
    if get_origin(kind) is Literal:
        return lambda name, value: _word(name, value, get_args(kind))
    without = [part for part in get_args(kind) if part is not type(None)]
    if len(without) < len(get_args(kind)) and (inner := _reader(_union(without))):
        return lambda name, value: None if value is None else inner(name, value)
    return None


def _union(kinds: list[Any]) -> Any:
    found = kinds[0]
    for kind in kinds[1:]:
        found = found | kind
    return found


def _value(name: str, value: Any) -> Any:
    (found,) = floats(**{name: value})
    return found if is_symbol(found) or found.ndim else float(found)


def _whole(name: str, value: object) -> int:
    (number,) = one_number(**{name: value})  # type: ignore[arg-type]
    if number != round(number):
        raise InvalidInputError(name, expected="a whole number", got=value)
    return int(number)


def _word(name: str, value: object, valid: tuple[object, ...]) -> object:
    if not isinstance(value, str) or value not in valid:
        raise InvalidInputError(name, expected=f"one of {valid}", got=value)
    return value


def check_not_negative(**values: ArrayLike) -> None:
    """Raise InvalidInputError for the first value that is not all finite and >= 0."""
    for name, value in values.items():
        (array,) = floats(**{name: value})
        if is_symbol(array):
            continue
        if not (array.size and np.isfinite(array).all() and (array >= 0).all()):
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
        if isinstance(value, float) and isfinite(value):
            continue  # without NumPy, many times as fast
        (array,) = floats(**{name: value})
        if is_symbol(array):
            continue
        if not (array.size and np.isfinite(array).all()):
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
            (array,) = floats(**{name: value})
        except InvalidInputError:
            raise NotFiniteError(name, got=value) from None
        if not (array.size and np.isfinite(array).all()):
            raise NotFiniteError(name, got=array.tolist())
        found.append(array)
    return tuple(found)


def record(*, at_least: int, **columns: ArrayLike) -> tuple[Floats, ...]:
    """Return the columns of a record as float arrays of one shape (N,), N >= `at_least`.

    Raises:
        InvalidInputError: If the shapes differ, a record is too short, or a value is not finite.
    """
    arrays = floats(**columns)
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
