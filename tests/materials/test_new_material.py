"""The exponent of a new material: Eq. (5.8) over all ten, with an honest interval."""

import numpy as np
import pytest
from scipy import stats

from softgrip.errors import InvalidInputError
from softgrip.materials.new_material import predict_power
from softgrip.materials.powerlaw import predictors
from softgrip.materials.table import fractional_powers, properties, table_5_1


def test_value_and_interval_by_another_way():
    """Oracle: QR by numpy, and the covariance of the coefficients written out."""
    A = predictors(*properties(table_5_1().values()).T)
    y = fractional_powers(table_5_1().values())
    x, residual, *_ = np.linalg.lstsq(A, y)
    a = predictors(0.3e6, 15.0, 2.5e6)
    spread = np.sqrt(residual[0] / 7 * (1 + a @ np.linalg.inv(A.T @ A) @ a))
    half = stats.t(7).ppf(0.975) * spread
    power = predict_power(0.3e6, 15.0, 2.5e6).power
    assert (power.value, power.low, power.high) == pytest.approx(
        (a @ x, a @ x - half, a @ x + half)
    )


def test_extrapolation_is_named():
    assert predict_power(2e6, 15.0, 2.5e6).extrapolates == ("young_modulus",)
    assert predict_power(0.3e6, 100.0, 9e6).extrapolates == (
        "mixed_viscosity",
        "tensile_strength",
    )


@pytest.mark.parametrize("bad", [0.0, -1.0, float("nan"), float("inf")])
def test_property_out_of_range_is_named(bad):
    with pytest.raises(InvalidInputError, match=r"mixed_viscosity: expected a finite number > 0"):
        predict_power(0.3e6, bad, 2.5e6)


def test_constant_narrows_the_interval_little():
    without = predict_power(0.3e6, 15.0, 2.5e6).power
    with_constant = predict_power(0.3e6, 15.0, 2.5e6, fit_intercept=True).power
    assert 0.5 < (with_constant.high - with_constant.low) / (without.high - without.low) < 1.5
