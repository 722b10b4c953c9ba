"""Many grippers in the sampled loop at once: settling, overshoot and synchronization of each."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, final

import numpy as np
from joblib import Parallel, delayed

from softgrip.arrays import Floats, chunks
from softgrip.errors import InvalidInputError
from softgrip.gripper.batch_loop import loop_states, metrics
from softgrip.gripper.gripper_batch import GripperBatch, Trial, draw_grippers
from softgrip.gripper.internal_model import ControllerMatrices
from softgrip.gripper.plant import Gripper
from softgrip.gripper.sampled_plant import held_motion

Keep = Literal["metrics", "trajectories"]

PART = 800
"""Most grippers that go through the loop at a time: their products are too small for the linear
algebra to start threads, which would cost more than it saves."""

BLOCK = 4e6
"""Bytes of trajectories that are worked on at a time: what a processor's cache holds."""


@final
@dataclass(frozen=True)
class Outcome:
    """What came of some grippers in one trial, in their order.

    Attributes:
        settling: As `step_metrics.settling_time` about each finger's own target, for each of the
            trial's bands: s, shape (bands, count, fingers).
        overshoot: As `step_metrics.overshoot`, share of the target, shape (count, fingers).
        synchronization: Largest difference between two fingers of a gripper at any time, each as
            the share of its own target that it has covered; shape (count,).
        peak_command: Largest absolute command after the limit, shape (count,).
        angles: rad, shape (count, fingers, points + 1) from time 0; None if not kept.
        commands: One a period, after limit and delay, shape (count, periods); None if not kept.
    """

    settling: Floats
    overshoot: Floats
    synchronization: Floats
    peak_command: Floats
    angles: Floats | None = None
    commands: Floats | None = None


def simulate(
    grippers: GripperBatch,
    controller: ControllerMatrices | None,
    trial: Trial,
    *,
    keep: Keep = "metrics",
    memory: float = 64e6,
) -> Outcome:
    """Run a trial on all grippers and return what came of each.

    Args:
        grippers, controller, trial, memory: As of `in_parts`.
        keep: Whether the trajectories are part of what is returned. They must then fit into
            `memory`.

    Raises:
        InvalidInputError: As `in_parts`, and if trajectories are to be kept that do not fit.
    """
    size = 8.0 * grippers.count * grippers.fingers * (trial.points + 1)
    if keep == "trajectories" and size > memory:
        raise InvalidInputError(
            "memory", expected=f">= {size:g} bytes for these trajectories, or in_parts", got=memory
        )
    return joined([found for _, found in in_parts(grippers, controller, trial, keep, memory)])


def joined(outcomes: list[Outcome]) -> Outcome:
    """Return the outcomes of several parts as one."""

    def join(name: str) -> Floats | None:
        values = [getattr(outcome, name) for outcome in outcomes]
        if values[0] is None:
            return None
        return np.concatenate(values, axis=1 if name == "settling" else 0)

    return Outcome(**{name: join(name) for name in Outcome.__dataclass_fields__})  # type: ignore[arg-type]


def in_parts(
    grippers: GripperBatch,
    controller: ControllerMatrices | None,
    trial: Trial,
    keep: Keep = "metrics",
    memory: float = 64e6,
) -> Iterator[tuple[slice, Outcome]]:
    """Run a trial on any number of grippers, in memory that does not grow with them.

    Args:
        grippers: The grippers, at rest at angle 0.
        controller: Of the trial's period. What it knows as sent is its command within the trial's
            limit; with a `B_sent` of zero it knows nothing. None for the trial's feedforward alone.
        trial: What they are put through.
        keep: Whether each part brings its trajectories.
        memory: About the largest memory that a part takes, bytes.

    Yields:
        part, outcome: The grippers of the part, and what came of them: the same in any part.

    Raises:
        InvalidInputError: If the controller has another form, or the target another number of
            fingers.
    """
    fingers = grippers.fingers
    if len(trial.target) != fingers:
        raise InvalidInputError("target", expected=f"{fingers} angles", got=trial.target)
    if controller is not None and (
        controller.D_measured.size != fingers or not np.isclose(controller.period, trial.period)
    ):
        raise InvalidInputError(
            "controller",
            expected=f"one for {fingers} fingers, sampled each {trial.period:g} s",
            got=(controller.D_measured.size, controller.period),
        )
    kept = trial.points if keep == "trajectories" else 0
    each = 8.0 * fingers * (kept + 8 * trial.periods)
    for part in chunks(grippers.count, each, limit=min(memory, PART * each)):
        yield part, _run(grippers.take(part), controller, trial, keep == "trajectories")


def _run(
    grippers: GripperBatch, controller: ControllerMatrices | None, trial: Trial, keep: bool
) -> Outcome:
    states = loop_states(grippers, controller, trial)
    commands = states[:, 0, :-1, 3]
    return Outcome(
        *metrics(grippers, states, trial),
        np.abs(commands).max(axis=1),
        _angles(grippers, states, trial) if keep else None,
        commands.copy() if keep else None,
    )


def _angles(grippers: GripperBatch, states: Floats, trial: Trial) -> Floats:
    count, fingers = grippers.count, grippers.fingers
    angles = np.zeros((count, fingers, trial.points + 1))
    for block in chunks(count, 8.0 * fingers * trial.points, limit=BLOCK):
        some = grippers.take(block)
        motion = held_motion(
            some.damping, some.stiffness, some.gain, trial.plant_step, trial.points_a_period
        )
        joined = states[block, :, :-1] @ motion.angle
        angles[block, :, 1:] = joined.reshape(*joined.shape[:2], -1)
    return angles


def study(
    nominal: Gripper,
    count: int,
    controller: ControllerMatrices | None,
    trial: Trial,
    *,
    seed: int = 0,
    parts: int = 1,
    jobs: int | None = None,
) -> Outcome:
    """Draw grippers, run a trial on each and return what came of them, in order.

    The parts go through `joblib.Parallel`: ``joblib.parallel_config`` says where they run, such as
    ``backend="dask"`` for a cluster. Each part draws its own grippers, so that nothing but numbers
    of grippers goes out and nothing but metrics comes back, whatever the parts.

    Args:
        nominal, count, seed: As of `draw_grippers`.
        controller, trial: As of `in_parts`.
        parts: 1 to `count`.
        jobs: As joblib's `n_jobs`: how many parts at a time; None leaves it to its configuration.

    Raises:
        InvalidInputError: If an argument is outside its range.

    >>> from softgrip.gripper.plant import PRINTED
    >>> trial = Trial((0.75, 0.85), duration=1.0, feedforward=(0.3,) * 10)
    >>> study(PRINTED, 6, None, trial, parts=3).overshoot.shape
    (6, 2)
    """
    if not 1 <= parts <= count:
        raise InvalidInputError("parts", expected=f"1 to {count}", got=parts)
    edges = np.linspace(0, count, parts + 1).round().astype(int).tolist()
    work = (
        delayed(_part)(nominal, first, last - first, controller, trial, seed)
        for first, last in pairwise(edges)
    )
    return joined(list(Parallel(n_jobs=jobs)(work)))


def _part(
    nominal: Gripper,
    first: int,
    count: int,
    controller: ControllerMatrices | None,
    trial: Trial,
    seed: int,
) -> Outcome:
    return simulate(draw_grippers(nominal, count, seed=seed, first=first), controller, trial)
