"""Eight simulated hours of a drifting force layer: grasps, pauses, known weights.

In each hour the five objects of Table 2.2 lie on the layer ten times each, in random order, with a
pause after each. Four known weights come before and after all, and one in every quarter of an hour:
a method takes as many of them as it needs.
"""

from dataclasses import dataclass, replace
from math import exp
from typing import Any

import numpy as np

from softgrip.arrays import Flags, Floats
from softgrip.simulator.chance import streams
from softgrip.simulator.force_layer import (
    ForceLayer,
    bridge_voltage,
    conductance,
    felt_force,
    read_counts,
    volts,
)
from softgrip.simulator.force_tests import LOADED, READ, UNLOADED, weight_forces
from softgrip.tactile.drift import DRIFT_WEIGHTS
from softgrip.tactile.drift_curve import KnownWeight
from softgrip.tactile.drift_law import Bridge
from softgrip.tactile.drift_model import HOUR, DriftSize
from softgrip.tactile.force import table_2_2
from softgrip.units import GRAM_FORCE

PERIOD = 1.0
"""s, from sample to sample."""
START = 2.0
"""h after the calibration, at which the hours begin, as those of Figure 2.G (a)."""
HOURS, TIMES = 8, 10
"""Hours, and how often an object is laid down in each."""
HELD = (6, 30)
"""s, least and longest, that an object lies there. Assumed."""
CYCLE = round(HOUR / (len(table_2_2()) * TIMES))
"""s, from one object to the next: 72."""
QUARTER = 0.25
"""h, from one known weight to the next."""
SINGLE = 2
"""Which of the four weights it is: that of 50 gf."""
MISSING = 0.05
"""Share of the samples that are lost: times are not even."""


@dataclass(frozen=True)
class Hold:
    """Something on the layer.

    Attributes:
        begin, seconds: When it is put down, s, and for how long.
        weight: Its true weight, N.
        part: Of it that the layer bears.
        read: s after it was put down, when it is read.
        hour: Of the session; -1 for known weights.
    """

    begin: float
    seconds: float
    weight: float
    part: float
    read: float
    hour: int


@dataclass(frozen=True, eq=False)
class Record:
    """What was read: time (s), voltage (V), the force borne (N), shape (N,).

    Attributes:
        gain, offset: Of the true drift, 1 and V.
        kept: Samples that were not lost.
        holds: What lay there.
    """

    time: Floats
    voltage: Floats
    force: Floats
    gain: Floats
    offset: Floats
    kept: Flags
    holds: tuple[Hold, ...]

    def index(self, hold: Hold) -> int:
        """Return the sample at which something is read."""
        return round((hold.begin + hold.read) / PERIOD)


@dataclass(frozen=True)
class Way:
    """How the layer is used in a session.

    Attributes:
        pauses: Whether something else than the next object comes after each object.
        touched: N, that the layer bears in pauses, unknown to who reads it.
    """

    pauses: bool = True
    touched: float = 0.0


USUAL = Way()


def drawn_rates(size: DriftSize, chance: np.random.Generator) -> tuple[float, float]:
    """Draw the steady rates of a layer's gain, 1/h, and offset, V/h."""
    gain, offset = chance.standard_normal(2)
    return size.gain_rate * gain, size.offset_rate * offset


def drawn_drift(
    size: DriftSize, rates: tuple[float, float], ages: Floats, chance: np.random.Generator
) -> tuple[Floats, Floats]:
    """Draw gain and offset, 1 and V, at rising ages, h, shape (N,)."""
    found = []
    steps = np.diff(ages, prepend=0.0)
    wanders = (size.gain_wander, size.offset_wander)
    for rate, wander in zip(rates, wanders, strict=True):
        drawn = chance.standard_normal(len(ages))
        if size.return_time == np.inf:
            path = np.cumsum(wander * np.sqrt(steps) * drawn)
        else:
            path, last = np.empty(len(ages)), 0.0
            for k, step in enumerate(steps.tolist()):
                last = last * exp(-step / size.return_time)
                last += wander * size.spread(step) ** 0.5 * float(drawn[k])
                path[k] = last
        found.append(rate * ages + path)
    return found[0], found[1]


ABOVE_ZERO = 0.5
"""V, of the unloaded layer at the calibration. Chapter 2 balances the bridge there; drift that goes
down would be cut off at the converter's end, so the bridge is balanced below it. Assumed."""


def bridge_of(layer: ForceLayer) -> Bridge:
    """Return the circuit of a layer."""
    beside, scale = layer.bridge_resistance, layer.supply * layer.amplification
    return Bridge(scale, beside / (beside + layer.rest_resistance) - ABOVE_ZERO / scale)


def drifting_voltage(felt: Floats, gain: Floats, offset: Floats, layer: ForceLayer) -> Floats:
    """Return the voltage without noise, V, for a felt force, N, and a drift."""
    fresh = replace(layer, gain_drift=gain, offset_drift=offset)
    bridge = bridge_voltage(conductance(felt, 1.0, fresh), fresh)
    return ABOVE_ZERO + layer.amplification * bridge + offset


