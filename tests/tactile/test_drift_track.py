import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.logs.contacts import read_weights
from softgrip.logs.reader import read_log
from softgrip.rig.record_pad import calibration_steps, record_pad, weight_steps
from softgrip.rig.simulated_pad import SimulatedPad
from softgrip.tactile.creep import Creep
from softgrip.tactile.drift_curve import KnownWeight
from softgrip.tactile.drift_law import Bridge
from softgrip.tactile.drift_model import DriftSize
from softgrip.tactile.drift_track import LayerMemory, track_drift
from softgrip.tactile.own_pad import PadReadings

LAW = Bridge(25.0, 0.05)
FORCES = np.linspace(0, 0.7, 29)
START = 7200.0


def voltage_of(force):
    return 0.5 + 4 * -np.expm1(-np.asarray(force) / 0.35)


CALIBRATION = PadReadings(("layer",), voltage_of(FORCES)[:, None], FORCES)


def session(gain_rate=0.02, offset_rate=-0.01, hours=2.0, noise=0.0, seed=0):
    """Return time, voltage and force of grasps with pauses, and a known weight at the start."""
    rng = np.random.default_rng(seed)
    force = np.concatenate(
        [np.repeat([0.0, w], 30) for w in rng.uniform(0.05, 0.5, int(60 * hours))]
    )
    force[30:60] = 0.4
    time = START + np.arange(len(force))
    age = time / 3600
    voltage = LAW.drifted(voltage_of(force), gain_rate * age, offset_rate * age)
    voltage = voltage + rng.normal(0, noise, len(time)) if noise else voltage
    return time, voltage, force, KnownWeight(time[45], 0.4, voltage[45])


def corrected(time, voltage, **options):
    given = {"law": LAW, "calibrated_at": 0.0, **options}
    return track_drift(time, voltage, CALIBRATION, **given)


def off(found, force):
    """Return the root mean square error in the second half, N, under a load."""
    late = np.arange(len(force)) > len(force) // 2
    return float(np.sqrt(np.mean((found.force - force)[late & (force > 0)] ** 2)))


def test_pauses_and_one_weight_undo_a_steady_drift():
    time, voltage, force, weight = session()
    steady = DriftSize(gain_wander=0.0, offset_wander=0.0)
    fresh = track_drift(time, voltage_of(force), CALIBRATION, calibrated_at=START, use_rests=False)
    found = corrected(time, voltage, weights=[weight], size=steady)
    blind = track_drift(time, voltage, CALIBRATION, use_rests=False)
    # What is left is the regressor's own error, and 1.5 mN of what pauses leave open.
    assert off(found, force) < off(fresh, force) + 1.5e-3
    assert off(blind, force) > 5 * off(found, force)


def test_lost_samples_at_random_change_little():
    time, voltage, _, weight = session(noise=0.003)
    kept = np.random.default_rng(1).random(len(time)) < 0.7
    whole = corrected(time, voltage, weights=[weight])
    found = corrected(time[kept], voltage[kept], weights=[weight])
    assert abs(found.voltage - whole.voltage[kept]).max() < 0.02


def test_deviation_holds_the_error_as_often_as_it_says():
    """On drifts drawn as the filter expects: nine of ten within 1.645 deviations."""
    inside = []
    for seed in range(60):
        rng = np.random.default_rng(100 + seed)
        gain, offset = rng.standard_normal(2) * (0.015, 0.01)
        time, voltage, force, weight = session(gain, offset, 0.5, 0.003, seed)
        size = DriftSize(gain_wander=0.0, offset_wander=0.0)
        found = corrected(time, voltage, weights=[weight], size=size)
        k = int(np.flatnonzero(force > 0)[-1])
        slope = 0.35 / 4 * np.exp(force[k] / 0.35)
        error = (found.voltage[k] - voltage_of(force[k])) * slope
        # Noise of the one reading is not part of the deviation.
        inside.append(abs(error) < 1.645 * np.hypot(found.deviation[k], 0.003 * slope))
    # 99.9 % of binomial numbers of 60 with 0.9 are 45 or more; the filter may be cautious.
    assert sum(inside) >= 45


def test_smoothing_tells_of_a_wander_before_it_is_weighed():
    time, voltage, force, _ = session(0.0, 0.0)
    gain = np.linspace(0, 0.06, len(time))
    voltage = LAW.drifted(voltage_of(force), gain, 0.0)
    weights = [KnownWeight(time[k], force[k], voltage[k]) for k in (45, len(time) - 5)]
    whole, causal = (corrected(time, voltage, weights=weights, smooth=s) for s in (True, False))
    assert off(whole, force) < 0.7 * off(causal, force)


