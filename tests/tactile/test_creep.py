import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.simulator.force_layer import ForceLayer, felt_force
from softgrip.tactile.creep import TRIED_LAGS, Creep, fitted_creep

LAYER = ForceLayer(memory=(0.2, 0.1), lag=(0.5, 20.0))
CREEP = Creep(LAYER.memory, LAYER.lag)


def test_a_step_is_felt_as_its_closed_form():
    time = np.array([0.0, 0.3, 2.0, 9.0, 60.0])
    found = CREEP.felt(time, np.ones(5))
    # Borne since the sample before: at the first one since no time at all.
    expected = 1 - 0.2 * np.exp(-time / 0.5) - 0.1 * np.exp(-time / 20.0)
    assert found == pytest.approx(expected, abs=1e-12)


def test_felt_force_is_that_of_the_simulated_layer_between_fine_samples():
    period = 1e-3
    force = np.repeat([0.0, 0.5, 0.2, 0.0], 2000)
    time = period * np.arange(len(force))
    both = CREEP.felt(time, force), felt_force(force, period, LAYER)
    # They differ by when a change is taken to begin: one period.
    assert abs(both[0] - both[1]).max() < 0.5 * period / 0.5


@given(
    st.lists(st.tuples(st.floats(0, 50), st.floats(-1, 1)), min_size=1, max_size=30),
    st.floats(0, 0.45),
    st.floats(0, 0.45),
    st.floats(0.1, 100),
)
def test_undoing_is_the_inverse_at_any_times(samples, fast, slow, lag):
    steps, force = np.array(samples).T
    creep, time = Creep((fast, slow), (lag, 7.0)), np.cumsum(steps)
    assert creep.undone(time, creep.felt(time, force)) == pytest.approx(force, abs=1e-9)


def test_what_is_left_is_felt_when_the_load_is_gone():
    time = np.array([0.0, 10.0, 10.0 + 1e-9, 40.0])
    left = CREEP.left(time, [1.0, 1.0, 0.0, 0.0])
    assert left[2:] == pytest.approx(CREEP.felt(time, [1.0, 1.0, 0.0, 0.0])[2:], abs=1e-6)


def test_without_parts_force_and_felt_force_are_one():
    assert Creep().felt([0, 1], [0.2, 0.3]).tolist() == [0.2, 0.3]


def calibration(creep):
    force = np.concatenate([np.repeat([w, 0.0], 8) for w in np.linspace(0.05, 0.7, 40)])
    time = np.arange(len(force), dtype=float)
    return time, force, 4 * -np.expm1(-creep.felt(time, force) / 0.3)


def test_memory_of_a_calibration_is_found():
    found = fitted_creep(*calibration(Creep((0.12,), (20.0,))))
    assert found.lags == (20.0,)
    assert found.parts == pytest.approx((0.12,), abs=1e-3)


def test_no_memory_is_found_where_none_is():
    time, force, voltage = calibration(Creep())
    noise = np.random.default_rng(0).normal(0, 2e-3, len(time))
    assert fitted_creep(time, force, voltage + noise).parts[0] < 0.01


def test_lags_are_tried_from_the_shortest_on():
    assert list(TRIED_LAGS) == sorted(TRIED_LAGS)


@pytest.mark.parametrize(
    ("parts", "lags"), [((0.1,), ()), ((0.6, 0.4), (1, 2)), ((-0.1,), (1,)), ((0.1,), (0,))]
)
def test_memory_out_of_range_is_refused(parts, lags):
    with pytest.raises(InvalidInputError):
        Creep(parts, lags)


@pytest.mark.parametrize(
    ("time", "force"), [([0, 2, 1], [1, 1, 1]), ([0, 1], [1, np.nan]), ([0, 1], [1, 1, 1])]
)
def test_records_that_are_none_are_refused(time, force):
    for call in (CREEP.felt, CREEP.undone, CREEP.left):
        with pytest.raises(InvalidInputError):
            call(time, force)


def test_one_force_tells_no_memory():
    with pytest.raises(InvalidInputError, match="two forces"):
        fitted_creep([0, 1, 2], [1, 1, 1], [0.1, 0.2, 0.3])
