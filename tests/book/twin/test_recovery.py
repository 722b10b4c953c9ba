"""Known rigs, on lines: there intervals hold as they claim, and the strategy's law is exact."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from book.twin.interval import NORMAL, coverage, widening
from book.twin.prediction import held
from book.twin.recovery import Recovered, known, normal_law, recovered
from tests.book.twin.lines import lines

RNG = np.random.default_rng(5)
# Misses of a few errors at most: beyond, they count by their logarithm.
SLOPES = 0.5 * RNG.normal(size=(6, 4))
SECTIONS = ("Section 3.4",) * 4 + ("Section 6.4",) * 2


def _problem(errors=(1.0,) * 6):
    targets = [
        SimpleNamespace(id=f"t{k}", section=section, value=1.0, tolerance=1.0)
        for k, section in enumerate(SECTIONS)
    ]
    return replace(lines(SLOPES, [0.0] * 6, errors), targets=tuple(targets))


@pytest.fixture(scope="module")
def rows():
    problem = _problem()
    return [
        row
        for number in range(12)
        for row in recovered(problem, number, rigs=512, rounds=4, generations=40)
    ]


def _chance(count):
    """Three deviations of the share of so many that are apart, %."""
    return 300 * (0.09 / count) ** 0.5


@pytest.mark.parametrize("kind", ["parameter", "target"])
def test_the_smoothers_intervals_hold_nine_times_in_ten(rows, kind):
    own = [row.interval for row in rows if (row.way, row.kind) == ("smoother", kind)]
    assert coverage(own) == pytest.approx(90, abs=_chance(len(own)))
    assert widening(own) == pytest.approx(1, abs=0.35)


@pytest.mark.parametrize("kind", ["parameter", "target"])
def test_the_strategys_intervals_hold_at_least_nine_times_in_ten(rows, kind):
    """Its loss trusts a target the less the more it is missed: more is left open."""
    own = [row.interval for row in rows if (row.way, row.kind) == ("strategy", kind)]
    assert coverage(own) >= 90 - _chance(len(own))


def test_the_normal_law_is_that_of_lines():
    """From a rig that misses little; and what is far off has no say."""
    x, observed = RNG.normal(size=4), 1e-3 * RNG.normal(size=6)
    exact = np.linalg.inv(SLOPES.T @ SLOPES + np.eye(4))
    near = 1e-3 * x
    mean, covariance = normal_law(SLOPES @ near - observed, SLOPES, near)
    np.testing.assert_allclose(covariance, exact, rtol=1e-4, atol=1e-6)
    np.testing.assert_allclose(mean, exact @ SLOPES.T @ observed, atol=1e-7)
    _, without = normal_law(np.array([0, 0, 0, 0, 0, 1e4]), SLOPES, x)
    five = np.linalg.inv(SLOPES[:5].T @ SLOPES[:5] + np.eye(4))
    np.testing.assert_allclose(without, five, rtol=1e-6, atol=1e-9)


def test_a_parameter_of_half_the_prior_is_told():
    wide, narrow = ([-s, 0.0, s] for s in (NORMAL * 0.6, NORMAL * 0.4))
    told = lambda ends, kind: Recovered(0, "", kind, "", SimpleNamespace(  # noqa: E731
        low=ends[0], high=ends[2])).told  # fmt: skip
    assert not told(wide, "parameter")
    assert told(narrow, "parameter")
    assert not told(narrow, "target")


def test_a_known_rig_is_drawn_by_its_number():
    """The same rig for the same number, and its observations are off by the errors alone."""
    errors = [1e-9] * 6
    one, other = (known(_problem(errors), 3) for _ in range(2))
    np.testing.assert_array_equal(one[1], other[1])
    np.testing.assert_allclose(one[0].observed, one[1] @ SLOPES.T, atol=1e-7)
    assert (known(_problem(errors), 4)[1] != one[1]).any()


def test_hidden_numbers_of_known_rigs_hold_nine_times_in_ten():
    """Of 2 numbers of each of 60 rigs, to three deviations of such a count."""
    found = [
        row.interval
        for number in range(60)
        for row in held(_problem(), "gripper", number, rigs=256, rounds=2)
    ]
    assert coverage(found) == pytest.approx(90, abs=_chance(len(found)))


def test_what_was_cut_goes_on_from_what_is_kept(tmp_path):
    whole = _problem()
    asked = {"rigs": 64, "rounds": 3, "generations": 5}
    want = recovered(whole, 0, **asked, kept=tmp_path)
    calls = len(whole.calls)
    again = recovered(whole, 0, **asked, kept=tmp_path)
    # Once more the rigs of which one is drawn, and those of the slopes.
    assert whole.calls[calls:] == [64, 2 * 4]
    assert again == want
