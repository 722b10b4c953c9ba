"""The linear model of the rig as its logs tell it: what the controllers of Chapter 4 know of it.

Nothing here knows the truth of the simulated rig; the same calls read the logs of a real one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from softgrip.dynamics.identify import Identified, identify
from softgrip.dynamics.second_order import SecondOrder
from softgrip.errors import DataFileError
from softgrip.logs.pump import check_start, even_push, pump_of, swept_volume
from softgrip.logs.reader import read_log
from softgrip.logs.repeated_steps import read_alike
from softgrip.provenance import data_file
from softgrip.pump.flow import flow
from softgrip.reads import remembered

STEP_LOGS = tuple(f"simulated/step-60-{run}.csv" for run in range(1, 8))
PUSH_LOG = "simulated/push-a.csv"
LOW_PRESSURE = 20e3
"""Gauge pressure, Pa, below which the capacity is taken: what a bend of 90 deg needs."""


@dataclass(frozen=True)
class IdentifiedModel:
    """Eq. (4.14) and (4.5) with their numbers.

    Attributes:
        finger: Natural frequency, damping ratio, gain.
        capacity: C_i at low pressure, m^3/Pa.
        pump_gain: ``A l / (2 pi C_i)``, Pa/s per rad/s.
    """

    finger: SecondOrder
    capacity: float
    pump_gain: float


def identify_finger(paths: Sequence[Path]) -> Identified:
    """Fit the finger to the mean of several logs of one step, measured pressure to measured angle.

    Args:
        paths: Logs that start at rest and at atmospheric pressure, with the same times; at least
            one.

    Raises:
        DataFileError: As of `read_alike`.
        InvalidInputError: If the logs do not determine the model; as of `identify`.
    """
    logs = read_alike(paths)
    mean = {name: np.mean([log[name] for log in logs], axis=0) for name in ("pressure", "angle")}
    return identify(
        logs[0]["time"], mean["pressure"], mean["angle"], initial_input=0.0, dead_time=0.0
    )


def identify_capacity(path: Path, *, below: float = LOW_PRESSURE) -> float:
    """Return the capacity C_i of Eq. (4.5), m^3/Pa, from the start of a push.

    It is the slope of the line through the origin from measured pressure to swept volume.

    Args:
        path: Log of a push from atmospheric pressure; its header tells `area` and `lead`.
        below: Gauge pressure at which to stop, Pa.

    Raises:
        DataFileError: If the header lacks the pump, the pressure does not rise, or gaps or the
            start of the log leave open what was swept.
    """
    log = read_log(path)
    swept = swept_volume(path, log, flow(log["command"], pump_of(path, log)))
    swept, pressure = even_push(path, log, swept, below)
    beyond = pressure > below
    end = int(np.argmax(beyond)) if beyond.any() else beyond.size
    pressure, swept = pressure[:end], swept[:end]
    if not (end >= 8 and swept @ pressure > 0):
        raise DataFileError(path, expected=f"a rise of pressure up to {below:g} Pa", got="none")
    check_start(path, swept, pressure)
    return float(swept @ swept / (swept @ pressure))


@remembered
def identified_model() -> IdentifiedModel:
    """Return the model of the simulated rig: seven steps to 60 deg and the default push."""
    finger = identify_finger([data_file(name).path for name in STEP_LOGS]).system
    path = data_file(PUSH_LOG).path
    capacity = identify_capacity(path)
    return IdentifiedModel(finger, capacity, pump_of(path, read_log(path)).displacement / capacity)
