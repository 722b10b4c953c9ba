"""A model of a reader's own pad: from the voltages of its channels to kind or force.

Both models are lazy: they keep the readings that they were given, and look up those near to a new
one. What has to be kept is therefore these readings and a few settings: as JSON, no code. On
loading a model is fitted anew, and must say of a few readings what it said before: another version
of a library that answers otherwise is found out.
"""

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike
from sklearn.exceptions import NotFittedError
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import MinMaxScaler

from softgrip.arrays import Floats, check_positive, floats, one_number
from softgrip.checks import check_not_negative, takes_numbers
from softgrip.errors import DataFileError, InvalidInputError, SoftgripError
from softgrip.files import existing, path_of
from softgrip.tactile.contact_kind import (
    ESTIMATORS,
    NEIGHBOURS,
    SAMPLES,
    bagged_neighbours,
    nearest_neighbours,
)
from softgrip.tactile.nadaraya_watson import NadarayaWatson, best_bandwidth
from softgrip.tactile.own_pad import Labels, PadReadings

LEAST_DRAWN = 10
"""Readings that a base classifier needs at least; scikit-learn warns of fewer."""


@dataclass(frozen=True)
class KindSettings:
    """How kinds are told apart.

    Attributes:
        estimators: Base classifiers of the bagging classifier, each without one of the channels; 0
            for a single classifier.
        neighbours, samples, seed: As in `contact_kind.bagged_neighbours`.
    """

    estimators: int = ESTIMATORS
    neighbours: int = NEIGHBOURS
    samples: float = SAMPLES
    seed: int = 0

    def __post_init__(self) -> None:
        check_not_negative(estimators=self.estimators, seed=self.seed)
        check_positive(neighbours=self.neighbours, samples=self.samples)
        numbers = one_number(**vars(self))
        if any(n % 1 for n in (numbers[0], numbers[1], numbers[3])) or self.samples > 1:
            raise InvalidInputError(
                "settings", expected="whole numbers, and samples of up to 1", got=self
            )

    def build(self, readings: PadReadings) -> Any:
        """Return the classifier, not fitted, for some readings.

        Raises:
            InvalidInputError: If the readings' labels are numbers, or fewer than two kinds, or too
                few readings.
        """
        labels = readings.labels
        kinds = sorted(set(map(str, labels)))
        if labels.dtype.kind != "U" or len(kinds) < 2:
            raise InvalidInputError(
                "labels", expected="at least two kinds of contact, as strings", got=kinds[:8]
            )
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

    Attributes:
        bandwidth: Of `nadaraya_watson.NadarayaWatson`, in parts of each channel's range; None to
            choose it by leaving one reading, or one group of readings, out at a time.
    """

    bandwidth: float | None = None

    def __post_init__(self) -> None:
        if self.bandwidth is not None:
            one_number(bandwidth=self.bandwidth)
            check_positive(bandwidth=self.bandwidth)

    def build(self, readings: PadReadings) -> Any:
        """Return the regressor, not fitted, for some readings.

        Raises:
            InvalidInputError: If the readings' labels are not forces, all one, or all of one group.
        """
        labels = readings.labels
        if labels.dtype.kind != "f" or np.unique(labels).size < 2:
            raise InvalidInputError(
                "labels", expected="at least two forces, N", got=np.unique(labels).tolist()[:1]
            )
        bandwidth = self.bandwidth
        if bandwidth is None and readings.groups is not None:
            points = np.asarray(MinMaxScaler().fit_transform(readings.voltages), dtype=np.float64)
            forces = np.asarray(labels, dtype=np.float64)
            bandwidth = best_bandwidth(points, forces, groups=readings.groups)
        return make_pipeline(MinMaxScaler(), NadarayaWatson(bandwidth=bandwidth))


Settings = KindSettings | ForceSettings


TOP_COUNT = 5.0 * 1023 / 1024
"""Volts of the highest count of a converter of 10 bits and 5 V, such as the text's."""


