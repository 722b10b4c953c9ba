import numpy as np
import pytest

from softgrip.errors import InvalidInputError, NotFiniteError
from softgrip.tactile.creep import Creep
from softgrip.tactile.rest_moments import RestFinder, noise_of, rest_moments

NOISE = 0.003


NO_MEMORY = Creep()


def record(force, seed=0, memory=NO_MEMORY, drift=0.0):
    time = np.arange(len(force), dtype=float)
    noise = np.random.default_rng(seed).normal(0, NOISE, len(force))
    return time, 0.1 + 5 * memory.felt(time, force) + drift * time / 3600 + noise


def grasps(count=40):
    return np.concatenate([np.repeat([0.0, w], 30) for w in np.resize([0.05, 0.3, 0.5], count)])


def finder(**given):
    return RestFinder(**({"noise": NOISE, "rate": 0.05, "wander": 0.02} | given))


@pytest.mark.parametrize("drift", [-0.1, 0.0, 0.1])
def test_moments_without_load_are_found_and_none_with_one(drift):
    force = grasps()
    time, voltage = record(force, drift=drift)
    found = rest_moments(time, voltage, finder())
    assert all(force[int(rest.time - 9) : int(rest.time) + 1].max() == 0 for rest in found)
    assert len(found) >= 40
    expected = [0.1 + drift * rest.time / 3600 for rest in found]
    # Of the median of ten samples.
    assert abs(np.array([r.voltage for r in found]) - expected).max() < 4 * 1.25 * NOISE / 10**0.5


def test_noise_is_told_under_changing_loads():
    _, voltage = record(grasps(200))
    assert noise_of(voltage) == pytest.approx(NOISE, rel=0.1)


def test_a_memory_of_loads_is_not_taken_for_rest_before_it_has_gone():
    force = np.concatenate([np.zeros(60), np.full(60, 0.5), np.zeros(120)])
    memory = Creep((0.13,), (20.0,))
    time, voltage = record(force, memory=memory)
    after = [rest for rest in rest_moments(time, voltage, finder()) if rest.time > 120]
    assert after
    assert min(rest.time for rest in after) > 150
    assert max(rest.voltage for rest in after) < 0.1 + 0.03


def test_a_load_that_is_never_taken_off_is_the_floor():
    """What the finder cannot see: said on the page, and held here."""
    time, voltage = record(np.repeat([0.1, 0.3, 0.1, 0.3], 60))
    found = rest_moments(time, voltage, finder())
    assert found
    assert found[0].voltage == pytest.approx(0.6, abs=0.01)


def test_a_glitch_is_no_rest():
    time, voltage = record(np.zeros(60))
    voltage[25] = -3.0
    assert {rest.time for rest in rest_moments(time, voltage, finder())} == {9, 19, 39, 49}


def test_what_is_refused_changes_nothing():
    one, other = finder(), finder()
    time, voltage = record(np.zeros(40))
    for k, sample in enumerate(zip(time, voltage, strict=True)):
        if k == 15:
            for wrong in ((np.nan, 0.1), (20.0, np.inf)):
                with pytest.raises(NotFiniteError):
                    one.push(*wrong)
            with pytest.raises(InvalidInputError, match="time"):
                one.push(3.0, 0.1)
        assert one.push(*sample) == other.push(*sample)


@pytest.mark.parametrize("wrong", [{"noise": 0}, {"rate": -1}, {"wander": np.nan}, {"length": 0}])
def test_finders_that_are_none_are_refused(wrong):
    with pytest.raises(InvalidInputError):
        finder(**wrong)
