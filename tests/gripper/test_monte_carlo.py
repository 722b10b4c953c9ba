"""Many grippers at once: against python-control, period by period, and against step_metrics."""

import tracemalloc
import warnings
from dataclasses import replace

import control
import distributed
import joblib
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

from softgrip.control import step_metrics
from softgrip.errors import InvalidInputError
from softgrip.gripper.batch_loop import sensor_noise, unaware
from softgrip.gripper.gripper_batch import GripperBatch, Trial, draw_grippers
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.monte_carlo import in_parts, joined, simulate, study
from softgrip.gripper.plant import PRINTED, FingerDynamics, Gripper, finger_state_space
from softgrip.gripper.sampled_plant import held_motion
from softgrip.gripper.shaping_filter import FAST, SLOW, filter_state_space
from tests.gripper.period_by_period import forced, gripper_of

TARGET = (0.714, 0.842)
FILTERS = {"fast": filter_state_space(*FAST), "slow": filter_state_space(*SLOW)}
LOOPS = {
    name: controller_matrices(PRINTED, mean_inverse(PRINTED), H) for name, H in FILTERS.items()
}
POSITIVE = st.floats(0.3, 12)
# Of two ways to the same trajectory [rad, rev/s]. One unit in the last place of the controller's
# coefficients moves it by up to 8e-10 in these trials, and processors and NumPys round differently.
ROUNDING = 1e-8


def assert_same(found, true):
    """To rounding: a product of another size may add up in another order."""
    for name in ("settling", "overshoot", "synchronization", "peak_command"):
        np.testing.assert_allclose(getattr(found, name), getattr(true, name), rtol=1e-9)


@pytest.mark.parametrize("name", LOOPS)
@pytest.mark.parametrize(
    "trial",
    [
        Trial(TARGET),
        Trial(TARGET, limit=1.0),
        Trial(TARGET, limit=5.0, noise=0.035, delay_samples=1, seed=3),
    ],
    ids=["free", "limited", "limited, noisy, late"],
)
def test_trajectories_are_those_of_forced_response(name, trial):
    batch = draw_grippers(PRINTED, 3, seed=4)
    found = simulate(batch, LOOPS[name], trial, keep="trajectories")
    for number in range(batch.count):
        loop = InternalModelController(LOOPS[name], TARGET, limit=trial.limit)
        noise = sensor_noise(batch, trial)[number]
        angles, commands = forced(gripper_of(batch, number), trial, loop, noise)
        np.testing.assert_allclose(found.angles[number], angles, rtol=0, atol=ROUNDING)
        np.testing.assert_allclose(found.commands[number], commands, rtol=0, atol=ROUNDING)
    assert (found.peak_command <= trial.limit).all()


def test_a_model_that_does_not_know_the_limit_is_the_command_cut_outside():
    trial = Trial(TARGET, limit=1.0)
    batch = draw_grippers(PRINTED, 1, seed=4)
    loop = InternalModelController(LOOPS["fast"], TARGET)
    angles, commands = forced(gripper_of(batch, 0), trial, loop)
    found = simulate(batch, unaware(LOOPS["fast"]), trial, keep="trajectories")
    np.testing.assert_allclose(found.angles[0], angles, rtol=0, atol=ROUNDING)
    assert np.abs(commands).max() == 1.0


@settings(max_examples=25)
@given(
    st.lists(st.tuples(POSITIVE, POSITIVE, POSITIVE), min_size=1, max_size=3),
    st.floats(1e-3, 0.2),
    st.integers(1, 40),
)
def test_held_motion_is_the_matrix_exponential(parameters, step, points):
    """Of a chain: angle, rate, pump, command; under-, over- and critically damped."""
    c, k, g = np.array(parameters).T
    found = held_motion(c, k, g, step, points)
    for i in range(c.size):
        A = np.array([[0, 1, 0, 0], [-k[i], -c[i], g[i], 0], [0, 0, 0, 1], [0, 0, 0, 0]])
        for point in (1, points):
            true = expm(A * step * point)
            np.testing.assert_allclose(found.angle[i, :, point - 1], true[0], atol=1e-11)
        np.testing.assert_allclose(found.rate[i], true[1], atol=1e-11)


