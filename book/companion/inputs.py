"""Inputs: the numbers that a reader may change, and what of the claims each of them is.

``data/claims/inputs.csv`` has them. An input is what a claim prints, wherever a claim names it by
``@`` and its id, or by that of one that repeats it: which says no more than the same number. Where
no claim prints it, it is the arguments of one name that hold the stated number; those of that name
with another number are another finger's, or another rubber's. A number that was computed from an
input and then printed stays as it is printed.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from inspect import signature
from math import nan
from types import MappingProxyType
from typing import Any

from book.companion.claims import Claim, printed_text, read_claims
from book.companion.verdict import recomputation
from softgrip.arrays import one_number
from softgrip.errors import DataFileError, InvalidInputError, UnknownNameError
from softgrip.provenance import data_rows
from softgrip.quantities import convert, in_si, si_unit
from softgrip.reads import remembered

FILE = "claims/inputs.csv"


@dataclass(frozen=True)
class Input:
    """A number that can be changed.

    Attributes:
        symbol: Its name in a call.
        name: What it is.
        unit: As printed.
        stated: As it stands, in that unit.
        low, high: What it may be.
        places: Ids of the claims that print it: the first place, and those that repeat it.
        arguments: Names of the arguments that hold it, ``gains.0`` for the first in a list.
    """

    symbol: str
    name: str
    unit: str
    stated: float
    low: float
    high: float
    places: tuple[str, ...] = ()
    arguments: tuple[str, ...] = ()

    def value(self, given: Any) -> float:
        """Return what a caller gives, in the unit of the print.

        Args:
            given: A number, in that unit, also in words; or words such as ``"10 cm"``, or a
                quantity of `pint`.

        Raises:
            InvalidInputError: If it is none of these, of another dimension, or out of range.
        """
        found = self._number(given)
        if not self.low <= found <= self.high:
            expected = f"{self.name}: {self.low:g} to {self.high:g} {self.unit}"
            raise InvalidInputError(self.symbol, expected=expected, got=given)
        return found

    def _number(self, given: Any) -> float:
        try:
            return one_number(**{self.symbol: given})[0]
        except InvalidInputError:
            try:
                si = si_unit(self.unit)
            except InvalidInputError:  # of no usual dimension, such as a stiffness by mass
                expected = f"a number in {self.unit}"
                raise InvalidInputError(self.symbol, expected=expected, got=given) from None
        # What goes into SI and back is off in the last of its digits.
        found = in_si(self.symbol, given, si) / float(convert(1.0, self.unit, si))
        return float(f"{found:.12g}")


def _repeats(claim: Claim, places: tuple[str, ...], stated: float) -> bool:
    """Tell whether a claim says no more than that a number stands in another place too."""
    return (
        claim.function == "same"
        and claim.relation in ("=", "~")
        and not claim.print_of
        and float(claim.printed) == stated
        and claim.arguments in [{"value": f"@{id}"} for id in places]
    )


def _places(id: str, stated: float) -> tuple[str, ...]:
    found: tuple[str, ...] = (id,)
    while more := tuple(
        claim.id
        for claim in read_claims()
        if claim.id not in found and _repeats(claim, found, stated)
    ):
        found += more
    return found


def _input(row: Mapping[str, str]) -> Input:
    stated = float(printed_text(row["claim"]) if row["claim"] else row["stated"])
    low, high = float(row["low"]), float(row["high"])
    if not low <= stated <= high:
        raise DataFileError(FILE, expected=f"{stated} from low to high", got=f"{row}")
    places = _places(row["claim"], stated) if row["claim"] else ()
    arguments = tuple(row["arguments"].split())
    return Input(row["symbol"], row["name"], row["unit"], stated, low, high, places, arguments)


@remembered
def inputs() -> Mapping[str, Input]:
    """Return all inputs by symbol."""
    return MappingProxyType({row["symbol"]: _input(row) for row in data_rows(FILE)})


def input_of(symbol: str) -> Input:
    """Return an input by its symbol.

    Raises:
        UnknownNameError: If there is none; the message lists those there are.

    >>> input_of("L").stated, input_of("E").places[:2]
    (94.0, ('table-5.1-e-dragon-skin-20', '3.4-modulus'))
    """
    known = inputs()
    if symbol not in known:
        raise UnknownNameError("input", symbol, list(known))
    return known[symbol]


def _put(
    item: Any, at: str, named: Mapping[str, Any], typed: Mapping[tuple[str, float], Any]
) -> Any:
    """Return an argument with the values of inputs in their places."""
    if isinstance(item, str):
        return named.get(item, item)
    if isinstance(item, bool):
        return item
    if isinstance(item, int | float):
        return typed.get((at, item), item)
    if isinstance(item, Mapping):
        return {name: _put(inner, f"{at}.{name}", named, typed) for name, inner in item.items()}
    if isinstance(item, list):
        return [_put(inner, f"{at}.{k}", named, typed) for k, inner in enumerate(item)]
    return item


def with_inputs(claim: Claim, values: Mapping[str, float]) -> Claim:
    """Return a claim with the values of inputs, by symbol, in the place of what is stated.

    They are exact: nobody has rounded them. So are they where the claim is held against one.
    """
    named: dict[str, Any] = {}
    typed: dict[tuple[str, float], Any] = {}
    for symbol, value in values.items():
        one = input_of(symbol)
        named |= {f"@{place}": value for place in one.places}
        typed |= {(name, one.stated): value for name in one.arguments}
    found = replaced(claim, named, typed)
    lent = named.get(f"@{claim.print_of}")
    return found if lent is None else replace(found, printed=repr(lent), exact=True, print_of="")


def replaced(
    claim: Claim, named: Mapping[str, Any], typed: Mapping[tuple[str, float], Any]
) -> Claim:
    """Return a claim with others of its arguments.

    Args:
        claim: As stated. What is replaced in a default of its recomputation becomes an argument.
        named: By ``@`` and the id that the argument names.
        typed: By the argument's name, as of `Input.arguments`, and the number that it holds.
    """

    def put(arguments: Mapping[str, Any]) -> dict[str, Any]:
        return {name: _put(item, name, named, typed) for name, item in arguments.items()}

    parameters = signature(recomputation(claim)).parameters
    left = {name: p.default for name, p in parameters.items() if name not in claim.arguments}
    arguments = put(claim.arguments) | {n: v for n, v in put(left).items() if v != left[n]}
    return replace(claim, arguments=arguments, assume=put(claim.assume))


@remembered
def reached(symbol: str) -> tuple[Claim, ...]:
    """Return the claims that hang on an input, but for those that print it.

    >>> [claim.id for claim in reached("kp")]
    ['4.3-gains', '4.3-settling-full-model']
    """
    places = input_of(symbol).places
    return tuple(
        claim
        for claim in read_claims()
        if claim.function and claim.id not in places and with_inputs(claim, {symbol: nan}) != claim
    )
