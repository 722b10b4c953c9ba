"""The author's scripts: what our functions give with his inputs, held against other ways to it."""

import numpy as np
import pytest
from scipy.linalg import solve_continuous_are
from scipy.signal import StateSpace, TransferFunction, lsim, step

from book.author import scripts, tables
from softgrip.actuator.design import (
    SCRIPT_BOUNDS,
    SCRIPT_MASS,
    SCRIPT_POWER,
    DesignProblem,
    FrequencyBand,
)
from softgrip.actuator.printed import table_3_2
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.shaping_filter import plant_inside, rounding_margin
from softgrip.units import MM

W, ZETA = 1.812, 0.7
RIGHT = np.array([[0, 1, 0], [0, 0, 1], [0, -(W**2), -2 * ZETA * W]])
WRITTEN = np.array([[0, 1, 0], [0, 0, 1], [0, -2 * ZETA * W, -(W**2)]])


def test_the_check_script_gives_what_it_gave_when_it_was_read():
    """By its own formulas, evaluated apart from this package."""
    assert scripts.checked_torque() == pytest.approx(0.305816, abs=5e-7)
    assert scripts.checked_angle() == pytest.approx(140.13, abs=5e-3)
    assert scripts.checked_angle(wall_subtracted=True) == pytest.approx(109.2, abs=0.05)


def test_defaults_of_the_package_are_the_design_scripts():
    problem = scripts.design_problem()
    assert problem.fractional_power == SCRIPT_POWER == DesignProblem().fractional_power
    assert problem.bounds == SCRIPT_BOUNDS
    assert problem.band == FrequencyBand(2.5, 3.5, SCRIPT_MASS, SCRIPT_MASS)
    assert problem.band == FrequencyBand(2.5, 3.5)


def test_the_angle_with_the_wall_subtracted_by_hand():
    chamber, wall = 18.5 * 27, 30 * 24 - 18.5 * 27
    longer = [1 + 0.15 / 0.34 * (chamber - less) / wall for less in (0, wall)]
    found = [scripts.checked_angle(wall_subtracted=one) for one in (False, True)]
    assert found[1] / found[0] == pytest.approx(longer[1] / longer[0], rel=1e-12)


@pytest.mark.parametrize("row", range(1, 4))
def test_the_upper_end_of_the_band_sets_the_height(row):
    """At n = 1, Eq. (3.19) is ``E w h**3 = 6 M (omega L)**2``; b, w and t are at their ends."""
    high = table_3_2()[row].high
    height = (6 * 0.36 * (high * 0.094) ** 2 / (0.34e6 * 0.030)) ** (1 / 3)
    section = tables.his_optimum((table_3_2()[row].low, high)).design.section
    assert section.top == pytest.approx(height - 0.004, abs=1e-8)
    assert (section.bottom, section.width, section.wall) == pytest.approx((0.004, 0.030, 0.0015))


def test_the_table_of_optima_has_what_the_page_says():
    table = tables.optimum_table().set_index("row")
    assert (table["proved"] == "yes").all()
    assert table["a, his inputs"].tolist() == ["20.00", "19.30", "18.09", "16.84", "14.23"]
    assert (table["so"] == tables.COMES_OUT).tolist() == [True, True, False, True, False]


def test_objective_is_without_effect():
    table = tables.disagreement_table().set_index("what")
    same = table["gives"] == table["then"]
    assert same[same].index.tolist() == ["objective, row 2"]


@pytest.mark.parametrize(("A", "as_written"), [(RIGHT, False), (WRITTEN, True)])
def test_regulator_by_the_matrices_themselves(A, as_written):
    B, C = np.array([[0.0], [0.0], [1.0]]), np.array([[0.455, 0.0, 0.0]])
    Y = solve_continuous_are(A, B, 2000 * np.diag([1.0, 0.1, 0.0]), np.eye(1))
    closed = A - B @ (B.T @ Y)
    scaled = B / -(C @ np.linalg.solve(closed, B))
    time = np.linspace(0, 5, 50001)
    _, out, _ = lsim(StateSpace(closed, scaled, C, 0), np.ones_like(time), time)
    settled = time[np.flatnonzero(abs(out - 1) > 0.02)[-1] + 1]
    rise = time[np.argmax(out >= 0.9)] - time[np.argmax(out >= 0.1)]
    found = scripts.lqr_metrics(scripts.control_model(as_written=as_written), WEIGHTS)
    # The grid here is 0.1 ms, that of the step response in the package 0.3 ms.
    assert float(found.settling_time) == pytest.approx(settled, abs=1e-3)
    assert float(found.rise_time) == pytest.approx(rise, abs=1e-3)
    assert settled == pytest.approx({False: 1.36, True: 1.40}[as_written], abs=5e-3)


WEIGHTS = scripts.control_weights()


@pytest.mark.parametrize(
    ("A", "as_written", "overshoot", "settled"),
    [(RIGHT, False, 0.40, 15.8), (WRITTEN, True, 0.63, 21.6)],
)
def test_pid_loop_by_its_transfer_function(A, as_written, overshoot, settled):
    plant = np.poly(A)
    top = 0.455 * np.array([0.25, 3.6, 1.0])
    loop = TransferFunction(top, np.polyadd(np.append(plant, 0.0), top))
    time, out = step(loop, T=np.linspace(0, 60, 60001))
    last = time[np.flatnonzero(abs(out - 1) > 0.02)[-1] + 1]
    found = scripts.pid_metrics(as_written=as_written)
    assert float(found.overshoot) == pytest.approx(out.max() - 1, abs=1e-6)
    assert float(found.settling_time) == pytest.approx(last, abs=1e-3)
    assert (out.max() - 1, last) == pytest.approx((overshoot, settled), abs=0.05)


def test_the_gains_are_not_those_of_the_rule():
    table = tables.gains_table().set_index("gains")["Kp² / (Ki Kd)"]
    assert float(table["the script"]) == pytest.approx(3.6**2 / 0.25, abs=0.05)
    assert [float(x) for x in table.drop("the script")] == [scripts.gain_ratio_by_rule()] == [4.0]


def test_both_filters_hold_the_plant_of_the_control_script():
    his = np.array([2 * ZETA * W, W**2])
    for printed in FILTERS.values():
        off = abs(np.array(plant_inside(*printed)) - his)
        assert (off <= rounding_margin(*printed)).all()
    shown = tables.plant_table()["natural frequency (rad/s)"].astype(float)
    assert shown[:3].tolist() == pytest.approx([W] * 3, abs=1.5e-3)
    assert (abs(shown[3:] - W) > 0.05).all()


def test_sources_that_disagree_are_the_ones_we_know_of():
    problem, stated = scripts.design_problem(), DesignProblem()
    assert problem.bounds.height[1] / MM == pytest.approx(24)
    assert stated.bounds.height[1] / MM == pytest.approx(25)
    assert (problem.combined, stated.combined) == ("product", "sum")
