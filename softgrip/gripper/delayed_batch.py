"""Many rigs and runs of fingers that answer late, in the sampled loop at once, and their measures.

Arrays have the axes rigs, fingers, runs, then time: a rig has one law and delays of its own, its
runs differ by what no law knows, spread and noise. The fingers move exactly as `sampled_plant` has
it, whatever the delay: what is late is the angle that is seen.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, final

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats, check_positive
from softgrip.errors import InvalidInputError
from softgrip.gripper.box_program import BoxPrograms
from softgrip.gripper.gripper_batch import GripperBatch
from softgrip.gripper.internal_model import PERIOD, ControllerMatrices
from softgrip.gripper.predictive import PredictiveLaw
from softgrip.gripper.sampled_plant import held_motion

POINTS = 4
"""At which fingers are looked at in a period: each 25 ms of the printed one."""
BAND = 0.05
"""Half width of the band about a finger's own end in which it counts as settled, a share of it."""
END = 0.5
"""s: the end of a record whose mean is where a finger ends."""


class BatchLaw(Protocol):
    """A law of some rigs, from their first update on."""

    def update(self, angles: Floats) -> Floats:
        """Return commands, shape (rigs, runs), from angles, rad, (rigs, runs, fingers)."""
        ...


@final
class LinearLaws:
    """A linear law of each rig; all have as many states.

    Args:
        laws: One a rig.
        targets: What its target is, shape (rigs, targets).
        limit: Up to which a law knows of the motor's limit; infinite for one that does not.
    """

    def __init__(
        self, laws: Sequence[ControllerMatrices], targets: Floats, limit: float = np.inf
    ) -> None:
        axes = {"A": 2, "B_measured": 2, "B_target": 2}

        def stacked(name: str) -> Floats:
            # A law of one run may have an axis of runs.
            each = [np.asarray(getattr(one, name)) for one in laws]
            return np.stack([one.reshape(one.shape[-axes.get(name, 1) :]) for one in each])

        self._A = stacked("A").swapaxes(-1, -2)
        self._B = stacked("B_measured").swapaxes(-1, -2)
        self._sent = stacked("B_sent")[:, None]
        self._C, self._D = stacked("C")[..., None], stacked("D_measured")[..., None]
        goal = targets[..., None]
        self._drive = (stacked("B_target") @ goal).swapaxes(-1, -2)
        self._ahead = stacked("D_target")[:, None] @ goal
        self._limit = limit
        self._state: Floats = np.zeros((len(laws), 1, self._A.shape[-1]))

    def update(self, angles: Floats) -> Floats:
        """Return commands, shape (rigs, runs)."""
        command = (self._state @ self._C + angles @ self._D + self._ahead)[..., 0]
        sent = np.clip(command, -self._limit, self._limit)
        self._state = self._state @ self._A + angles @ self._B + self._drive
        self._state += sent[..., None] * self._sent
        return sent


@final
class PredictiveLaws:
    """A predictive law of each rig, of `predictive.predictive_law`; all of one size and limit.

    The same as a `PredictiveController` each.
    """

    def __init__(self, laws: Sequence[PredictiveLaw]) -> None:
        def rows(arrays: Sequence[Floats]) -> Floats:
            return np.stack(arrays).swapaxes(-1, -2)

        self._A, self._C = rows([one.model.A for one in laws]), rows([one.model.C for one in laws])
        self._B = np.stack([one.model.B for one in laws])[:, None]
        self._correct = rows([one.correct for one in laws])
        self._by_state = rows([one.by_state for one in laws])
        self._constant = np.stack([one.constant for one in laws])[:, None]
        self._programs = BoxPrograms.of(np.stack([one.H for one in laws]))
        self._limit = laws[0].limit
        self._predicted: Floats = np.zeros((len(laws), 1, self._A.shape[-1]))
        self._start: tuple[Floats, Floats] | None = None

    def update(self, angles: Floats) -> Floats:
        """Return commands, shape (rigs, runs)."""
        now = self._predicted + (angles - self._predicted @ self._C) @ self._correct
        self._start = self._programs.solve(now @ self._by_state + self._constant, self._start)
        command = self._limit * self._start[0][..., 0]
        self._predicted = now @ self._A + command[..., None] * self._B
        return command


@final
class Sequences:
    """Commands that look at nothing, of each rig, shape (rigs, periods), then rest."""

    def __init__(self, commands: Floats) -> None:
        self._commands, self._next = commands, 0

    def update(self, angles: Floats) -> Floats:
        """Return commands, shape (rigs, runs)."""
        k, self._next = self._next, self._next + 1
        now = self._commands[:, k] if k < self._commands.shape[1] else np.zeros(len(angles))
        return np.broadcast_to(now[:, None], angles.shape[:2])


