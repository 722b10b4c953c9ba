"""Designs within limits of weight and size: certified, against SLSQP from many starts."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from scipy.optimize import minimize

from softgrip.actuator.design import DIMENSIONS
from softgrip.actuator.front import KEPT, Question, answer, questions, sweep
from softgrip.actuator.limits import LimitedProblem, measures, ranges
from softgrip.actuator.limits_certificate import proposed_within
from softgrip.actuator.section import Section
from tests.bench.entry import Entry, entry, timed

MOST_SECONDS, CORES, LEAST_RATIO = 60.0, 2, 10.0
SAME = 1e-4
"""Part of the torque within which SLSQP counts as having reached ours."""


def _slacks(limited: LimitedProblem, x: np.ndarray) -> np.ndarray:
    """Return what is left of each limit, all at once: SLSQP asks for them by differences."""
    section = Section(*(x * 1e-3))
    if section.bottom <= section.wall:
        return np.full(12, section.bottom / section.wall - 1.0)
    values = {**measures(limited, section), "height": section.height}
    known = {**ranges(limited), "height": limited.problem.bounds.height}
    found = [
        sign * (values[name] / end - 1)
        for name, ends in known.items()
        for end, sign in zip(ends, (1, -1), strict=True)
        if 0 < end < np.inf
    ]
    return np.array(found + [1.0] * (12 - len(found)))


def _cost(limited: LimitedProblem, x: np.ndarray) -> float:
    section = Section(*(x * 1e-3))
    if section.bottom <= section.wall:
        return 0.0  # bends backwards: there is no torque that way
    return -float(measures(limited, section)["objective"])


def multi_start(question: Question, starts: int) -> float:
    """Return the best torque that SLSQP reaches from some starts, N m; nothing if none is."""
    limited, best = question.problem(), 0.0
    ends = 1e3 * np.array([getattr(limited.problem.bounds, name) for name in DIMENSIONS])
    rng = np.random.default_rng(0)
    for _ in range(starts):
        with np.errstate(all="ignore"):
            found = minimize(
                partial(_cost, limited), rng.uniform(*ends.T), method="SLSQP", bounds=ends,
                constraints={"type": "ineq", "fun": partial(_slacks, limited)},
                options={"ftol": 1e-9, "maxiter": 200},
            )  # fmt: skip
            if (_slacks(limited, found.x) >= -1e-6).all():
                best = max(best, -float(found.fun))
    return best


def _subset(points: int) -> list[Question]:
    """Return feasible questions from all over the front."""
    feasible = [row.question for row in KEPT.read() if row.answer.feasible]
    return [feasible[k] for k in np.linspace(0, len(feasible) - 1, points).astype(int)]


def _whole(asked: Sequence[Question]) -> float:
    with TemporaryDirectory() as folder:
        return timed(lambda: sweep(asked, Path(folder) / "front.jsonl", jobs=CORES))


def entries(*, points: int = 12, starts: int = 20, whole: int | None = None) -> list[Entry]:
    """Return the time of a point against the rival's, and that of the front."""
    some = _subset(points)
    for one in some:
        answer(one)  # builds the programs, once for each number of chambers
    best: list[float] = []
    ours, rivals, solved = [], [], []
    for one in some:  # in turns, so that a machine that slows down slows all
        ours.append(timed(lambda one=one: best.append(answer(one).torque)))
        rivals.append(timed(lambda one=one: best.append(multi_start(one, starts))))
        solved.append(timed(lambda one=one: proposed_within(one.problem())))
    reached = sum(
        rival >= own * (1 - SAME) for own, rival in zip(best[::2], best[1::2], strict=True)
    )
    asked = questions()[:whole]
    taken = _whole(asked)
    spread = [asked[k] for k in np.linspace(0, len(asked) - 1, points).astype(int)]
    loop = len(asked) * np.mean([timed(lambda one=one: multi_start(one, starts)) for one in spread])
    rival = sum(rivals) / points
    proved, plain = sum(ours) / points, sum(solved) / points
    said = (
        f"Mean of {points} feasible points from all over the front, in turns; SLSQP takes"
        f" derivatives by differences and all limits in one call, reaches our torque in {reached}"
        f" of {points}, and proves nothing."
    )
    return [
        entry(
            f"one point within limits, against SLSQP from {starts} starts", plain, "s", rival,
            f">= {LEAST_RATIO:g} times", rival / plain >= LEAST_RATIO,
            f"{said} Ours is the solver alone, from one start by exact derivatives: the section"
            " that the next row proves.",
        ),
        entry(
            "the same with its certificate", proved, "s", rival,
            f">= {LEAST_RATIO:g} times", rival / proved >= LEAST_RATIO,
            f"{said} Ours is solved and proved to be within 1e-5 of the best.",
        ),
        entry(
            f"front of {len(asked)} points, certified", taken, "s", float(loop),
            f"< {MOST_SECONDS:g}, {LEAST_RATIO:g} times",
            taken < MOST_SECONDS and bool(loop / taken >= LEAST_RATIO),
            f"On {CORES} processes with their start; infeasible points are proved to be so."
            f" Baseline: a loop of SLSQP from {starts} starts a point, by {points} points of all,"
            " feasible or not, on one process.",
        ),
    ]  # fmt: skip
