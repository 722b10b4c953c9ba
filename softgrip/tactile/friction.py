"""What a grip can lift by friction, Eq. (2.8) and (2.9), how surely, and with which coefficient.

Section 2.4 prints no coefficient, but forces that the two equations join by one. Each is rounded,
so that a pair leaves an interval of coefficients; a single rubber must lie in all of them.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from types import MappingProxyType
from typing import Self

from scipy.stats import norm

from softgrip.arrays import Value, check_positive
from softgrip.errors import InvalidInputError
from softgrip.provenance import data_rows
from softgrip.reads import remembered


def contact_force(lift_force: Value, friction: float) -> Value:
    """Return the force with which each of two fingers must press, N: Eq. (2.8).

    Args:
        lift_force: What the fingers are to bear by friction, N, any shape; it should exceed the
            weight.
        friction: Coefficient of Coulomb's law between finger and object, > 0, the same for both
            fingers.

    Raises:
        InvalidInputError: If the coefficient is not above zero.

    >>> contact_force(0.6, friction=1.0)
    0.3
    """
    check_positive(friction=friction)
    return lift_force / (2 * friction)


def lift_force(contact_force: Value, friction: float) -> Value:
    """Return what two fingers can bear by friction, N: Eq. (2.9); arguments as `contact_force`."""
    check_positive(friction=friction)
    return 2 * friction * contact_force


def holding_probability(lift_force: float, weight: float, friction: float, error: float) -> float:
    """Return how probable it is that a grip holds whose force is known by a sensor only.

    The sensor says that the grip lifts `lift_force`; the true contact force deviates from what it
    says by a normal error. The object is held if the true lift force is at least its weight.

    Args:
        lift_force, weight: N.
        friction: As of `contact_force`.
        error: Deviation of the measured contact force, N, > 0.

    Raises:
        InvalidInputError: If friction or error is not above zero, or the weight is below it.

    A lift force that is the weight holds every second time, whatever the sensor.

    >>> holding_probability(0.6, 0.6, friction=1.0, error=0.015)
    0.5
    """
    check_positive(error=error)
    if not weight >= 0:
        raise InvalidInputError("weight", expected="N, >= 0", got=weight)
    spare = contact_force(lift_force - weight, friction)
    return float(norm.cdf(spare / error))


PRINTED_GRASPS = "tactile/grasp_printed.csv"


@dataclass(frozen=True)
class Interval:
    """The numbers from `low` to `high`, ends included; 0 <= low <= high."""

    low: float
    high: float

    def __post_init__(self) -> None:
        if not 0 <= self.low <= self.high:
            raise InvalidInputError("interval", expected="0 <= low <= high", got=self)

    @classmethod
    def of_print(cls, text: str) -> Self:
        """Return the numbers >= 0 that are printed so when rounded to the same place.

        Raises:
            InvalidInputError: If the text is no number >= 0.

        >>> Interval.of_print("0.09"), Interval.of_print("0.3")
        (Interval(low=0.085, high=0.095), Interval(low=0.25, high=0.35))
        """
        try:
            number = Decimal(text)
            half = Decimal(5).scaleb(int(number.as_tuple().exponent) - 1)
        except (InvalidOperation, ValueError):
            raise InvalidInputError("text", expected="a printed number", got=text) from None
        if number < 0:
            raise InvalidInputError("text", expected="a number >= 0", got=text)
        # In decimals, as 0.3 - 0.05 in binary is not the float nearest to 0.25.
        return cls(float(max(number - half, Decimal(0))), float(number + half))

    @property
    def middle(self) -> float:
        """Half way between the ends."""
        return (self.low + self.high) / 2


def friction_interval(contact_force: Interval, lift_force: Interval) -> Interval:
    """Return the coefficients that join two rounded forces.

    The same function gives, for a weight in the place of the lift force, the coefficient that the
    friction must exceed for the weight to be held.

    Args:
        contact_force, lift_force: N; the contact force lies wholly above zero.

    Raises:
        InvalidInputError: If the contact force may be zero.

    >>> found = friction_interval(Interval.of_print("0.09"), Interval.of_print("0.19"))
    >>> round(found.low, 3), round(found.high, 3)  # 0.185 / 0.19, 0.195 / 0.17
    (0.974, 1.147)
    """
    if not contact_force.low > 0:
        raise InvalidInputError("contact_force", expected="N, > 0", got=contact_force)
    return Interval(
        lift_force.low / (2 * contact_force.high), lift_force.high / (2 * contact_force.low)
    )


def intersection(intervals: Iterable[Interval]) -> Interval | None:
    """Return what intervals have in common, or None; there must be at least one."""
    given = [*intervals]
    if not given:
        raise InvalidInputError("intervals", expected="at least one", got=given)
    low, high = max(i.low for i in given), min(i.high for i in given)
    return Interval(low, high) if low <= high else None


@dataclass(frozen=True)
class PrintedGrasp:
    """What Section 2.4 prints of a grasp, as strings in N.

    Attributes:
        contact: Desired contact force.
        lift: Estimated lift force.
        weight: Of the object.
    """

    contact: str
    lift: str
    weight: str

    @property
    def friction(self) -> Interval:
        """The coefficients that agree, if the measured force at rest is the desired one."""
        return friction_interval(Interval.of_print(self.contact), Interval.of_print(self.lift))

    @property
    def least_friction(self) -> Interval:
        """Where the coefficient lies at which the desired force just bears the weight."""
        return friction_interval(Interval.of_print(self.contact), Interval.of_print(self.weight))


@remembered
def printed_grasps() -> Mapping[str, PrintedGrasp]:
    """Return the three grasps of Section 2.4 by object, in the order of the text."""
    return MappingProxyType(
        {
            row["object"]: PrintedGrasp(
                row["contact force [N]"], row["lift force [N]"], row["weight [N]"]
            )
            for row in data_rows(PRINTED_GRASPS)
        }
    )


@remembered
def common_friction() -> Interval | None:
    """Return the coefficients that agree with all three printed grasps, or None."""
    return intersection(grasp.friction for grasp in printed_grasps().values())
