"""The sampled loop: a controller, a limit and a delay around a plant, for a batch of runs."""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, read_only
from softgrip.control.pid import PERIOD
from softgrip.errors import InvalidInputError
from softgrip.units import REV

SPEED_LIMIT = 5 * REV
"""Largest motor speed, rad/s (Section 3.4)."""


class Plant(Protocol):
    """What a loop drives: a linear model, or the simulated grasp of the pad."""

    def advance(self, command: ArrayLike, duration: float) -> ArrayLike:
        """Hold the command for a time [s], then return the measurement [rad].

        Command and measurement are floats or of shape (runs,). A duration of 0 moves nothing and
        returns the first measurement.
        """
        ...


class Controller(Protocol):
    """A law of one angle; `rig_controller.Tracking` brings it to a rig."""

    def update(self, reference: ArrayLike, measurement: ArrayLike) -> ArrayLike:
        """Return the command for the next period, from reference and measurement [rad]."""
        ...


@dataclass(frozen=True)
class LoopResult:
    """The record of a loop, sample by sample.

    Attributes:
        time: s, shape (N,), from 0.
        reference: rad, shape (N,) or (runs, N).
        measured: rad, shape (N,) or (runs, N): the measurement at each time.
        command: Command unit, same shape: what the plant is given from each time on, after limit
            and delay.
    """

    time: Floats
    reference: Floats
    measured: Floats
    command: Floats


def run_loop(
    plant: Plant,
    controller: Controller,
    reference: Callable[[float], ArrayLike] | ArrayLike,
    *,
    duration: float,
    period: float = PERIOD,
    limit: float = np.inf,
    delay_samples: int = 0,
) -> LoopResult:
    """Run a controller on a plant.

    Args:
        plant: The plant, at rest or wherever it is.
        controller: The controller; its own period must be the loop's.
        reference: rad: a function of time [s], a number, or an array of shape (N,) or (runs, N)
            with ``N = round(duration / period) + 1``.
        duration: s, >= one period.
        period: Time between samples, s, > 0.
        limit: The command is cut to +-limit on its way to the plant, as a motor does. A controller
            that does not know of the same limit winds up against it.
        delay_samples: Periods by which the command comes late, >= 0; until the first comes, the
            plant gets 0.

    Raises:
        InvalidInputError: If an argument is outside its range, or the reference has another length.

    >>> import control
    >>> from softgrip.control.pid import PID, Gains
    >>> from softgrip.control.state_space_plant import StateSpacePlant
    >>> plant = StateSpacePlant(control.ss(0, 1, 1, 0))
    >>> result = run_loop(plant, PID(Gains(kp=2.0)), 1.0, duration=3.0, limit=0.5)
    >>> float(result.command[0]), float(result.measured[-1].round(2))
    (0.5, 0.99)
    """
    check_positive(duration=duration, period=period, limit=1.0 if np.isinf(limit) else limit)
    if delay_samples < 0 or duration < period:
        raise InvalidInputError(
            "delay_samples, duration",
            expected=">= 0, and at least one period",
            got=(delay_samples, duration),
        )
    count = round(duration / period) + 1
    time = period * np.arange(count)
    wanted = (
        np.stack([np.asarray(reference(float(t)), dtype=np.float64) for t in time], axis=-1)
        if callable(reference)
        else np.asarray(reference, dtype=np.float64)
    )
    wanted = np.full(count, wanted) if wanted.ndim == 0 else wanted
    if wanted.shape[-1] != count:
        raise InvalidInputError(
            "reference", expected=f"a last axis of {count} samples", got=wanted.shape
        )
    measured, commands = [], []
    measurement = np.asarray(plant.advance(0.0, 0.0), dtype=np.float64)
    late: deque[Floats] = deque([np.zeros(())] * delay_samples)
    for k in range(count):
        measured.append(measurement)
        command = np.asarray(controller.update(wanted[..., k], measurement), dtype=np.float64)
        late.append(np.minimum(np.maximum(command, -limit), limit))
        sent = late.popleft()
        commands.append(sent)
        measurement = np.asarray(plant.advance(sent, period), dtype=np.float64)
    shape = np.broadcast_shapes(np.shape(measurement), command.shape)
    return LoopResult(
        read_only(time), read_only(wanted), _record(measured, shape), _record(commands, shape)
    )


def _record(samples: list[Floats], shape: tuple[int, ...]) -> Floats:
    # A plant at rest may answer for all runs with one number until the first command.
    full = [y if y.shape == shape else np.broadcast_to(y, shape) for y in samples]
    return read_only(np.stack(full, axis=-1))
