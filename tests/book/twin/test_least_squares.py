"""A batch of fits against scipy's, one by one."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from book.twin.least_squares import differences, fit

TIME = np.linspace(0, 3, 40)


def _decays(x, which):
    del which
    return x[:, :1] * np.exp(-np.exp(x[:, 1:2]) * TIME)


def test_many_fits_are_scipys():
    chance = np.random.default_rng(3)
    wanted = _decays(chance.normal([2.0, 0.0], 0.3, (12, 2)), None)
    wanted += 0.05 * chance.standard_normal(wanted.shape)
    squares = differences(lambda x, which: _decays(x, which) - wanted[which])
    found = fit(squares, np.tile([1.0, 0.5], (12, 1)))
    for row, own in zip(wanted, found, strict=True):
        alone = least_squares(lambda x, row=row: _decays(x[None], None)[0] - row, [1.0, 0.5])
        # Both end where a step changes the sum by 1e-8 to 1e-10 of it.
        assert own == pytest.approx(alone.x, abs=1e-4)


def test_a_fit_hangs_on_no_other():
    wanted = _decays(np.array([[1.0, 0.1], [3.0, -1.0]]), None)
    start = np.array([[2.0, 0.0]] * 2)
    both = fit(differences(lambda x, which: _decays(x, which) - wanted[which]), start)
    one = fit(differences(lambda x, which: _decays(x, which) - wanted[1 + which]), start[:1])
    assert both[1] == pytest.approx(one[0], abs=1e-12)


def test_a_parameter_that_moves_nothing_stays():
    squares = differences(lambda x, _: x[:, :1] - np.array([[1.0, 3.0]]) + 0 * x[:, 1:])
    found = fit(squares, np.array([[0.0, 7.0]]))
    assert found[0] == pytest.approx([2.0, 7.0])


def test_the_derivatives_are_those_by_hand():
    x = np.array([[2.0, 0.3]])
    cost, pull, normal = (part[0] for part in differences(_decays)(x, np.array([0])))
    shape = np.exp(-np.exp(0.3) * TIME)
    slopes = np.stack([shape, -2 * shape * np.exp(0.3) * TIME])
    # Central differences of 1e-5 are good to their square.
    assert cost == pytest.approx(np.sum((2 * shape) ** 2))
    assert pull == pytest.approx(slopes @ (2 * shape), rel=1e-8)
    assert normal == pytest.approx(slopes @ slopes.T, rel=1e-8)
