"""Where the rigs lie that agree with the print: bands for figures of simulated experiments.

``data/calibration/bands.csv`` has the middle nine tenths of the twin's ensemble, by curve; each rig
does the very experiment of the figure, with controllers designed on its own logs.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import UnknownNameError
from softgrip.provenance import data_rows
from softgrip.reads import remembered

FILE = "calibration/bands.csv"
LABEL = "rigs that agree with the print"


@remembered
def _bands() -> Mapping[str, Floats]:
    rows: dict[str, list[list[float]]] = {}
    for row in data_rows(FILE):
        rows.setdefault(row["curve"], []).append([float(row[n]) for n in ("x", "low", "high")])
    return MappingProxyType({name: np.transpose(own) for name, own in rows.items()})


def band(curve: str) -> Floats:
    """Return x, 5 % and 95 % of a curve, in the units of its figure, shape (3, N).

    Raises:
        UnknownNameError: If there is no such curve.
    """
    known = _bands()
    if curve not in known:
        raise UnknownNameError("band", curve, [*known])
    return known[curve]


def shade(axes: Any, curve: str, colour: str, *, label: str = "_band") -> None:
    """Draw a band behind a curve."""
    x, low, high = band(curve)
    axes.fill_between(x, low, high, color=colour, alpha=0.18, lw=0, zorder=0.5, label=label)
