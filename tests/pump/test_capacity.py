"""The elastance filter: against the joint Gaussian and against chi-square."""

import dataclasses

import numpy as np
import pytest
from scipy.stats import chi2

from softgrip.errors import InvalidInputError
from softgrip.pump import elastance
from softgrip.pump.capacity import estimate
from softgrip.pump.flow import PARAMETER_SETS
from softgrip.pump.observability import observable_rank

from .gaussian import JointGaussian

DT = 0.025
FLOW = PARAMETER_SETS["default"].flow
NOISE = elastance.NoiseLevels(pressure_step=40.0, elastance_step=2e7, sensor=150.0)
PRIOR = elastance.Prior(pressure=0.0, pressure_std=200.0, elastance=1e9, elastance_std=2e8)
MODEL = elastance.ElastanceModel(DT, NOISE, PRIOR, angle_gain=-3e8)
SCALE = np.array([1e4, 1e9])


def estimated(pressure, *others):
    """Return the estimate of a record that is even in time."""
    return estimate(pressure, *others, time=DT * np.arange(len(pressure)))


def simulate(model, flow, angle, runs, seed):
    """Draw from the filter's own model: true states (runs, N, 2), measurements (runs, N)."""
    rng = np.random.default_rng(seed)
    noise, prior = model.noise, model.prior
    x = np.stack(
        [
            rng.normal(prior.pressure, prior.pressure_std, runs),
            rng.normal(prior.elastance, prior.elastance_std, runs),
        ],
        axis=-1,
    )
    states = [x]
    for F, turn in zip(
        elastance.transitions(flow[:-1], model.time_step), np.diff(angle), strict=True
    ):
        w = rng.normal(0, [noise.pressure_step, noise.elastance_step], (runs, 2))
        x = x @ F.T + [0.0, model.angle_gain * turn] + w
        states.append(x)
    states = np.stack(states, axis=1)
    return states, states[..., 0] + rng.normal(0, noise.sensor, states.shape[:2])


def oracle_of(model, flow, angle):
    kalman = elastance.elastance_filter(model)
    b = np.stack([np.zeros(len(flow) - 1), model.angle_gain * np.diff(angle)], axis=-1)
    F = elastance.transitions(flow[:-1], model.time_step)
    return JointGaussian(F, b, kalman.H, kalman.Q, kalman.R, kalman.x[:, 0], kalman.P)


@pytest.fixture(scope="module")
def short():
    flow = FLOW * np.array([1, 1, 0.5, 0, -1, 1, 2, 1.0])
    angle = np.array([0, 0.1, 0.15, 0.3, 0.2, 0.4, 0.7, 0.8])
    _, measured = simulate(MODEL, flow, angle, 1, seed=3)
    return measured[0], flow, angle


def test_filter_agrees_with_the_joint_gaussian(short):
    measured, flow, angle = short
    found, oracle = estimated(measured, flow, angle, MODEL), oracle_of(MODEL, flow, angle)
    for k in range(8):
        mean, covariance = oracle.state(k, measured[: k + 1, None])
        std = np.sqrt(np.diag(covariance))
        np.testing.assert_allclose(found.state[k] / std, mean / std, rtol=1e-9, atol=1e-9)
        unit = np.outer(std, std)
        np.testing.assert_allclose(found.covariance[k] / unit, covariance / unit, atol=1e-9)


def test_likelihood_is_the_joint_density(short):
    measured, flow, angle = short
    expected = oracle_of(MODEL, flow, angle).log_density(measured)
    assert estimated(measured, flow, angle, MODEL).log_likelihood == pytest.approx(
        expected, rel=1e-9
    )


