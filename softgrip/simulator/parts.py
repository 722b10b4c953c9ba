"""Any number of runs in parts, several at a time, in memory that does not grow with them."""

from collections.abc import Callable

import numpy as np
from joblib import Parallel, delayed

from softgrip.arrays import Floats, chunks
from softgrip.errors import InvalidInputError


def in_parts(
    work: Callable[[slice], Floats],
    runs: int,
    bytes_per_run: float,
    *,
    memory: float = 64e6,
    jobs: int | None = None,
) -> Floats:
    """Work on all runs in parts and return what came of each run, in order.

    The parts go through `joblib.Parallel`: ``joblib.parallel_config`` says where they run, such as
    ``backend="dask"`` for a cluster. With ``first=part.start`` a run of `Simulation` is the same in
    any part, so nothing but a slice need go out, and nothing but measures come back.

    Args:
        work: From the numbers of some runs to their measures, shape (runs of the part, ...). It
            makes its rigs, or takes them from a batch by `rig_batch.take`.
        runs: How many, >= 1.
        bytes_per_run: What the work on a run takes, > 0: 8 for each sample of each quantity kept.
        memory: Largest for a part, bytes.
        jobs: As joblib's `n_jobs`: how many parts at a time; None leaves it to its configuration.

    Raises:
        InvalidInputError: If an argument is outside its range, or the work gives something else.

    >>> in_parts(lambda part: np.arange(part.start, part.stop) ** 2.0, 5, 8.0, memory=16.0).tolist()
    [0.0, 1.0, 4.0, 9.0, 16.0]
    """
    parts = list(chunks(runs, bytes_per_run, limit=memory))
    found = list(Parallel(n_jobs=jobs)(delayed(work)(part) for part in parts))
    lengths, wanted = [len(one) for one in found], [part.stop - part.start for part in parts]
    if lengths != wanted:
        raise InvalidInputError("work", expected=f"arrays of {wanted} runs", got=lengths)
    return np.concatenate(found)
