"""How a reader's own pad is read: the settings of its model, which build the estimator."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import MinMaxScaler

from softgrip.errors import InvalidInputError
from softgrip.tactile.contact_kind import (
    ESTIMATORS,
    NEIGHBOURS,
    SAMPLES,
    bagged_neighbours,
    nearest_neighbours,
)
from softgrip.tactile.nadaraya_watson import NadarayaWatson
from softgrip.tactile.own_pad import PadReadings

LEAST_DRAWN = 10
"""Readings that a base classifier needs at least; scikit-learn warns of fewer."""


@dataclass(frozen=True)
class KindSettings:
    """How kinds are told apart.

    Attributes
    ----------
    estimators
        Base classifiers of the bagging classifier, each without one of the channels; 0 for a
        single classifier.
    neighbours, samples, seed
        As in `contact_kind.bagged_neighbours`.
    """

    estimators: int = ESTIMATORS
    neighbours: int = NEIGHBOURS
    samples: float = SAMPLES
    seed: int = 0

    def build(self, readings: PadReadings) -> Any:
        """Return the classifier, not fitted, for some readings.

        Raises
        ------
        InvalidInputError
            If the readings' labels are numbers, or fewer than two kinds, or too few
            readings.
        """
        labels = readings.labels
        kinds = sorted(set(map(str, labels)))
        if labels.dtype.kind != "U" or len(kinds) < 2:
            raise InvalidInputError("labels", expected="at least two kinds of contact", got=kinds)
        if not self.estimators:
            least, drawn = self.neighbours, len(labels)
        else:
            least, drawn = max(self.neighbours, LEAST_DRAWN), int(self.samples * len(labels))
        if drawn < least:
            raise InvalidInputError("readings", expected=f"enough to draw {least}", got=len(labels))
        if not self.estimators:
            return nearest_neighbours(self.neighbours)
        return bagged_neighbours(
            k=self.neighbours,
            estimators=self.estimators,
            samples=self.samples,
            features=max(1, len(readings.channels) - 1),
            seed=self.seed,
        )


@dataclass(frozen=True)
class ForceSettings:
    """How forces are read.

    Attributes
    ----------
    bandwidth
        Of `nadaraya_watson.NadarayaWatson`, in parts of each channel's range; None to choose it
        by leaving one reading out at a time.
    """

    bandwidth: float | None = None

    def build(self, readings: PadReadings) -> Any:
        """Return the regressor, not fitted, for some readings.

        Raises
        ------
        InvalidInputError
            If the readings' labels are not forces, or all one.
        """
        labels = readings.labels
        if labels.dtype.kind != "f" or np.unique(labels).size < 2:
            raise InvalidInputError(
                "labels", expected="at least two forces, N", got=np.unique(labels).tolist()[:1]
            )
        return make_pipeline(MinMaxScaler(), NadarayaWatson(bandwidth=self.bandwidth))


Settings = KindSettings | ForceSettings