def test_critical_damping_is_no_special_case():
    found = held_motion(np.array([2.0]), np.ones(1), np.ones(1), 0.1, 1)
    assert found.angle[0, 1, 0] == pytest.approx(0.1 * np.exp(-0.1), rel=1e-12)


@settings(max_examples=80)
@given(
    st.lists(st.tuples(POSITIVE, POSITIVE, POSITIVE), min_size=2, max_size=4),
    st.lists(st.floats(-2, 2), min_size=10, max_size=10),
    st.floats(0.05, 3),
)
def test_metrics_are_those_of_step_metrics(parameters, commands, size):
    fingers = Gripper(tuple(FingerDynamics(*p) for p in parameters))
    target = tuple(size * (1 + 0.1 * k) for k in range(len(parameters)))
    trial = Trial(target, 1.0, feedforward=tuple(commands), bands=(0.02, 0.05, 0.5))
    found = simulate(GripperBatch.of(fingers), None, trial, keep="trajectories")
    time, angles = 1e-3 * np.arange(1001), found.angles[0]
    for band, times in zip(trial.bands, found.settling[:, 0], strict=True):
        true = step_metrics.settling_time(time, angles, final=target, band=band)
        np.testing.assert_allclose(times, true, rtol=0, atol=1e-6)
    # Metrics come from a power series, trajectories from a matrix: alike to 1e-10 rad, as promised.
    allowed = 1e-10 / size
    over = step_metrics.overshoot(angles, target=target)
    np.testing.assert_allclose(found.overshoot[0], over, rtol=0, atol=allowed)
    apart = np.ptp(angles / np.array(target)[:, None], axis=0).max()
    # It is the difference of two angles, each of them as near as that.
    assert found.synchronization[0] == pytest.approx(apart, abs=2 * allowed)


def test_settling_at_every_kind_of_end():
    """Settled within the first point, within a period, at the edge of one, and never."""
    plant = GripperBatch.of(PRINTED)
    rest = simulate(plant, None, Trial(TARGET, 1.0, feedforward=(0.0,) * 10))
    assert np.isinf(rest.settling).all()
    close = Trial((1e-9, 1e-9), 0.1, feedforward=(1.0,), bands=(0.99, 0.995), plant_step=0.1)
    assert np.isinf(simulate(plant, None, close).settling).all()
    # One point a period: the target is what the first point reaches, to a part of the band.
    one = simulate(plant, None, replace(close, target=(1.0, 1.0)), keep="trajectories")
    reached = replace(close, target=tuple(one.angles[0, :, -1]), bands=(0.5, 0.25))
    np.testing.assert_allclose(simulate(plant, None, reached).settling[:, 0, 0], [0.05, 0.075])


def test_a_gripper_is_the_same_in_any_batch_and_part():
    trial = Trial(TARGET, limit=5.0, noise=0.035, seed=2)
    whole = draw_grippers(PRINTED, 50, seed=7)
    alone = draw_grippers(PRINTED, 5, seed=7, first=20)
    assert (alone.stiffness == whole.stiffness[20:25]).all()
    at_once = simulate(whole, LOOPS["slow"], trial)
    parts = list(in_parts(whole, LOOPS["slow"], trial, memory=50e3))
    assert len(parts) > 2
    pieces = joined([outcome for _, outcome in parts])
    single = simulate(alone, LOOPS["slow"], trial)
    assert_same(pieces, at_once)
    np.testing.assert_allclose(single.settling, at_once.settling[:, 20:25], rtol=1e-9)


def test_draws_fill_the_bounds_of_section_6_4_evenly():
    drawn = draw_grippers(PRINTED, 20_000, seed=5)
    nominal = GripperBatch.of(PRINTED)
    for name, bound in (("damping", 0.143), ("stiffness", 0.059)):
        off = getattr(drawn, name) / getattr(nominal, name) - 1
        assert np.abs(off).max() <= bound
        # Uniform: standard deviation bound / sqrt(3); of 40,000 draws good to 1 % and then some.
        assert off.std() == pytest.approx(bound / 3**0.5, rel=0.02)
        assert np.abs(off.mean(axis=0)).max() < 4 * bound / (3 * 20_000) ** 0.5
        assert abs(np.corrcoef(off.T)[0, 1]) < 4 / 20_000**0.5
    assert (drawn.gain == 7.831).all()


