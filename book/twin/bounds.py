"""Bounds on what any rig of the declared space can give, in closed form.

Where a search finds no rig for a print it may not have searched well. A bound needs no search. Each
takes the corner of the space that is best for the print; random rigs are run beside it.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

import numpy as np

from book.twin.gripper_tests import REST
from book.twin.laboratory import STROKE
from book.twin.misfit import RIGS, laboratory
from book.twin.problem import error_of
from book.twin.recipes import measured
from book.twin.space import space
from book.twin.targets import Target, targets
from softgrip.arrays import Floats
from softgrip.gripper.internal_model import PERIOD
from softgrip.logs.pushes import HIGH
from softgrip.logs.steps import WINDOW
from softgrip.pump.gas import ATMOSPHERE
from softgrip.simulator.gripper_steps import OPEN_LOOP_DURATION
from softgrip.simulator.motor import travel
from softgrip.simulator.parameters import PumpParameters
from softgrip.simulator.statics import FULL_PRESSURE
from softgrip.units import DEG, MM, REV, MPa

Side = Literal["at most", "at least"]


@dataclass(frozen=True)
class Bound:
    """What no rig passes.

    Attributes:
        value: In the target's unit.
        side: On which side of it all rigs are.
        reason: In a sentence.
        holds: For what it is proven, if that is not every rig.
    """

    value: float
    side: Side
    reason: str
    holds: str = ""


def highest_frequency() -> Bound:
    """Bound the highest excited frequency, rad/s: Nyquist's."""
    reason = f"records of {PERIOD:g} s show no frequency above half their rate"
    return Bound(np.pi / PERIOD, "at most", reason)


def _lowest(periods: int, reason: str) -> Bound:
    """Bound the lowest excited frequency of a record of so many periods at least, rad/s.

    Of n equal commands in a record of N the lines of the spectrum, 0 left out, are ``sin(pi m n /
    N) / sin(pi m / N)`` in size: none is larger than the first, which therefore always counts.
    """
    why = f"the first line of a push's spectrum is its largest, and stands at one swing a {reason}"
    return Bound(2 * np.pi / (periods * PERIOD), "at most", why)


def lowest_frequency() -> Bound:
    """Bound the lowest excited frequency of the steps at high speed, rad/s."""
    return _lowest(round(OPEN_LOOP_DURATION / PERIOD), f"record, of {OPEN_LOOP_DURATION:g} s")


def lowest_slow_frequency() -> Bound:
    """Bound that of the steps at low speed, rad/s: by the shortest push, and the rest after it."""
    travelled = space()["choice.gripper_travel"].low * MM
    speed = PumpParameters().advance * space()["choice.low_speed"].high * REV
    pushing = int(np.ceil(travelled / (speed * PERIOD) - 1e-9))
    return _lowest(pushing + round(REST / PERIOD), "record, which is longer than its rest")


def swept(pressure: Floats, volume: Floats, growth: Floats) -> Floats:
    """Return what a plunger sweeps until gauge pressures, m^3, of closed air at one temperature.

    Args:
        pressure: Gauge, Pa.
        volume: At the start, m^3.
        growth: Of the finger, m^3; all broadcast.
    """
    return np.asarray(volume * pressure / (ATMOSPHERE + pressure) + growth)


def constant_capacity() -> Bound:
    """Bound the error of the constant capacity at high pressure, %.

    By the gas law a gauge pressure p takes ``q = V p / (P_atm + p) + g``, V the air at the start
    and g the growth of the finger, which bends by ``p^(1/n)``, n >= 1, and balloons by p: so g / p
    does not rise with p. The fitted capacity is a mean of q / p over pressures up to b, so is at
    least that at b, hence ``q / p + d`` with q and p of the end and ``d = V / (P_atm + b) -
    V / (P_atm + p)``. The model over the truth is ``q / p / C``, at most ``x / (x + d)`` with
    ``x = q / p``. That is largest for the longest stroke, the smallest V, the largest b and the
    smallest p that counts as high.
    """
    known = space()
    volume = STROKE + known["finger.rest_volume"].low + known["gas.dead_volume"].low
    below = known["choice.capacity_below"].high * MPa
    d = volume * (1 / (ATMOSPHERE + below) - 1 / (ATMOSPHERE + HIGH))
    x = STROKE / HIGH
    return Bound(
        100 * (x / (x + d) - 1),
        "at most",
        "a syringe that empties makes the pressure rise ever faster, and a finger grows ever slower"
        " with pressure: a line fitted below lies below above",
        "proven for a closed rig whose finger rests at each pressure, without dry friction; the"
        " rest is tried",
    )


