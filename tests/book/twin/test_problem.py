"""The inverse problem: variables, values, and what each experiment looks at."""

import numpy as np
import pytest

from book.twin.problem import FULL, compressed, error_of, printed
from book.twin.space import space
from softgrip.errors import InvalidInputError

STATIC = ["statics", "lifts"]


@pytest.fixture(scope="module")
def statics():
    return printed(STATIC)


def test_variables_are_the_inverse_of_values(statics):
    x = statics.prior(16, seed=3)
    np.testing.assert_allclose(statics.variables(statics.rows(x)), x, atol=1e-9)


def test_the_prior_fills_each_range_evenly(statics):
    """Of Sobol's points as many lie in each quarter of a range."""
    rows = dict(zip(space(), statics.rows(statics.prior(64, seed=1)).T, strict=True))
    for one in statics.free:
        shares = one.share(rows[one.name])
        assert np.histogram(shares, 4, (0, 1))[0].tolist() == [16] * 4, one.name


def test_a_parameter_is_tied_to_the_targets_that_it_moves(statics):
    """The angle under pressure knows nothing of friction, and nothing at rest of the motor."""
    names = [one.name for one in statics.free]
    assert "pump.acceleration_limit" not in names
    row = statics.touched[names.index("choice.friction")]
    assert row.tolist() == [target.experiment == "lifts" for target in statics.targets]
    soft = statics.touched[names.index("soft.stiffness")]
    assert [t.quantity for t, own in zip(statics.targets, soft, strict=True) if own] == [
        "angle-design-3", "sum-design-3",
    ]  # fmt: skip


def test_rounding_ties_nothing():
    """The settling times on models of many rigs differ in last digits from those of one."""
    problem = printed(["pid on models", "lifts"])
    names = [one.name for one in problem.free]
    row = problem.touched[names.index("choice.friction")]
    assert row.tolist() == [one.experiment == "lifts" for one in problem.targets]
    assert not any(name.startswith("pad.") for name in names)


def test_a_part_of_the_problem_gives_what_the_whole_does(statics):
    x = statics.prior(4, seed=2)
    which = np.arange(len(statics.targets)) % 2 == 0
    part = statics.part(which)
    shared = [statics.free.index(one) for one in part.free]
    np.testing.assert_array_equal(part.off(x[:, shared], jobs=1), statics.off(x, jobs=1)[:, which])


def test_far_misses_count_by_their_logarithm():
    grid = np.linspace(-100, 100, 2001)
    assert (np.diff(compressed(grid)) > 0).all()
    np.testing.assert_array_equal(compressed(-grid), -compressed(grid))
    # The slope does not jump where the logarithm begins.
    near = compressed(np.array([FULL - 1e-6, FULL, FULL + 1e-6]))
    np.testing.assert_allclose(np.diff(near), 1e-6, rtol=1e-5)


def test_the_error_is_that_of_print_and_model(statics):
    target = statics.targets[0]
    assert error_of(target, 0.0) == 1.0
    want = np.hypot(target.tolerance, 0.05 * target.value) / target.tolerance
    assert error_of(target) == pytest.approx(want)


def test_no_target_is_refused():
    with pytest.raises(InvalidInputError, match="some of"):
        printed([])
