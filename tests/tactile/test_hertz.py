"""Eq. (2.2): the contact of Hertz by its own pressure, its powers, the misprint, refusals."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from softgrip.errors import InvalidInputError
from softgrip.tactile.hertz import hertz_approach

E, NU, R = 0.1e6, 0.49, 3e-3


def test_pressure_of_hertz_carries_the_force_and_sinks_by_the_approach():
    """Eq. (2.2): the elliptic pressure, integrated anew, gives back force and approach."""
    force = 0.2
    d = hertz_approach(force, R, E, NU)
    a = np.sqrt(R * d)
    peak = 3 * force / (2 * np.pi * a**2)
    carried = quad(lambda r: 2 * np.pi * r * peak * np.sqrt(1 - (r / a) ** 2), 0, a)[0]
    assert carried == pytest.approx(force)
    # Boussinesq: a point load F sinks a half space by (1 - nu^2) F / (pi E r).
    middle = quad(lambda r: 2 * np.pi * peak * np.sqrt(1 - (r / a) ** 2), 0, a)[0]
    assert (1 - NU**2) / (np.pi * E) * middle == pytest.approx(d)


@given(force=st.floats(1e-3, 1), factor=st.floats(0.1, 10))
def test_powers(force, factor):
    once = hertz_approach(force, R, E, NU)
    assert hertz_approach(factor * force, R, E, NU) == pytest.approx(factor ** (2 / 3) * once)
    assert hertz_approach(force, factor * R, E, NU) == pytest.approx(factor ** (-1 / 3) * once)
    # All lengths times c: forces times c^2 keep the strains.
    assert hertz_approach(factor**2 * force, factor * R, E, NU) == pytest.approx(factor * once)


def test_without_the_exponent_it_is_no_length():
    """A length does not depend on the unit that is chosen; the printed right side does."""
    metres = hertz_approach(0.1, R, E, NU, exponent=1.0)
    # In millimetres: N, mm and N/mm^2.
    millimetres = hertz_approach(0.1, R * 1e3, E * 1e-6, NU, exponent=1.0)
    assert millimetres != pytest.approx(metres * 1e3, rel=0.5)
    right = hertz_approach(0.1, R * 1e3, E * 1e-6, NU)
    assert right == pytest.approx(hertz_approach(0.1, R, E, NU) * 1e3)


@pytest.mark.parametrize(
    ("given_", "message"),
    [
        ({"force": -1.0}, "force: expected N, >= 0"),
        ({"force": 1.0, "radius": 0.0}, "radius"),
        ({"force": 1.0, "poisson_ratio": 0.6}, "poisson_ratio"),
        ({"force": 1.0, "young_modulus": -1.0}, "young_modulus"),
    ],
)
def test_bad_input_is_refused(given_, message):
    with pytest.raises(InvalidInputError, match=message):
        hertz_approach(**given_)
