"""Single changes that a slip may make, and which of them recover a number that does not come out.

By rule, and counted: what is tried, what recovers the print, and how many other numbers of as many
digits the same changes would recover. Where those are many, a change that fits says little.
"""

import re
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from inspect import signature
from itertools import combinations, pairwise
from math import isfinite, pi, sqrt, trunc
from typing import Any

import numpy as np

from book.companion.claims import Claim, printed_text, read_claims
from book.companion.printed import CORNERS_UP_TO, Printed, Spread, carried, decimals
from book.companion.verdict import meets

RESULT, PRINT, ASSUMPTION = "result", "print", "assumption"
G = 9.80665
DIGITS = "0123456789"
SWAPPED, CHANGED = "two digits swapped", "one digit changed"


def _times(factor: float) -> Callable[[float], float]:
    return lambda x: x * factor


OPERATIONS: dict[str, Callable[[float], float]] = {
    "with the other sign": _times(-1),
    **{f"times {k}": _times(k) for k in (10, 100, 1000)},
    **{f"divided by {k}": _times(1 / k) for k in (10, 100, 1000)},
    "doubled": _times(2),
    "halved": _times(0.5),
    "times 2 pi": _times(2 * pi),
    "divided by 2 pi": _times(1 / (2 * pi)),
    "times 180 / pi": _times(180 / pi),
    "times pi / 180": _times(pi / 180),
    "times 9.80665 (kgf to N)": _times(G),
    "divided by 9.80665 (N to kgf)": _times(1 / G),
    "times 0.00980665 (gf to N)": _times(G / 1000),
    "divided by 0.00980665 (N to gf)": _times(1000 / G),
    "squared": lambda x: x * x,
    "as its square root": sqrt,
}
"""What is done to a result, or to one of its inputs."""

OTHERS = 100
"""Other numbers that are tried, over two decades about the printed one."""


@dataclass(frozen=True)
class Change:
    """One change.

    Attributes:
        of: `RESULT`, `PRINT`, `ASSUMPTION`, or the input: a claim's id, or its name.
        does: What is done to it.
    """

    of: str
    does: str


@dataclass(frozen=True)
class Found:
    """What came of trying single changes.

    Attributes:
        tried: Changes that were tried and give different numbers.
        recovering: Those that recover the print, the smallest first.
        others: Other numbers of as many digits that the same changes recover.
        other_numbers: Of how many.
    """

    tried: int
    recovering: tuple[Change, ...]
    others: int
    other_numbers: int


Path = tuple[str | int, ...]


@dataclass(frozen=True)
class Input:
    """A printed input: its name, text and number, and where it stands among the arguments.

    The name is a claim's id, or the path to a number that no claim prints.
    """

    name: str
    text: str
    number: Printed
    paths: tuple[Path, ...]


def reprints(text: str) -> Iterator[tuple[str, str]]:
    """Yield a number with two neighbouring digits swapped, or with one changed, nearest first.

    >>> [new for new, _ in reprints("2.1")][:4]
    ['2.0', '2.2', '2.3', '2.4']
    """
    mantissa, e, exponent = text.partition("e")
    places = [k for k, character in enumerate(mantissa) if character.isdigit()]

    def put(digits: Mapping[int, str]) -> str:
        return "".join(digits.get(k, c) for k, c in enumerate(mantissa)) + e + exponent

    swapped = [
        put({first: mantissa[second], second: mantissa[first]})
        for first, second in pairwise(places)
        if mantissa[first] != mantissa[second]
    ]
    changed = [put({k: digit}) for k in places for digit in DIGITS if digit != mantissa[k]]
    named = [*((new, SWAPPED) for new in swapped), *((new, CHANGED) for new in changed)]
    # Nobody prints 03 for 3.
    likely = [(new, name) for new, name in named if not re.match(r"-?0\d", new)]
    yield from sorted(likely, key=lambda reprint: abs(float(reprint[0]) - float(text)))


def _text(number: Printed) -> str:
    """Return what was printed; of what nobody has rounded, the shortest form."""
    if not number.half:
        return f"{number:g}"
    return f"{number:.{max(0, round(-np.log10(2 * number.half)))}f}"


