"""The fractional power of a material that is not in the table, with its interval."""

from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Floats, check_positive
from softgrip.errors import InvalidInputError
from softgrip.materials.least_squares import Prediction, prediction_interval
from softgrip.materials.powerlaw import predictors
from softgrip.materials.table import fractional_powers, properties, table_5_1

PROPERTIES = ("young_modulus", "mixed_viscosity", "tensile_strength")


@dataclass(frozen=True)
class PowerOfNewMaterial:
    """A predicted fractional power, and which properties lie outside the ten that it rests on."""

    power: Prediction
    extrapolates: tuple[str, ...]


def predict_power(
    young_modulus: float,
    mixed_viscosity: float,
    tensile_strength: float,
    *,
    fit_intercept: bool = False,
    confidence: float = 0.95,
) -> PowerOfNewMaterial:
    """Predict n by the power law fitted to all ten materials of Table 5.1.

    Parameters
    ----------
    young_modulus, mixed_viscosity, tensile_strength
        E [Pa], MV [Pa s], TS [Pa] from the data sheet, each > 0. The table's E is the stress at
        100 % strain, which suppliers call the 100 % modulus.
    fit_intercept
        Whether to add the constant that Eq. (5.8) does not have.
    confidence
        Of the interval for the n that a fit to a tensile test of the material would give.

    Raises
    ------
    InvalidInputError
        If a property is not a finite number above zero, or `confidence` is not in (0, 1).

    Examples
    --------
    >>> found = predict_power(0.34e6, 20, 3.79e6)
    >>> round(found.power.value, 2), found.extrapolates
    (2.37, ())
    """
    new = (young_modulus, mixed_viscosity, tensile_strength)
    check_positive(**dict(zip(PROPERTIES, new, strict=True)))
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


def _with_constant(columns: Floats, wanted: bool) -> Floats:
    if not wanted:
        return columns
    return np.concatenate([columns, np.ones((*columns.shape[:-1], 1))], axis=-1)
