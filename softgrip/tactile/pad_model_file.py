"""A fitted pad model as a file: its readings and settings as JSON, no code.

On loading it is fitted anew, and must say of a few readings what it said before: another version
of a library that answers otherwise is found out.
"""

import json
from dataclasses import asdict
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import DataFileError, SoftgripError
from softgrip.tactile.own_pad import PadReadings
from softgrip.tactile.pad_model import PadModel
from softgrip.tactile.pad_model_settings import ForceSettings, KindSettings, Settings

FORMAT, VERSION = "softgrip pad model", 1
EXAMPLES = 32
"""Readings whose answers are kept."""
SAME = 1e-9
"""Relative difference of forces that is still the same: rounding of other processors."""
TASKS: dict[str, type[Settings]] = {"kind": KindSettings, "force": ForceSettings}


def save(model: PadModel, path: Path | str) -> None:
    """Write a fitted model.

    Raises
    ------
    sklearn.exceptions.NotFittedError
        If it is not fitted.
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
        "answers": model.predict(_examples(readings)).tolist(),
    }
    Path(path).write_text(json.dumps(record) + "\n", encoding="utf-8")


def load(path: Path | str) -> PadModel:
    """Read a model and fit it anew.

    Raises
    ------
    DataFileError
        If the file is no such model, is of another version, holds what no model can be fitted
        to, or the model answers otherwise than when it was saved.
    """
    file = Path(path)
    if not file.is_file():
        raise DataFileError(file, expected="a file", got="none")
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
            tuple(record["channels"]), np.array(record["voltages"]), np.array(record["labels"])
        )
        model = PadModel(settings, saturation=record["saturation"]).fit(readings)
        answers = np.array(record["answers"])
    except (SoftgripError, ValueError, KeyError, TypeError) as error:
        raise DataFileError(file, expected="a model that can be fitted", got=f"{error}") from None
    found = model.predict(_examples(readings))
    same = (
        np.array_equal(found, answers)
        if found.dtype.kind == "U"
        else found.shape == answers.shape and np.allclose(found, answers, rtol=SAME, atol=0)
    )
    if not same:
        raise DataFileError(file, expected="the answers it was saved with", got="others")
    return model


def _examples(readings: PadReadings) -> Floats:
    """Return readings between those of the training, which a lazy model does not know by heart."""
    voltages = readings.voltages
    some = np.linspace(0, len(voltages) - 1, min(EXAMPLES, len(voltages))).astype(int)
    return np.asarray((voltages[some] + voltages[some[::-1]]) / 2)