def test_noise_is_normal_and_its_own_for_each_gripper():
    trial = Trial(TARGET, noise=0.035, seed=1)
    found = sensor_noise(draw_grippers(PRINTED, 500, seed=1), trial)
    assert found.std() == pytest.approx(0.035, rel=0.02)  # 30,000 draws: 0.4 %
    assert abs(np.corrcoef(found.reshape(500, -1)[:2])[0, 1]) < 4 / 60**0.5


def test_memory_does_not_grow_with_the_number():
    trial = Trial(TARGET, limit=5.0)
    peaks = []
    for count in (1000, 4000):
        batch = draw_grippers(PRINTED, count)
        tracemalloc.start()
        try:
            for _ in in_parts(batch, LOOPS["slow"], trial, "trajectories", memory=16e6):
                pass
            peaks.append(tracemalloc.get_traced_memory()[1])
        finally:
            tracemalloc.stop()
    assert peaks[1] < 1.1 * peaks[0]
    # A part's trajectories, those of the part before that the caller holds, and the block at work.
    assert peaks[1] < 2 * 16e6 + 6 * 4e6


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"target": (0.5,)}, "2 angles"),
        ({"target": (0.5, 0.0)}, "other than 0"),
        ({"period": 0.05}, "each 0.05 s"),
        ({"duration": 0.25}, "multiple"),
        ({"limit": -1.0}, "limit"),
        ({"noise": -1.0}, ">= 0"),
        ({"bands": (2.0,)}, "between"),
        ({"feedforward": (1.0,)}, "30 commands"),
    ],
)
def test_impossible_trials_are_refused(change, match):
    with pytest.raises(InvalidInputError, match=match):
        simulate(GripperBatch.of(PRINTED), LOOPS["slow"], replace(Trial(TARGET), **change))


def test_trajectories_that_do_not_fit_are_refused():
    with pytest.raises(InvalidInputError, match="in_parts"):
        simulate(draw_grippers(PRINTED, 100), None, Trial(TARGET), keep="trajectories", memory=1e6)


@pytest.mark.parametrize("bad", [{"count": 0}, {"first": -1}, {"damping": 1.0}])
def test_impossible_draws_are_refused(bad):
    with pytest.raises(InvalidInputError):
        draw_grippers(PRINTED, **{"count": 2, **bad})


def test_batches_of_another_shape_are_refused():
    one = np.ones((2, 2))
    with pytest.raises(InvalidInputError, match="one shape"):
        GripperBatch(one, one, one[0])
    with pytest.raises(InvalidInputError, match="> 0"):
        GripperBatch(one, -one, one)


def test_single_finger_of_a_batch_is_eq_6_15():
    _, angle = control.step_response(finger_state_space(PRINTED.fingers[1]), 1e-3 * np.arange(1001))
    trial = Trial(TARGET, 1.0, feedforward=(1.0,) * 10)
    found = simulate(GripperBatch.of(PRINTED), None, trial, keep="trajectories")
    np.testing.assert_allclose(found.angles[0, 1], angle, atol=1e-10)


def run(**how):
    return study(PRINTED, 60, LOOPS["slow"], Trial(TARGET, limit=5.0, noise=0.01), seed=11, **how)


def test_parts_on_threads_give_the_serial_numbers():
    assert_same(run(parts=7), run())
    with joblib.parallel_config(backend="threading", n_jobs=2):
        assert_same(run(parts=7), run())


def test_a_dask_cluster_gives_the_serial_numbers():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the cluster's own, on its way up and down
        with (
            distributed.LocalCluster(
                n_workers=2, threads_per_worker=1, processes=False, protocol="tcp",
                host="127.0.0.1", dashboard_address="127.0.0.1:0",
            ) as cluster,
            distributed.Client(cluster) as client,
        ):  # fmt: skip
            assert len(client.scheduler_info()["workers"]) == 2
            with joblib.parallel_config(backend="dask"):
                found = run(parts=6)
    assert_same(found, run())


def test_more_parts_than_grippers_are_refused():
    with pytest.raises(InvalidInputError, match="1 to 60"):
        run(parts=61)