@dataclass(frozen=True)
class LateMotion:
    """Runs of some rigs.

    Attributes:
        time: s, shape (N,), some points a period.
        angles: The true ones, late as they are, rad, shape (rigs, fingers, runs, N).
        commands: What the motor did from each period on, shape (rigs, runs, periods).
        period: s.
    """

    time: Floats
    angles: Floats
    commands: Floats
    period: float


def run_late(
    fingers: Sequence[GripperBatch],
    delays: Floats,
    law: BatchLaw,
    noise: Floats,
    *,
    limit: float,
    period: float = PERIOD,
    points: int = POINTS,
) -> LateMotion:
    """Run laws on rigs at rest.

    Args:
        fingers: Of each rig, as they are in each run: equally many runs and fingers.
        delays: s, shape (rigs, fingers), whole numbers of ``period / points``.
        law: Of the rigs.
        noise: Of what is measured as each period begins, rad, shape (rigs, fingers, runs, periods).
        limit: The motor's, > 0.
        period: s, > 0.
        points: At which fingers are looked at in a period, >= 1.

    Raises:
        InvalidInputError: If shapes do not fit, or a delay is none of these.
    """
    check_positive(limit=limit, period=period, points=points)
    shape = (len(fingers), fingers[0].fingers, fingers[0].count)
    late = delays * points / period
    if noise.shape[:3] != shape or delays.shape != shape[:2]:
        raise InvalidInputError(
            "noise, delays", expected=f"shapes {(*shape, 'periods')} and {shape[:2]}",
            got=(noise.shape, delays.shape),
        )  # fmt: skip
    if not ((late >= 0).all() and np.abs(late - np.rint(late)).max() < 1e-6):
        raise InvalidInputError("delays", expected=f"multiples of {period / points:g} s >= 0",
                                got=delays)  # fmt: skip
    behind: NDArray[np.int64] = np.rint(late).astype(np.int64)
    damping, stiffness, gain = (
        np.stack([getattr(one, name).T for one in fingers])
        for name in ("damping", "stiffness", "gain")
    )
    motion = held_motion(damping, stiffness, gain, period / points, points)
    periods = noise.shape[-1]
    angles = np.zeros((*shape, periods * points + 1))
    commands = np.zeros((shape[0], shape[2], periods))
    state = np.zeros((*shape, 4))
    rig, finger = np.indices(shape[:2])
    for k in range(periods):
        seen = k * points - behind
        measured = angles[rig, finger, :, np.maximum(seen, 0)] + noise[..., k]
        sent = np.clip(law.update(measured.swapaxes(1, 2)), -limit, limit)
        commands[..., k] = sent
        state[..., 3] = sent[:, None]
        moved = np.einsum("rfsi,rfsip->rfsp", state, motion.angle)
        angles[..., k * points + 1 : (k + 1) * points + 1] = moved
        state[..., 1] = np.einsum("rfsi,rfsi->rfs", state, motion.rate)
        state[..., 0] = moved[..., -1]
        state[..., 2] += period * sent[:, None]
    for r, f in np.ndindex(shape[:2]):
        if steps := int(behind[r, f]):
            angles[r, f, :, steps:] = angles[r, f, :, :-steps].copy()
            angles[r, f, :, :steps] = 0.0
    time = period / points * np.arange(periods * points + 1)
    return LateMotion(time, angles, commands, period)


@dataclass(frozen=True)
class LateMeasures:
    """What came of runs, each of shape (rigs, runs).

    Attributes:
        settling: s after which all fingers stay within `BAND` about their own ends; infinite where
            that begins within the last `END` only.
        apart: Largest difference of the fingers on the way, as `synchronization_error`, rad.
        missed: The mean of the fingers' distances from their targets, as shares, added up over
            time, s: how badly the target is tracked.
        error: Largest distance of an end from its target, as a share of it.
        travel: Of the motor, there and back, rad.
    """

    settling: Floats
    apart: Floats
    missed: Floats
    error: Floats
    travel: Floats


def late_measures(motion: LateMotion, targets: Floats) -> LateMeasures:
    """Judge runs by targets, rad, shape (rigs, fingers)."""
    shares = motion.angles / targets[..., None, None]
    step = motion.time[1]
    last = round(END / step)
    ends = shares[..., -last:].mean(axis=-1)
    out = np.abs(shares - ends[..., None]) > BAND * np.abs(ends)[..., None]
    count = shares.shape[-1]
    after = count - np.argmax(out[..., ::-1], axis=-1)
    after = np.where(out.any(axis=-1), after, 0).max(axis=1)
    settling = np.where(after > count - last, np.inf, after * step)
    mean = np.abs(targets.mean(axis=1))[:, None]
    return LateMeasures(
        settling,
        np.ptp(shares, axis=1).max(axis=-1) * mean,
        np.abs(shares - 1).mean(axis=1).sum(axis=-1) * step,
        np.abs(ends - 1).max(axis=1),
        motion.period * np.abs(motion.commands).sum(axis=-1),
    )
