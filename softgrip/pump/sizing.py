"""Which syringe, screw and motor a finger needs.

The torque is taken at the end of the stroke, where the pressure is highest, at the speed that the
rise time asks for. What it cannot tell is how smoothly a motor near its limit runs; it tells how
near it is.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product
from typing import Literal, get_args

from softgrip.arrays import Number
from softgrip.errors import InvalidInputError
from softgrip.pump.finger import Finger, swept_volume
from softgrip.pump.flow import Pump
from softgrip.pump.gas import ATMOSPHERE
from softgrip.pump.parts import MOTORS, SCREWS, SYRINGES, Motor, Screw, Syringe
from softgrip.units import ML, REV

Order = Literal["margin", "rise time"]


@dataclass(frozen=True)
class Sizing:
    """One combination, judged.

    Attributes:
        syringe, screw, motor: The combination.
        stroke: Travel of the plunger from the start to the pressure, m.
        motor_speed: That the rise time asks for, rad/s.
        thrust: Of the gas and the seal at the end of the stroke, N.
        torque_needed, torque_available: At the end of the stroke, at that speed, N m.
        fastest_rise: Shortest rise time that keeps the margin asked for, s; infinity if there is
            none.
        reasons: Why it cannot do it; empty if it can.
    """

    syringe: Syringe
    screw: Screw
    motor: Motor
    stroke: float
    motor_speed: float
    thrust: float
    torque_needed: float
    torque_available: float
    fastest_rise: float
    reasons: tuple[str, ...]

    @property
    def margin(self) -> float:
        """Torque available over torque needed."""
        return self.torque_available / self.torque_needed

    @property
    def feasible(self) -> bool:
        """Whether nothing speaks against it."""
        return not self.reasons


def loads(
    finger: Finger,
    syringe: Syringe,
    screw: Screw,
    motor: Motor,
    start_volume: float,
    atmosphere: float = ATMOSPHERE,
) -> tuple[Number, Number, Number, Number, Number]:
    """Return what a push asks for at its end: the law of `size`, for symbols too.

    Args:
        finger: Of floats or symbols.
        syringe, screw, motor: The parts.
        start_volume: Of air in the syringe, m^3.
        atmosphere: Pa.

    Returns:
        The swept volume, m^3, the motor's speed, rad/s, the thrust, N, and the torques needed and
        available, N m.
    """
    swept = swept_volume(finger, start_volume, atmosphere)
    speed = swept / Pump(syringe.area, screw.lead).displacement / finger.rise_time
    # The atmosphere pushes on the plunger from outside: the motor feels the gauge pressure.
    thrust = finger.gauge_pressure * syringe.area + syringe.friction
    return swept, speed, thrust, screw.torque(thrust), motor.torque(speed)


def size(
    finger: Finger,
    syringe: Syringe,
    screw: Screw,
    motor: Motor,
    *,
    fill: float = 1.0,
    least_margin: float = 1.5,
    atmosphere: float = ATMOSPHERE,
) -> Sizing:
    """Judge one combination.

    Args:
        finger: What is wanted.
        syringe, screw, motor: The parts.
        fill: Part of the syringe's volume that holds air at the start, in (0, 1].
        least_margin: Torque available over needed to ask for, >= 1; 1.5 is what Parker advises for
            steppers.
        atmosphere: Pressure outside and at the start, Pa, > 0.

    Raises:
        InvalidInputError: If the fill or the margin is out of range or the atmosphere is not above
            zero.
    """
    if not 0 < fill <= 1:
        raise InvalidInputError("fill", expected="a number in (0, 1]", got=fill)
    if not least_margin >= 1:
        raise InvalidInputError("least_margin", expected="a number >= 1", got=least_margin)
    start_volume = fill * syringe.volume
    swept, speed, thrust, needed, available = loads(
        finger, syringe, screw, motor, start_volume, atmosphere
    )
    turns = speed * finger.rise_time
    fastest = motor.speed(least_margin * needed)
    reasons = []
    if swept > start_volume:
        reasons.append(
            f"the syringe holds {start_volume / ML:.1f} mL, {swept / ML:.1f} mL are needed"
        )
    if speed > motor.speed_limit:
        reasons.append(
            f"{speed / REV:.1f} rev/s are needed, {motor.speed_limit / REV:.1f} rev/s are allowed"
        )
    if available < least_margin * needed:
        reasons.append(
            f"{least_margin:g} times {needed:.3f} N m are needed at {speed / REV:.1f} rev/s, "
            f"the motor has {available:.3f} N m"
        )
    return Sizing(
        syringe,
        screw,
        motor,
        stroke=swept / syringe.area,
        motor_speed=speed,
        thrust=thrust,
        torque_needed=needed,
        torque_available=float(available),
        fastest_rise=turns / fastest if fastest > 0 else float("inf"),
        reasons=tuple(reasons),
    )


def sizings(
    finger: Finger,
    syringes: Iterable[Syringe] = SYRINGES,
    screws: Iterable[Screw] = SCREWS,
    motors: Iterable[Motor] = MOTORS,
    *,
    fill: float = 1.0,
    least_margin: float = 1.5,
    atmosphere: float = ATMOSPHERE,
    order: Order = "margin",
) -> list[Sizing]:
    """Judge all combinations: those that can do it first, the best first.

    Args:
        finger: What is wanted.
        syringes, screws, motors: Parts to choose from.
        fill, least_margin, atmosphere: As for `size`.
        order: "margin", largest first, or "rise time", shortest possible first.

    Raises:
        InvalidInputError: If the order is unknown, or as for `size`.

    >>> finger = Finger(0.1e6, 20e-6, 25e-6, 5e-6, rise_time=4.0)
    >>> best = sizings(finger)[0]
    >>> best.syringe.name, best.screw.name, best.feasible
    ('60 mL', '8 mm', True)
    """
    if order not in get_args(Order):
        raise InvalidInputError("order", expected=f"one of {get_args(Order)}", got=order)
    found = [
        size(finger, *parts, fill=fill, least_margin=least_margin, atmosphere=atmosphere)
        for parts in product(syringes, screws, motors)
    ]
    by_margin = order == "margin"
    return sorted(found, key=lambda s: (not s.feasible, -s.margin if by_margin else s.fastest_rise))
