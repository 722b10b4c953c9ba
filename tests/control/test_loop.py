"""The sampled loop: order of samples, limits, delay, batches; and the linear plant in it."""

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softgrip.control.loop import run_loop
from softgrip.control.pid import PID, Gains, pid_state_space
from softgrip.control.state_space_plant import StateSpacePlant
from softgrip.dynamics.second_order import SecondOrder, full_state_space, state_space
from softgrip.errors import InvalidInputError

INTEGRATOR = control.ss([[0]], [[1]], [[1]], 0)
FINGER = SecondOrder(2.86, 0.7, 2.4e-5)


class Constant:
    """A controller that commands what it is told to."""

    def __init__(self, command):
        self.command = command

    def update(self, reference, measurement):
        return self.command


def test_samples_are_measured_before_the_command_of_their_time():
    result = run_loop(StateSpacePlant(INTEGRATOR), Constant(2.0), 0.0, duration=1.0, period=0.25)
    np.testing.assert_allclose(result.time, [0, 0.25, 0.5, 0.75, 1])
    np.testing.assert_allclose(result.measured, [0, 0.5, 1, 1.5, 2])
    np.testing.assert_allclose(result.command, np.full(5, 2.0))


def test_limit_cuts_on_the_way_to_the_plant():
    result = run_loop(
        StateSpacePlant(INTEGRATOR), Constant(-9.0), 0.0, duration=1.0, period=0.5, limit=2.0
    )
    np.testing.assert_allclose(result.measured, [0, -1, -2])


def test_delay_brings_the_command_late():
    result = run_loop(
        StateSpacePlant(INTEGRATOR), Constant(1.0), 0.0, duration=1, period=0.25, delay_samples=2
    )
    np.testing.assert_allclose(result.command, [0, 0, 1, 1, 1])
    np.testing.assert_allclose(result.measured, [0, 0, 0, 0.25, 0.5])


def test_reference_as_function_number_and_array_are_one():
    def loop(reference):
        return run_loop(
            StateSpacePlant(INTEGRATOR), PID(Gains(1.0)), reference, duration=1
        ).measured

    np.testing.assert_array_equal(loop(0.5), loop(lambda t: 0.5))
    np.testing.assert_array_equal(loop(0.5), loop(np.full(41, 0.5)))


def test_proportional_loop_around_an_integrator_is_a_geometric_series():
    result = run_loop(StateSpacePlant(INTEGRATOR), PID(Gains(2.0)), 1.0, duration=2.0)
    np.testing.assert_allclose(result.measured, 1 - (1 - 2 * 0.025) ** np.arange(81))


@pytest.mark.parametrize(
    "plant", [state_space(FINGER), full_state_space(FINGER, 3000.0)], ids=["(4.14)", "(4.15)"]
)
def test_fast_sampling_comes_to_the_continuous_loop(plant):
    gain = 0.3 / abs(complex(plant(1j)))
    gains = Gains(gain, 0.2 * gain, 0.3 * gain, 0.1)
    result = run_loop(
        StateSpacePlant(plant), PID(gains, period=1e-3), 1.0, duration=4.0, period=1e-3
    )
    closed = control.feedback(plant * pid_state_space(gains), 1)
    exact = control.step_response(closed, result.time).outputs
    # Half a millisecond of hold at a slope of about 1 rad/s.
    np.testing.assert_allclose(result.measured, exact, atol=1e-3)


def test_batch_of_references_is_each_run():
    wanted = np.array([0.2, 0.5, 1.0])
    reference = np.tile(wanted[:, None], (1, 81))

    def loop(reference):
        plant = StateSpacePlant(full_state_space(FINGER, 3000.0))
        pid = PID(Gains(20.0, 2.0, 5.0), limits=(-30, 30))
        return run_loop(plant, pid, reference, duration=2.0, limit=30)

    batch = loop(reference)
    assert batch.measured.shape == batch.command.shape == (3, 81)
    for run in range(3):
        one = loop(float(wanted[run]))
        np.testing.assert_allclose(batch.measured[run], one.measured, atol=1e-12)
        np.testing.assert_allclose(batch.command[run], one.command, atol=1e-9)


