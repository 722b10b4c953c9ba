"""A record of the force layer without its drift: for a reader's own pad, in one line."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, one_number
from softgrip.checks import record
from softgrip.errors import InvalidInputError
from softgrip.tactile.creep import Creep, fitted_creep
from softgrip.tactile.drift_curve import Curve, KnownWeight
from softgrip.tactile.drift_filter import COUNT, ENDS, EVERY, DriftFilter, finder
from softgrip.tactile.drift_law import DriftLaw, Line
from softgrip.tactile.drift_model import HOUR, DriftSize, gain_and_offset
from softgrip.tactile.own_pad import PadReadings
from softgrip.tactile.pad_model import ForceSettings, PadModel
from softgrip.tactile.rest_moments import Rest, noise_of, rest_moments

MOST = 5.0
"""How many times the largest calibrated voltage a record may have: more are no volts."""
UNSATURATED = 1e9
"""V, that no converter reaches: a drifting record is corrected first."""


@dataclass(frozen=True, eq=False)
class LayerMemory:
    """A layer's memory, and its calibration in terms of what it felt.

    Attributes:
        creep: The memory.
        model: Fitted to voltages and the forces that were felt then.
    """

    creep: Creep
    model: PadModel

    @classmethod
    def fitted(
        cls,
        time: ArrayLike,
        force: ArrayLike,
        voltage: ArrayLike,
        read: ArrayLike,
        settings: ForceSettings | None = None,
    ) -> Self:
        """Fit it to the whole record of a calibration.

        Args:
            time, force, voltage: As of `fitted_creep`.
            read: The samples that the calibration's readings are, as an index of NumPy.
            settings: How forces are read.

        Raises:
            InvalidInputError: As of `fitted_creep`.
        """  # fmt: skip
        t, known, v = record(at_least=3, time=time, force=force, voltage=voltage)
        creep, which = fitted_creep(t, known, v), np.asarray(read)
        groups = np.char.mod("%.9g", known[which])
        felt = creep.felt(t, known)[which]
        readings = PadReadings(("layer",), v[which, None], felt, groups)
        model = PadModel(settings or ForceSettings(), saturation=UNSATURATED)
        return cls(creep, model.fit(readings))


@dataclass(frozen=True, eq=False)
class TrackedDrift:
    """A record without its drift; arrays of shape (N,).

    Attributes:
        time: s.
        voltage: What it would have been at the calibration, V.
        force: By the calibration, and without the memory if one was given, N.
        deviation: Of the force, by what is not known of the drift alone, N; infinite where the
            converter cut a reading off.
        gain, offset: Of the drift, 1 and V.
        rests: The moments without load that were found.
        refused: How many of those taken were not believed.
    """

    time: Floats
    voltage: Floats
    force: Floats
    deviation: Floats
    gain: Floats
    offset: Floats
    rests: tuple[Rest, ...]
    refused: int


def track_drift(
    time: ArrayLike,
    voltage: ArrayLike,
    calibration: PadReadings | PadModel,
    *,
    weights: Iterable[KnownWeight] = (),
    calibrated_at: float | None = None,
    size: DriftSize | None = None,
    law: DriftLaw | None = None,
    memory: LayerMemory | None = None,
    use_rests: bool = True,
    smooth: bool = False,
    rests: Sequence[Rest] | None = None,
    noise: float | None = None,
    ends: tuple[float, float] = ENDS,
) -> TrackedDrift:
    """Return the forces of a record of the force layer without the layer's drift.

    Args:
        time, voltage: s, not falling, at any times, and V, shape (N,), N >= 3.
        calibration: Voltages of known forces [N], some without load; or a model fitted to such.
        weights: Known weights during the record, if any, and before; not before the calibration.
        calibrated_at: s, when it was calibrated, on the clock of the record; where it begins
            without it.
        size: How much drift is expected; the assumed `DriftSize` without it.
        law: What drift does to a voltage; `Line` without it, `Bridge` for a known circuit.
        memory: Of the layer, to be undone; it goes by all samples from the record's begin on.
        use_rests: Whether moments without load are used. The record then begins without load.
        smooth: Whether what comes later tells too: for a record that is over.
        rests: The moments without load, if they are known; they are looked for without it.
        noise: V, of a sample, one deviation; from the record without it.
        ends: V, of the converter: what reaches one was cut off, and measures no drift.

    Raises:
        InvalidInputError: If shapes differ, a value is NaN or infinite, time falls or lies before
            the calibration, the record's numbers are far beyond volts of the calibration, a weight
            lies beyond its forces, or the calibration has no reading without load.

    >>> volts = [[0.1], [0.6], [1.1], [2.1]]
    >>> mine = PadReadings(("layer",), volts, [0.0, 0.125, 0.25, 0.5])
    >>> time = np.arange(0.0, 3600.0)
    >>> drifting = 0.1 + 0.02 * time / 3600
    >>> found = track_drift(time, drifting, mine)
    >>> bool(abs(found.voltage - 0.1).max() < 0.005)
    True
    """
    if isinstance(calibration, PadReadings):
        model = PadModel(ForceSettings(), saturation=UNSATURATED).fit(calibration)
    elif isinstance(calibration, PadModel):
        model = calibration
    else:
        expected = "PadReadings with forces, or a PadModel fitted to such"
        raise InvalidInputError("calibration", expected=expected, got=calibration)
    curve = Curve.of(model.readings)
    t, v = record(at_least=3, time=time, voltage=voltage)
    begun = float(t[0]) if calibrated_at is None else one_number(calibrated_at=calibrated_at)[0]
    _check(t, v, curve, begun)
    size, law = size or DriftSize(), law or Line()
    noise = max(noise_of(v) if noise is None else one_number(noise=noise)[0], COUNT / 2)
    drift = DriftFilter(curve, size, law, noise, begun, ends=ends)
    if not use_rests:
        rests = ()
    elif rests is None:
        rests = rest_moments(t, v, finder(curve, size, law, noise))
    if memory:
        rests = without_memory(rests, t, v, memory, curve)
    _run(drift, rests, list(weights))
    age = (t - begun) / HOUR
    states, spreads = _states(drift, t, smooth=smooth)
    gain, offset = gain_and_offset(states, age)
    calibrated = np.asarray(law.calibrated(v, gain, offset))
    per_gain = np.asarray(law.per_gain(calibrated, gain))
    H = np.stack([per_gain * age, age, per_gain, np.ones_like(age)], axis=1)
    deviation = _slopes(model, curve, calibrated) * np.sqrt(
        np.einsum("ni,nij,nj->n", H, spreads, H)
    )
    deviation[(v <= ends[0]) | (v >= ends[1])] = inf
    if memory:
        felt = memory.model.estimator.predict(calibrated[:, None])
        force = memory.creep.undone(t, felt)
    else:
        force = model.estimator.predict(calibrated[:, None])
    return TrackedDrift(t, calibrated, force, deviation, gain, offset, tuple(rests), drift.refused)


def without_memory(
    rests: Sequence[Rest], time: Floats, voltage: Floats, memory: LayerMemory, curve: Curve
) -> tuple[Rest, ...]:
    """Return moments without load, less what the layer still felt of loads before them.

    Args:
        rests: The moments.
        time, voltage: Of all samples, s and V, shape (N,). Their drift is not corrected: it changes
            the little that is left by a small part of it.
        memory, curve: Of the layer.
    """
    felt = memory.model.estimator.predict(voltage[:, None])
    left = memory.creep.left(time, memory.creep.undone(time, felt))
    slope = float((curve.voltage[1] - curve.voltage[0]) / curve.force[1])
    at = np.searchsorted(time, [rest.time for rest in rests], side="right") - 1
    return tuple(
        replace(rest, voltage=rest.voltage - slope * float(left[k]))
        for rest, k in zip(rests, at.tolist(), strict=True)
    )


def _check(time: Floats, voltage: Floats, curve: Curve, begun: float) -> None:
    if (np.diff(time) < 0).any():
        raise InvalidInputError("time", expected="times that do not fall", got="one that does")
    if begun > time[0]:
        expected = f"up to {time[0]} s, where the record begins"
        raise InvalidInputError("calibrated_at", expected=expected, got=begun)
    most, largest = MOST * float(np.abs(curve.voltage).max()), float(np.abs(voltage).max())
    if largest > most:
        expected = f"volts, as of the calibration, up to {most:g}"
        raise InvalidInputError("voltage", expected=expected, got=largest)


def _run(drift: DriftFilter, rests: Sequence[Rest], weights: list[KnownWeight]) -> None:
    """Give the filter what is measured, in the order of time."""
    taken, last = [], -inf
    for rest in rests:
        if rest.time - last >= EVERY:
            taken.append(rest)
            last = rest.time
    both: list[Rest | KnownWeight] = [*taken, *weights]
    for one in sorted(both, key=lambda event: event.time):
        if isinstance(one, Rest):
            drift.rest(one.time, one.voltage)
        else:
            drift.weigh(one.time, one.voltage, one.force)


def _states(drift: DriftFilter, time: Floats, *, smooth: bool) -> tuple[Floats, Floats]:
    """Return the states at some times, shape (N, 4), and their covariances, (N, 4, 4)."""
    size, times = drift.size, np.array([event.time for event in drift.events])
    if smooth:
        states, spreads = drift.smoothed()
    else:
        states = np.array([event.state for event in drift.events])
        spreads = np.array([event.covariance for event in drift.events])
    before = np.searchsorted(times, time, side="right") - 1
    hours = (time - times[before]) / HOUR
    # As `DriftSize.transition`, of all steps at once.
    moved = np.ones((len(time), 4))
    moved[:, 2:] = np.exp(-hours / size.return_time)[:, None]
    grown = np.array([size.spread(step) for step in hours.tolist()])
    wanders = np.diag([0.0, 0.0, size.gain_wander**2, size.offset_wander**2])
    state = states[before] * moved
    spread = spreads[before] * moved[:, :, None] * moved[:, None, :]
    spread += grown[:, None, None] * wanders
    if smooth:
        # Between two events on a straight line, as a random walk is expected to lie.
        after = np.minimum(before + 1, len(times) - 1)
        whole = (times[after] - times[before]) / HOUR
        part = np.divide(hours, whole, out=np.zeros_like(hours), where=whole > 0)[:, None]
        inside = after > before
        line = states[before] + part * (states[after] - states[before])
        state = np.where(inside[:, None], line, state)
        ends = spreads[before] + part[..., None] * (spreads[after] - spreads[before])
        spread = np.where(inside[:, None, None], ends, spread)
    return state, spread


def _slopes(model: PadModel, curve: Curve, voltage: Floats) -> Floats:
    """Return how much the force changes with the voltage, N/V, by the calibration."""
    grid = np.linspace(curve.voltage[0], curve.voltage[-1], 201)
    rises = np.gradient(model.estimator.predict(grid[:, None]), grid)
    return np.asarray(np.interp(voltage, grid, np.abs(rises)))