def _leaves(raw: Any, value: Any, path: Path) -> Iterator[Input]:
    if isinstance(value, Printed):
        named = isinstance(raw, str) and raw.startswith("@")
        if named:
            yield Input(raw[1:], printed_text(raw[1:]), value, (path,))
        else:
            text = raw if isinstance(raw, str) else _text(value)
            yield Input(".".join(map(str, path)), text, value, (path,))
    elif isinstance(value, Mapping):
        for name, inner in value.items():
            yield from _leaves(raw[name], inner, (*path, name))
    elif isinstance(value, tuple):
        for k, inner in enumerate(value):
            yield from _leaves(raw[k], inner, (*path, k))


def _put(arguments: Any, path: Path, value: float) -> Any:
    if not path:
        return value
    first, rest = path[0], path[1:]
    if isinstance(arguments, Mapping):
        return {**arguments, first: _put(arguments[first], rest, value)}
    return tuple(
        _put(item, rest, value) if k == first else item for k, item in enumerate(arguments)
    )


def _replaced(arguments: Any, item: Input, number: Printed) -> Any:
    for path in item.paths:
        arguments = _put(arguments, path, number)
    return arguments


def _operated(number: Printed, operation: Callable[[float], float]) -> Printed:
    """Return a printed input after an operation, its rounding along with it."""
    ends = [operation(float(number) + sign * number.half) for sign in (-1, 1)]
    result = Printed(repr(operation(float(number))))
    result.half = abs(ends[1] - ends[0]) / 2
    return result