def test_smoothed_drift_lies_on_a_line_between_two_weights():
    """A random walk is expected there: without pauses nothing else is known of it."""
    time, voltage, force, _ = session(0.0, 0.0)
    late = len(time) - 5
    weights = [KnownWeight(time[45], force[45], voltage[45]),
               KnownWeight(time[late], force[late], voltage[late] + 0.2)]  # fmt: skip
    size = DriftSize(gain_rate=0.0, offset_rate=0.0)
    found = corrected(time, voltage, weights=weights, size=size, smooth=True, use_rests=False)
    middle = (45 + late) // 2
    part = (time[middle] - time[45]) / (time[late] - time[45])
    for path in (found.gain, found.offset):
        expected = (1 - part) * path[45] + part * path[late]
        assert path[middle] == pytest.approx(expected, abs=1e-9)
        assert abs(path[late] - path[45]) > 0.01


def test_order_of_weights_does_not_matter():
    time, voltage, force, weight = session()
    other = KnownWeight(time[645], force[645], voltage[645])
    both = [corrected(time, voltage, weights=w).force for w in ([weight, other], [other, weight])]
    assert both[0].tolist() == both[1].tolist()


@pytest.mark.parametrize(("touch", "harm"), [(0.01, True), (0.05, False)])
def test_a_touch_in_all_pauses_does_harm_unless_it_is_too_heavy_to_be_drift(touch, harm):
    time, _, force, weight = session()
    touched = np.maximum(force, touch)
    voltage = LAW.drifted(voltage_of(touched), 0.02 * time / 3600, -0.01 * time / 3600)
    weights = [KnownWeight(weight.time, weight.force, voltage[45])]
    with_pauses, without = (
        off(corrected(time, voltage, weights=weights, use_rests=use), touched)
        for use in (True, False)
    )
    assert (with_pauses > 1.2 * without) == harm


def test_memory_is_undone():
    creep = Creep((0.2,), (20.0,))
    known = np.concatenate([np.repeat([w, 0.0], 8) for w in FORCES])
    clock = np.arange(len(known), dtype=float)
    read = np.arange(5, len(known), 16)
    calibration = voltage_of(creep.felt(clock, known))
    memory = LayerMemory.fitted(clock, known, calibration, read)
    model = PadReadings(("layer",), calibration[read, None], known[read])
    time, _, force, _ = session(0.0, 0.0)
    voltage = voltage_of(creep.felt(time, force))
    forces = [track_drift(time, voltage, model, law=LAW, memory=m).force for m in (memory, None)]
    undone, left = (np.sqrt(np.mean((f - force) ** 2)) for f in forces)
    assert undone < 0.6 * left


def test_a_reading_that_was_cut_off_has_no_deviation():
    time, voltage, _, _ = session()
    voltage[31] = 5.0
    found = corrected(time, voltage)
    assert np.flatnonzero(np.isinf(found.deviation)).tolist() == [31]


def test_log_of_a_pad_of_ones_own(tmp_path):
    pad, path = SimulatedPad(), tmp_path / "mine.csv"
    steps = [*calibration_steps(), *weight_steps([1, 2, 5, 10, 20, 30, 50, 70])]
    record_pad(pad, steps, path, say=pad.obey, progress=lambda *_: None)
    log = read_log(path)
    found = track_drift(log["time"], log["layer"], read_weights(path), law=LAW)
    assert found.force.shape == log["time"].shape
    assert np.isfinite(found.force).all()


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"time": [0, 2, 1]}, "time"),
        ({"voltage": [0.5, np.nan, 0.5]}, "finite"),
        ({"time": [0, 1, np.inf]}, "finite"),
        ({"voltage": [500.0, 501.0, 502.0]}, "volts"),
        ({"time": [0, 1]}, "shape"),
        ({"calibrated_at": 1.0}, "calibrated_at"),
        ({"weights": [KnownWeight(1.0, 50.0, 3.0)]}, "as calibrated"),
        ({"weights": [KnownWeight(-10.0, 0.5, 3.0)]}, "time"),
    ],
)
def test_what_is_no_record_is_refused(change, match):
    given = {"time": [0.0, 1.0, 2.0], "voltage": [0.5, 0.5, 0.5], "calibration": CALIBRATION}
    with pytest.raises(InvalidInputError, match=match):
        track_drift(**given | change)
