"""The rigs that were found, kept in ``data/calibration/``.

The best one, an ensemble, and for each target the one that comes nearest to it.
"""

import numpy as np

from book.twin.space import space
from softgrip.arrays import Floats
from softgrip.kept import write_data
from softgrip.provenance import data_folder, data_rows
from softgrip.reads import remembered

BEST, ENSEMBLE, NEAREST = (
    f"calibration/{name}.csv" for name in ("best_rig", "ensemble", "nearest_rigs")
)
SOURCE = "python -m book.twin fit"
DIGITS = 6
"""Significant ones, of what is kept: a rig's answers are those of the kept numbers."""


def rounded(rows: Floats) -> Floats:
    """Return values as they are kept, within their ranges, any shape (..., parameters)."""
    low, high = np.array([(one.low, one.high) for one in space().values()]).T
    texts = np.vectorize(lambda value: float(f"{value:.{DIGITS}g}"))(rows)
    return np.asarray(np.clip(texts, low, high))


def keep(name: str, rows: Floats, notes: str) -> None:
    """Write rigs, a row each, with all parameters of the space as columns."""
    lines = [",".join(f"{value:.{DIGITS}g}" for value in row) for row in np.atleast_2d(rows)]
    text = "\n".join([",".join(space()), *lines, ""])
    write_data(data_folder() / name, text, source=SOURCE, notes=notes)


@remembered
def ensemble() -> Floats:
    """Return the rigs of the ensemble, values in the order of `space`, shape (rigs, parameters)."""
    return rigs(ENSEMBLE)


@remembered
def best_rig() -> Floats:
    """Return the best rig, values in the order of `space`, shape (parameters,)."""
    return np.asarray(rigs(BEST)[0])


@remembered
def nearest() -> Floats:
    """Return the rig nearest to each target of `misfit`, shape (targets, parameters)."""
    return rigs(NEAREST)


def rigs(name: str) -> Floats:
    """Return the rigs of a file as it now is: what is `remembered` a fit may have replaced."""
    return np.array([[float(row[column]) for column in space()] for row in data_rows(name)])
