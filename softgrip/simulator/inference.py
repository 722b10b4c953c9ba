"""The simulated rig that logs ask for: the least squares of `fit_problem`, from several starts."""

from collections.abc import Callable, MutableMapping, Sequence
from dataclasses import replace
from functools import lru_cache, partial

import numpy as np
import scipy

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.simulator.fit_estimates import Inferred
from softgrip.simulator.fit_problem import DEVIATIONS, Problem
from softgrip.simulator.free_parameters import parameter_values
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.trial import Trial

OUTLIER = 4.0
"""Standard deviations, beyond which a residual pulls no more than at them."""
DRAWS, STARTS, ROUNDS = 40, 3, 6
"""Rigs drawn from the ranges, those of them that a search begins at, and its rounds there."""
MOST_ROUNDS = 60
SEED = 2024

Progress = Callable[[str], None]
"""Called with words on how far a fit is."""
Stages = MutableMapping[str, Floats]
"""Where each stage of a fit has got to, by its name; of one that is over, with `OVER` behind it."""
OVER = ", over"


def silent(words: str) -> None:
    """Tell nothing."""


def correlated(residuals: Floats) -> float:
    """Return to how many rows one independent row comes: 1 if they are white, never less.

    One and twice the sum of the autocorrelations, up to the first that chance would give.

    Args:
        residuals: Shape (rows,).

    >>> correlated(np.tile([1.0, -1.0], 50))
    1.0
    """
    centred = residuals - residuals.mean()
    size = 2 ** int(np.ceil(np.log2(2 * len(centred))))
    power = np.abs(np.fft.rfft(centred, size)) ** 2
    covariances = np.fft.irfft(power, size)[: len(centred) // 4]
    if not covariances[0] > 0:
        return 1.0
    found = covariances / covariances[0]
    chance = found < 2 / len(centred) ** 0.5
    end = int(np.argmax(chance)) if chance.any() else len(found)
    return float(1 + 2 * found[1:end].sum())


def infer(
    trials: Sequence[Trial],
    base: RigParameters,
    *,
    stages: Stages | None = None,
    progress: Progress = silent,
) -> Inferred:
    """Find the rig that logs ask for.

    Args:
        trials: One or more.
        base: The rest of the rig, and the spread from run to run; it is one of the starts.
        stages: What an interrupted fit of the same logs left there, to go on with; it is kept up
            to date.
        progress: Told of each round.

    Raises:
        InvalidInputError: If there is no log, or one has other fingers than the rig.
    """
    if not trials or {one.fingers for one in trials} != {len(base.fingers)}:
        raise InvalidInputError(
            "trials",
            expected=f"logs of {len(base.fingers)} finger(s)",
            got=[one.fingers for one in trials],
        )
    problem = Problem(base, tuple(trials), tuple(one.noise for one in trials))
    seek = partial(_least, stages={} if stages is None else stages, progress=progress)
    point = seek(problem, _search(problem, seek), "fit")
    misfit, alike = _left_over(problem, point)
    real = (
        np.maximum(one.noise * np.nan_to_num(size, nan=1.0) * np.sqrt(rows), one.rounding)
        for one, size, rows in zip(trials, misfit, alike, strict=True)
    )
    problem = replace(problem, noise=tuple(real))
    point = seek(problem, point, "fit with the real noise")
    _, slopes = problem.linear(point)
    count = len(problem.space)
    known = np.linalg.inv(slopes.T @ slopes)[:count, :count]
    covariance: Floats = known * np.outer(problem.deviation, problem.deviation)
    return Inferred(problem, point, covariance, tuple(misfit), tuple(alike))


def _search(problem: Problem, seek: Callable[..., Floats]) -> Floats:
    """Return the best of several starts after some rounds."""
    count = len(problem.space)
    drawn = np.zeros((DRAWS, problem.size))
    drawn[1:, :count] = np.random.default_rng(SEED).uniform(-1, 1, (DRAWS - 1, count))
    given = parameter_values(problem.base)
    known = problem.on_scale(np.array([given[one.name] for one in problem.space]))
    drawn[0, :count] = (known - problem.middle) / problem.deviation
    drawn = np.clip(drawn, -DEVIATIONS, DEVIATIONS)
    costs = np.zeros(DRAWS)
    for trial, noise in zip(problem.trials, problem.noise, strict=True):
        found = problem.predict(trial, problem.values(drawn), np.zeros(DRAWS))
        off = (found - trial.measured[..., None]) / noise[:, None, None]
        costs += np.minimum(np.abs(off[trial.believed]), 1e3).sum(axis=0)
    best: tuple[float, Floats] = (np.inf, drawn[0])
    for k, start in enumerate(np.argsort(costs, kind="stable")[:STARTS]):
        point = seek(problem, drawn[start], f"start {k + 1} of {STARTS}", rounds=ROUNDS)
        best = min(best, (_cost(problem.linear(point)[0]), point), key=lambda one: one[0])
    return best[1]


def _cost(residuals: Floats) -> float:
    size = np.abs(residuals)
    return float(np.where(size < OUTLIER, size**2 / 2, OUTLIER * size - OUTLIER**2 / 2).sum())


def _least(
    problem: Problem,
    point: Floats,
    name: str,
    *,
    stages: Stages,
    progress: Progress,
    rounds: int = MOST_ROUNDS,
) -> Floats:
    """Return the point of least squares, sought from a point on for so many rounds at most."""
    if name + OVER in stages:
        return stages[name + OVER]
    limit = np.full(problem.size, np.inf)
    limit[: len(problem.space)] = DEVIATIONS  # the declared ranges
    linear = lru_cache(maxsize=1)(lambda at: problem.linear(np.frombuffer(at)))
    rounds_done = 0

    def slopes(at: Floats) -> Floats:
        nonlocal rounds_done
        rounds_done += 1
        stages[name] = at.copy()
        progress(f"{name}, round {rounds_done}")
        return linear(at.tobytes())[1]

    found = scipy.optimize.least_squares(
        lambda at: linear(at.tobytes())[0],
        np.clip(stages.get(name, point), -limit + 1e-9, limit - 1e-9),
        slopes,
        bounds=(-limit, limit),
        loss="huber",
        f_scale=OUTLIER,
        ftol=1e-6,
        xtol=1e-5,
        gtol=None,
        max_nfev=rounds,
    )
    stages[name + OVER] = np.asarray(found.x)
    return stages[name + OVER]


def _left_over(problem: Problem, point: Floats) -> tuple[list[Floats], list[Floats]]:
    """Return the size of each log's residuals and to how many rows one comes, by channels."""
    residuals, row = problem.linear(point)[0], 0
    misfit, alike = [], []
    for trial in problem.trials:
        size, rows = np.full(len(trial.measured), np.nan), np.ones(len(trial.measured))
        for k, good in enumerate(trial.believed):
            if good.any():
                own = np.clip(residuals[row : row + good.sum()], -OUTLIER, OUTLIER)
                row += int(good.sum())
                size[k], rows[k] = np.sqrt(np.mean(own**2)), correlated(own)
        misfit.append(size)
        alike.append(rows)
    return misfit, alike
