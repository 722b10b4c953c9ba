"""Batches of runs in parts that fit into memory."""

from collections.abc import Iterator

from softgrip.errors import InvalidInputError


def chunks(runs: int, bytes_per_run: float, *, limit: float = 64e6) -> Iterator[slice]:
    """Cut a batch into pieces whose output fits into memory.

    Parameters
    ----------
    runs
        Number of runs, >= 1.
    bytes_per_run
        Size of the output of one run.
    limit
        Largest output held at a time, bytes.

    Examples
    --------
    >>> [(part.start, part.stop) for part in chunks(5, 8.0, limit=16.0)]
    [(0, 2), (2, 4), (4, 5)]
    """
    if runs < 1 or not bytes_per_run > 0:
        raise InvalidInputError("runs", expected=">= 1, of more than 0 bytes", got=runs)
    size = max(1, int(limit // bytes_per_run))
    for start in range(0, runs, size):
        yield slice(start, min(start + size, runs))
