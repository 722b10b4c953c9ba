"""What captions and findings of Chapter 4 say in words is what its figures and tables have."""

import numpy as np
import pytest

from book.chapter_4.controllers import own_step
from book.companion.drawn import drawn
from softgrip.logs.reader import kept_log
from softgrip.logs.steps import judge_step_log
from softgrip.pump.flow import PARAMETER_SETS


def test_the_full_model_is_better_by_the_wide_criteria_alone():
    alone, full = (judge_step_log(kept_log(f"pid-{x}")) for x in ("actuator", "full"))
    own_alone, own_full = map(own_step, ("actuator", "full"))
    better = {"5_percent": True, "5_deg": True, "2_percent": False, "2_deg": False}
    for criterion, is_better in better.items():
        name = f"settled_{criterion}"
        assert (getattr(full, name) < getattr(alone, name)) == is_better
        assert getattr(own_alone, name) < getattr(own_full, name)


def test_rates_of_figure_4_3_are_a_quarter_and_twice():
    default = PARAMETER_SETS["default"].flow
    for name, times in (("smaller lead", 1 / 4), ("higher speed", 2)):
        assert PARAMETER_SETS[name].flow / default == pytest.approx(times)


@pytest.mark.parametrize("panel", ["(a)", "(b)", "(c)", "(d)"])
def test_the_constant_model_ends_at_half_the_pressure_and_the_modified_one_is_best(panel):
    pressure = {
        name: drawn("Figure 4.4", name, panel)[1]
        for name in ("simulated", "constant", "modified", "filter")
    }
    true, end = pressure["simulated"], -1
    assert pressure["constant"][end] / true[end] == pytest.approx(0.5, abs=0.05)
    high = true > 0.1
    worst = {name: np.abs(found[high] / true[high] - 1).max() for name, found in pressure.items()}
    assert worst["modified"] < worst["filter"] < worst["constant"]
    # The filter lags.
    assert pressure["filter"][end] < true[end]


def test_filters_fall_and_rise_as_figure_4_a_says():
    for name in ("as printed", "with pressure"):
        _, seen = drawn("Figure 4.A", name, "pushing")
        assert seen[-1] < seen[0] / 2
    assert (np.diff(drawn("Figure 4.A", "as printed", "holding")[1])[40:] < 0).all()
    time, other = drawn("Figure 4.A", "with pressure", "holding")
    assert other[time < 1].min() < other[0] < other[time > 3].min()
    # Flat: the last three seconds of six change it by less than a tenth.
    assert np.ptp(other[time > 3]) < 0.1 * other[-1]
