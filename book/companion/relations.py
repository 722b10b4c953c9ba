"""Relations between printed numbers: what claims name that hold one print against another."""

from collections.abc import Sequence
from math import pi

from book.companion.claims import read_claims
from softgrip.arrays import Number, largest_of, least_of


def same(value: float, scale: float = 1.0) -> float:
    """Return a number that is printed elsewhere, in another unit by ``scale``."""
    return value * scale


def total(parts: Sequence[float]) -> float:
    """Return a sum; of a difference the subtrahend is given with its sign."""
    return sum(parts)


def difference(value: float, less: float) -> float:
    """Return ``value - less``."""
    return value - less


def ratio(part: float, whole: float, scale: float = 1.0) -> float:
    """Return ``scale * part / whole``; 100 for percent.

    >>> round(ratio(6.15, 90, 100), 3)
    6.833
    """
    return scale * part / whole


def scaled(value: float, part: float, whole: float) -> float:
    """Return a number in proportion: ``value * part / whole``."""
    return value * part / whole


def mean(values: Sequence[float]) -> float:
    """Return the arithmetic mean."""
    return sum(values) / len(values)


def largest(values: Sequence[Number]) -> Number:
    """Return the largest of printed numbers."""
    return largest_of(values)


def least(values: Sequence[Number]) -> Number:
    """Return the least of printed numbers."""
    return least_of(values)


def upper_limit(stated: Number, reached: Sequence[Number]) -> Number:
    """Return the limit that values need: the stated one, or the largest that lies above it.

    >>> upper_limit(5.0, [20.0, 14.4]), upper_limit(24.0, [20.0, 14.4])
    (20.0, 24.0)
    """
    return largest_of([stated, *reached])


def lower_limit(stated: Number, reached: Sequence[Number]) -> Number:
    """Return the limit that values need: the stated one, or the least that lies below it."""
    return least_of([stated, *reached])


def number_of(values: Sequence[object]) -> Number:
    """Count what is listed in print."""
    return len(values)


def change(after: float, before: float) -> Number:
    """Return by how many percent ``after`` differs from ``before``, without a sign."""
    return 100 * abs(after / before - 1)


def largest_ratio(parts: Sequence[float], wholes: Sequence[float]) -> Number:
    """Return the largest of the ratios of parts to wholes, pair by pair.

    >>> largest_ratio([1.0, 3.0], [2.0, 4.0])
    0.75
    """
    return max(part / whole for part, whole in zip(parts, wholes, strict=True))


def largest_change(after: Sequence[float], before: Sequence[float]) -> Number:
    """Return the largest `change`, pair by pair, in percent.

    >>> round(largest_change([2.365, 1.727], [2.174, 1.538]), 2)
    12.29
    """
    return max(map(change, after, before))


def degrees(radians: float) -> float:
    """Convert an angle."""
    return radians * 180 / pi


def nearest_share(percent: float, whole: float) -> float:
    """Return the share, in percent, of a whole number of cases that comes nearest to a printed one.

    >>> round(nearest_share(96.4, 504), 2)
    96.43
    """
    return 100 * round(percent / 100 * whole) / whole


def section_of(claim: str) -> float:
    """Return the number of the section in which a claim stands, to hold a reference against.

    >>> section_of("2.4-objects-bagged")
    2.4
    """
    where = {found.id: found.where for found in read_claims()}[claim]
    return float(where.removeprefix("Section "))
