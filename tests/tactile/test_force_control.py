"""The PD controller on the contact force: its limits by polynomials and by the running loop."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.control.loop import run_loop
from softgrip.control.pid import PERIOD, Gains
from softgrip.errors import InvalidInputError
from softgrip.tactile.force_control import ForceController, largest_loop_gain, tuned_gains

LAG, STIFFNESS = 0.03, 250.0


class LinearGrip:
    """A lag to the commanded position, then a linear contact."""

    def __init__(self, gap=0.0):
        self.position, self.gap = 0.0, gap

    def advance(self, command, duration):
        self.position += (command - self.position) * -np.expm1(-duration / LAG)
        return max(STIFFNESS * (self.position - self.gap), 0.0)


def closed_loop(loop_gain, derivative, lag=LAG):
    """Return the poles of the command as a position, the plant's by `derivative` k kd / period."""
    a = np.exp(-PERIOD / lag)
    b = 1 - a
    return np.roots([1, -a, b * (loop_gain + derivative), -b * derivative])


@given(lag=st.floats(0.005, 0.2), share=st.floats(0.05, 0.99))
def test_position_is_stable_just_below_the_largest_gain_only(lag, share):
    limit = largest_loop_gain(lag)
    assert np.abs(closed_loop(share * limit, 0.0, lag)).max() < 1
    assert np.abs(closed_loop(limit / share, 0.0, lag)).max() > 1


@given(lag=st.floats(0.005, 0.2), derivative=st.floats(0, 10))
def test_no_derivative_allows_more_gain(lag, derivative):
    poles = closed_loop(1.001 * largest_loop_gain(lag), derivative, lag)
    assert np.abs(poles).max() > 1


def resting_force(kp, gap):
    """Return where the position rests, by hand: kp times the error, less the gap, times k."""
    return max(STIFFNESS * (kp * 0.3 - gap) / (1 + kp * STIFFNESS), 0.0)


def run(gains, command, gap=0.0):
    return run_loop(
        LinearGrip(gap), ForceController(gains, command), 0.3, duration=8.0, delay_samples=1
    )


@pytest.mark.parametrize("gap", [0.0, 2e-4])
def test_position_rests_where_its_formula_says(gap):
    kp = 0.5 * largest_loop_gain(LAG) / STIFFNESS
    found = run(Gains(kp=kp), "position", gap)
    assert found.measured[-1] == pytest.approx(resting_force(kp, gap), rel=1e-6)
    assert found.measured[-1] < 0.16


def test_position_never_closes_a_gap_beyond_its_reach():
    found = run(Gains(kp=0.5 * largest_loop_gain(LAG) / STIFFNESS), "position", gap=5e-3)
    assert not found.measured.any()
    assert resting_force(0.5 / STIFFNESS, 5e-3) == 0


def test_change_leaves_no_error_whatever_the_gap():
    gains = tuned_gains(STIFFNESS, LAG, 1.5 * PERIOD)
    for gap in (0.0, 5e-3):
        found = run(gains, "change", gap)
        assert found.measured[-1] == pytest.approx(0.3, rel=1e-6)
        # Skogestad's rule hardly overshoots on its own plant; the contact here is an edge, too.
        assert found.measured.max() < 1.1 * 0.3


@pytest.mark.parametrize("factor", [1.0, 2.0, 4.0])
def test_change_is_stable_with_twice_the_gains_and_not_with_four_times(factor):
    """The rule leaves a gain margin of about three."""
    gains = tuned_gains(STIFFNESS / factor, LAG, 1.5 * PERIOD)
    end = run(gains, "change").measured[-40:]
    assert (np.ptp(end) < 1e-3) == (factor < 3)


def test_speed_is_limited():
    controller = ForceController(Gains(kp=1.0), speed=0.05)
    first, second = (float(controller.update(1.0, 0.0)) for _ in range(2))
    assert (first, second) == pytest.approx((0.05 * PERIOD, 0.1 * PERIOD))


def test_what_is_no_pd_controller_is_refused():
    with pytest.raises(InvalidInputError, match="ki"):
        ForceController(Gains(kp=1.0, ki=1.0))
    with pytest.raises(InvalidInputError, match="command"):
        ForceController(Gains(kp=1.0), "speed")  # type: ignore[arg-type]


@pytest.mark.parametrize("bad", [0.0, -1.0])
def test_arguments_that_cannot_be_are_refused(bad):
    for call in (lambda: tuned_gains(bad, 0.1, 0.1), lambda: largest_loop_gain(bad)):
        with pytest.raises(InvalidInputError):
            call()
