"""Which columns of a table are no channels of a pad, and which rows are not independent."""

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import KDTree

from softgrip.arrays import Floats

CLOCKS = frozenset(
    {"time", "t", "timestamp", "date", "clock", "seconds", "sec", "s", "ms", "millis", "index"}
    | {"idx", "id", "row", "sample", "no", "nr", "n", "number", "count", "counter", "press"}
    | {"trial", "run", "event", "group", "session", "grasp"}
)
"""Names of columns that count or tell the time."""
OTHERS = frozenset(
    {"force", "load", "weight", "mass", "pressure", "stress", "temperature", "temp", "humidity"}
    | {"x", "y", "z", "position", "depth", "indentation", "displacement", "distance", "height"}
    | {"angle", "speed", "velocity", "code", "class", "label", "kind", "object", "material"}
    | {"repeat", "rep", "repetition", "diameter", "size"}
)
"""Names of columns that tell something else of a contact."""
CODES = 20
"""Whole numbers, so many or fewer in a column, are a code's: a converter has more."""
RISING = 8
"""Rows from which on a column that never falls is no channel: one in 40 000 does so by chance."""
EVEN = 0.7
"""Share of the steps from row to row that are one and the same, from which on it is a clock."""
NEAR = 1e-3
"""Share of a channel's range within which two readings are near-equal."""
FEW = 12
"""Rows of a label below which their order tells nothing."""


def no_channel(name: str, values: Floats, ordered: bool) -> str | None:
    """Say why a column that nobody named as a channel is none, or return None if it may be one.

    Args:
        name: Of the column.
        values: Shape (N,).
        ordered: Whether the rows are in the order of their labels, as known weights may be: a
            channel then rises with them.

    >>> no_channel("e1", np.array([0.1, 0.7, 0.2]), False)
    >>> no_channel("x", np.array([0.0, 0.5, 1.0, 1.5]), False)
    'it rises by 0.5 from row to row, as a clock does'
    """
    steps = np.diff(values)
    plain = name.strip().lower().split("[")[0].split("(")[0].strip().removesuffix("_")
    if plain in CLOCKS or plain == "":
        return "its name is that of a clock or a counter"
    if values.size < 2:
        return None
    if not steps.any():
        return f"it is {values[0]:g} throughout"
    sizes, counts = np.unique(np.round(steps, 9), return_counts=True)
    step = float(sizes[np.argmax(counts)])
    if values.size > 3 and step != 0 and counts.max() >= EVEN * steps.size:
        way = "rises" if step > 0 else "falls"
        return f"it {way} by {abs(step):g} from row to row, as a clock does"
    if values.size >= RISING and not ordered and ((steps >= 0).all() or (steps <= 0).all()):
        return f"it {'never falls' if steps.max() > 0 else 'never rises'}, as a clock or a counter"
    if (
        values.size >= RISING
        and (values == np.rint(values)).all()
        and ((few := np.unique(values).size) <= CODES)
    ):
        return f"it has {few} whole numbers only, as a code has"
    if plain in OTHERS:
        return "its name is that of another quantity"
    return None


def no_channels(columns: Mapping[str, Floats], labels: ArrayLike) -> dict[str, str]:
    """Return the columns that are no channels, with the reason; see `no_channel`.

    Args:
        columns: By name, shape (N,) each.
        labels: Kinds or forces, shape (N,).
    """
    marks = np.asarray(labels)
    ordered = marks.dtype.kind != "U" and (
        bool((np.diff(marks) >= 0).all()) or bool((np.diff(marks) <= 0).all())
    )
    found = {name: no_channel(name, values, ordered) for name, values in columns.items()}
    return {name: reason for name, reason in found.items() if reason}


def near_equal(voltages: Floats, labels: ArrayLike) -> int:
    """Return how many rows have a near-equal one of the same label.

    Args:
        voltages: Shape (N, channels).
        labels: Shape (N,).

    >>> near_equal(np.array([[0.0], [0.5], [0.5], [1.0]]), ["a", "b", "b", "a"])
    2
    """
    return sum(int(np.count_nonzero(apart <= NEAR)) for apart, _ in _nearest(voltages, labels))


def near_equal_by_chance(channels: int, labels: ArrayLike) -> float:
    """Return what `near_equal` is about, where readings lie anywhere in the ranges of channels.

    >>> [round(near_equal_by_chance(channels, ["a"] * 10), 6) for channels in (1, 2)]
    [0.18, 0.00036]
    """
    _, counts = np.unique(np.asarray(labels), return_counts=True)
    return float(np.sum(counts * np.minimum((counts - 1) * (2 * NEAR) ** channels, 1)))


def order_of_alike(voltages: Floats, labels: ArrayLike) -> float:
    """Return how far in the table the most alike row of the same label is, as a share of chance's.

    It is about 1 where rows are independent, or in any order, and small where neighbours are
    samples of one press, however noisy. Labels of fewer than `FEW` rows tell nothing; 1 is returned
    if there are no others.

    Args:
        voltages, labels: As of `near_equal`.

    >>> drift = np.arange(30.0)[:, None]
    >>> order_of_alike(drift, ["a"] * 30) < 0.1
    True
    """
    far, chance = 0.0, 0.0
    for _, other in _nearest(voltages, labels):
        if other.size >= FEW:
            far += float(np.abs(other - np.arange(other.size)).sum())
            chance += other.size * (other.size + 1) / 3  # two of n places differ by (n + 1) / 3
    return far / chance if chance else 1.0


def _nearest(voltages: Floats, labels: ArrayLike) -> Iterator[tuple[Floats, NDArray[np.intp]]]:
    """Yield, for the rows of each label, distance and place among them of the most alike one.

    The distance is the largest over the channels, each as a share of its range.
    """
    span = np.ptp(voltages, axis=0)
    scaled = voltages / np.where(span > 0, span, 1.0)
    marks = np.asarray(labels)
    for mark in np.unique(marks):
        own = scaled[marks == mark]
        if len(own) > 1:
            apart, place = KDTree(own).query(own, k=2, p=np.inf)
            # A row is nearest to itself, but of equal ones another may come first.
            first = (place[:, 0] != np.arange(len(own))).astype(int)
            pick = np.arange(len(own)), 1 - first
            yield apart[pick], place[pick]
