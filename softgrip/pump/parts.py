"""The parts a pump is chosen from: syringes, screws and stepper motors.

Areas, volumes of the 60 and 200 mL syringes and leads are the dissertation's (Section 4.2, Table
4.1). The rest are typical values of such parts, named with their source; put your own in.
"""

from dataclasses import dataclass
from math import pi

import numpy as np

from softgrip.arrays import Value, check_positive
from softgrip.checks import check_not_negative
from softgrip.errors import InvalidInputError
from softgrip.pump.flow import TABLE_4_1
from softgrip.units import ML, REV


@dataclass(frozen=True)
class Syringe:
    """A syringe.

    Attributes:
        name: For people.
        volume: m^3, > 0.
        area: Inside cross-section, m^2, > 0.
        friction: Force that the sliding seal takes, N, >= 0; 0 where it was not measured.
    """

    name: str
    volume: float
    area: float
    friction: float = 0.0

    def __post_init__(self) -> None:
        check_positive(volume=self.volume, area=self.area)
        check_not_negative(friction=self.friction)

    @property
    def stroke(self) -> float:
        """Length of the whole stroke, m."""
        return self.volume / self.area


@dataclass(frozen=True)
class Screw:
    """A screw drive.

    Attributes:
        name: For people.
        lead: m a turn, > 0.
        efficiency: Work out over work in, in (0, 1].
    """

    name: str
    lead: float
    efficiency: float

    def __post_init__(self) -> None:
        check_positive(lead=self.lead, efficiency=self.efficiency)
        if self.efficiency > 1:
            raise InvalidInputError("efficiency", expected="in (0, 1]", got=self.efficiency)

    def force(self, torque: Value) -> Value:
        """Return the thrust that a torque gives, ``2 pi eta T / l``, N for N m.

        >>> round(Screw("", 0.008, 0.9).force(0.4))
        283
        """
        return torque * (2 * pi * self.efficiency / self.lead)

    def torque(self, force: Value) -> Value:
        """Return the torque that a thrust takes, N m for N: the inverse of `force`."""
        return force * (self.lead / (2 * pi * self.efficiency))


@dataclass(frozen=True)
class Motor:
    """A stepper motor with its driver: torque falling in a straight line with speed.

    Attributes:
        name: For people.
        holding_torque: At standstill, N m, > 0.
        no_torque_speed: Where the line reaches zero, rad/s, > 0.
        speed_limit: Highest speed that the rig allows, rad/s, > 0; infinity for none.
    """

    name: str
    holding_torque: float
    no_torque_speed: float
    speed_limit: float = float("inf")

    def __post_init__(self) -> None:
        check_positive(holding_torque=self.holding_torque, no_torque_speed=self.no_torque_speed)
        if not self.speed_limit > 0:
            raise InvalidInputError("speed_limit", expected="a number > 0", got=self.speed_limit)

    def torque(self, speed: Value) -> Value:
        """Return the torque at a speed in rad/s of either sign, N m; zero from its end on."""
        result: Value = self.holding_torque * np.maximum(
            0.0, 1 - np.abs(speed) / self.no_torque_speed
        )
        return result

    def speed(self, torque: float) -> float:
        """Return the highest speed that leaves a torque, rad/s, within the limit; 0 if none does.

        >>> Motor("", holding_torque=0.4, no_torque_speed=60.0).speed(0.1)
        45.0
        """
        free = self.no_torque_speed * (1 - torque / self.holding_torque)
        return min(max(0.0, free), self.speed_limit)


def winding_limited_speed(
    voltage: float, inductance: float, current: float, *, rotor_teeth: int = 50
) -> float:
    """Estimate the speed where a stepper has lost its torque: ``U / (N L I)``.

    There the reactance of the winding, N omega L, takes the whole supply to pass the rated
    current. Beyond it torque falls about as 1/speed, so it errs to the safe side.

    Args:
        voltage: Supply of the driver, V, > 0.
        inductance: Of a phase, H, > 0.
        current: Rated, of a phase, A, > 0.
        rotor_teeth: N, 50 for a step of 1.8 degrees.

    Returns:
        float: rad/s.

    >>> round(winding_limited_speed(24.0, 3.0e-3, 2.0))  # 12.7 rev/s
    80
    """
    check_positive(voltage=voltage, inductance=inductance, current=current, rotor_teeth=rotor_teeth)
    return voltage / (rotor_teeth * inductance * current)


SUPPLY = 24.0
"""Of the motors' drivers, V: ours, as none is printed."""


def _nema_17(name: str, torque: float, inductance: float, current: float) -> Motor:
    free = winding_limited_speed(SUPPLY, inductance, current)
    return Motor(f"NEMA 17, {name}", torque, free, speed_limit=5 * REV)


SYRINGES = (
    Syringe("60 mL", 60 * ML, TABLE_4_1["area"][0]),
    Syringe("200 mL", 200 * ML, TABLE_4_1["area"][1]),
)
"""The two of Section 4.2. No area is printed for one of 150 mL; measure yours and add it."""

SCREWS = (
    Screw("8 mm", TABLE_4_1["lead"][0], 0.9),
    Screw("2 mm", TABLE_4_1["lead"][1], 0.9),
)
"""The two leads of Table 4.1; 0.9 is typical of ball screws (sliding screws: 0.2 to 0.5)."""

MOTORS = (
    _nema_17("34 mm", 0.27, 6.6e-3, 1.0),
    _nema_17("40 mm", 0.35, 7.5e-3, 1.0),
    _nema_17("48 mm", 0.59, 3.0e-3, 2.0),
)
"""Three lengths of the frame; the print gives no torque. Holding torque, inductance and current
are the makers' for Trinamic QSH4218-35-10-027 and -41-10-035 and Stepperonline 17HS19-2004S1; the
limit of 5 rev/s is that of Section 3.4."""
