"""All methods on the rigs of the ensemble, for many delays: one motor limit, one chance for all.

``python -m book.beyond.delay.sweep`` writes ``data/delay/sweep.csv``. The work goes in parts of a
case and some rigs through `joblib.Parallel`, so that ``joblib.parallel_config`` says where they
run, such as ``backend="dask"``. Each part is kept in a folder as soon as it is done: a run that was
cut, or whose worker was killed, goes on from there.
"""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from pathlib import Path
from typing import Literal

import numpy as np
from joblib import Parallel, delayed

from book.beyond.delay.methods import KNOW_DELAY, METHODS, known_targets
from book.beyond.delay.rigs import RigRow, real_fingers, rigs, sensor_noise
from softgrip.arrays import Floats, chunks
from softgrip.control.loop import SPEED_LIMIT
from softgrip.gripper.delayed_batch import late_measures, run_late
from softgrip.gripper.delayed_plant import DelayedGripper
from softgrip.gripper.internal_model import PERIOD
from softgrip.kept import Kept
from softgrip.simulator.gripper_steps import OPEN_LOOP_DURATION
from softgrip.units import DEG, REV

DELAYS = (0, 50, 100, 150, 200, 300)
"""ms."""
FINGERS = (2, 3, 4, 5)
RUNS = 25
"""Of each rig, with noise and spread of their own: thousands of seeds in all, those of all methods.
What rigs differ in is far more than what is left of chance in the mean of so many."""
SEED = 2024
WRONG = (-30, 30)
"""By how many per cent a delay is taken to be another than it is."""
APART, GRID = 0.25, 0.025
"""Where delays are the fingers' own: the largest share by which one differs, and the grid they are
on, s."""
RIGS = 16
"""In a part."""
SPENT = 48
"""Rigs, the first of the ensemble, on which weights were chosen: none of them is compared on."""
REFERENCE = "printed, 2/s"
"""What a gain is over: the better of the two printed loops."""
RESAMPLES = 2000

Kind = Literal["common", "own"]
MEASURES = ("settling", "settled", "apart", "missed", "error", "travel")
"""Of a rig: median s, share of runs, then means: deg, s, share, rev. What did not settle counts as
the length of the record."""


@dataclass(frozen=True)
class Case:
    """What rigs and laws are put through.

    Attributes:
        kind: Whether all fingers have one delay, or each its own about it.
        fingers: How many.
        delay: ms.
        wrong: By how many per cent the laws take the delay to be longer than it is.
    """

    kind: Kind
    fingers: int
    delay: int
    wrong: int = 0

    @property
    def methods(self) -> tuple[str, ...]:
        """Which are compared: a wrong delay concerns those alone whose model has one."""
        return KNOW_DELAY if self.wrong else tuple(METHODS)

    @property
    def name(self) -> str:
        """Of its files."""
        return f"{self.kind}-{self.fingers}-{self.delay}-{self.wrong}"


def cases() -> tuple[Case, ...]:
    """Return all cases."""
    common = [Case("common", n, d) for n, d in product(FINGERS, DELAYS)]
    own = [Case("own", 2, d) for d in DELAYS[1:]]
    wrong = [Case("common", 2, d, off) for d, off in product(DELAYS[1:], WRONG)]
    return (*common, *own, *wrong)


def delays_of(case: Case, row: RigRow) -> Floats:
    """Return the delays of a rig's fingers, s, shape (fingers,)."""
    if case.kind == "common":
        return np.full(case.fingers, case.delay / 1000)
    chance = np.random.default_rng((SEED, 2, row.rig)).uniform(-APART, APART, max(FINGERS))
    own = case.delay / 1000 * (1 + chance[: case.fingers])
    return np.asarray(np.rint(own / GRID) * GRID)


def measured(case: Case, rows: Sequence[RigRow], *, runs: int = RUNS) -> Floats:
    """Run a case on some rigs.

    Returns:
        ndarray: Shape (methods, rigs, measures), those of `Case.methods` and `MEASURES`.
    """
    late = np.stack([delays_of(case, row) for row in rows])
    known = [
        DelayedGripper(row.gripper(case.fingers), tuple(own.tolist())).scaled(1 + case.wrong / 100)
        for row, own in zip(rows, late, strict=True)
    ]
    targets = known_targets(known)
    real = [real_fingers(row, case.fingers, runs=runs, seed=SEED) for row in rows]
    periods = round(OPEN_LOOP_DURATION / PERIOD)
    noise = np.stack(
        [sensor_noise(row, case.fingers, periods, runs=runs, seed=SEED) for row in rows]
    )
    found = []
    for name in case.methods:
        law = METHODS[name](known, targets)
        one = late_measures(run_late(real, late, law, noise, limit=SPEED_LIMIT), targets)
        settling = np.minimum(one.settling, OPEN_LOOP_DURATION)
        found.append(
            np.stack(
                [
                    np.median(settling, axis=1),
                    np.isfinite(one.settling).mean(axis=1),
                    one.apart.mean(axis=1) / DEG,
                    one.missed.mean(axis=1),
                    one.error.mean(axis=1),
                    one.travel.mean(axis=1) / REV,
                ],
                axis=1,
            )
        )
    return np.stack(found)


