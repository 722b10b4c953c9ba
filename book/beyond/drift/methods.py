"""Ways to correct a session for drift, from none to one that knows it, and their errors."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from book.beyond.drift.sessions import HOURS, QUARTER, SINGLE, START, Session, bridge_of
from softgrip.arrays import Floats
from softgrip.tactile.drift import DRIFT_WEIGHTS, DriftBetween, LinearDrift
from softgrip.tactile.drift_curve import Curve, KnownWeight
from softgrip.tactile.drift_filter import COUNT, finder
from softgrip.tactile.drift_law import Line
from softgrip.tactile.drift_model import HOUR, DriftSize
from softgrip.tactile.drift_track import UNSATURATED, LayerMemory, track_drift
from softgrip.tactile.own_pad import PadReadings
from softgrip.tactile.pad_model import ForceSettings, PadModel
from softgrip.tactile.rest_moments import Rest, noise_of, rest_moments

FOUR = len(DRIFT_WEIGHTS)
FEW = {0: (), 1: (SINGLE,), 2: (SINGLE - 1, SINGLE), FOUR: (0, 1, 2, 3)}
"""Which of the four weights at the start are used, by their number: one of 50 gf, and one of 20."""
SPREAD = (0, 1, 2, 4, 8, 16, 32)
"""How many single weights are spread over a session, from its start on."""


@dataclass(frozen=True, eq=False)
class Case:
    """A session, what is known of its layer before, and how much drift is expected of it."""

    session: Session
    expected: DriftSize

    @cached_property
    def _read(self) -> list[int]:
        record = self.session.calibration
        return [record.index(hold) for hold in record.holds]

    @cached_property
    def model(self) -> PadModel:
        """From voltage to force, by the 69 weights; its bandwidth by leaving whole weights out."""
        record = self.session.calibration
        forces = np.array([hold.weight for hold in record.holds])
        groups = np.char.mod("%.6f", forces)
        readings = PadReadings(("layer",), record.voltage[self._read, None], forces, groups)
        return PadModel(ForceSettings(), saturation=UNSATURATED).fit(readings)

    @cached_property
    def curve(self) -> Curve:
        """Of the calibration."""
        return Curve.of(self.model.readings)

    @cached_property
    def memory(self) -> LayerMemory:
        """As fitted to the calibration's record."""
        record = self.session.calibration
        known = np.zeros(len(record.time))
        for hold in record.holds:
            known[round(hold.begin) : round(hold.begin + hold.seconds)] = hold.weight
        return LayerMemory.fitted(record.time, known, record.voltage, self._read)

    def calibrated(self, force: float) -> float:
        """Return the mean voltage, V, of a weight in the calibration, as the text compares it."""
        readings = self.model.readings
        same = np.isclose(np.asarray(readings.labels, dtype=np.float64), force)
        return float(readings.voltages[same, 0].mean())

    @cached_property
    def noise(self) -> float:
        """Of a sample, V, as told from the record."""
        record = self.session.record
        return max(noise_of(record.voltage[record.kept]), COUNT / 2)

    @cached_property
    def rests(self) -> list[Rest]:
        """Moments without load that are found."""
        record, law = self.session.record, bridge_of(self.session.layer)
        time, voltage = record.time[record.kept], record.voltage[record.kept]
        return rest_moments(time, voltage, finder(self.curve, self.expected, law, self.noise))

    @cached_property
    def at(self) -> NDArray[np.intp]:
        """The samples at which an object is read."""
        record = self.session.record
        return np.array([record.index(hold) for hold in self.session.grasps])

    @cached_property
    def voltage(self) -> Floats:
        """What is read of the objects, V."""
        found: Floats = self.session.record.voltage[self.at]
        return found

    @cached_property
    def borne(self) -> Floats:
        """What the layer bears of the objects and all else, N."""
        found: Floats = self.session.record.force[self.at]
        return found

    def force(self, voltage: Floats) -> Floats:
        """Return forces, N, of voltages as of the calibration, V."""
        found: Floats = self.model.estimator.predict(voltage[:, None])
        return found

    def tracked(self, chosen: list[KnownWeight], **options: Any) -> Floats:
        """Return the forces of the objects with the drift tracked by some weights, N."""
        record = self.session.record
        given = {"law": bridge_of(self.session.layer), "rests": self.rests, **options}
        # Memory goes by all samples, drift by those that are read.
        every = "memory" in given
        which = np.flatnonzero(record.kept) if every else self.at
        found = track_drift(
            record.time[which],
            record.voltage[which],
            self.model,
            weights=chosen,
            calibrated_at=-START * HOUR,
            size=self.expected,
            noise=self.noise,
            **given,
        )
        return found.force[np.searchsorted(which, self.at)]

    def few(self, count: int) -> list[KnownWeight]:
        """Return some of the four weights at the start: a key of `FEW`."""
        return [self.session.weights[k] for k in FEW[count]]

    def spread(self, count: int) -> list[KnownWeight]:
        """Return single weights, as many in equal steps of time from the start: one of `SPREAD`."""
        singles = [self.session.weights[SINGLE], *self.session.weights[FOUR:-FOUR]]
        return singles[:: round(HOURS / QUARTER / count)] if count else []


