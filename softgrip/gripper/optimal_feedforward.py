"""The best feedforward within the motor limit, by linear program: fingers together, and in time.

Held commands move the fingers linearly, so the least largest difference between them, under the
limit and with all of them settled by a given time, is a linear program: its optimum is the least
that any command sequence of that period can reach.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations
from typing import Any, final

import numpy as np
from scipy.optimize import linprog

from softgrip.arrays import Floats, check_positive, read_only
from softgrip.checks import check_fields
from softgrip.errors import InvalidInputError
from softgrip.gripper.gripper_batch import GripperBatch, Trial
from softgrip.gripper.monte_carlo import simulate
from softgrip.gripper.plant import Gripper
from softgrip.gripper.reach import project


@dataclass(frozen=True)
class OptimalFeedforward:
    """The command that keeps the fingers together best.

    Attributes:
        time: Start of each period, s, shape (N,).
        command: Unit of the input, shape (N,): of those that do so, the one whose changes add up to
            least.
        angles: rad at the end of each point, shape (fingers, points).
        settling: Time by which all fingers stay in the band, as asked for, s.
        worst_sync: Largest difference between two fingers at any point, as shares of their targets.
        gap: What the dual program's optimum falls short of it: 0 but for rounding proves the
            optimum.
    """

    time: Floats
    command: Floats
    angles: Floats
    settling: float
    worst_sync: float
    gap: float


@final
@dataclass(frozen=True)
class FeedforwardProgram:
    """The linear program: commands that keep the fingers together best, and settle them in time.

    Attributes:
        gripper: The fingers; the command is open loop, so what they are is taken as known.
        target: Angle of each finger, rad, a multiple of the velocity gains: one pump cannot hold
            others.
        limit: Largest absolute command, > 0.
        band: Half width as a share of each target, between 0 and 1.
        duration: s, longer than what is asked to settle; then the pump is at rest, and where the
            fingers end is in the band too.
        period: Time between commands, s, > 0.
        points: Points a period at which the fingers are looked at, >= 1. Between the 10 of a period
            of 100 ms they are up to 0.05 % farther apart, and leave the band by 0.0002 of the
            target.
        delays: By how much each finger answers late, s, whole numbers of points; none if empty.

    Raises:
        InvalidInputError: If a number is outside its range, or the target cannot be held.

    >>> from softgrip.gripper.plant import PRINTED
    >>> target = tuple(0.35 * PRINTED.velocity_gains)
    >>> found = FeedforwardProgram(PRINTED, target, limit=1.0).settled_by(2.0)
    >>> 0 < found.worst_sync < 0.05, abs(found.gap) < 1e-9
    (True, True)
    """

    gripper: Gripper
    target: tuple[float, ...]
    limit: float
    band: float = 0.02
    duration: float = 3.0
    period: float = 0.1
    points: int = 10
    delays: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        check_fields(self, other=("gripper", "target", "delays"))
        late = np.asarray(self.delays, dtype=np.float64) * self.points / self.period
        if late.size and (
            late.shape != (len(self.gripper.fingers),)
            or not (np.isfinite(late) & (late >= 0)).all()
            or np.abs(late - np.rint(late)).max() > 1e-6
        ):
            raise InvalidInputError(
                "delays",
                expected=f"one a finger, multiples of {self.period / self.points:g} s",
                got=self.delays,
            )
        if project(self.gripper, self.target).share > 1e-6:
            gains = self.gripper.velocity_gains
            raise InvalidInputError("target", expected=f"a multiple of {gains}", got=self.target)

    def settled_by(self, settling: float) -> OptimalFeedforward:
        """Return the best command with which every finger stays within the band from a time on.

        Args:
            settling: s, a multiple of the period, > 0 and below the duration.

        Raises:
            InvalidInputError: If it is none, or no command within the limit settles that early.
        """
        check_positive(settling=settling)
        first = round(settling / self.period)
        if not (first < self._pulse.periods and np.isclose(settling, first * self.period)):
            raise InvalidInputError(
                "settling",
                expected=f"a multiple of {self.period:g} s below {self.duration:g} s",
                got=settling,
            )
        if (found := self._solve(settling)) is None:
            raise InvalidInputError(
                "settling",
                expected=f"a time within reach of a limit of {self.limit:g}",
                got=settling,
            )
        return found

    def trade_off(self, latest: float = 2.0) -> Iterator[OptimalFeedforward]:
        """Yield the best command for each settling time up to a last one, s, below the duration.

        Yields:
            OptimalFeedforward: One a period; the first settles as early as any held command within
                the limit can. None if nothing settles by then.
        """
        times = self.period * np.arange(1, round(latest / self.period) + 1)
        found = (self._solve(float(time)) for time in times.round(9))
        yield from (best for best in found if best is not None)

    @cached_property
    def _pulse(self) -> Trial:
        first = (1.0, *[0.0] * (round(self.duration / self.period) - 1))
        step = self.period / self.points
        return Trial(self.target, self.duration, self.period, step, feedforward=first)

    @cached_property
    def _progress(self) -> Floats:
        """The share of its target that each finger covers, per unit of each command."""
        pulse = self._pulse
        found = simulate(GripperBatch.of(self.gripper), None, pulse, keep="trajectories").angles
        assert found is not None
        each = found[0, :, 1:] / np.array(self.target)[:, None]
        for own, delay in zip(each, self.delays, strict=False):
            if behind := round(delay * self.points / self.period):
                own[:] = np.concatenate([np.zeros(behind), own[:-behind]])
        late = np.zeros((*each.shape, pulse.periods))
        for k in range(pulse.periods):
            start = k * pulse.points_a_period
            late[:, start:, k] = each[:, : pulse.points - start]
        return late

    def _solve(self, settling: float) -> OptimalFeedforward | None:
        pulse, progress, target = self._pulse, self._progress, np.array(self.target)
        limit, band, gain = self.limit, self.band, self.gripper.velocity_gains[0]
        step = pulse.plant_step
        settled = step * np.arange(1, pulse.points + 1) > settling - step / 2
        apart = np.concatenate(
            [progress[i] - progress[j] for i, j in permutations(range(len(target)), 2)]
        )
        # The last row is where the fingers end once the pump is at rest.
        rest = np.full((1, pulse.periods), pulse.period * gain / target[0])
        there = np.concatenate([*progress[:, settled], rest])
        # Variables: commands, the difference to make small, the commands' changes, from 0 and to 0.
        n = pulse.periods
        change = np.eye(n + 1, n) - np.eye(n + 1, n, k=-1)
        own, none = -np.ones((len(apart), 1)), np.zeros((len(apart), n + 1))
        free, steps = (
            np.zeros((len(there), n + 2)),
            np.hstack([np.zeros((n + 1, 1)), -np.eye(n + 1)]),
        )
        A = np.block(
            [[apart, own, none], [there, free], [-there, free], [change, steps], [-change, steps]]
        )
        b = np.repeat(
            [0.0, 1 + band, band - 1, 0.0], [len(apart), len(there), len(there), 2 * len(change)]
        )
        low = np.repeat([-limit, 0.0], [n, n + 2])
        high = np.repeat([limit, np.inf], [n, n + 2])

        def solve(cost: Floats, high: Floats) -> Any:
            return linprog(cost, A, b, bounds=np.stack([low, high], axis=1), method="highs")

        found = solve(np.eye(2 * n + 2)[n], high)
        if found.status == 2:
            return None
        if found.status != 0:
            raise InvalidInputError("limit, band", expected="a solvable program", got=found.message)
        marginals = found.upper.marginals - found.lower.marginals
        dual = b @ found.ineqlin.marginals + limit * marginals[:n].sum()
        # Many commands are as good: of these the one that changes least, not an arbitrary corner.
        high[n] = found.fun * (1 + 1e-6) + 1e-9
        calm = solve(np.repeat([0.0, 1.0], n + 1), high)
        command = np.asarray((calm if calm.status == 0 else found).x[:n])
        return OptimalFeedforward(
            read_only(pulse.period * np.arange(n)),
            read_only(command),
            read_only((progress @ command) * target[:, None]),
            settling,
            float(found.fun),
            float(found.fun - dual),
        )
