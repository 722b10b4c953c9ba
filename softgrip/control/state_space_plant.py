"""A linear plant that a sampled loop can drive: exact between samples, with a sensor's faults."""

from typing import final

import control
import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError


@final
class StateSpacePlant:
    """A state space with a held command, for one run or a batch of runs.

    Args:
        system: One input, one output, continuous, no direct feedthrough.
        initial: State at the start, shape (n,) or (n, runs); rest if None.
        quantum: Step of the measurement, rad, >= 0: 0 for none.
        noise: Standard deviation of the measurement before it is quantised, rad, >= 0.
        seed: Of the noise.

    Raises:
        InvalidInputError: If the system has another form or a number is negative.

    >>> plant = StateSpacePlant(control.ss(0, 1, 1, 0), quantum=0.25)
    >>> float(plant.advance(1.0, 0.6)), plant.state.round(6).tolist()
    (0.5, [0.6])
    """

    def __init__(
        self,
        system: control.StateSpace,
        *,
        initial: ArrayLike | None = None,
        quantum: float = 0.0,
        noise: float = 0.0,
        seed: int = 0,
    ) -> None:
        if system.ninputs != 1 or system.noutputs != 1 or system.dt or np.any(system.D):
            raise InvalidInputError(
                "system",
                expected="a continuous state space, one input, one output, D = 0",
                got=(system.ninputs, system.noutputs, system.dt, system.D),
            )
        if not (quantum >= 0 and noise >= 0):
            raise InvalidInputError("quantum, noise", expected="numbers >= 0", got=(quantum, noise))
        self.system, self.quantum, self.noise = system, quantum, noise
        self.state: Floats = (
            np.zeros(system.nstates) if initial is None else np.array(initial, dtype=np.float64)
        )
        self._random = np.random.default_rng(seed)
        self._steps: dict[float, tuple[Floats, Floats]] = {}

    def advance(self, command: ArrayLike, duration: float) -> Floats:
        """Hold the command for a time [s], then return the measurement, shape () or (runs,)."""
        step, drive = self._step(duration)
        u = np.asarray(command, dtype=np.float64)
        moved = step @ self.state
        if u.ndim or moved.ndim > 1:  # a batch: of commands, of states, or of both
            moved, drive = moved.reshape(len(drive), -1), drive[:, None]
        self.state = moved + drive * u
        y = self.system.C[0] @ self.state
        if self.noise:
            y = y + self._random.normal(0, self.noise, np.shape(y))
        if self.quantum:
            y = self.quantum * np.round(y / self.quantum)
        return np.asarray(y)

    def _step(self, duration: float) -> tuple[Floats, Floats]:
        if duration not in self._steps:
            n = self.system.nstates
            joined = np.zeros((n + 1, n + 1))
            joined[:n, :n], joined[:n, n:] = self.system.A, self.system.B
            whole = expm(joined * duration)
            self._steps[duration] = whole[:n, :n], whole[:n, n]
        return self._steps[duration]


def pulse_response(system: control.StateSpace, period: float, samples: int) -> Floats:
    """Return the output at the end of each period after a command of 1 held for the first, (N,).

    Args:
        system: As of `StateSpacePlant`.
        period: s, > 0.
        samples: N, >= 1.

    >>> pulse_response(control.ss(0, 1, 1, 0), 0.5, 3).tolist()
    [0.5, 0.5, 0.5]
    """
    plant = StateSpacePlant(system)
    return np.array([float(plant.advance(float(k == 0), period)) for k in range(samples)])
