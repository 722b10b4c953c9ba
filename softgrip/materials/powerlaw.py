"""The fractional power from three properties of a material, Eq. (5.7) and (5.8)."""

from dataclasses import dataclass
from typing import Any, final

import numpy as np
from numpy.typing import ArrayLike
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils.validation import check_is_fitted, validate_data

from softgrip.arrays import Floats, check_positive
from softgrip.checks import takes_numbers
from softgrip.errors import InvalidInputError
from softgrip.materials.least_squares import Prediction, normal_equations, prediction_interval
from softgrip.materials.table import fractional_powers, properties, table_5_1
from softgrip.plausible import STRENGTH, VISCOSITY, YOUNG_MODULUS
from softgrip.quantities import in_si
from softgrip.units import MPa

EXPONENTS = (1.0, 0.5, 0.5)
"""Powers of E, MV and TS in Eq. (5.7)."""
SCALES = (1 * MPa, 50.0, 10 * MPa)
"""Units of E [Pa], MV [Pa s] and TS [Pa] in Eq. (5.7); they change coefficients only."""

PROPERTIES = ("young_modulus", "mixed_viscosity", "tensile_strength")
PLAUSIBLE = (YOUNG_MODULUS, VISCOSITY, STRENGTH)
UNITS = ("Pa", "Pa s", "Pa")


def predictors(E: ArrayLike, MV: ArrayLike, TS: ArrayLike) -> Floats:
    """Return the predictors, Eq. (5.7): E, the root of MV and the root of TS, made dimensionless.

    Args:
        E: Young's modulus, Pa, >= 0, shape (m,) or a float.
        MV: Mixed viscosity, Pa s, >= 0, same shape.
        TS: Tensile strength, Pa, >= 0, same shape.

    Returns:
        ndarray: E / 1 MPa, (MV / 50 Pa s)**0.5 and (TS / 10 MPa)**0.5, shape (m, 3), or (3,) from
            floats.

    Raises:
        InvalidInputError: If a value is negative or not finite.

    >>> predictors(0.5e6, 12.5, 2.5e6).tolist()
    [0.5, 0.5, 0.5]
    """
    return _powers(np.stack(np.broadcast_arrays(E, MV, TS), axis=-1), EXPONENTS, SCALES)


@final
class FractionalPowerRegressor(RegressorMixin, BaseEstimator):  # type: ignore[misc]  # untyped base
    """Least squares for the fractional power, as a scikit-learn regressor.

    Args:
        exponents: Power of each column of X, or one for all. The default is Eq. (5.7).
        scales: Unit of each column of X, or one for all, > 0. The default is Eq. (5.7) for columns
            in SI.
        fit_intercept: Whether to add a constant, which Eq. (5.8) does not have.

    Attributes:
        coef_ (ndarray of shape (p,)): The x of Eq. (5.6).
        intercept_ (float): The constant, 0 when not fitted.

    `fit` and `predict` take X of shape (m, 3) with columns E [Pa], MV [Pa s], TS [Pa], all >= 0,
    and raise InvalidInputError, a ValueError, for negative values. Eq. (5.8) is an empirical rule:
    outside the materials that it was fitted to it has no ground.

    >>> X = [[1e6, 0, 0], [0, 50, 0], [0, 0, 10e6], [1e6, 50, 10e6]]
    >>> FractionalPowerRegressor().fit(X, [1, 2, 3, 6]).coef_.round(9).tolist()
    [1.0, 2.0, 3.0]
    """

    def __init__(
        self,
        exponents: float | tuple[float, ...] = EXPONENTS,
        scales: float | tuple[float, ...] = SCALES,
        fit_intercept: bool = False,
    ) -> None:
        self.exponents = exponents
        self.scales = scales
        self.fit_intercept = fit_intercept

    def fit(self, X: ArrayLike, y: ArrayLike) -> "FractionalPowerRegressor":
        """Fit the coefficients x, Eq. (5.6), to X of shape (m, 3) and y of shape (m,)."""
        X, y = validate_data(self, X, y, dtype=np.float64, y_numeric=True, ensure_min_samples=2)
        columns = _powers(X, self.exponents, self.scales)
        if self.fit_intercept:
            columns = np.column_stack([columns, np.ones(len(columns))])
        solution = normal_equations(columns, y)
        self.coef_ = solution[: self.n_features_in_]
        self.intercept_ = float(solution[-1]) if self.fit_intercept else 0.0
        return self

    def predict(self, X: ArrayLike) -> Floats:
        """Predict the fractional power, Eq. (5.8); X of shape (m, 3), result of shape (m,)."""
        check_is_fitted(self)
        X = validate_data(self, X, dtype=np.float64, reset=False)
        return _powers(X, self.exponents, self.scales) @ self.coef_ + self.intercept_

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.positive_only = True
        return tags


