"""From motor speed to air flow: the pump's kinematics and its parameter sets, Table 4.1."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from types import MappingProxyType

from softgrip.arrays import Value, check_positive
from softgrip.errors import UnknownNameError
from softgrip.plausible import AREA, LEAD
from softgrip.quantities import fields_in_si
from softgrip.units import REV


@dataclass(frozen=True)
class Pump:
    """A syringe on a screw; words such as ``"8 mm"``, or quantities of `pint`, are put into SI.

    Attributes:
        area: Inside cross-section A of the syringe, m^2, > 0.
        lead: Travel l of the slider in one turn of the screw, m, > 0.

    Raises:
        InvalidInputError: If one is not above zero, or no pump has it: `plausible`.
    """

    area: float
    lead: float

    def __post_init__(self) -> None:
        fields_in_si(self, {"area": "m^2", "lead": "m"})
        check_positive(area=self.area, lead=self.lead)
        AREA.check("area", self.area)
        LEAD.check("lead", self.lead)

    @property
    def displacement(self) -> float:
        """Volume swept per angle of the motor, A l / (2 pi), m^3/rad."""
        return self.area * self.lead / (2 * pi)


@dataclass(frozen=True)
class PumpRun:
    """A pump driven at one motor speed.

    Attributes:
        pump: The pump.
        motor_speed: omega_m, rad/s; below zero the plunger is pulled.
    """

    pump: Pump
    motor_speed: float

    @property
    def flow(self) -> float:
        """Air flow out of the syringe, m^3/s."""
        return flow(self.motor_speed, self.pump)


def slider_speed(motor_speed: Value, lead: float) -> Value:
    """Return the speed of the slider, Eq. (4.1): ``l omega_m / (2 pi)``.

    Args:
        motor_speed: omega_m, rad/s, any shape.
        lead: l, m, > 0.

    Returns:
        float or ndarray: v_s, m/s, shape of `motor_speed`.

    >>> round(slider_speed(1.65 * REV, 0.008), 6)
    0.0132
    """
    check_positive(lead=lead)
    result: Value = lead / (2 * pi) * motor_speed
    return result


def flow(motor_speed: Value, pump: Pump) -> Value:
    """Return the air flow out of the syringe, Eq. (4.2): ``A v_s``.

    It is the volume that the plunger sweeps, at the pressure in the syringe; not a flow at
    standard conditions.

    Args:
        motor_speed: omega_m, rad/s, any shape.
        pump: The pump.

    Returns:
        float or ndarray: Q_i, m^3/s, shape of `motor_speed`.

    >>> round(flow(1.65 * REV, Pump(area=6.61e-4, lead=0.008)) * 1e6, 4)  # mL/s
    8.7252
    """
    return slider_speed(motor_speed, pump.lead) * pump.area


TABLE_4_1: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        "area": (6.61e-4, 16.62e-4),
        "lead": (0.008, 0.002),
        "motor_speed": (1.65 * REV, 3.30 * REV),
    }
)
"""Both printed values of each design parameter, in m^2, m and rad/s; the first is the default."""

_A, _L, _W = TABLE_4_1.values()

PARAMETER_SETS: Mapping[str, PumpRun] = MappingProxyType(
    {
        "default": PumpRun(Pump(_A[0], _L[0]), _W[0]),
        "larger area": PumpRun(Pump(_A[1], _L[0]), _W[0]),
        "smaller lead": PumpRun(Pump(_A[0], _L[1]), _W[0]),
        "higher speed": PumpRun(Pump(_A[0], _L[0]), _W[1]),
        "optimal": PumpRun(Pump(_A[1], _L[0]), _W[1]),
    }
)
"""The runs of Fig. 4.3, one parameter changed at a time, and the best set of Section 4.2."""


def parameter_set(name: str) -> PumpRun:
    """Return a set of Section 4.2 by its name in `PARAMETER_SETS`.

    Raises:
        UnknownNameError: If there is no such set; the message lists those that are.

    >>> parameter_set("optimal").pump
    Pump(area=0.001662, lead=0.008)
    """
    try:
        return PARAMETER_SETS[name]
    except KeyError:
        raise UnknownNameError("parameter set", name, list(PARAMETER_SETS)) from None
