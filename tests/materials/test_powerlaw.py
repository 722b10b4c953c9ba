"""Eq. (5.3) to (5.8): least squares, the regressor, its errors on unseen materials."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats
from scipy.stats import t as student_t
from sklearn.dummy import DummyRegressor
from sklearn.utils.estimator_checks import parametrize_with_checks

from softgrip.errors import InvalidInputError
from softgrip.materials.least_squares import normal_equations, prediction_interval
from softgrip.materials.leave_out import leave_k_out
from softgrip.materials.powerlaw import SCALES, FractionalPowerRegressor, predict_power, predictors
from softgrip.materials.table import fractional_powers, properties, table_5_1

X = properties(table_5_1().values())
Y = fractional_powers(table_5_1().values())
factors = st.floats(0.01, 100)


# One exponent for all columns, because the checks bring tables of any width.
@parametrize_with_checks(
    [
        FractionalPowerRegressor(exponents=0.5, scales=1.0),
        FractionalPowerRegressor(exponents=0.5, scales=1.0, fit_intercept=True),
    ]
)
def test_scikit_learn_estimator(estimator, check):
    check(estimator)


@given(seed=st.integers(0, 999), p=st.integers(1, 5), extra=st.integers(0, 20))
def test_normal_equations_agree_with_lstsq(seed, p, extra):
    """Eq. (5.3) by another method; what Eq. (5.4) leaves is at right angles to the columns."""
    random = np.random.default_rng(seed)
    A, y = random.normal(size=(p + 5 + extra, p)), random.normal(size=p + 5 + extra)
    x = normal_equations(A, y)
    np.testing.assert_allclose(x, np.linalg.lstsq(A, y)[0], rtol=1e-8, atol=1e-10)
    np.testing.assert_allclose(A.T @ (y - A @ x), 0, atol=1e-10)


def test_predictors_of_the_first_row_of_the_table():
    """Eq. (5.7) by hand."""
    expected = [0.26, np.sqrt(18 / 50), np.sqrt(1.99 / 10)]
    np.testing.assert_allclose(predictors(0.26e6, 18, 1.99e6), expected)
    np.testing.assert_allclose(predictors(*X.T)[0], expected)


@given(x=st.tuples(*[st.floats(-5, 5)] * 3))
def test_powers_that_some_coefficients_made_give_them_back(x):
    """Eq. (5.6): without error in y the fit finds x."""
    found = FractionalPowerRegressor().fit(X, predictors(*X.T) @ np.array(x)).coef_
    np.testing.assert_allclose(found, x, atol=1e-9)


def test_prediction_is_the_sum_of_three_terms_by_hand():
    """Eq. (5.8) for 0.5 MPa, 12.5 Pa s and 2.5 MPa: half of each coefficient."""
    model = FractionalPowerRegressor().fit(X, Y)
    assert model.predict([[0.5e6, 12.5, 2.5e6]]) == pytest.approx([model.coef_.sum() / 2])


@given(viscosity=factors, strength=factors)
def test_normalisation_changes_coefficients_but_no_prediction(viscosity, strength):
    scales = (SCALES[0], SCALES[1] * viscosity, SCALES[2] * strength)
    ours, other = FractionalPowerRegressor(), FractionalPowerRegressor(scales=scales)
    np.testing.assert_allclose(other.fit(X, Y).predict(X), ours.fit(X, Y).predict(X), rtol=1e-7)
    ratio = [1, np.sqrt(viscosity), np.sqrt(strength)]
    np.testing.assert_allclose(other.coef_, ours.coef_ * ratio, rtol=1e-6)


@given(order=st.permutations(range(10)))
def test_order_of_materials_does_not_matter(order):
    expected = FractionalPowerRegressor().fit(X, Y).coef_
    found = FractionalPowerRegressor().fit(X[order], Y[order]).coef_
    np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_intercept_makes_the_residuals_sum_to_zero():
    model = FractionalPowerRegressor(fit_intercept=True).fit(X, Y)
    assert np.sum(Y - model.predict(X)) == pytest.approx(0, abs=1e-9)
    assert FractionalPowerRegressor().fit(X, Y).intercept_ == 0


def test_interval_of_a_straight_line_agrees_with_the_textbook_formula():
    x, y = np.array([1.0, 2, 3, 4, 6]), np.array([1.1, 1.9, 3.2, 3.9, 6.3])
    slope, constant = np.polyfit(x, y, 1)
    spread = np.sqrt(np.sum((y - constant - slope * x) ** 2) / 3)
    reach = 1 + 1 / 5 + (8 - x.mean()) ** 2 / np.sum((x - x.mean()) ** 2)
    half = student_t.ppf(0.95, 3) * spread * np.sqrt(reach)
    found = prediction_interval(np.column_stack([x, np.ones(5)]), y, [8, 1], confidence=0.9)
    assert found.value == pytest.approx(constant + 8 * slope)
    assert (found.low, found.high) == pytest.approx((found.value - half, found.value + half))


@pytest.mark.parametrize("confidence", [0.5, 0.95])
def test_interval_holds_new_values_as_often_as_it_says(confidence):
    random = np.random.default_rng(2026)
    A, a, x = predictors(*X.T), predictors(0.3e6, 15, 3e6), np.array([-0.5, 0.4, 3.6])
    draws = 2000
    inside = 0
    for errors in random.normal(0, 0.2, (draws, 11)):
        found = prediction_interval(A, A @ x + errors[:10], a, confidence=confidence)
        inside += found.low <= a @ x + errors[10] <= found.high
    # Four standard errors of a binomial share.
    allowed = 4 * np.sqrt(confidence * (1 - confidence) / draws)
    assert inside / draws == pytest.approx(confidence, abs=allowed)


def test_leave_one_out_agrees_with_the_hat_matrix():
    A = predictors(*X.T)
    hat = A @ np.linalg.pinv(A)
    errors = -(Y - hat @ Y) / (1 - np.diag(hat))
    np.testing.assert_allclose([p.error for p in leave_k_out(1).predictions], errors)


def test_leave_two_out_holds_each_pair_out_once():
    found = leave_k_out(2)
    pairs = {frozenset(p.without) for p in found.predictions}
    assert len(pairs) == 45
    assert all(len(found.of(name)) == 9 for name in table_5_1())
    assert abs(found.worst.error) == max(abs(p.error) for p in found.predictions)


def test_power_law_predicts_better_than_the_mean():
    mean = leave_k_out(1, model=DummyRegressor())
    assert leave_k_out(1).rms_error < mean.rms_error
    # Leaving row i out moves the mean by 1/9 of its distance, in closed form.
    assert mean.rms_error == pytest.approx(np.std(Y) * 10 / 9)


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        (lambda: leave_k_out(0), "an integer from 1 to 6, got 0"),
        (lambda: leave_k_out(7), "an integer from 1 to 6, got 7"),
        (lambda: predictors(-1.0, 1, 1), "numbers >= 0, got .*-1 the least"),
        (lambda: predictors(np.nan, 1, 1), "finite numbers, got"),
        (lambda: FractionalPowerRegressor().fit(X[:, :2], Y), "exponents: expected one number"),
        (lambda: FractionalPowerRegressor(scales=(0.0, 1.0, 1.0)).fit(X, Y), "scales: .*> 0"),
        (lambda: FractionalPowerRegressor().fit(-X, Y), "Negative values in data"),
        (lambda: FractionalPowerRegressor().fit(X[:2], Y[:2]), "3 independent columns, got 'rank"),
        (lambda: normal_equations([[1, 2], [2, 4], [3, 6]], [1, 2, 3]), "2 independent columns"),
        (lambda: normal_equations([[1, 2]], [1, 2]), r"shapes \(m, p\) and \(m,\)"),
        (lambda: prediction_interval(np.eye(3), [1, 2, 3], [1, 1, 1]), "m > p"),
        (lambda: prediction_interval(predictors(*X.T), Y, [1, 1]), r"\(p,\)"),
        (
            lambda: prediction_interval(predictors(*X.T), Y, [1, 1, 1], confidence=95),
            r"confidence: expected a number in \(0, 1\), got 95",
        ),
    ],
)
def test_bad_input_says_what_is_valid(call, expected):
    with pytest.raises(InvalidInputError, match=expected):
        call()


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
    assert predict_power(0.3e6, 100.0, 9e6).extrapolates == ("mixed_viscosity", "tensile_strength")


@pytest.mark.parametrize("bad", [0.0, -1.0, float("nan"), float("inf")])
def test_property_out_of_range_is_named(bad):
    with pytest.raises(InvalidInputError, match="mixed_viscosity: expected a finite number"):
        predict_power(0.3e6, bad, 2.5e6)


def test_constant_narrows_the_interval_little():
    without = predict_power(0.3e6, 15.0, 2.5e6).power
    with_constant = predict_power(0.3e6, 15.0, 2.5e6, fit_intercept=True).power
    assert 0.5 < (with_constant.high - with_constant.low) / (without.high - without.low) < 1.5


def test_properties_may_be_given_with_their_units():
    found = predict_power("340 kPa", "20000 cP", "550 psi").power.value
    assert found == pytest.approx(predict_power(340e3, 20.0, 550 * 6894.757).power.value)