def least_time(
    angle: float, frequency: float, full_angle: float, power: float, volume: float, ramp: float
) -> float:
    """Return the least time in which a pump can turn a finger from rest, s.

    Whatever the controller, if it does not turn the finger back on its way: so long the memory,
    too, holds it back.
    The plunger goes as fast as it can into air whose volume does not grow, and nothing holds the
    finger back: no stiffness, damping, friction or memory. Its torque over its inertia is
    ``frequency^2 full_angle^n / n`` times the pressure over 0.15 MPa.

    Args:
        angle: rad.
        frequency: Of small motions at 1 rad, rad/s.
        full_angle: At 0.15 MPa, rad.
        power: n of the rubber.
        volume: Of the air at the start, m^3.
        ramp: Largest acceleration of the motor, rad/s^2.
    """
    pump = PumpParameters(acceleration_limit=ramp)
    time = np.linspace(0, LONGEST, TIMES)
    q = pump.area * np.asarray(travel(0.0, pump.speed_limit, time, pump))
    left = np.maximum(volume - q, 1e-12)
    push = frequency**2 * full_angle**power / power * ATMOSPHERE * q / left / FULL_PRESSURE
    # Sums from the right end of each interval: no less than the integrals, as the push rises.
    turned = np.cumsum(np.cumsum(push) * time[1]) * time[1]
    return float(time[np.argmax(turned >= angle) - 1])


LONGEST, TIMES = 3.0, 30001
"""s, and the points at which the motion is summed: the plunger is at its end by then."""


def regulator_settling() -> Bound:
    """Bound the settling time of the regulator, s: by `least_time` at the fastest corner.

    It falls with each of frequency, angle at 0.15 MPa, power (as that angle is beyond e^(1/n)
    rad) and ramp, and rises with the volume.
    """
    known = space()
    angle = known["choice.lqr_step"].low - known["choice.lqr_band"].high
    least = least_time(
        angle * DEG,
        known["finger.frequency"].high,
        known["finger.full_angle"].high * DEG,
        known["rubber.power"].high,
        PumpParameters().syringe_volume
        + known["finger.rest_volume"].low
        + known["gas.dead_volume"].low,
        known["pump.acceleration_limit"].high,
    )
    reason = (
        f"the pump cannot turn the finger to the band of the smallest step in less than {least:.2g}"
        f" s; but a record is averaged over {WINDOW:g} s, half of it ahead"
    )
    return Bound(max(least - WINDOW / 2, 0.0), "at least", reason)


BOUNDS: Mapping[str, Callable[[], Bound]] = MappingProxyType(
    {
        "3.4-lqr-settling-measured": regulator_settling,
        "4.4-constant-error": constant_capacity,
        "6.4-excited-low-both-fingers": lowest_frequency,
        "6.4-excited-high": highest_frequency,
        "6.4-excited-low-speeds": lowest_slow_frequency,
        "6.4-excited-high-speeds": highest_frequency,
    }
)
"""By target."""


def excludes(bound: Bound, target: Target) -> bool:
    """Return whether a bound keeps every rig farther from a print than its error."""
    error = error_of(target) * target.tolerance
    beyond = target.value - bound.value
    return bool(error < (beyond if bound.side == "at most" else -beyond))


@dataclass(frozen=True)
class Tried:
    """What random rigs of the space give beside a bound.

    Attributes:
        id: Of the target.
        rigs: How many were run of which it could be told.
        nearest: What came nearest to the bound, or passed it most, in the target's unit.
    """

    id: str
    rigs: int
    nearest: float


MANY = 1024


def tried(rigs: int = MANY) -> Iterator[Tried]:
    """Run rigs that are drawn evenly from the space through the experiments of the bounds."""
    known = {one.id: one for one in targets() if one.id in BOUNDS}
    rng = np.random.default_rng(15)
    rows = np.stack([one.at(rng.random(rigs)) for one in space().values()], axis=1)
    parts = []
    with np.errstate(all="ignore"):
        for first in range(0, rigs, RIGS):
            lab = laboratory(rows[first : first + RIGS])
            parts.append(measured(lab, dict.fromkeys(one.experiment for one in known.values())))
    for name, make in BOUNDS.items():
        own = known[name].experiment, known[name].quantity
        values = np.concatenate([part[own] for part in parts])
        told = values[np.isfinite(values)]
        farthest = np.max if make().side == "at most" else np.min
        yield Tried(name, told.size, float(farthest(told)))
