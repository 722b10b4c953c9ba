"""A model of a reader's own pad: from the voltages of its channels to kind or force.

Both models are lazy: they keep the readings that they were given, and look up those near to a new
one. What has to be kept is therefore these readings and a few settings, see `pad_model_file`.
"""

from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike
from sklearn.exceptions import NotFittedError

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.tactile.own_pad import Labels, PadReadings
from softgrip.tactile.pad_model_settings import Settings

TOP_COUNT = 5.0 * 1023 / 1024
"""Volts of the highest count of a converter of 10 bits and 5 V, such as the text's."""


class PadModel:
    """A pad's model: `fit` to labelled readings, then `predict` from voltages.

    Parameters
    ----------
    settings
        `KindSettings` or `ForceSettings`.
    saturation
        V: a channel that reaches it may have been cut off, and is refused.

    Examples
    --------
    >>> from softgrip.tactile.pad_model_settings import KindSettings
    >>> at_rest, pressed = [0.1, 0.1], [0.8, 0.1]
    >>> mine = PadReadings(
    ...     ("e1", "e2"),
    ...     [at_rest, pressed] * 6,
    ...     ["none", "point"] * 6,
    ... )
    >>> PadModel(KindSettings()).fit(mine).predict([[0.7, 0.1]])
    array(['point'], dtype='<U5')
    """

    def __init__(self, settings: Settings, *, saturation: float = TOP_COUNT) -> None:
        self.settings, self.saturation = settings, saturation
        self._fitted: tuple[PadReadings, Any] | None = None

    def fit(self, readings: PadReadings) -> Self:
        """Fit to labelled readings.

        Raises
        ------
        InvalidInputError
            If a channel is saturated, or the settings cannot be used with these labels.
        """
        checked = self._checked(readings.voltages, readings.channels)
        estimator = self.settings.build(readings)
        self._fitted = readings, estimator.fit(checked, readings.labels)
        return self

    @property
    def readings(self) -> PadReadings:
        """What the model was fitted to."""
        return self._state()[0]

    @property
    def estimator(self) -> Any:
        """The fitted model of scikit-learn."""
        return self._state()[1]

    def predict(self, voltages: ArrayLike) -> Labels:
        """Return kinds, or forces [N], shape (N,), from voltages [V], shape (N, C).

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If the model was not fitted.
        InvalidInputError
            If there are more or fewer channels than were fitted, a voltage is not finite, or a
            channel is saturated.
        """
        readings, estimator = self._state()
        found: Labels = estimator.predict(self._checked(voltages, readings.channels))
        return found

    def _state(self) -> tuple[PadReadings, Any]:
        if self._fitted is None:
            raise NotFittedError("this PadModel is not fitted: call fit with labelled readings")
        return self._fitted

    def _checked(self, voltages: ArrayLike, channels: tuple[str, ...]) -> Floats:
        given = np.asarray(voltages, dtype=np.float64)
        if given.ndim != 2 or given.shape[1] != len(channels):
            raise InvalidInputError(
                "voltages",
                expected=f"shape (N, {len(channels)}), channels {', '.join(channels)}",
                got=given.shape,
            )
        for bad, expected in (
            (~np.isfinite(given), "a finite number"),
            (given >= self.saturation, f"less than {self.saturation:g} V, or it is saturated"),
        ):
            if bad.any():
                row, column = np.argwhere(bad)[0]
                raise InvalidInputError(
                    f"reading {row}, channel {channels[column]}",
                    expected=expected,
                    got=float(given[row, column]),
                )
        return given