def part_of(case: Case, rows: Sequence[RigRow], folder: Path | None, runs: int) -> Floats:
    """Return `measured` of a part: what a folder keeps of it, or made and kept there."""
    file = None if folder is None else folder / f"{case.name}-{rows[0].rig}-{len(rows)}-{runs}.npy"
    if file is not None and file.is_file():
        return np.asarray(np.load(file))
    found = measured(case, rows, runs=runs)
    if file is not None:
        # Whole or not at all: a killed worker leaves no half of a file by this name.
        partial_file = file.with_suffix(".part.npy")
        np.save(partial_file, found)
        partial_file.replace(file)
    return found


def swept(
    which: Sequence[Case],
    rows: Sequence[RigRow],
    *,
    folder: Path | None = None,
    jobs: int | None = None,
    runs: int = RUNS,
    at_a_time: int = RIGS,
) -> dict[Case, Floats]:
    """Run cases on rigs, part by part.

    Args:
        which, rows, runs: What.
        folder: Where parts are kept, which all workers share; None for nowhere.
        jobs: As joblib's `n_jobs`; None leaves it to its configuration.
        at_a_time: Rigs in a part.

    Returns:
        dict: Of each case, shape (methods, rigs, measures).
    """
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    parts = list(chunks(len(rows), 1.0, limit=at_a_time))
    # All cases of the same rigs one after the other: what one process knows of them serves again.
    work = (
        delayed(part_of)(case, rows[part], folder, runs) for part, case in product(parts, which)
    )
    done = list(Parallel(n_jobs=jobs)(work))
    return {case: np.concatenate(done[k :: len(which)], axis=1) for k, case in enumerate(which)}


@dataclass(frozen=True)
class Cell:
    """A measure of a method in a case, over the rigs, with 95 % intervals.

    Attributes:
        kind, fingers, delay, wrong: As of `Case`.
        method: One of `METHODS`.
        measure: One of `MEASURES`.
        value, low, high: Mean over the rigs, of settling the median.
        gain, gain_low, gain_high: By how much it is less than with `REFERENCE` on the same rigs.
    """

    kind: str
    fingers: int
    delay: int
    wrong: int
    method: str
    measure: str
    value: float
    low: float
    high: float
    gain: float
    gain_low: float
    gain_high: float


def interval(values: Floats, middle: Literal["mean", "median"]) -> tuple[float, float, float]:
    """Return the middle over rigs and its 95 % percentile bootstrap interval, rigs drawn anew."""
    drawn = np.random.default_rng(0).integers(values.size, size=(RESAMPLES, values.size))
    take = np.mean if middle == "mean" else np.median
    low, high = np.percentile(take(values[drawn], axis=1), [2.5, 97.5])
    return float(take(values)), float(low), float(high)


def cells(found: dict[Case, Floats]) -> Iterator[Cell]:
    """Put what rigs gave into words: each measure with its interval, and the gain."""
    for case, table in found.items():
        right = replace(case, wrong=0)
        reference = found[right][right.methods.index(REFERENCE)]
        for method, own in zip(case.methods, table, strict=True):
            for k, measure in enumerate(MEASURES):
                middle: Literal["mean", "median"] = "median" if measure == "settling" else "mean"
                yield Cell(
                    case.kind, case.fingers, case.delay, case.wrong, method, measure,
                    *interval(own[:, k], middle), *interval(reference[:, k] - own[:, k], middle),
                )  # fmt: skip


def made(folder: Path | None = None, jobs: int | None = None) -> Iterator[Cell]:
    """Run all cases on all rigs."""
    yield from cells(swept(cases(), rigs()[SPENT:], folder=folder, jobs=jobs))


KEPT = Kept(
    "delay/sweep.csv",
    Cell,
    made,
    "python -m book.beyond.delay.sweep",
    notes="s, a share, deg, s, a share and rev: settling, settled, apart, missed, error, travel\n"
    "intervals: percentile bootstrap over rigs; gain: the printed loop at 2/s less the method",
    number=".4g",
)


def main() -> None:
    """Make the sweep, as a command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", type=int, help="processes; all that joblib's configuration says")
    parser.add_argument("--kept", type=Path, help="folder of what is done, to go on from")
    given = parser.parse_args()
    table = replace(KEPT, make=partial(made, given.kept, given.jobs))
    print(table.write())


if __name__ == "__main__":
    main()