def _quietly(make: Callable[[], Any]) -> Any:
    """Return None for what has no value, as the root of a negative number."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return make()
        except (ArithmeticError, ValueError, LookupError, TypeError, RuntimeError):
            return None


def _results(claim: Claim, spread: Spread) -> Iterator[tuple[Change, Spread]]:
    """Yield what may be done to the recomputed number itself."""
    operations = {**OPERATIONS}
    if claim.unit == "%":
        operations["in percent of the other number"] = lambda x: 100 * x / (100 + x)
    for name, operation in operations.items():
        if changed := _quietly(partial(_applied, operation, spread)):
            yield Change(RESULT, name), changed


def _applied(operation: Callable[[float], float], spread: Spread) -> Spread:
    value, *ends = map(operation, (spread.value, spread.low, spread.high))
    return Spread(value, min(ends), max(ends))


def _cut(claim: Claim, spread: Spread) -> Spread:
    unit = 10.0 ** decimals(claim.printed)
    # The error of writing a number in binary is no difference.
    return _applied(lambda x: trunc(round(x * unit, 6)) / unit, spread)


def _inputs(
    function: Callable[..., float], raw: Mapping[str, Any], resolved: Mapping[str, Any]
) -> tuple[dict[str, Any], list[Input]]:
    defaults = {
        name: parameter.default
        for name, parameter in signature(function).parameters.items()
        if isinstance(parameter.default, Printed | tuple) and name not in raw
    }
    arguments = {**defaults, **resolved}
    found: dict[str, Input] = {}
    for leaf in _leaves({**defaults, **raw}, arguments, ()):
        before = found.get(leaf.name, leaf)
        paths = tuple(dict.fromkeys((*before.paths, *leaf.paths)))
        found[leaf.name] = replace(leaf, paths=paths)
    return arguments, [*found.values()]


def _beside(id: str, claims: Mapping[str, Claim]) -> Iterator[Claim]:
    """Yield the claims of other numbers of the place and unit of one that a claim prints."""
    if own := claims.get(id):
        for other in claims.values():
            if (other.where, other.unit) == (own.where, own.unit) and other.printed != own.printed:
                yield other


def _read(item: Input, claims: Mapping[str, Claim]) -> Iterator[tuple[str, Printed]]:
    """Yield an input as it may have been read: other digits, another unit, another row."""
    exact = not item.number.half
    for text, name in reprints(item.text):
        yield f"as {text}, {name}", Printed(text, exact=exact)
    for name, operation in () if exact else OPERATIONS.items():  # a count has no unit
        if number := _quietly(partial(_operated, item.number, operation)):
            yield name, number
    for other in _beside(item.name, claims):
        yield f"read as {other.id}", Printed(other.printed, exact=other.exact)


def _changed_inputs(
    arguments: Mapping[str, Any], inputs: list[Input], claims: Mapping[str, Claim]
) -> Iterator[tuple[Change, Any]]:
    """Yield the arguments after each change of an input, and after each exchange of two."""
    for item in inputs:
        for name, number in _read(item, claims):
            yield Change(item.name, name), _replaced(arguments, item, number)
    for first, second in combinations(inputs, 2):
        once = _replaced(arguments, first, second.number)
        change = Change(first.name, f"exchanged with {second.name}")
        yield change, _replaced(once, second, first.number)


def other_numbers(text: str) -> Iterator[str]:
    """Yield numbers of as many digits, a tenth to ten times as large.

    >>> [*other_numbers("0.25")][:2], [*other_numbers("0.25")][-1]
    (['2.5e-02', '2.6e-02'], '2.5e+00')
    """
    digits = len("".join(filter(str.isdigit, text.partition("e")[0])).lstrip("0")) or 1
    for share in np.linspace(-1, 1, OTHERS):
        yield f"{(float(text) or 1.0) * 10**share:.{digits - 1}e}"


def search(
    claim: Claim,
    function: Callable[..., float],
    resolved: Mapping[str, Any],
    spread: Spread,
    assumed: Spread | None = None,
) -> Found:
    """Try single changes, of the result, the print, an input, and two inputs, and count.

    Args:
        claim: What is printed.
        function: What recomputes it.
        resolved: Its arguments, printed numbers as such.
        spread: What it gives.
        assumed: What it gives under the assumption that the claim names.
    """
    recovering: list[Change] = []
    values: dict[float, None] = {spread.value: None}

    def hold(change: Change, changed: Spread) -> None:
        values[changed.value] = None
        if meets(claim, changed.low, changed.high):
            recovering.append(change)

    hold(Change(RESULT, "cut, not rounded"), _cut(claim, spread))
    prints = [*reprints(claim.printed)]
    for text, name in prints:
        if meets(replace(claim, printed=text), spread.low, spread.high):
            recovering.append(Change(PRINT, f"as {text}, {name}"))
    claims = {other.id: other for other in read_claims()}
    exchanged = [(other.id, _printing(claim, other)) for other in _beside(claim.id, claims)]
    for id, other in exchanged:
        if meets(other, spread.low, spread.high):
            recovering.append(Change(PRINT, f"exchanged with {id}"))
    for change, changed in _results(claim, spread):
        hold(change, changed)
    width = (spread.high - spread.low) / 2 / abs(spread.value) if spread.value else 0.0
    arguments, inputs = _inputs(function, claim.arguments, resolved)
    # Rounding is carried for what comes near alone: with many inputs that takes long.
    reach = 3.0 if len(inputs) <= CORNERS_UP_TO else 1.25
    for change, changed_arguments in _changed_inputs(arguments, inputs, claims):
        value = _quietly(partial(_value, function, changed_arguments))
        if value is None or value in values:
            continue
        values[value] = None
        if _near(claim, value, reach * width):
            exactly = _quietly(partial(carried, function, changed_arguments))
            if exactly and meets(claim, exactly.low, exactly.high):
                recovering.append(change)
    if assumed:
        hold(Change(ASSUMPTION, claim.assumption), assumed)
    del values[spread.value]
    others, recovered = _by_chance(claim, spread, [*values], width, [o for _, o in exchanged])
    tried = len(values) + len(prints) + len(exchanged)
    return Found(tried, tuple(recovering), recovered, others)


def _printing(claim: Claim, other: Claim) -> Claim:
    return replace(claim, printed=other.printed, exact=other.exact)


def _value(function: Callable[..., float], arguments: Mapping[str, Any]) -> float | None:
    value = float(function(**arguments))
    return value if isfinite(value) else None


def _near(claim: Claim, value: float, width: float) -> bool:
    margin = width * abs(value)
    return meets(claim, value - margin, value + margin) is not False


def _by_chance(
    claim: Claim, spread: Spread, values: list[float], width: float, exchanged: list[Claim]
) -> tuple[int, int]:
    """Count other numbers that do not come out, and those of them that changes recover.

    For an exchange of prints the other number stands in the place of what is recomputed.
    """
    others = recovered = 0
    for text in other_numbers(claim.printed):
        other = replace(claim, printed=text)
        if meets(other, spread.low, spread.high) is not False:
            continue
        others += 1
        recovered += (
            any(_near(other, value, width) for value in values)
            or any(
                meets(replace(claim, printed=new), spread.low, spread.high)
                for new, _ in reprints(text)
            )
            or any(_near(neighbour, float(text), width) for neighbour in exchanged)
        )
    return others, recovered
