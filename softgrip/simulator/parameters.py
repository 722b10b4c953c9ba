"""What the simulated rig is made of: pump, gas, finger, sensors, and their spread over runs.

A parameter is a number; where each run has a rig of its own, an array of shape (runs,).
"""

from dataclasses import dataclass, field, fields

import numpy as np

from softgrip.arrays import Number, check_positive, is_symbol
from softgrip.checks import check_fields, check_not_negative
from softgrip.errors import InvalidInputError
from softgrip.pump.gas import ATMOSPHERE
from softgrip.units import DEG, ML, MM, PSI, REV

MOST_BITS = 52
"""Of a converter: a floating-point number holds no finer counts. Those of rigs have 10 to 24."""


@dataclass(frozen=True)
class PumpParameters:
    """The syringe and the linear actuator that drives it (Sections 4.2 and 4.4).

    Attributes:
        area: A, m^2.
        lead: l of the screw, m.
        syringe_volume: Air in the syringe when its plunger is drawn out, m^3.
        speed_limit: Largest motor speed, rad/s.
        acceleration_limit: Largest change of motor speed, rad/s^2 (assumed: 0.1 s to full speed).
        backlash: Travel of the screw that is lost to the plunger when it turns round, m. A seal
            that sticks looks the same to the air. At first it is drawn back, so that the first
            push loses it.
    """

    area: Number = 6.61e-4
    lead: Number = 8 * MM
    syringe_volume: Number = 60 * ML
    speed_limit: Number = 5 * REV
    acceleration_limit: Number = 50 * REV
    backlash: Number = 0.0

    def __post_init__(self) -> None:
        check_fields(self, zero=("backlash",))

    @property
    def stroke(self) -> Number:
        """Travel of the plunger, m."""
        return self.syringe_volume / self.area

    @property
    def advance(self) -> Number:
        """Travel of the plunger per angle of the motor, ``l / 2 pi``, m/rad."""
        return self.lead / REV


@dataclass(frozen=True)
class GasParameters:
    """The air: ideal, and at the temperature of the room (Section 4.2).

    Attributes:
        temperature: K (assumed).
        atmosphere: Pa, absolute (standard).
        dead_volume: Tube and fittings, m^3 (assumed: 0.4 m of 2.5 mm bore).
        leakage: G of the leak ``n R T' = -G (P**2 - P_atm**2) / 2``, m^3/(s Pa): laminar flow of a
            gas through a narrow gap (assumed: 0.2 % of the air a second at 0.15 MPa).
    """

    temperature: Number = 293.15
    atmosphere: Number = ATMOSPHERE
    dead_volume: Number = 2 * ML
    leakage: Number = 7e-13

    def __post_init__(self) -> None:
        check_fields(self, zero=("leakage", "dead_volume"))


@dataclass(frozen=True)
class FingerParameters:
    """The finger. `softgrip.simulator.fitted_rigs` gives those of Design 1.

    Attributes:
        stiffness: K of the settled torque ``K theta**n``, N m/rad^n.
        fractional_power: n, >= 1.
        inertia: kg m^2: what the printed frequency asks for, far above that of the rubber alone.
        damping: N m s/rad.
        torque_per_pressure: N m/Pa. It is also the growth of the finger's volume with its angle,
            m^3/rad: the work that the air does when the finger bends is the work of the torque.
        rest_volume: Air in the finger at rest, m^3.
        ballooning: Growth of its volume with pressure at a held angle, m^3/Pa (assumed).
        memory: Parts of the settled torque that the branches of the memory add at once,
            dimensionless.
        memory_time: Their relaxation times, s (both assumed).
        friction: Torque of dry friction, N m (assumed), smoothed below `friction_rate`, rad/s.
    """

    stiffness: Number
    fractional_power: Number
    inertia: Number
    damping: Number
    torque_per_pressure: Number
    rest_volume: Number
    ballooning: Number = 6e-12
    memory: tuple[Number, ...] = (0.08, 0.05)
    memory_time: tuple[Number, ...] = (0.5, 8.0)
    friction: Number = 1e-4
    friction_rate: Number = 0.05

    def __post_init__(self) -> None:
        check_fields(
            self,
            zero=("damping", "ballooning", "friction", "torque_per_pressure"),
            other=("memory", "memory_time"),
        )
        if np.any(self.fractional_power < 1):
            raise InvalidInputError("fractional_power", expected=">= 1", got=self.fractional_power)
        if len(self.memory) != len(self.memory_time):
            raise InvalidInputError("memory", expected="one for each memory_time", got=self.memory)
        for part, time in zip(self.memory, self.memory_time, strict=True):
            check_not_negative(memory=part)
            check_positive(memory_time=time)


