"""How far rigs are from the printed targets, in tolerances: what an inference of the twin calls."""

import sys
from collections.abc import Collection, Sequence
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from book.twin.laboratory import Laboratory
from book.twin.recipes import FAST, measured
from book.twin.space import space
from book.twin.targets import Target, targets
from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.simulator.parts import in_parts

PENALTY = 100.0
"""Largest deviation, tolerances, and that of what is not told: a quantity that is NaN, as no model
was identified or no pressure reached, or infinite, as a loop that does not settle. A rig that is a
hundred tolerances off is as wrong as one that does not do the experiment at all; beyond it the size
says nothing, and a mean of squares would hang on it alone."""
LOOPS, STEPS = 20, 20
"""Runs of `Laboratory.loops` and `steps`: of a deviation, 20 runs tell 16 %, where the print's own
seven tell 29 %, and the median of 20 is off by some quarter of what a run is."""
SPLITS = 1
"""Of `Laboratory.splits`: an accuracy by one split is as well known as the print's."""
RIGS = 256
"""At a time: enough to fill the compiled lanes, in half a gigabyte with all that is imported."""


def chosen(experiments: Collection[str] = FAST) -> tuple[Target, ...]:
    """Return the targets of some experiments, in the order of the text: the columns of `misfit`."""
    return tuple(one for one in targets() if one.experiment in experiments)


def deviations(lab: Laboratory, wanted: Sequence[Target]) -> Floats:
    """Return by how many tolerances each laboratory misses targets, shape (rigs, targets).

    With its sign; 0 within a bound. At most `PENALTY` in size, which also stands where nothing is
    told.
    """
    with np.errstate(all="ignore"):
        found = measured(lab, dict.fromkeys(one.experiment for one in wanted))
        off = [one.off(found[one.experiment, one.quantity]) / one.tolerance for one in wanted]
    told = np.nan_to_num(np.stack(off, axis=1), nan=PENALTY, posinf=PENALTY, neginf=-PENALTY)
    return np.clip(told, -PENALTY, PENALTY)


def laboratory(rows: Floats) -> Laboratory:
    """Return the laboratories of parameters as `space` orders them, shape (rigs, parameters)."""
    columns = dict(zip(space(), rows.T.copy(), strict=True))
    return Laboratory(columns, loops=LOOPS, steps=STEPS, splits=SPLITS)


def misfit(
    rows: ArrayLike,
    *,
    experiments: Collection[str] = FAST,
    jobs: int | None = None,
    rigs_at_a_time: int = RIGS,
    progress: bool = False,
) -> Floats:
    """Return by how many tolerances rigs miss the targets of experiments, as `deviations`.

    The rigs go in parts through `simulator.parts.in_parts`, so that joblib says where they run; a
    rig's deviations hang on no other.

    Args:
        rows: Values of all parameters, in their units, shape (rigs, parameters); the parameters are
            in the order of `space.space`.
        experiments: Names in `recipes.ALL`.
        jobs: Parts at a time; None leaves it to joblib's configuration.
        rigs_at_a_time: In a part.
        progress: Whether to say on the error stream which parts are done.

    Returns:
        Floats: Shape (rigs, targets), those of `chosen`.

    Raises:
        InvalidInputError: If the rows have another shape, or a value is outside its range.
    """
    given, known = np.asarray(rows, dtype=np.float64), list(space().values())
    if given.ndim != 2 or given.shape[1] != len(known) or not len(given):
        raise InvalidInputError(
            "rows", expected=f"shape (rigs, {len(known)}), rigs >= 1", got=given.shape
        )
    low, high = np.array([(one.low, one.high) for one in known]).T
    # The ends of a range are given with fewer digits than a share of it is worked out.
    outside = ~((given >= low - SLACK * np.abs(low)) & (given <= high + SLACK * np.abs(high)))
    if outside.any():
        rig, k = np.argwhere(outside)[0]
        raise InvalidInputError(
            f"{known[k].name} of rig {rig}", expected=f"{low[k]:g} to {high[k]:g} {known[k].unit}",
            got=given[rig, k],
        )  # fmt: skip
    wanted = chosen(experiments)
    work = partial(_part, given, wanted, progress)
    return in_parts(work, len(given), 1.0, memory=rigs_at_a_time, jobs=jobs)


SLACK = 1e-9
"""Relative, by which a value may be beyond an end."""


def _part(rows: Floats, wanted: Sequence[Target], progress: bool, part: slice) -> Floats:
    found = deviations(laboratory(rows[part]), wanted)
    if progress:
        print(f"rigs {part.start} to {part.stop - 1} of {len(rows)}", file=sys.stderr, flush=True)
    return found
