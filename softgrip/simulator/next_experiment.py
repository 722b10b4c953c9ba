"""Which further experiment would tell most of what the logs of a rig did not.

Each candidate is put on the fitted rig. The slopes of what its sensors would feel, with the noise
that the logs have, say how much narrower the intervals would become.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ceil

import numpy as np

from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.simulator.fit_estimates import Estimate, Inferred, estimate
from softgrip.simulator.fit_problem import Problem
from softgrip.simulator.parameters import RigParameters

REST = 2.0
"""At the end of a candidate that moves slowly, s."""
WEIGHT = 0.2
"""Torque of the known weight, as a share of the largest that the air gave."""


@dataclass(frozen=True)
class Candidate:
    """An experiment in open loop: speeds that are held for a while each.

    Attributes:
        name: For its log.
        words: What to do.
        speeds, times: rad/s, and how long each is held, s.
        clamped, torque: As of `trial.Trial`.
    """

    name: str
    words: str
    speeds: tuple[float, ...]
    times: tuple[float, ...]
    clamped: bool = False
    torque: float = 0.0

    def periods(self, period: float) -> list[int]:
        """Return for how many periods each speed is held."""
        return [max(1, round(time / period)) for time in self.times]

    def commands(self, period: float) -> Floats:
        """Return the commands, one a period, rad/s."""
        return np.repeat(self.speeds, self.periods(period))


@dataclass(frozen=True)
class Expected:
    """What a candidate is expected to bring.

    Attributes:
        candidate: Which.
        estimates: What would be said of each parameter with it, on the fitted rig.
        told: Names of those that would be told, and are not without it.
        gain: Sum of the logarithms of the factors by which the intervals of those that are not
            told would shrink.
    """

    candidate: Candidate
    estimates: tuple[Estimate, ...]
    told: tuple[str, ...]
    gain: float


def candidates(found: Inferred) -> tuple[Candidate, ...]:
    """Return experiments that go no deeper into the syringe than the logs.

    Shut at the finger, it is pushed to no more than their pressure.

    Args:
        found: What the logs say.
    """
    trials, rig = found.problem.trials, found.rig
    period, advance = trials[0].period, rig.pump.advance
    deepest = min(max(one.deepest for one in trials), rig.pump.stroke)
    highest = max(float(one.measured[0].max()) for one in trials)
    speed = min(SPEED_LIMIT, rig.pump.speed_limit)

    def push(travel: float, seconds: float) -> tuple[float, float]:
        """Return the speed and the time of a push over a way, as long as wanted or as it takes."""
        time = period * ceil(max(seconds, travel / (speed * advance)) / period)
        return travel / (advance * time), time

    slow, quick = push(deepest, 20.0), push(deepest, 0.0)
    stair = push(deepest / 5, 0.0)
    clamped = push(min(deepest, _shut_travel(rig, highest)), 10.0)
    steps = (stair[0], 0.0) * 5 + (-stair[0], 0.0) * 5
    weight = WEIGHT * highest * max(one.torque_per_pressure for one in rig.fingers)
    return (
        Candidate("slow", "a slow push", (slow[0], 0.0), (slow[1], REST)),
        Candidate("step", "a fast step", (quick[0], 0.0), (quick[1], 6.0)),
        Candidate("hold", "a fast step, held for 60 s", (quick[0], 0.0), (quick[1], 60.0)),
        Candidate("staircase", "five steps in and five out", steps, (stair[1], REST) * 10),
        Candidate(
            "clamped", "a slow push with the tube shut at the finger, held for 20 s",
            (clamped[0], 0.0), (clamped[1], 20.0), clamped=True,
        ),
        Candidate(
            "weight", f"a slow push with a weight that bends each finger by {weight:.3g} N m more",
            (slow[0], 0.0), (slow[1], REST), torque=weight,
        ),
    )  # fmt: skip


def _shut_travel(rig: RigParameters, pressure: float) -> float:
    """Return the travel, m, that brings syringe and dead volume to a gauge pressure, Pa."""
    charge = float(rig.pump.syringe_volume + rig.gas.dead_volume)
    return float(
        charge * (1 - rig.gas.atmosphere / (rig.gas.atmosphere + pressure)) / rig.pump.area
    )


def expected(found: Inferred) -> Iterator[Expected]:
    """Yield what each candidate is expected to bring, best first."""
    problem, known = found.problem, np.array([one.told for one in found.estimates])
    before, results = np.diag(found.covariance), []
    for candidate in candidates(found):
        after = np.diag(_expect(found, candidate))
        rows = zip(problem.space, found.values, after**0.5, strict=True)
        then = [estimate(one, float(value), float(width)) for one, value, width in rows]
        new = tuple(one.name for one, was in zip(then, known, strict=True) if one.told and not was)
        gain = float(np.log(before / after)[~known].sum() / 2)
        results.append(Expected(candidate, tuple(then), new, gain))
    yield from sorted(results, key=lambda one: -one.gain)


def _expect(found: Inferred, candidate: Candidate) -> Floats:
    """Return the covariance with the candidate's log, on the fitted rig."""
    problem, trials = found.problem, found.problem.trials
    commands = candidate.commands(trials[0].period)
    believed = np.ones((trials[0].fingers + 1, len(commands)), dtype=bool)
    if candidate.clamped:
        believed[1:] = False
    trial = replace(
        trials[0],
        commands=commands,
        at=np.arange(float(len(commands))),
        measured=np.zeros(believed.shape),
        believed=believed,
        plunger=0.0,
        clamped=candidate.clamped,
        torque=candidate.torque,
    )
    # A channel that a log does not tell has infinite noise there.
    noise = np.quantile(problem.noise, 0.5, axis=0, method="lower")
    other = Problem(problem.base, (trial,), (noise,))
    point = np.zeros(other.size)
    point[: len(problem.space)] = found.point[: len(problem.space)]
    _, slopes = other.linear_trial(point, 0)
    size = len(problem.space)
    common, own = slopes[:, :size], slopes[:, size:]
    # What the new log's own run, start and zeros take of it.
    mixed, inner = common.T @ own, own.T @ own + np.eye(own.shape[1])
    brought = common.T @ common - mixed @ np.linalg.solve(inner, mixed.T)
    scale = np.outer(problem.deviation, problem.deviation)
    return np.asarray(np.linalg.inv(np.linalg.inv(found.covariance / scale) + brought) * scale)
