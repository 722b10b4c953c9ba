"""The PID controller: textbook arithmetic, its continuous twin, limits and windup."""

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.control.loop import run_loop
from softgrip.control.pid import PID, Gains, pid_state_space
from softgrip.control.state_space_plant import StateSpacePlant
from softgrip.control.step_metrics import overshoot
from softgrip.errors import InvalidInputError

ERRORS = np.random.default_rng(0).normal(size=50)


def test_proportional_alone_is_a_factor():
    pid = PID(Gains(kp=3.0))
    assert [float(pid.update(e, 0.0)) for e in ERRORS] == pytest.approx(3 * ERRORS)


def test_integral_is_the_sum_of_the_errors():
    pid = PID(Gains(kp=0.0, ki=2.0), period=0.1)
    found = [float(pid.update(e, 0.0)) for e in ERRORS]
    assert found == pytest.approx(0.2 * np.cumsum(ERRORS))


def test_derivative_of_a_ramp_comes_to_its_slope():
    pid = PID(Gains(kp=0.0, kd=2.0, derivative_filter=0.1))
    found = [float(pid.update(3.0 * t, 0.0)) for t in 0.025 * np.arange(100)]
    # A first-order lag of four periods: each difference equation step leaves 0.1 / 0.125 of it.
    assert found == pytest.approx(6.0 * (1 - 0.8 ** np.arange(100)))


def test_derivative_on_the_measurement_ignores_the_reference():
    gains = Gains(kp=0.0, kd=1.0)
    kicked, calm = PID(gains), PID(gains, derivative_on="measurement")
    assert float(kicked.update(1.0, 0.5)) > 0
    assert float(calm.update(1.0, 0.5)) == 0
    assert float(calm.update(1.0, 0.6)) < 0


gain = st.floats(0, 5)


@given(kp=gain, ki=gain, kd=gain, tau=st.floats(0.05, 1), w=st.floats(0.1, 10))
def test_state_space_has_the_response_of_the_formula(kp, ki, kd, tau, w):
    found = complex(pid_state_space(Gains(kp, ki, kd, tau))(1j * w))
    expected = kp + ki / (1j * w) + kd * 1j * w / (1 + tau * 1j * w)
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-12)


def test_state_space_keeps_no_idle_state():
    assert [pid_state_space(Gains(1, i, d)).nstates for i, d in ((0, 0), (1, 0), (0, 1))] == [
        0,
        1,
        1,
    ]


def test_sampled_controller_comes_to_the_continuous_one_as_the_period_shrinks():
    gains, plant = (
        Gains(2.0, 1.5, 0.5, 0.1),
        control.ss([[0, 1], [-4, -2]], [[0], [4]], [[1, 0]], 0),
    )
    closed = control.feedback(plant * pid_state_space(gains), 1)
    gaps = []
    for period in (0.02, 0.01, 0.005):
        result = run_loop(
            StateSpacePlant(plant), PID(gains, period=period), 1.0, duration=5, period=period
        )
        exact = control.step_response(closed, result.time).outputs
        gaps.append(np.max(np.abs(result.measured - exact)))
    # Backward differences are of first order: half the period, half the gap.
    assert gaps[1] / gaps[0] == pytest.approx(0.5, abs=0.1)
    assert gaps[2] / gaps[1] == pytest.approx(0.5, abs=0.1)


@given(st.lists(st.floats(-100, 100), min_size=1, max_size=30))
def test_command_stays_within_its_limits(errors):
    pid = PID(Gains(5.0, 3.0, 1.0), limits=(-1.0, 2.0))
    commands = [float(pid.update(e, 0.0)) for e in errors]
    assert min(commands) >= -1.0
    assert max(commands) <= 2.0


def test_clamped_integral_lets_go_at_once():
    def after_a_long_saturation(anti_windup):
        pid = PID(Gains(1.0, 10.0), limits=(-1, 1), anti_windup=anti_windup)
        for _ in range(400):
            pid.update(5.0, 0.0)
        return float(pid.update(0.0, 1.0))

    assert after_a_long_saturation(False) == 1.0
    assert after_a_long_saturation(True) < 0.0


def test_anti_windup_lowers_the_overshoot_of_a_limited_loop():
    def beyond(anti_windup):
        pid = PID(Gains(2.0, 1.0), limits=(-0.1, 0.1), anti_windup=anti_windup)
        plant = StateSpacePlant(control.ss([[0]], [[1]], [[1]], 0))
        return overshoot(run_loop(plant, pid, 1.0, duration=60).measured, target=1.0)

    assert beyond(True) < 0.5 * beyond(False)


def test_reset_forgets():
    pid = PID(Gains(1.0, 2.0, 3.0))
    first = [float(pid.update(e, 0.0)) for e in ERRORS]
    pid.reset()
    assert [float(pid.update(e, 0.0)) for e in ERRORS] == first


def test_batch_is_each_run_by_itself():
    errors = np.random.default_rng(1).normal(size=(20, 3)) * 3
    batch = PID(Gains(2.0, 5.0, 0.1), limits=(-4, 4))
    found = np.array([batch.update(e, np.zeros(3)) for e in errors])
    for run in range(3):
        one = PID(Gains(2.0, 5.0, 0.1), limits=(-4, 4))
        assert [float(one.update(e, 0.0)) for e in errors[:, run]] == pytest.approx(found[:, run])


def test_map_of_gains_is_each_gain_by_itself():
    kp, ki = np.array([1.0, 2.0]), np.array([0.0, 3.0])
    both = PID(Gains(kp, ki))
    single = [PID(Gains(float(p), float(i))) for p, i in zip(kp, ki, strict=True)]
    for e in ERRORS:
        assert both.update(e, 0.0) == pytest.approx([float(c.update(e, 0.0)) for c in single])
    with pytest.raises(InvalidInputError, match="one number each"):
        pid_state_space(Gains(kp, ki))


@pytest.mark.parametrize("gains", [(np.nan,), (1, np.inf), (1, 0, 0, 0), (1, 0, 0, -1)])
def test_gains_out_of_range(gains):
    with pytest.raises(InvalidInputError):
        Gains(*gains)


@pytest.mark.parametrize(
    "options", [{"limits": (1, -1)}, {"period": 0}, {"derivative_on": "output"}]
)
def test_controller_out_of_range(options):
    with pytest.raises(InvalidInputError):
        PID(Gains(1.0), **options)
