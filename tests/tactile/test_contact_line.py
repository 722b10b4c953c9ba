"""The principal axis of responses: against NumPy's covariance, and hand calculations."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from softgrip.tactile.contact_line import angle_between, line_angle
from softgrip.tactile.contact_place import FELT
from softgrip.tactile.pad_layout import THREE_TWO_THREE as PAD
from softgrip.tactile.pad_layout import rows
from softgrip.units import DEG

some = arrays(np.float64, 8, elements=st.floats(0, 1))


@given(responses=some)
def test_angle_is_that_of_the_first_principal_component(responses):
    felt = responses > FELT
    assume(felt.sum() >= 2)
    moments = np.cov(PAD.places[felt].T, aweights=responses[felt], bias=True)
    values, vectors = np.linalg.eigh(moments)
    # Near a round one, rounding chooses the direction.
    assume(values[1] - values[0] > 1e-6 * values[1])
    oracle = np.arctan2(*vectors[::-1, 1])
    assert angle_between(line_angle(responses, PAD), oracle) == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize(
    ("pair", "degrees"), [((0, 2), 0), ((1, 6), 90), ((0, 3), -61.19), ((3, 5), 61.19)]
)
@given(weights=st.tuples(st.floats(0.06, 1), st.floats(0.06, 1)))
def test_two_elements_give_their_connection_whatever_they_say(pair, degrees, weights):
    responses = np.zeros(8)
    responses[list(pair)] = weights
    # By hand: arctan(10 / 5.5) = 61.19 deg.
    assert angle_between(line_angle(responses, PAD), degrees * DEG) < 0.01 * DEG


@pytest.mark.parametrize("felt", [0, 1])
def test_less_than_two_elements_say_no_angle(felt):
    assert np.isnan(line_angle(0.5 * (np.arange(8) < felt), PAD))


def test_square_says_no_angle():
    assert np.isnan(line_angle([0.5] * 4, rows((2, 2), 0.01, 0.01)))


def test_angles_between_lines():
    assert angle_between([0, 80 * DEG, 1.0], [90 * DEG, -80 * DEG, 1.0]) / DEG == pytest.approx(
        [90, 20, 0]
    )
