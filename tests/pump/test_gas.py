"""Eq. (4.3), (4.4), the capacity that they give, and the exact pressure of a closed charge."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from softgrip.errors import InvalidInputError
from softgrip.pump.flow import PARAMETER_SETS
from softgrip.pump.gas import (
    ATMOSPHERE,
    GAS_CONSTANT,
    capacity,
    capacity_growth,
    charge_pressure,
    closed_volume_pressure,
    gas_pressure,
)
from softgrip.pump.parts import SYRINGES

volumes = st.floats(1e-6, 1e-3)
fractions = st.floats(-0.5, 0.9)
compliances = st.floats(0, 1e-9)


@given(amount=st.floats(1.0, 50.0), volume=st.floats(2e-5, 3e-4), ballooning=st.floats(0.0, 1e-10))
def test_pressure_of_a_charge_solves_the_gas_law(amount, volume, ballooning):
    p = charge_pressure(amount, volume, ballooning, ATMOSPHERE)
    assert p * (volume + ballooning * (p - ATMOSPHERE)) == pytest.approx(amount, rel=1e-9)


def test_molar_volume_at_standard_conditions():
    """Eq. (4.4) against CODATA: 22.413 969 54 L/mol at 273.15 K and 101.325 kPa."""
    assert gas_pressure(1.0, 22.41396954e-3, 273.15) == pytest.approx(ATMOSPHERE, rel=1e-9)


@given(V=volumes, fraction=fractions)
def test_rigid_volume_keeps_pressure_times_volume(V, fraction):
    P = closed_volume_pressure(fraction * V, V)
    assert P * (V - fraction * V) == pytest.approx(ATMOSPHERE * V)


@given(V=volumes, fraction=fractions)
def test_exact_pressure_is_that_of_eq_4_4_for_the_same_amount(V, fraction):
    amount = ATMOSPHERE * V / (GAS_CONSTANT * 293.15)
    expected = gas_pressure(amount, V * (1 - fraction))
    assert closed_volume_pressure(fraction * V, V) == pytest.approx(expected)


@given(V=volumes, fraction=st.floats(0, 0.9), K=compliances)
def test_elastic_volume_solves_its_equation(V, fraction, K):
    """Eq. (4.3): the same ``P V`` in a finger that gives way, by a root finder."""

    def excess(P):
        return P * (V - fraction * V + K * (P - ATMOSPHERE)) - ATMOSPHERE * V

    expected = brentq(excess, ATMOSPHERE * (1 - 1e-9), 20 * ATMOSPHERE, xtol=1e-6)
    assert closed_volume_pressure(fraction * V, V, compliance=K) == pytest.approx(expected)


@pytest.mark.parametrize("K", [0.0, 2e-10])
def test_capacity_integrates_to_the_exact_pressure(K):
    V, swept = 100e-6, 60e-6

    def rate(s, P):
        gas = V - s + K * (P - ATMOSPHERE)
        return 1 / capacity(P, gas, K)

    path = solve_ivp(rate, (0, swept), [ATMOSPHERE], rtol=1e-10, atol=1e-4)
    assert path.y[0, -1] == pytest.approx(closed_volume_pressure(swept, V, compliance=K), rel=1e-7)


@given(V=volumes, P=st.floats(5e4, 5e5), K=compliances)
def test_capacity_limits(V, P, K):
    assert capacity(P, V) == pytest.approx(V / P)  # rigid
    assert capacity(P, V, K) == pytest.approx(V / P + K)
    assert capacity(P, 1e-15, 1e-9) == pytest.approx(1e-9)  # hardly any gas: the wall alone


@given(V=volumes, P=st.floats(5e4, 5e5))
def test_rigid_capacity_falls_by_two_over_the_pressure(V, P):
    assert capacity_growth(P, V) == pytest.approx(-2 / P)


@given(V=volumes, P=st.floats(5e4, 5e5), K=compliances)
def test_constant_compliance_never_lets_the_capacity_grow(V, P, K):
    assert -2 / P * (1 + 1e-12) <= capacity_growth(P, V, K) < 0


@pytest.mark.parametrize("softening", [0.0, 5e-15])
def test_growth_is_the_slope_of_the_capacity_along_a_push(softening):
    """Central differences along the exact law with V_f = K p + softening p^2 / 2."""
    V, K = 80e-6, 1e-10

    def gas_law(P, s):
        p = P - ATMOSPHERE
        return P * (V - s + K * p + softening * p**2 / 2) - ATMOSPHERE * V

    def state(s):
        P = brentq(gas_law, ATMOSPHERE, 10 * ATMOSPHERE, args=(s,), xtol=1e-9, rtol=1e-14)
        return P, ATMOSPHERE * V / P, K + softening * (P - ATMOSPHERE)

    h = 1e-8
    below, here, above = (state(20e-6 + d) for d in (-h, 0, h))
    slope = (capacity(*above) - capacity(*below)) / (2 * h)
    assert capacity_growth(*here, softening) == pytest.approx(slope, rel=1e-5)
    assert (slope > 0) == (softening > 2 * here[1] / here[0] ** 2)


@pytest.mark.parametrize(("rest", "faster"), [(20e-6, False), (32.4e-6, False), (32.5e-6, True)])
def test_full_large_syringe_is_faster_only_on_a_large_finger(rest, faster):
    """Eq. (4.5) gives the 200 mL syringe 2.51 times the rate; its own gas takes that back.

    With the syringes full the rates at the start go as A / (V_s + rest), equal at a rest of
    (200 - 60 r) / (r - 1) = 32.43 mL with r = 16.62 / 6.61.
    """
    runs = PARAMETER_SETS["default"], PARAMETER_SETS["larger area"]
    small, large = (
        run.flow / capacity(ATMOSPHERE, syringe.volume + rest)
        for run, syringe in zip(runs, SYRINGES, strict=True)
    )
    assert (large > small) == faster
    assert large / small < 0.5 * 16.62 / 6.61


def test_swept_volume_must_leave_gas():
    with pytest.raises(InvalidInputError, match="below the gas volume"):
        closed_volume_pressure(np.array([1e-6, 1e-4]), 1e-4)
    with pytest.raises(InvalidInputError, match="below the gas volume"):
        closed_volume_pressure(float("nan"), 1e-4)


@pytest.mark.parametrize("bad", [{"gas_volume": 0.0}, {"compliance": -1.0}, {"start_pressure": -1}])
def test_bad_chamber_is_refused(bad):
    with pytest.raises(InvalidInputError, match=next(iter(bad))):
        closed_volume_pressure(**({"swept_volume": 0.0, "gas_volume": 1e-4} | bad))
