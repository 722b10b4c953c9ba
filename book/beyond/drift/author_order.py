"""What the author's readings of 2020 say of drift: ``python -m book.beyond.drift.author_order``.

They have no times. If they stand in the order in which they were taken, drift would show as
readings of one weight that go one way. No reading is kept, only how many go up and down.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.stats import binomtest

from softgrip.arrays import Floats
from softgrip.kept import Kept
from softgrip.provenance import Provenance
from softgrip.tactile import published_readings


@dataclass(frozen=True)
class Order:
    """How neighbouring readings of one weight differ.

    Attributes:
        readings, levels: Their number, and that of weights.
        up, down: Neighbours of which the later one is larger, or smaller.
        p: Two-sided, that so many go one way if either is as likely.
    """

    readings: int
    levels: int
    up: int
    down: int
    p: float


def order(signal: Floats, force: Floats) -> Order:
    """Count how readings of one force go, in the order in which they stand.

    Args:
        signal, force: Shape (N,); readings of one force stand together.

    >>> order(np.array([1.0, 2.0, 1.5, 5.0, 5.0]), np.array([0.1, 0.1, 0.1, 0.2, 0.2]))
    Order(readings=5, levels=2, up=1, down=1, p=1.0)
    """
    steps = np.concatenate([np.diff(signal[force == level]) for level in np.unique(force)])
    up, down = int((steps > 0).sum()), int((steps < 0).sum())
    p = float(binomtest(up, up + down).pvalue)
    return Order(len(signal), len(np.unique(force)), up, down, p)


def _rows() -> Iterator[Order]:
    found = published_readings.load()
    yield order(found.signal, found.force)


KEPT = Kept(
    "author/force_order.csv",
    Order,
    _rows,
    source="WuteYANG/Modeling-soft-sensor-by-NN at 46c7f6b4, Processed_09142020.csv, reduced by:"
    " python -m book.beyond.drift.author_order",
    notes="No reading is contained.",
    number=".4f",
    provenance=Provenance.PUBLIC,
)


if __name__ == "__main__":
    KEPT.main()
