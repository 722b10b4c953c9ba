"""The regulator's gain without a Riccati equation, against the one that solves it."""

import casadi as ca
import numpy as np
import pytest

from softgrip.control.lqr import Weights, lqr_gain
from softgrip.control.spectral_factor import spectral_gain
from softgrip.dynamics.second_order import SecondOrder


@pytest.mark.parametrize("damping_ratio", [0.0, 0.2, 0.7, 1.5])
@pytest.mark.parametrize("natural_frequency", [1.0, 2.86])
@pytest.mark.parametrize("q3", [0.0, 0.1])
def test_gain_by_spectral_factor_solves_the_riccati_equation(natural_frequency, damping_ratio, q3):
    made = SecondOrder(natural_frequency, damping_ratio)
    p, q2 = np.meshgrid(np.geomspace(1, 1e6, 13), [0.0, 0.003, 0.01, 0.1, 0.3, 1.0])
    damping, stiffness = 2 * damping_ratio * natural_frequency, natural_frequency**2
    found = spectral_gain(damping, stiffness, p, (1.0, q2, q3))
    for k in np.ndindex(p.shape):
        expected = lqr_gain(made, Weights(p[k], (1.0, q2[k], q3)))
        np.testing.assert_allclose([gain[k] for gain in found], expected, rtol=1e-9)


def test_symbols_give_what_floats_do():
    p, q2 = ca.SX.sym("p"), ca.SX.sym("q2")
    law = ca.Function("law", [p, q2], spectral_gain(4.0, 8.0, p, (1.0, q2, 0.0)))
    found = [float(gain) for gain in law(100.0, 0.3)]
    # The operations are the same; a cube root need not be.
    np.testing.assert_allclose(found, spectral_gain(4.0, 8.0, 100.0, (1.0, 0.3, 0.0)), rtol=1e-14)