@pytest.mark.parametrize("lost", [[1, 2, 3], [4], [3, 4], [1, 2, 5, 6]])
def test_missing_samples_are_predicted_over_and_have_no_likelihood(lost):
    # [1, 2, 3]: the gap comes before any sample has told of the elastance.
    time = np.arange(8.0)
    flow, angle = FLOW * np.ones(8), 0.1 * time
    _, measured = simulate(MODEL, flow, angle, 1, seed=4)
    kept = np.delete(np.arange(8), lost)
    found = estimate(measured[0, kept], flow[kept], angle[kept], MODEL, time=DT * time[kept])
    oracle = oracle_of(MODEL, flow, angle)
    oracle.Z, oracle.z_mean = oracle.Z[kept], np.array(oracle.z_mean)[kept]
    for k, row in enumerate(kept):
        mean, covariance = oracle.state(row, measured[0, kept[: k + 1], None])
        std = np.sqrt(np.diag(covariance))
        np.testing.assert_allclose(found.state[k] / std, mean / std, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(
            found.covariance[k] / np.outer(std, std), covariance / np.outer(std, std), atol=1e-9
        )
    assert found.log_likelihood == pytest.approx(oracle.log_density(measured[0, kept]), rel=1e-9)
    np.testing.assert_allclose(found.time, time[kept] * DT, rtol=1e-12)


@pytest.mark.parametrize("missing", [[0], [3], [1, 2, 6], [7]])
def test_pressures_that_are_nan_are_predicted_over_and_have_no_likelihood(short, missing):
    measured, flow, angle = short
    holed = np.where(np.isin(np.arange(8), missing), np.nan, measured)
    found = estimated(holed, flow, angle, MODEL)
    oracle, kept = oracle_of(MODEL, flow, angle), np.delete(np.arange(8), missing)
    oracle.Z, oracle.z_mean = oracle.Z[kept], np.array(oracle.z_mean)[kept]
    for k in range(int(kept[0]), 8):
        before = int(np.count_nonzero(kept <= k))
        mean, covariance = oracle.state(k, measured[kept[:before], None])
        std = np.sqrt(np.diag(covariance))
        np.testing.assert_allclose(found.state[k] / std, mean / std, rtol=1e-9, atol=1e-9)
    assert found.log_likelihood == pytest.approx(oracle.log_density(measured[kept]), rel=1e-9)
    np.testing.assert_array_equal(np.flatnonzero(np.isnan(found.innovation)), missing)


def test_angles_that_are_nan_turn_evenly(short):
    measured, flow, angle = short
    time = DT * np.array([0, 1, 2, 4, 5, 6, 7, 8.0])
    line = angle[2] + (angle[4] - angle[2]) * 2 / 3
    filled, holed = angle.copy(), angle.copy()
    filled[3], holed[3] = line, np.nan
    found = estimate(measured, flow, holed, MODEL, time=time)
    expected = estimate(measured, flow, filled, MODEL, time=time)
    np.testing.assert_allclose(found.state, expected.state, rtol=1e-12)


@pytest.mark.parametrize("lost", ["a fifth", "a tenth of a second each second", "uneven"])
def test_capacity_of_a_record_with_lost_rows_comes_from_its_times(lost):
    rng = np.random.default_rng(8)
    time = np.arange(200) * DT
    if lost == "a fifth":
        time = time[np.sort(rng.choice(200, 160, replace=False))]
    elif lost == "uneven":
        time = np.cumsum(rng.uniform(0.2, 1.8, 200)) * DT
    else:
        time = time[np.arange(200) % 40 >= 4]
    pressure = FLOW * (time - time[0]) / 1.2e-9 + rng.normal(0, 100, time.size)
    noise = elastance.NoiseLevels(pressure_step=40.0, elastance_step=1e5, sensor=100.0)
    model = elastance.ElastanceModel(DT, noise, PRIOR)
    flow, angle = np.full(time.size, FLOW), np.zeros(time.size)
    found = estimate(pressure, flow, angle, model, time=time)
    assert abs(found.capacity[-1] - 1.2e-9) < 3 * found.capacity_std[-1] < 0.1e-9


def test_uneven_steps_move_by_their_own_time(short):
    measured, flow, angle = short
    steps = np.array([1.0, 0.8, 1.2, 1.0, 1.4, 0.6, 1.0])
    time = DT * np.concatenate([[0.0], np.cumsum(steps)])
    found = estimate(measured, flow, angle, MODEL, time=time)
    # A flow that is so much larger moves as much in a step.
    scaled = estimated(measured, np.append(flow[:-1] * steps, 0.0), angle, MODEL)
    np.testing.assert_allclose(found.state, scaled.state, rtol=1e-12)
    assert found.time[-1] == pytest.approx(steps.sum() * DT)


def ramp(n):
    time = np.arange(n) * DT
    return np.full(n, FLOW), 0.6 * time


RUNS, SAMPLES = 200, 60


@pytest.fixture(scope="module")
def monte_carlo():
    flow, angle = ramp(SAMPLES)
    states, measured = simulate(MODEL, flow, angle, RUNS, seed=0)
    return flow, angle, states, measured


def normalized(monte_carlo, model):
    flow, angle, states, measured = monte_carlo
    found = [estimated(z, flow, angle, model) for z in measured]
    nis = np.array([f.normalized_innovation_squared for f in found])
    error = states - np.array([f.state for f in found])
    nees = np.einsum("rki,rkij,rkj->rk", error, np.linalg.inv([f.covariance for f in found]), error)
    return nis, nees


def test_innovations_and_errors_are_as_large_as_the_filter_says(monte_carlo):
    nis, nees = normalized(monte_carlo, MODEL)
    # All innovations are independent; errors are independent between runs only.
    low, high = chi2.ppf([0.025, 0.975], nis.size)
    assert low < nis.sum() < high
    low, high = chi2.ppf([0.025, 0.975], 2 * RUNS)
    for k in (0, SAMPLES // 2, SAMPLES - 1):
        assert low < nees[:, k].sum() < high
    inside = (low < nees.sum(axis=0)) & (nees.sum(axis=0) < high)
    assert inside.mean() > 0.8  # 0.95 is expected; the samples of a run are not independent


@pytest.mark.parametrize("wrong", [{"sensor": 75.0}, {"sensor": 300.0}, {"elastance_step": 0.0}])
def test_wrong_noise_levels_are_seen(monte_carlo, wrong):
    """The test above can fail: levels wrong by a factor 2, or left out, leave the bounds."""
    flow, angle, states, measured = monte_carlo
    part = flow, angle, states[:50], measured[:50]
    model = dataclasses.replace(MODEL, noise=dataclasses.replace(NOISE, **wrong))
    nis, nees = normalized(part, model)
    low, high = chi2.ppf([0.025, 0.975], nis.size)
    last_low, last_high = chi2.ppf([0.025, 0.975], 2 * 50)
    assert not (low < nis.sum() < high and last_low < nees[:, -1].sum() < last_high)


def test_elastance_is_observable_as_soon_as_the_pump_moves():
    H = elastance.elastance_filter(MODEL).H
    assert observable_rank(elastance.transitions(np.zeros(50), DT), H, SCALE) == 1
    assert observable_rank(elastance.transitions([0, 0, FLOW], DT), H, SCALE) == 2


def test_pump_at_rest_teaches_nothing_of_the_elastance():
    measured, still = np.random.default_rng(1).normal(0, 150, 50), np.zeros(50)
    model = dataclasses.replace(MODEL, noise=dataclasses.replace(NOISE, elastance_step=0.0))
    found = estimated(measured, still, still, model)
    np.testing.assert_allclose(found.elastance, PRIOR.elastance, rtol=1e-12)
    np.testing.assert_allclose(found.covariance[:, 1, 1], PRIOR.elastance_std**2, rtol=1e-12)


def test_result_cannot_be_written_to(short):
    found = estimated(*short, MODEL)
    with pytest.raises(ValueError, match="read-only"):
        found.state[0, 0] = 0.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        found.time = None


def test_capacity_is_nan_where_noise_has_pushed_the_elastance_below_zero(short):
    _, flow, angle = short
    prior = dataclasses.replace(PRIOR, elastance=1e8, elastance_std=1e10)
    found = estimated(np.linspace(0, -1e5, 8), flow, angle, dataclasses.replace(MODEL, prior=prior))
    below = found.elastance <= 0
    assert below.any()
    np.testing.assert_array_equal(np.isnan(found.capacity), below)


def test_state_stays_a_column():
    kalman = elastance.elastance_filter(MODEL)
    kalman.predict(u=np.array([[0.1]]), F=elastance.transitions([FLOW], DT)[0])
    kalman.update(10.0)
    assert kalman.x.shape == (2, 1)


def test_bad_records_are_refused(short):
    measured, flow, angle = short
    with pytest.raises(InvalidInputError, match="one shape"):
        estimated(measured, flow[:-1], angle, MODEL)
    with pytest.raises(InvalidInputError, match="N >= 2"):
        estimated(measured[:1], flow[:1], angle[:1], MODEL)
    with pytest.raises(InvalidInputError, match="finite"):
        estimated(np.where(measured > 0, np.inf, measured), flow, angle, MODEL)
    with pytest.raises(InvalidInputError, match="finite"):
        estimated(measured, np.where(angle > 0.5, np.nan, flow), angle, MODEL)
    with pytest.raises(InvalidInputError, match="two pressures"):
        estimated(np.where(angle > 0, np.nan, measured), flow, angle, MODEL)
    with pytest.raises(InvalidInputError, match="an angle or more"):
        estimated(measured, flow, np.nan * angle, MODEL)
    time = np.arange(8.0)
    for times in (time[:-1], time[::-1], np.where(time == 3, 2.0, time)):
        with pytest.raises(InvalidInputError, match="increasing"):
            estimate(measured, flow, angle, MODEL, time=times)


@pytest.mark.parametrize(
    "make",
    [
        lambda: elastance.NoiseLevels(-1.0, 0.0, 1.0),
        lambda: elastance.NoiseLevels(0.0, 0.0, 0.0),
        lambda: elastance.Prior(0.0, 1.0, -1e9, 1e8),
        lambda: dataclasses.replace(MODEL, time_step=0.0),
        lambda: dataclasses.replace(MODEL, angle_gain=float("inf")),
    ],
)
def test_bad_models_are_refused(make):
    with pytest.raises(InvalidInputError, match="expected"):
        make()
