"""The comparison on the ensemble: going on where it was cut, and what is kept made again."""

import joblib
import numpy as np
import pytest

from book.beyond.delay import sweep
from book.beyond.delay.methods import METHODS, known_targets
from book.beyond.delay.rigs import KEPT as RIGS
from book.beyond.delay.rigs import real_fingers, rigs, sensor_noise
from book.beyond.delay.sweep import MEASURES, Case, cases, cells, delays_of, interval, swept

CASES = (Case("common", 2, 100), Case("common", 2, 100, 30))
ROWS = rigs()[:4]


@pytest.fixture
def cheap(monkeypatch):
    """Two methods that cost little."""
    few = {name: METHODS[name] for name in (sweep.REFERENCE, "Smith, 2/s")}
    monkeypatch.setattr(sweep, "METHODS", few)
    monkeypatch.setattr(sweep, "KNOW_DELAY", ("Smith, 2/s",))


def test_a_run_that_was_cut_goes_on_from_its_parts(cheap, tmp_path, monkeypatch):
    made, whole = [], sweep.measured

    def counted(case, rows, **given):
        made.append((case, rows[0].rig))
        if len(made) == 3:
            raise KeyboardInterrupt  # as if killed in its third part
        return whole(case, rows, **given)

    monkeypatch.setattr(sweep, "measured", counted)
    given = {"folder": tmp_path, "runs": 2, "at_a_time": 2}
    with pytest.raises(KeyboardInterrupt):
        swept(CASES, ROWS, **given)
    kept = sorted(tmp_path.glob("*.npy"))
    assert len(kept) == 2
    before = [file.stat().st_mtime_ns for file in kept]
    found = swept(CASES, ROWS, **given)
    # Of four parts two were kept: only the one that was cut and the last are made.
    assert len(made) == 3 + 2
    assert [file.stat().st_mtime_ns for file in kept] == before
    assert not list(tmp_path.glob("*.part*"))
    alone = swept(CASES, ROWS, runs=2, at_a_time=4)
    for case in CASES:
        assert found[case] == pytest.approx(alone[case], rel=1e-9)


def test_joblib_s_configuration_says_where_parts_run(cheap):
    alone = swept(CASES[:1], ROWS, runs=2, at_a_time=2)
    with joblib.parallel_config(backend="threading", n_jobs=2):
        found = swept(CASES[:1], ROWS, runs=2, at_a_time=2)
    assert found[CASES[0]] == pytest.approx(alone[CASES[0]], rel=1e-12)


def test_a_rig_s_chance_hangs_on_no_method_or_number_of_fingers():
    row = rigs()[7]
    few, many = (real_fingers(row, n, runs=5, seed=1) for n in (2, 5))
    assert many.stiffness[:, :2] == pytest.approx(few.stiffness)
    noise = [sensor_noise(row, n, 10, runs=5, seed=1) for n in (2, 5)]
    assert noise[1][:2] == pytest.approx(noise[0])
    assert np.std(noise[1]) == pytest.approx(row.angle_noise, rel=0.2)


def test_further_fingers_lie_between_the_first_two():
    for row in rigs()[::40]:
        gains = row.gripper(5).velocity_gains
        assert gains[:2].min() < gains[2:].min() < gains[2:].max() < gains[:2].max()


def test_own_delays_are_about_the_common_one():
    case = Case("own", 2, 200)
    late = np.array([delays_of(case, row) for row in rigs()])
    assert np.abs(late - 0.2).max() <= 0.25 * 0.2 + 0.0126
    assert np.ptp(late, axis=1).mean() > 0.01
    assert np.array_equal(late, np.array([delays_of(case, row) for row in rigs()]))


def test_without_delay_the_predictor_is_the_printed_loop():
    found = swept((Case("common", 2, 0),), ROWS[:2], runs=3)[Case("common", 2, 0)]
    names = list(METHODS)
    smith, printed = (found[names.index(name)] for name in ("Smith, 2/s", "printed, 2/s"))
    assert smith == pytest.approx(printed, rel=1e-9)


def test_interval_of_a_mean_is_that_of_the_central_limit():
    values = np.random.default_rng(3).normal(2.0, 0.5, 400)
    middle, low, high = interval(values, "mean")
    half = 1.96 * values.std() / 20
    assert (middle - low, high - middle) == pytest.approx((half, half), rel=0.1)


def test_targets_are_what_each_rig_s_pump_can_hold():
    from softgrip.gripper.delayed_plant import DelayedGripper

    known = [DelayedGripper(row.gripper(3), (0.1,) * 3) for row in rigs()[:3]]
    for one, own in zip(known, known_targets(known), strict=True):
        assert np.ptp(own / one.gripper.velocity_gains) < 1e-12


def test_kept_cells_are_those_of_the_cases():
    kept = sweep.KEPT.read()
    wanted = {(c.kind, c.fingers, c.delay, c.wrong, m) for c in cases() for m in c.methods}
    assert {(k.kind, k.fingers, k.delay, k.wrong, k.method) for k in kept} == wanted
    assert len(kept) == len(wanted) * len(MEASURES)
    assert len(RIGS.read()) - sweep.SPENT >= 200
    for one in kept:
        assert one.low <= one.value + 1e-9
        assert one.value <= one.high + 1e-9


def test_kept_values_are_what_rigs_give_made_again(cheap):
    """All rigs and runs of one case, by the two methods that cost little."""
    case = Case("common", 2, 300)
    found = cells(swept((case,), rigs()[sweep.SPENT :]))
    kept = {
        (one.method, one.measure): one
        for one in sweep.KEPT.read()
        if (one.kind, one.fingers, one.delay, one.wrong) == ("common", 2, 300, 0)
    }
    for one in found:
        own = kept[one.method, one.measure]
        for name in ("value", "low", "high", "gain", "gain_low", "gain_high"):
            # Four digits are kept.
            assert getattr(one, name) == pytest.approx(getattr(own, name), rel=1e-3, abs=1e-6)
