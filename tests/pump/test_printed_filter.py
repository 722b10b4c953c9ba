"""Eq. (4.8)-(4.10) as printed: what they can and cannot find."""

import control
import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.pump.observability import observability_matrix, observable_rank
from softgrip.pump.printed_filter import open_loop_capacity, printed_filter, run_printed

from .gaussian import JointGaussian

K = 2e-12
LEVELS = {
    "capacity": 1e-9,
    "capacity_std": 3e-10,
    "capacity_step": 1e-12,
    "angle_std": 0.1,
    "angle_step": 0.02,
    "sensor": 0.035,
}
SCALE = np.array([1e-9, 1.0])


def angles(n, seed=0):
    rng = np.random.default_rng(seed)
    return np.linspace(0, 1.2, n) + rng.normal(0, LEVELS["sensor"], n)


def joint(kalman, samples):
    """Return the oracle of a filter as it stands, which a run of it moves on."""
    F, b = np.tile(kalman.F, (samples - 1, 1, 1)), np.zeros((samples - 1, 2))
    start = kalman.x[:, 0].copy(), kalman.P.copy()
    return JointGaussian(F, b, kalman.H, kalman.Q.copy(), kalman.R, *start)


@pytest.mark.parametrize("samples", [2, 10, 400])
def test_printed_matrices_have_rank_one_however_long_the_record(samples):
    """Eq. (4.10): its matrices have no way from the capacity to what is measured."""
    kalman = printed_filter(K, **LEVELS)
    F = np.tile(kalman.F, (samples, 1, 1))
    assert observable_rank(F, kalman.H, SCALE) == 1
    # Had the angle's row held the capacity, two samples would do.
    F[:, 1, 0] = 1e8
    assert observable_rank(F[:1], kalman.H, SCALE) == 2


def test_observability_matrix_is_that_of_python_control():
    kalman = printed_filter(K, **LEVELS)
    ours = observability_matrix(kalman.F[np.newaxis], kalman.H)
    np.testing.assert_array_equal(ours, control.obsv(kalman.F, kalman.H))


def test_gramian_holds_nothing_of_the_capacity():
    kalman = printed_filter(K, **LEVELS)
    traces = observability_matrix(np.tile(kalman.F, (50, 1, 1)), kalman.H)
    W = traces.T @ traces
    np.testing.assert_array_equal(W, [[0.0, 0.0], [0.0, 51.0]])


def test_two_capacities_leave_the_same_measurements_and_innovations():
    measured = angles(40)
    runs = []
    for start in (1e-9, 5e-9):
        kalman = printed_filter(K, **(LEVELS | {"capacity": start}))
        runs.append(run_printed(kalman, measured)[0])
    # The angle's estimate is the same bit for bit; the capacities never come nearer.
    np.testing.assert_array_equal(runs[0][:, 1], runs[1][:, 1])
    np.testing.assert_allclose(runs[1][:, 0] - runs[0][:, 0], 4e-9, rtol=1e-12)


def test_filter_agrees_with_the_joint_gaussian():
    """Eq. (4.8) and (4.9) written out for all samples, and conditioned at once."""
    measured = angles(8)
    kalman = printed_filter(K, **LEVELS)
    oracle = joint(kalman, 8)
    states, covariances = run_printed(kalman, measured)
    for k in range(8):
        mean, covariance = oracle.state(k, measured[: k + 1, None])
        np.testing.assert_allclose(states[k] / SCALE, mean / SCALE, rtol=1e-9)
        np.testing.assert_allclose(
            covariances[k] / np.outer(SCALE, SCALE),
            covariance / np.outer(SCALE, SCALE),
            rtol=1e-9,
            atol=1e-15,
        )


def test_estimate_is_the_guess_plus_the_sum_of_the_smoothed_angles():
    measured = angles(12)
    kalman = printed_filter(K, **LEVELS)
    oracle = joint(kalman, 12)
    smoothed = [oracle.state(k, measured[:, None])[0][1] for k in range(12)]
    states, _ = run_printed(kalman, measured)
    expected = open_loop_capacity(smoothed, K, LEVELS["capacity"])[-1]
    assert states[-1, 0] == pytest.approx(expected, rel=1e-9)


def test_capacity_drifts_while_the_finger_stands_still():
    held = np.full(400, 0.8)
    states, _ = run_printed(printed_filter(K, **LEVELS), held)
    drift = np.diff(states[200:, 0])
    # By sample 200 the angle has settled to better than a part in a million.
    np.testing.assert_allclose(drift, K * 0.8, rtol=1e-6)


def test_variance_never_falls_below_that_of_the_guess():
    _, covariances = run_printed(printed_filter(K, **LEVELS), angles(100))
    steps = LEVELS["capacity_step"] ** 2 * np.arange(100)
    assert (covariances[:, 0, 0] >= (LEVELS["capacity_std"] ** 2 + steps) * (1 - 1e-12)).all()


@pytest.mark.parametrize(
    ("name", "value"), [("sensor", 0.0), ("angle_step", -1.0), ("capacity", float("nan"))]
)
def test_bad_level_is_refused(name, value):
    with pytest.raises(InvalidInputError, match=name):
        printed_filter(K, **(LEVELS | {name: value}))


def test_shapes_that_do_not_fit_are_refused():
    with pytest.raises(InvalidInputError, match="shapes"):
        observability_matrix(np.eye(2), np.eye(2))
    with pytest.raises(InvalidInputError, match="scale"):
        observable_rank(np.eye(2)[np.newaxis], np.eye(2), [1.0])
    with pytest.raises(InvalidInputError, match="angle"):
        run_printed(printed_filter(K, **LEVELS), np.zeros((3, 1)))


def test_angles_that_are_nan_are_predicted_over():
    measured = angles(30)
    missing = np.isin(np.arange(30), [0, 7, 8, 29])
    kalman = printed_filter(K, **LEVELS)
    oracle, kept = joint(kalman, 30), np.flatnonzero(~missing)
    oracle.Z, oracle.z_mean = oracle.Z[kept], np.array(oracle.z_mean)[kept]
    found, _ = run_printed(kalman, np.where(missing, np.nan, measured))
    for k in (1, 7, 8, 9, 29):
        before = int(np.count_nonzero(kept <= k))
        mean, _ = oracle.state(k, measured[kept[:before], None])
        np.testing.assert_allclose(found[k] / SCALE, mean / SCALE, rtol=1e-9)
    with pytest.raises(InvalidInputError, match="finite"):
        run_printed(printed_filter(K, **LEVELS), [0.1, np.inf])
