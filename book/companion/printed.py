"""A number as it is printed, and what the rounding of inputs does to what follows from them."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from inspect import signature
from itertools import product
from typing import Any, Self

NUMBER = re.compile(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", re.IGNORECASE)
CORNERS_UP_TO = 6
"""Inputs of which all corners are tried; of more, those that their slopes point to."""


def decimals(text: str) -> int:
    """Count the decimals of a printed number.

    >>> decimals("2.365"), decimals("96"), decimals("6.61e-4"), decimals("2.52e5")
    (3, 0, 6, -3)
    """
    mantissa, _, exponent = text.lower().partition("e")
    return len(mantissa.partition(".")[2]) - int(exponent or 0)


class Printed(float):
    """A printed number: a float that knows its text and half a unit of its last place.

    >>> Printed("6.15") / 90, Printed("6.15").half
    (0.06833333333333334, 0.005)
    """

    text: str
    half: float

    def __new__(cls, text: str, *, exact: bool = False) -> Self:
        """Read it; ``exact`` for a count or a setting, which nobody has rounded."""
        number = super().__new__(cls, text)
        number.text = text
        number.half = 0.0 if exact else 0.5 * 10.0 ** -decimals(text)
        return number


@dataclass(frozen=True)
class Spread:
    """A value, and the least and largest that the rounding of its inputs allows."""

    value: float
    low: float
    high: float


def _rounded(item: Any) -> Iterator[Printed]:
    if isinstance(item, Printed):
        if item.half:
            yield item
    elif isinstance(item, Mapping):
        for inner in item.values():
            yield from _rounded(inner)
    elif isinstance(item, Sequence) and not isinstance(item, str):
        for inner in item:
            yield from _rounded(inner)


def _moved(item: Any, moves: Iterator[float]) -> Any:
    if isinstance(item, Printed):
        return float(item) + next(moves) * item.half if item.half else float(item)
    if isinstance(item, Mapping):
        return {name: _moved(inner, moves) for name, inner in item.items()}
    if isinstance(item, Sequence) and not isinstance(item, str):
        return tuple(_moved(inner, moves) for inner in item)
    return item


def with_rounded_defaults(
    function: Callable[..., float], arguments: Mapping[str, Any]
) -> dict[str, Any]:
    """Return arguments with those of the function's defaults that are printed numbers."""
    defaults = {
        name: parameter.default
        for name, parameter in signature(function).parameters.items()
        if any(_rounded(parameter.default))
    }
    return defaults | dict(arguments)


def carried(function: Callable[..., float], arguments: Mapping[str, Any]) -> Spread:
    """Carry the rounding of printed inputs through a recomputation.

    Every `Printed` among the arguments, and among the function's defaults, may lie half a unit of
    its last place up or down. Up to `CORNERS_UP_TO` of them are tried at all corners, which is
    exact where the function is monotone in each; more of them one by one, then all together in
    the two directions to which their slopes point.

    Args:
        function: What recomputes the number.
        arguments: By name; mappings and sequences of printed numbers are looked into.

    >>> spread = carried(lambda error, step: error / step, {"error": Printed("6.15"), "step": 90})
    >>> f"{spread.low:.5f} {spread.high:.5f}"
    '0.06828 0.06839'
    """
    given = with_rounded_defaults(function, arguments)
    count = len(list(_rounded(given)))

    def at(moves: Sequence[float]) -> float:
        return float(function(**_moved(given, iter(moves))))

    value = at([0.0] * count)
    if count <= CORNERS_UP_TO:
        found = [at(corner) for corner in product((-1.0, 1.0), repeat=count)] if count else []
    else:
        ends = [
            [at([sign * (i == k) for i in range(count)]) for sign in (-1.0, 1.0)]
            for k in range(count)
        ]
        up = [1.0 if high >= low else -1.0 for low, high in ends]
        found = [*(x for pair in ends for x in pair), at(up), at([-sign for sign in up])]
    return Spread(value, min([value, *found]), max([value, *found]))