def test_map_of_gains_is_each_gain():
    def loop(kp):
        return run_loop(StateSpacePlant(INTEGRATOR), PID(Gains(kp)), 1.0, duration=1.0).measured

    both = loop(np.array([1.0, 3.0]))
    np.testing.assert_allclose(both, [loop(1.0), loop(3.0)])


def test_record_cannot_be_written_to():
    result = run_loop(StateSpacePlant(INTEGRATOR), PID(Gains(1.0)), 1.0, duration=1.0)
    with pytest.raises(ValueError, match="read-only"):
        result.measured[0] = 1.0


@pytest.mark.parametrize(
    "options",
    [
        {"duration": 0.0},
        {"duration": 0.01},
        {"duration": 1.0, "period": 0.0},
        {"duration": 1.0, "limit": 0.0},
        {"duration": 1.0, "delay_samples": -1},
    ],
)
def test_loop_out_of_range(options):
    with pytest.raises(InvalidInputError):
        run_loop(StateSpacePlant(INTEGRATOR), PID(Gains(1.0)), 1.0, **options)


def test_reference_of_another_length():
    with pytest.raises(InvalidInputError, match="41 samples"):
        run_loop(StateSpacePlant(INTEGRATOR), PID(Gains(1.0)), np.ones(40), duration=1.0)


@settings(max_examples=40)
@given(durations=st.lists(st.floats(0, 1), min_size=1, max_size=5), u=st.floats(-10, 10))
def test_plant_does_not_care_how_a_held_command_is_cut(durations, u):
    system = state_space(SecondOrder(3.0, 0.3))
    parts, whole = StateSpacePlant(system), StateSpacePlant(system)
    for duration in durations:
        last = parts.advance(u, duration)
    assert last == pytest.approx(float(whole.advance(u, sum(durations))), abs=1e-9)


def test_plant_is_exact_between_samples():
    system = full_state_space(FINGER, 3000.0)
    time = np.arange(0, 4, 0.1)
    plant = StateSpacePlant(system)
    found = [float(plant.advance(10.0, 0.1 if k else 0.0)) for k in range(time.size)]
    exact = control.forced_response(system, time, np.full(time.size, 10.0)).outputs
    np.testing.assert_allclose(found, exact, atol=1e-9)


def test_plant_starts_where_it_is_told():
    plant = StateSpacePlant(control.ss([[-1]], [[1]], [[1]], 0), initial=[[1.0, 2.0]])
    np.testing.assert_allclose(plant.advance(0.0, 1.0), np.exp(-1) * np.array([1, 2]))


def test_quantised_measurement_is_a_multiple_and_never_far():
    rough = StateSpacePlant(INTEGRATOR, quantum=0.1)
    fine = StateSpacePlant(INTEGRATOR)
    for _ in range(50):
        found, true = float(rough.advance(1.0, 0.033)), float(fine.advance(1.0, 0.033))
        assert found / 0.1 == pytest.approx(round(found / 0.1), abs=1e-9)
        assert abs(found - true) <= 0.05 + 1e-12


def test_noise_follows_its_seed_and_its_size():
    def readings(seed):
        plant = StateSpacePlant(INTEGRATOR, noise=0.2, seed=seed)
        return np.array([plant.advance(np.zeros(200), 0.0) for _ in range(20)])

    np.testing.assert_array_equal(readings(1), readings(1))
    assert np.any(readings(1) != readings(2))
    # 4000 readings give the standard deviation to 1.1 %; four of these.
    assert readings(1).std() == pytest.approx(0.2, rel=0.045)


@pytest.mark.parametrize(
    ("system", "options"),
    [
        (control.ss([[0]], [[1]], [[1]], 1), {}),
        (control.ss([[0]], [[1, 1]], [[1]], [[0, 0]]), {}),
        (control.ss([[0]], [[1]], [[1]], 0, dt=0.1), {}),
        (INTEGRATOR, {"noise": -1.0}),
        (INTEGRATOR, {"quantum": np.nan}),
    ],
)
def test_plant_out_of_range(system, options):
    with pytest.raises(InvalidInputError):
        StateSpacePlant(system, **options)