@dataclass(frozen=True)
class PowerOfNewMaterial:
    """A predicted fractional power, and which properties lie outside the ten that it rests on."""

    power: Prediction
    extrapolates: tuple[str, ...]


@takes_numbers
def predict_power(
    young_modulus: float | str,
    mixed_viscosity: float | str,
    tensile_strength: float | str,
    *,
    fit_intercept: bool = False,
    confidence: float = 0.95,
) -> PowerOfNewMaterial:
    """Predict n by the power law fitted to all ten materials of Table 5.1.

    Args:
        young_modulus, mixed_viscosity, tensile_strength: E [Pa], MV [Pa s], TS [Pa] from the data
            sheet, each > 0; numbers in SI, words such as ``"20000 cP"``, or quantities of `pint`.
            The table's E is the stress at 100 % strain, which suppliers call the 100 % modulus.
        fit_intercept: Whether to add the constant that Eq. (5.8) does not have.
        confidence: Of the interval for the n that a fit to a tensile test of the material would
            give.

    Raises:
        InvalidInputError: If a property is not a finite number above zero, or is one that no
            elastomer has (`plausible`), or `confidence` is not in (0, 1).

    >>> found = predict_power(0.34e6, 20, 3.79e6)
    >>> round(found.power.value, 2), found.extrapolates
    (2.37, ())
    """
    given = zip(PROPERTIES, (young_modulus, mixed_viscosity, tensile_strength), UNITS, strict=True)
    new = tuple(in_si(*one) for one in given)
    check_positive(**dict(zip(PROPERTIES, new, strict=True)))
    for range_, name, value in zip(PLAUSIBLE, PROPERTIES, new, strict=True):
        range_.check(name, value)
    if not 0 < confidence < 1:
        raise InvalidInputError("confidence", expected="a number in (0, 1)", got=confidence)
    known = table_5_1().values()
    X = properties(known)
    interval = prediction_interval(
        _with_constant(predictors(*X.T), fit_intercept),
        fractional_powers(known),
        _with_constant(predictors(*new), fit_intercept),
        confidence=confidence,
    )
    outside = tuple(
        name
        for name, value, low, high in zip(
            PROPERTIES, new, X.min(axis=0), X.max(axis=0), strict=True
        )
        if not low <= value <= high
    )
    return PowerOfNewMaterial(interval, outside)


def _powers(
    X: ArrayLike, exponents: float | tuple[float, ...], scales: float | tuple[float, ...]
) -> Floats:
    X = np.asarray(X, dtype=np.float64)
    if not np.isfinite(X).all():
        raise InvalidInputError("properties", expected="finite numbers", got="NaN or infinity")
    if X.min() < 0:
        # The words are those that scikit-learn asks of an estimator for positive data.
        got = f"Negative values in data, {X.min():g} the least"
        raise InvalidInputError("properties", expected="numbers >= 0", got=got)
    for name, value in (("exponents", exponents), ("scales", scales)):
        if np.shape(value) not in ((), X.shape[-1:]):
            raise InvalidInputError(
                name, expected=f"one number, or {X.shape[-1]}: one for each column", got=value
            )
    if not np.all(np.greater(scales, 0)):
        raise InvalidInputError("scales", expected="numbers > 0", got=scales)
    return np.asarray((X / scales) ** exponents, dtype=np.float64)


def _with_constant(columns: Floats, wanted: bool) -> Floats:
    if not wanted:
        return columns
    return np.concatenate([columns, np.ones((*columns.shape[:-1], 1))], axis=-1)