def calibration_holds(layer: ForceLayer, chance: np.random.Generator) -> list[Hold]:
    """Return the 69 weights of Section 2.3, one after the other."""
    parts = np.exp(layer.seating * chance.standard_normal(len(weight_forces())))
    both = zip(weight_forces().tolist(), parts.tolist(), strict=True)
    length = LOADED + UNLOADED
    return [Hold(k * length, LOADED, *weight, READ, -1) for k, weight in enumerate(both)]


def session_holds(layer: ForceLayer, way: Way, chance: np.random.Generator) -> list[Hold]:
    """Return what lies on the layer in a session, in order."""
    holds: list[Hold] = []
    clock = 30.0

    def weigh(weights: tuple[float, ...]) -> None:
        nonlocal clock
        for weight in weights:
            part = exp(layer.seating * chance.standard_normal())
            holds.append(Hold(clock, LOADED, weight * GRAM_FORCE, part, READ, -1))
            clock += LOADED + (UNLOADED if way.pauses else 0.0)

    weigh(DRIFT_WEIGHTS)
    clock += 30.0 if way.pauses else 0.0
    objects = [one.true for one in table_2_2().values()] * TIMES
    quarters = np.arange(round(1 / QUARTER)) * QUARTER
    for hour in range(HOURS):
        due = {round(len(objects) * share) for share in quarters} - ({0} if hour == 0 else set())
        for k, weight in enumerate(chance.permutation(objects).tolist()):
            if k in due:
                weigh((DRIFT_WEIGHTS[SINGLE],))
            held = int(chance.integers(HELD[0], HELD[1] + 1))
            read = float(chance.integers(2, held))
            part = exp(layer.object_seating * chance.standard_normal())
            seconds = float(held if way.pauses else CYCLE)
            holds.append(Hold(clock, seconds, weight, part, read, hour))
            clock += CYCLE
    weigh(DRIFT_WEIGHTS)
    return holds


def recorded(
    holds: list[Hold],
    layer: ForceLayer,
    *,
    size: DriftSize,
    rates: tuple[float, float],
    start: float,
    way: Way,
    chance: np.random.Generator,
    noise: np.random.Generator,
) -> Record:
    """Return what the layer reads.

    Args:
        holds: What lies on it.
        layer, size, rates, way: Its parameters, its drift, and how it is used.
        start: h after the middle of the calibration.
        chance, noise: Of the drift, and of the readings.
    """
    count = round((holds[-1].begin + holds[-1].seconds + 30) / PERIOD)
    time = PERIOD * np.arange(count, dtype=np.float64)
    force = np.full(count, way.touched)
    for hold in holds:
        first = round(hold.begin / PERIOD)
        last = first + round(hold.seconds / PERIOD)
        force[first:last] = hold.weight * hold.part
    ages = start + time / HOUR
    if start > 0:
        gain, offset = drawn_drift(size, rates, ages, chance)
    else:
        gain, offset = rates[0] * ages, rates[1] * ages
    felt = felt_force(force, PERIOD, layer)
    counts = read_counts(
        drifting_voltage(felt, gain, offset, layer), noise.standard_normal(count), layer
    )
    kept = chance.random(count) >= MISSING
    kept[[round((hold.begin + hold.read) / PERIOD) for hold in holds]] = True
    return Record(time, volts(counts, layer), force, gain, offset, kept, tuple(holds))


@dataclass(frozen=True, eq=False)
class Session:
    """A calibration and eight hours after it, of one layer."""

    layer: ForceLayer
    calibration: Record
    record: Record

    @property
    def grasps(self) -> list[Hold]:
        """The objects that lay there."""
        return [hold for hold in self.record.holds if hold.hour >= 0]

    @property
    def weights(self) -> list[KnownWeight]:
        """The known weights: four, one in every later quarter of an hour, four."""
        rows = [(hold, self.record.index(hold)) for hold in self.record.holds if hold.hour < 0]
        return [
            KnownWeight(self.record.time[k], hold.weight, self.record.voltage[k])
            for hold, k in rows
        ]


def session(layer: ForceLayer, size: DriftSize, seed: int, way: Way = USUAL) -> Session:
    """Simulate a calibration and a session.

    Args:
        layer: Its parameters; those of its drift are not used.
        size: Of the drift that is drawn.
        seed: Of chance.
        way: How the layer is used.
    """
    chance, noise = streams(seed, 0)
    rates = drawn_rates(size, chance)
    known = calibration_holds(layer, chance)
    middle = -(known[-1].begin / 2) / HOUR
    shared: dict[str, Any] = {
        "layer": layer,
        "size": size,
        "rates": rates,
        "chance": chance,
        "noise": noise,
    }
    calibration = recorded(known, start=middle, way=USUAL, **shared)
    holds = session_holds(layer, way, chance)
    return Session(layer, calibration, recorded(holds, start=START, way=way, **shared))