class PadModel:
    """A pad's model: `fit` to labelled readings, then `predict` from voltages.

    Args:
        settings: `KindSettings` or `ForceSettings`.
        saturation: V: a channel that reaches it may have been cut off, and is refused.

    >>> from softgrip.tactile.pad_model import KindSettings
    >>> at_rest, pressed = [0.1, 0.1], [0.8, 0.1]
    >>> mine = PadReadings(
    ...     ("e1", "e2"),
    ...     [at_rest, pressed] * 6,
    ...     ["none", "point"] * 6,
    ... )
    >>> PadModel(KindSettings()).fit(mine).predict([[0.7, 0.1]])
    array(['point'], dtype='<U5')
    """

    @takes_numbers
    def __init__(self, settings: Settings, *, saturation: float = TOP_COUNT) -> None:
        self.settings, self.saturation = settings, saturation
        self._fitted: tuple[PadReadings, Any] | None = None

    def fit(self, readings: PadReadings) -> Self:
        """Fit to labelled readings.

        Raises:
            InvalidInputError: If a channel is saturated, or the settings cannot be used with these
                labels.
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

        Raises:
            sklearn.exceptions.NotFittedError: If the model was not fitted.
            InvalidInputError: If there are more or fewer channels than were fitted, a voltage is
                not finite, or a channel is saturated.
        """
        readings, estimator = self._state()
        found: Labels = estimator.predict(self._checked(voltages, readings.channels))
        return found

    def _state(self) -> tuple[PadReadings, Any]:
        if self._fitted is None:
            raise NotFittedError("this PadModel is not fitted: call fit with labelled readings")
        return self._fitted

    def _checked(self, voltages: ArrayLike, channels: tuple[str, ...]) -> Floats:
        (given,) = floats(voltages=voltages)
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


FORMAT, VERSION = "softgrip pad model", 1
EXAMPLES = 32
"""Readings whose answers are kept."""
SAME = 1e-9
"""Relative difference of forces that is still the same: rounding of other processors."""
TASKS: dict[str, type[Settings]] = {"kind": KindSettings, "force": ForceSettings}


def save(model: PadModel, path: Path | str) -> None:
    """Write a fitted model.

    Raises:
        sklearn.exceptions.NotFittedError: If it is not fitted.
    """
    readings = model.readings
    task = next(name for name, kind in TASKS.items() if isinstance(model.settings, kind))
    record = {
        "format": FORMAT,
        "version": VERSION,
        "task": task,
        "settings": asdict(model.settings),
        "saturation": model.saturation,
        "channels": list(readings.channels),
        "voltages": readings.voltages.tolist(),
        "labels": readings.labels.tolist(),
        "groups": None if readings.groups is None else readings.groups.tolist(),
        "answers": model.predict(_examples(readings)).tolist(),
    }
    path_of(path).write_text(json.dumps(record) + "\n", encoding="utf-8")


def load(path: Path | str) -> PadModel:
    """Read a model and fit it anew.

    Raises:
        DataFileError: If the file is no such model, is of another version, holds what no model can
            be fitted to, or the model answers otherwise than when it was saved.
    """
    file = existing(path)
    try:
        record = json.loads(file.read_text(encoding="utf-8"))
        header = record["format"], record["version"]
    except (ValueError, KeyError, TypeError) as error:
        raise DataFileError(file, expected=f"a {FORMAT}", got=f"{error!r}") from None
    if header != (FORMAT, VERSION):
        raise DataFileError(file, expected=f"{FORMAT}, version {VERSION}", got=f"{header}")
    try:
        settings = TASKS[record["task"]](**record["settings"])
        readings = PadReadings(
            tuple(record["channels"]),
            np.array(record["voltages"]),
            np.array(record["labels"]),
            record.get("groups"),
        )
        model = PadModel(settings, saturation=record["saturation"]).fit(readings)
        answers = np.array(record["answers"])
    except (SoftgripError, ValueError, KeyError, TypeError) as error:
        raise DataFileError(file, expected="a model that can be fitted", got=f"{error}") from None
    found = model.predict(_examples(readings))
    same = (
        np.array_equal(found, answers)
        if found.dtype.kind == "U"
        else found.shape == answers.shape
        and answers.dtype.kind in "if"
        and np.allclose(found, answers, rtol=SAME, atol=0)
    )
    if not same:
        raise DataFileError(file, expected="the answers it was saved with", got="others")
    return model


def _examples(readings: PadReadings) -> Floats:
    """Return readings between those of the training, which a lazy model does not know by heart."""
    voltages = readings.voltages
    some = np.linspace(0, len(voltages) - 1, min(EXAMPLES, len(voltages))).astype(int)
    return np.asarray((voltages[some] + voltages[some[::-1]]) / 2)