def _line(case: Case, weights: list[KnownWeight]) -> LinearDrift:
    known = [case.calibrated(weight.force) for weight in weights]
    return LinearDrift.from_weights(known, [weight.voltage for weight in weights])


def text(case: Case) -> Floats:
    """Return the forces, N, by the text: a line through four weights at the start."""
    return case.force(_line(case, case.few(FOUR)).corrected(case.voltage))


def both_ends(case: Case) -> Floats:
    """Return the forces, N, by lines at start and end, and what lies between."""
    weights, time = case.session.weights, case.session.record.time[case.at]
    lines = DriftBetween(_line(case, weights[:FOUR]), _line(case, weights[-FOUR:]))
    begin, end = (np.mean([one.time for one in w]) for w in (weights[:FOUR], weights[-FOUR:]))
    return case.force(lines.corrected(case.voltage, (time - begin) / (end - begin)))


def best_constant(case: Case) -> Floats:
    """Return the forces, N, by the one line that errs least: it knows the truth."""
    low, high = case.curve.voltage[[0, -1]]
    # Where the regressor has gone flat at both ends, as far out as it is asked here.
    grid = np.linspace(2 * low - high, 2 * high - low, 3001)
    said = case.force(grid)

    def off(line: Floats) -> float:
        error = np.interp(line[0] + line[1] * case.voltage, grid, said) - case.borne
        return float(error @ error)

    found = minimize(
        off, (0.0, 1.0), method="Nelder-Mead",
        options={"initial_simplex": [(0, 1), (0.1, 1), (0, 1.1)], "xatol": 1e-4, "fatol": 1e-8},
    )  # fmt: skip
    return case.force(found.x[0] + found.x[1] * case.voltage)


def known(case: Case) -> Floats:
    """Return the forces, N, with the true drift undone: no correction of drift can do better."""
    record, law = case.session.record, bridge_of(case.session.layer)
    gain, offset = record.gain[case.at], record.offset[case.at]
    return case.force(law.calibrated(case.voltage, gain, offset))


def smoothed(case: Case, count: int) -> Floats:
    """Return the forces, N, once a session is over: spread weights, one at the end, smoothed."""
    chosen = [*case.spread(count), case.session.weights[SINGLE - FOUR]]
    return case.tracked(chosen, smooth=True)


def known_without_memory(case: Case) -> Floats:
    """Return the forces, N, with the true drift undone, and the memory as it was fitted."""
    record, law = case.session.record, bridge_of(case.session.layer)
    fresh = law.calibrated(record.voltage, record.gain, record.offset)
    felt = case.memory.model.estimator.predict(fresh[:, None])
    found: Floats = case.memory.creep.undone(record.time, felt)[case.at]
    return found


def _spread(count: int, case: Case) -> Floats:
    return case.tracked(case.spread(count))


Method = Callable[[Case], Floats]
METHODS: Mapping[str, tuple[int, Method]] = MappingProxyType(
    {
        "no correction": (0, lambda case: case.force(case.voltage)),
        "text: a line, 4 at the start": (FOUR, text),
        "lines at both ends": (2 * FOUR, both_ends),
        "best constant line": (0, best_constant),
        "tracked, 2 at the start": (2, lambda case: case.tracked(case.few(2))),
        "tracked, 4 at the start": (FOUR, lambda case: case.tracked(case.few(FOUR))),
        **{
            f"tracked, {count} spread": (count, partial(_spread, count)) for count in SPREAD
        },
        "smoothed, 1 and 1 at the end": (2, lambda case: smoothed(case, 1)),
        "smoothed, 4 spread and 1 at the end": (FOUR + 1, lambda case: smoothed(case, FOUR)),
        "4 at the start, no pauses used": (
            FOUR, lambda case: case.tracked(case.few(FOUR), use_rests=False)
        ),
        "0 weights, circuit unknown": (0, lambda case: case.tracked([], law=Line())),
        "4 spread, circuit unknown": (
            FOUR, lambda case: case.tracked(case.spread(FOUR), law=Line())
        ),
        "4 spread, memory undone": (
            FOUR, lambda case: case.tracked(case.spread(FOUR), memory=case.memory)
        ),
        "drift known": (0, known),
        "drift known, memory undone": (0, known_without_memory),
    }
)  # fmt: skip
"""By name: how many known weights it needs in a session, and the forces, N, of the objects."""
