"""How the power law predicts materials that it has not seen."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
from sklearn.base import clone
from sklearn.dummy import DummyRegressor
from sklearn.model_selection import LeavePOut

from softgrip.errors import InvalidInputError
from softgrip.materials.powerlaw import FractionalPowerRegressor
from softgrip.materials.table import Material, fractional_powers, properties, table_5_1

RIVALS: Mapping[str, Callable[[], Any]] = MappingProxyType(
    {
        "Eq. (5.8)": FractionalPowerRegressor,
        "with a constant": lambda: FractionalPowerRegressor(fit_intercept=True),
        "mean of the others": DummyRegressor,
    }
)
"""Models that are worth comparing: the printed one, one with a constant, and none at all."""


@dataclass(frozen=True)
class HeldOut:
    """A material predicted by a model fitted without it.

    Attributes:
        name: The material.
        without: All materials that the fit had not seen, this one included.
        printed, predicted: Fractional power of Table 5.1, and that of the model.
    """

    name: str
    without: tuple[str, ...]
    printed: float
    predicted: float

    @property
    def error(self) -> float:
        """Predicted minus printed fractional power."""
        return self.predicted - self.printed


@dataclass(frozen=True)
class LeaveOut:
    """All predictions when each set of k materials is held out once.

    Attributes:
        k: Number of materials held out at a time.
        predictions: One for each material of each set.
    """

    k: int
    predictions: tuple[HeldOut, ...]

    @property
    def rms_error(self) -> float:
        """Root mean square of all errors."""
        return float(np.sqrt(np.mean([p.error**2 for p in self.predictions])))

    @property
    def worst(self) -> HeldOut:
        """The prediction with the largest error in size."""
        return max(self.predictions, key=lambda p: abs(p.error))

    def of(self, name: str) -> tuple[HeldOut, ...]:
        """Return the predictions of one material."""
        return tuple(p for p in self.predictions if p.name == name)


def leave_k_out(
    k: int, *, model: Any = None, materials: Iterable[Material] | None = None
) -> LeaveOut:
    """Hold out each set of k materials, fit to the rest and predict those held out.

    Args:
        k: 1 or more; at least one more material than the three coefficients of Eq. (5.8) must stay.
        model: Any scikit-learn regressor of (E, MV, TS) in SI; None for that of Eq. (5.8). A
            ``DummyRegressor`` shows what the mean alone would do.
        materials: None for all ten of Table 5.1.

    Raises:
        InvalidInputError: If k is out of range.

    >>> len(leave_k_out(1).predictions), len(leave_k_out(2).predictions)
    (10, 90)
    """
    rows = tuple(table_5_1().values() if materials is None else materials)
    most = len(rows) - 4
    if not 1 <= k <= most:
        raise InvalidInputError("k", expected=f"an integer from 1 to {most}", got=k)
    X, y = properties(rows), fractional_powers(rows)
    regressor = FractionalPowerRegressor() if model is None else model
    predictions = []
    for kept, held in LeavePOut(k).split(X):
        predicted = clone(regressor).fit(X[kept], y[kept]).predict(X[held])
        names = tuple(rows[i].name for i in held)
        predictions += [
            HeldOut(rows[i].name, names, rows[i].fractional_power, float(value))
            for i, value in zip(held, predicted, strict=True)
        ]
    return LeaveOut(k, tuple(predictions))
