"""The power that a compiler can work out for several numbers at once."""

import numpy as np
from numba import vectorize

from softgrip.simulator import kernel


@vectorize(nopython=True)  # compiled when it is called
def power(base, exponent):
    return kernel._power(base, exponent)


def test_power_is_that_of_the_library():
    chance = np.random.default_rng(0)
    edges = 2.0 ** np.arange(-40, 10)
    near_one = 1 + 1e-9 * chance.normal(size=99)
    wide = 10 ** chance.uniform(-12, 3, 20_000)
    bases = np.concatenate([wide, near_one, edges, edges**0.5])
    exponents = chance.uniform(0, 4, bases.size)
    # A last place of the logarithm, 2e-16, times its size and the exponent, some 150 at most.
    np.testing.assert_allclose(power(bases, exponents), bases**exponents, rtol=1e-13)


def test_limits_are_those_of_the_library():
    assert power(0.0, 0.0) == 1.0
    assert 0 <= power(0.0, 1.5) < 1e-300
    assert power(0.3, 0.0) == 1.0
    assert power(1.0, 2.7) == 1.0
