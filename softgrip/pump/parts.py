"""The parts a pump is chosen from: syringes, screws and stepper motors.

Areas, volumes of the 60 and 200 mL syringes and leads are the dissertation's (Section 4.2, Table
4.1). The rest are typical values of such parts, named with their source; put your own in.
"""

from dataclasses import dataclass
from math import pi

from softgrip.arrays import Value
from softgrip.checks import check_above_zero, check_not_negative
from softgrip.errors import InvalidInputError
from softgrip.pump.flow import TABLE_4_1
from softgrip.pump.motor import Motor, winding_limited_speed
from softgrip.units import ML, REV


@dataclass(frozen=True)
class Syringe:
    """A syringe.

    Attributes
    ----------
    name
        For people.
    volume
        m^3, > 0.
    area
        Inside cross-section, m^2, > 0.
    friction
        Force that the sliding seal takes, N, >= 0; 0 where it was not measured.
    """

    name: str
    volume: float
    area: float
    friction: float = 0.0

    def __post_init__(self) -> None:
        check_above_zero(volume=self.volume, area=self.area)
        check_not_negative(friction=self.friction)

    @property
    def stroke(self) -> float:
        """Length of the whole stroke, m."""
        return self.volume / self.area


@dataclass(frozen=True)
class Screw:
    """A screw drive.

    Attributes
    ----------
    name
        For people.
    lead
        m a turn, > 0.
    efficiency
        Work out over work in, in (0, 1].
    """

    name: str
    lead: float
    efficiency: float

    def __post_init__(self) -> None:
        check_above_zero(lead=self.lead, efficiency=self.efficiency)
        if self.efficiency > 1:
            raise InvalidInputError("efficiency", expected="in (0, 1]", got=self.efficiency)

    def force(self, torque: Value) -> Value:
        """Return the thrust that a torque gives, ``2 pi eta T / l``, N for N m.

        Examples
        --------
        >>> round(Screw("", 0.008, 0.9).force(0.4))
        283
        """
        return torque * (2 * pi * self.efficiency / self.lead)

    def torque(self, force: Value) -> Value:
        """Return the torque that a thrust takes, N m for N: the inverse of `force`."""
        return force * (self.lead / (2 * pi * self.efficiency))


def _nema_17(name: str, torque: float, inductance: float, current: float) -> Motor:
    free = winding_limited_speed(24.0, inductance, current)
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
supply of 24 V is ours; the limit of 5 rev/s is that of Section 3.4."""