@dataclass(frozen=True)
class SensorParameters:
    """The two sensors and the converter (Sections 4.4 and 6.4).

    Both sensors are first-order lags. Their outputs span the middle of the converter's scale, from
    `low_count` to `high_count`, as 0.5 to 4.5 V of 5 V do.

    Attributes:
        pressure_range: Pa, gauge.
        pressure_noise: Pa, root mean square (assumed).
        pressure_lag: s (assumed).
        angle_range: rad; a finger that bends further reads this.
        angle_noise: rad, root mean square.
        angle_lag: s (assumed).
        low_count, high_count: Counts at zero and at the end of the range.
        bits: Of the converter, 1 to `MOST_BITS`.
    """

    pressure_range: Number = 80 * PSI
    pressure_noise: Number = 500.0
    pressure_lag: Number = 0.015
    angle_range: Number = 100 * DEG
    angle_noise: Number = 2 * DEG
    angle_lag: Number = 0.04
    low_count: Number = 102.3
    high_count: Number = 920.7
    bits: Number = 10

    def __post_init__(self) -> None:
        check_fields(self, zero=("pressure_noise", "angle_noise", "low_count"))
        if not np.all(np.asarray(self.bits) <= MOST_BITS):
            raise InvalidInputError("bits", expected=f"1 to {MOST_BITS}", got=self.bits)
        rising = (self.low_count < self.high_count) & (self.high_count <= self.largest_count)
        if not np.all(rising):
            raise InvalidInputError(
                "low_count, high_count",
                expected=f"rising, up to {self.largest_count}",
                got=(self.low_count, self.high_count),
            )

    @property
    def largest_count(self) -> Number:
        """Count at the end of the converter's scale."""
        return 2**self.bits - 1


MOST_SPREAD = 3.0
"""Of a logarithm: one run in three is then twenty times off, and none is a repeat of another."""


@dataclass(frozen=True)
class Spread:
    """Standard deviation of the logarithm of what differs from run to run, dimensionless.

    Attributes:
        stiffness, damping: Of the finger; the first is calibrated, the second assumed.
        leakage: Of the air path (assumed).
    """

    stiffness: Number = 0.0
    damping: Number = 0.0
    leakage: Number = 0.0

    def __post_init__(self) -> None:
        check_fields(self, zero=("stiffness", "damping", "leakage"))
        for entry in fields(self):
            if not is_symbol(found := getattr(self, entry.name)) and np.any(found > MOST_SPREAD):
                raise InvalidInputError(
                    entry.name, expected=f"a spread of at most {MOST_SPREAD:g}", got=found
                )


@dataclass(frozen=True)
class RigParameters:
    """All of a simulated rig: fingers on one syringe, one pressure sensor, a flex sensor each.

    Attributes:
        fingers: One to five, with as many branches of memory each.
        pump: Common to all.
        spread: From run to run, of each finger by itself; the leak is common.

    Raises:
        InvalidInputError: If the fingers are none, too many, or have other numbers of branches.
    """

    fingers: tuple[FingerParameters, ...]
    pump: PumpParameters = field(default_factory=PumpParameters)
    gas: GasParameters = field(default_factory=GasParameters)
    sensors: SensorParameters = field(default_factory=SensorParameters)
    spread: Spread = field(default_factory=Spread)

    def __post_init__(self) -> None:
        branches = {len(finger.memory) for finger in self.fingers}
        if not 1 <= len(self.fingers) <= 5 or len(branches) != 1:
            raise InvalidInputError(
                "fingers",
                expected="one to five, with as many branches of memory each",
                got=(len(self.fingers), branches),
            )

    @property
    def finger(self) -> FingerParameters:
        """The finger, or the first of several."""
        return self.fingers[0]
