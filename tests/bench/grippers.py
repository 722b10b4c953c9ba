"""Many grippers in the sampled loop, against python-control called for each pair and period."""

from collections.abc import Sequence

import numpy as np
from threadpoolctl import threadpool_limits

from softgrip.gripper.gripper_batch import Trial, draw_grippers
from softgrip.gripper.internal_model import (
    ControllerMatrices,
    InternalModelController,
    controller_matrices,
)
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.monte_carlo import Keep, Outcome, in_parts, joined, simulate
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.reach import project
from softgrip.gripper.shaping_filter import SLOW, filter_state_space
from tests.bench.entry import Entry, entry, interleaved, peak_memory, spread
from tests.bench.growth import growth_entry, listed
from tests.gripper.period_by_period import forced, gripper_of

TRIAL = Trial(tuple(project(PRINTED, [np.pi / 4] * 2).reached.tolist()), limit=3.0)
"""Within 3 the printed loop for 2/s is cut off, as a motor would."""
MEMORY = 64e6
WANTED, WANTED_KEPT, ALLOWED = 1000, 300, 1e-10


def loop() -> ControllerMatrices:
    """Return the printed controller for 2/s."""
    return controller_matrices(PRINTED, mean_inverse(PRINTED), filter_state_space(*SLOW))


def ours(pairs: int, keep: Keep = "metrics") -> Outcome | None:
    """Draw pairs, discretise and simulate them; trajectories are made, and dropped by the part."""
    parts = in_parts(draw_grippers(PRINTED, pairs, seed=1), loop(), TRIAL, keep, MEMORY)
    if keep == "metrics":
        return joined([found for _, found in parts])
    for _ in parts:
        pass
    return None


def baseline(pairs: int) -> np.ndarray:
    """Return the angles of the first pairs, a call of `forced_response` a pair and period."""
    batch = draw_grippers(PRINTED, pairs, seed=1)
    controller = InternalModelController(loop(), TRIAL.target, limit=TRIAL.limit)
    found = []
    for number in range(pairs):
        controller.reset()
        found.append(forced(gripper_of(batch, number), TRIAL, controller)[0])
    return np.stack(found)


def entries(
    *, pairs: int = 10_000, plain_pairs: int = 20, growth: Sequence[int] = (), repetitions: int = 5
) -> list[Entry]:
    """Return time, equality, growth and memory."""
    # One thread on both sides: the baseline's matrices are so small that more of them slow it down.
    with threadpool_limits(1):
        seconds = interleaved(
            lambda: ours(pairs),
            lambda: ours(pairs, "trajectories"),
            lambda: baseline(plain_pairs),
            repetitions=repetitions,
        )
    seconds[:, 2] *= pairs / plain_pairs
    metrics, kept, plain = (float(s) for s in np.median(seconds, axis=0))
    how = (
        f"{TRIAL.duration:g} s of the printed loop for 2/s at 100 ms, limit {TRIAL.limit:g},"
        f" {TRIAL.points:,} points of two fingers; drawing and discretisation included. Baseline:"
        f" python-control's forced_response for each pair and period, {plain_pairs} pairs timed"
        f" and scaled to {pairs:,}. Both on one thread. Medians of {repetitions} turns"
    )
    found = [
        entry(
            f"{pairs:,} gripper pairs, {name}", value, "s", plain,
            f"ratio >= {wanted:,}", plain / value >= wanted,
            f"{how} ({spread(seconds[:, column])}).",
        )
        for column, name, value, wanted in (
            (0, "metrics", metrics, WANTED),
            (1, "trajectories", kept, WANTED_KEPT),
        )
    ]  # fmt: skip
    return [
        *found,
        _equality(plain_pairs),
        _growth(growth or (pairs // 8, pairs // 2, pairs)),
        _memory(pairs),
    ]


def _equality(pairs: int) -> Entry:
    batch = draw_grippers(PRINTED, pairs, seed=1)
    found = simulate(batch, loop(), TRIAL, keep="trajectories")
    true = baseline(pairs)
    apart = np.ptp(true / np.array(TRIAL.target)[:, None], axis=1).max(axis=1)
    error = max(
        float(np.abs(found.angles - true).max()), float(np.abs(found.synchronization - apart).max())
    )
    return entry(
        "gripper pairs, largest difference from the baseline",
        error, "rad", None, f"< {ALLOWED:g}", error < ALLOWED,
        f"All points of {pairs} pairs, the same that were timed, and the largest difference between"
        " two fingers (a share).",
    )  # fmt: skip


def _growth(pairs: Sequence[int]) -> Entry:
    with threadpool_limits(1):
        works = [lambda count=count: ours(count) for count in pairs]
        seconds = np.median(interleaved(*works, repetitions=3), axis=0)
    note = f"Log-log fit of medians of 3 ({listed(pairs, seconds)})."
    return growth_entry("gripper pairs", pairs, seconds, note)


def _memory(pairs: int) -> Entry:
    peak = peak_memory(lambda: ours(pairs, "trajectories"))
    whole = 8e-6 * pairs * 2 * (TRIAL.points + 1)
    most = 2.5 * MEMORY / 1e6
    return entry(
        f"peak memory, trajectories of {pairs:,} gripper pairs",
        peak, "MB", whole, f"<= {most:g} MB", peak <= most,
        f"By tracemalloc. Baseline: the trajectories alone, if kept. A part takes"
        f" {MEMORY / 1e6:g} MB at most, and the part before is still held.",
    )  # fmt: skip
