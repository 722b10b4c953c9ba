"""Which columns of a table are no channels of a pad, and which rows are not independent."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats

CLOCKS = frozenset(
    {"time", "t", "timestamp", "date", "clock", "seconds", "sec", "s", "ms", "millis", "index"}
    | {"idx", "id", "row", "sample", "no", "nr", "n", "number", "count", "counter", "press"}
    | {"trial", "run", "event", "group", "session", "grasp"}
)
"""Names of columns that count or tell the time."""
RISING = 8
"""Rows from which on a column that never falls is no channel: one in 40 000 does so by chance."""
EVEN = 0.7
"""Share of the steps from row to row that are one and the same, from which on it is a clock."""
NEAR = 1e-3
"""Share of a channel's range within which two readings are near-equal."""
FEW = 6
"""Readings of a label below which nothing is told of them."""


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


def near_equal(voltages: Floats, labels: Sequence[str] | ArrayLike) -> int:
    """Return how many rows have a near-equal one of the same label.

    Args:
        voltages: Shape (N, channels).
        labels: Shape (N,).

    >>> near_equal(np.array([[0.0], [0.5], [0.5], [1.0]]), ["a", "b", "b", "a"])
    2
    """
    span = np.ptp(voltages, axis=0)
    scaled = voltages / np.where(span > 0, span, 1.0)
    marks, found = np.asarray(labels), np.zeros(len(voltages), dtype=bool)
    for mark in np.unique(marks):
        own = np.flatnonzero(marks == mark)
        for k, row in enumerate(own):
            near = np.abs(scaled[own[k + 1 :]] - scaled[row]).max(axis=1, initial=0.0) <= NEAR
            found[own[k + 1 :][near]] = True
            found[row] |= bool(near.any())
    return int(np.count_nonzero(found))


def like_the_next(voltages: Floats, labels: Sequence[str] | ArrayLike) -> float:
    """Return the share of rows whose nearest one of the same label is next to it in the table.

    It is large where rows are samples of one press, however noisy they are; labels of fewer than
    `FEW` readings are left out, and 0 is returned if none is left.

    >>> drift = np.arange(20.0)[:, None]
    >>> like_the_next(drift, ["a"] * 20)
    1.0
    """
    span = np.ptp(voltages, axis=0)
    scaled = voltages / np.where(span > 0, span, 1.0)
    marks, beside, counted = np.asarray(labels), 0, 0
    for mark in np.unique(marks):
        own = np.flatnonzero(marks == mark)
        if own.size < FEW:
            continue
        for k, row in enumerate(own):
            apart = np.sum((scaled[own] - scaled[row]) ** 2, axis=1)
            apart[k] = np.inf
            beside += abs(int(own[int(np.argmin(apart))]) - int(row)) == 1
        counted += own.size
    return beside / counted if counted else 0.0
