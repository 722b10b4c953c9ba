"""The step responses that are timed: fingers after Eq. (5.16), by the package and by SciPy."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from softgrip.dynamics.integrate import StepChoice, step_for
from softgrip.dynamics.ludwick import LudwickFinger, step_responses

SECONDS = 5.0
ALLOWED = 1e-6
"""Allowed error of an angle, rad."""


@dataclass(frozen=True)
class Batch:
    """Fingers that differ in all but mass, each pushed by a force of its own."""

    finger: LudwickFinger
    force: np.ndarray
    times: np.ndarray

    @property
    def runs(self) -> int:
        """Number of runs."""
        return self.force.size

    def take(self, runs: np.ndarray) -> "Batch":
        """Return some of the runs."""
        fields = (np.asarray(value)[runs] for value in vars(self.finger).values())
        return Batch(LudwickFinger(*fields), self.force[runs], self.times)


def batch(runs: int, *, samples: int = 5001) -> Batch:
    """Return fingers about that of Section 5.4, which settle at about 0.3 to 1.6 rad."""
    rng = np.random.default_rng(0)
    n = rng.uniform(1.5, 2.5, runs)
    stiffness = 8.18 / n * rng.uniform(0.8, 1.2, runs)
    finger = LudwickFinger(np.ones(runs), 4 * rng.uniform(0.8, 1.2, runs), stiffness, n)
    force = stiffness * rng.uniform(0.3, 1.6, runs) ** n
    return Batch(finger, force, np.linspace(0, SECONDS, samples))


def stream(given: Batch, step: float) -> Iterable[tuple[slice, np.ndarray]]:
    """Return the package's responses, a part of the runs at a time."""
    return step_responses(given.finger, given.force, given.times, step, runs=given.runs)


def run(given: Batch, step: float) -> None:
    """Make all responses, and keep none."""
    for _ in stream(given, step):
        pass


def responses(given: Batch, step: float) -> np.ndarray:
    """Return all responses, rad, shape (N, runs)."""
    return np.concatenate([angle.copy() for _, angle in stream(given, step)], axis=1)


def choose_step(given: Batch) -> StepChoice:
    """Return the longest step of 100 ms, 50 ms, ... that is good to `ALLOWED`."""
    return step_for(ALLOWED, lambda step: responses(given, step), first=0.1)


def plain(
    given: Batch, *, method: str = "RK45", rtol: float = 1e-6, atol: float = 1e-8
) -> np.ndarray:
    """Return the same responses from a loop over `solve_ivp`, shape (N, runs)."""
    angles = np.empty((given.times.size, given.runs))
    values = [np.asarray(value).tolist() for value in vars(given.finger).values()]
    for i, (m, c, k, n, force) in enumerate(zip(*values, given.force.tolist(), strict=True)):

        def law(_time, state, m=m, c=c, k=k, n=n, force=force):
            angle, rate = state
            return rate, (force - c * rate - k * angle * abs(angle) ** (n - 1)) / m

        found = solve_ivp(
            law, (0, SECONDS), (0, 0), method=method, rtol=rtol, atol=atol, t_eval=given.times
        )
        angles[:, i] = found.y[0]
    return angles
