"""Large studies of grippers in parts, on all cores or on a cluster."""

from itertools import pairwise

import numpy as np
from joblib import Parallel, delayed

from softgrip.errors import InvalidInputError
from softgrip.gripper.gripper_batch import draw_grippers
from softgrip.gripper.internal_model import ControllerMatrices
from softgrip.gripper.monte_carlo import Outcome, joined, simulate
from softgrip.gripper.plant import Gripper
from softgrip.gripper.trial import Trial


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

    Parameters
    ----------
    nominal, count, seed
        As of `draw_grippers`.
    controller, trial
        As of `monte_carlo.in_parts`.
    parts
        1 to `count`.
    jobs
        As joblib's `n_jobs`: how many parts at a time; None leaves it to its configuration.

    Raises
    ------
    InvalidInputError
        If an argument is outside its range.

    Examples
    --------
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
