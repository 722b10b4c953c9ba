"""Logs of the simulated force layer: kept ones are those that the command makes."""

import numpy as np
import pandas as pd
import pytest

from book.chapter_2 import forces
from book.chapter_2.force_logs import AGES, read, simulate, write
from softgrip.errors import UnknownNameError
from softgrip.logs.reader import read_log
from softgrip.provenance import Provenance, data_file
from softgrip.simulator.force_layer import ForceLayer
from softgrip.simulator.force_tests import put_down, weight_forces
from softgrip.tactile.force import WEIGHTS, table_2_2
from softgrip.tactile.force_comparison import cross_validated, regressors, root_mean_square
from softgrip.tactile.nadaraya_watson import best_bandwidth
from softgrip.units import GRAM_FORCE


def test_kept_logs_come_out_again(tmp_path):
    for path in write(tmp_path):
        kept = data_file(f"simulated/{path.name}")
        assert kept.provenance is Provenance.SIMULATED
        made, other = read_log(path), read_log(kept.path)
        assert (made.header, made.events) == (other.header, other.events)
        assert not other.repairs
        for name in ("time", "command"):
            np.testing.assert_array_equal(made[name], other[name])
        # A count may tip where two machines' exponentials differ in the last bit.
        assert abs(made["layer_counts"] - other["layer_counts"]).max() <= 1


def test_points_are_those_of_the_text():
    log = read("weights")
    assert len(log) == 69
    weights = (log["weight [N]"] / GRAM_FORCE).round(6)
    assert weights.value_counts().to_dict() == dict.fromkeys([0.0, *map(float, WEIGHTS)], 3)


def test_weights_carry_no_noise():
    weights = weight_forces()
    found = put_down(weights, seed=5, run=0)
    np.testing.assert_array_equal(found.force, weights)
    assert not np.array_equal(found.counts, put_down(weights, seed=6, run=0).counts)


def test_without_chance_and_memory_equal_weights_read_equal():
    bare = ForceLayer(memory=(0.0, 0.0), voltage_noise=0.0, seating=0.0, gain_drift=0.0,
                      offset_drift=0.0)  # fmt: skip
    counts = put_down(weight_forces(), seed=1, run=0, layer=bare).counts.reshape(3, 23)
    np.testing.assert_array_equal(counts, np.tile(counts[0], (3, 1)))
    assert (np.diff(counts[0]) > 0).all()


def test_cycles_repeat_and_reach_their_forces():
    log = read("cycles")
    force = log["weight [N]"].to_numpy().reshape(9, -1)
    np.testing.assert_array_equal(force.max(axis=1), np.repeat([0.2, 0.5, 0.7], 3))
    voltage = log["voltage [V]"].to_numpy().reshape(3, 3, -1)
    # The first cycle of a force still feels the force before; the other two agree.
    assert abs(voltage[:, 1] - voltage[:, 2]).max() < 0.1


def test_objects_are_those_of_table_2_2():
    log = read("objects")
    assert log["object"].value_counts().to_dict() == dict.fromkeys(table_2_2(), 10)
    for name, rows in log.groupby("object"):
        assert rows["weight [N]"].to_numpy() == pytest.approx(table_2_2()[name].true, abs=1e-9)


def test_long_runs_take_about_an_hour():
    for age, rows in read("long").groupby("start [h]"):
        assert age in AGES
        assert len(rows) == 28
        assert rows["time [s]"].iloc[-1] == pytest.approx(3600, rel=0.05)


def test_unknown_log_is_refused():
    with pytest.raises(UnknownNameError, match="weights, cycles"):
        simulate("tofu")


def test_kept_drift_comes_out_again(tmp_path):
    made = pd.read_csv(forces.write_drift(tmp_path / "drift.csv"), comment="#")
    kept = forces.kept_drift().reset_index()
    np.testing.assert_allclose(made, kept, rtol=1e-3)


@pytest.mark.parametrize("name", ["ordinary least squares", "Nadaraya-Watson", "neural network"])
def test_kept_comparison_comes_out_again(name):
    voltage, force = forces.weight_points()
    errors = cross_validated(regressors()[name], voltage, force, groups=force) - force
    kept = forces.kept_comparison().loc[name, forces.WHOLE]
    # The network's end depends on the last bits of its sums.
    assert root_mean_square(errors) == pytest.approx(kept, rel=0.05 if "net" in name else 1e-4)


def test_repeats_hide_how_wide_the_kernel_must_be():
    voltage, force = forces.weight_points()
    points = best_bandwidth(voltage[:, None], force)
    assert forces.weight_bandwidth(whole=False) == points
    assert forces.weight_bandwidth() > 3 * points


def test_line_at_the_start_repairs_the_start_only():
    errors = forces.kept_drift()
    for start in AGES[1:]:
        first, last = errors.loc[(start, 1)], errors.loc[(start, 5)]
        assert first["repaired"] < first["without"] / 2
        assert last["repaired"] > 1.5 * first["repaired"]
        assert last["between"] < last["repaired"]


def test_errors_of_a_logged_hour():
    rows = read("long").query("`start [h]` == 2.0")
    hour = (rows[name].to_numpy() for name in ("time [s]", "voltage [V]", "weight [N]"))
    errors = forces.hour_errors(*hour)
    assert len(errors) == 20
    assert abs(errors["without"]).mean() > abs(errors["between"]).mean()


def test_simulated_objects_are_ten_weighings_each():
    found = forces.weighed_objects()
    assert [*found] == [*table_2_2()]
    voltage = read("objects").query("object == 'egg'")["voltage [V]"].to_numpy()
    read_forces = forces.to_force(voltage)
    assert found["egg"].measured == pytest.approx(read_forces.mean())
    assert found["egg"].deviation == pytest.approx(read_forces.std(ddof=1))
