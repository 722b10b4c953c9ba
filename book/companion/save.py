"""Exhibits as files that are the same, to the bit, from run to run; and their numbers as CSV."""

import re
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.collections import PathCollection, PolyCollection
from matplotlib.container import BarContainer
from matplotlib.figure import Figure

from book.companion.exhibit import Exhibit
from book.companion.style import style
from softgrip.logs.reader import read_log
from softgrip.provenance import DataFile, data_folder, describe
from softgrip.reads import recorded


@dataclass(frozen=True)
class Made:
    """An exhibit made: a Figure or DataFrame, the seconds that it took, and the files it read."""

    shown: Any
    seconds: float
    data: tuple[DataFile, ...]
    """The reader's logs, and what was opened below ``data/``: also by those who remembered it."""


def make(exhibit: Exhibit) -> Made:
    """Make an exhibit in the book's style."""
    start = perf_counter()
    with style(), recorded() as files:
        shown = exhibit.make()
    seconds = perf_counter() - start
    logs = {log.resolve(): log for log in exhibit.logs}
    ours = data_folder().resolve()
    named = [_of_reader(log) for path, log in logs.items() if path in files]
    kept = sorted(path for path in files - set(logs) if path.is_relative_to(ours))
    return Made(shown, seconds, (*named, *map(describe, kept)))


def _of_reader(log: Path) -> DataFile:
    # What another program made states nothing of itself: the reader of logs knows what it is.
    header = read_log(log).header
    return DataFile(log, header.provenance, header.source)


def _points(axes: Any) -> list[tuple[str, Any, Any]]:
    """Return (name, x, y) of all that is drawn in data coordinates; of bands, the outline."""
    found: list[tuple[str, Any, Any]] = []
    for line in axes.lines:
        if line.get_transform().contains_branch(axes.transData):
            found.append((line.get_label(), *line.get_data()))
    for item in axes.collections:
        if isinstance(item, PathCollection):
            found.append((item.get_label(), *np.asarray(item.get_offsets()).T))
        elif isinstance(item, PolyCollection):
            for path in item.get_paths():
                found.append((item.get_label(), *np.asarray(path.vertices).T))
    for item in axes.containers:
        if isinstance(item, BarContainer):
            edges = [(bar.get_x() + bar.get_width() / 2, bar.get_height()) for bar in item]
            found.append((item.get_label(), *np.transpose(edges)))
    return found


def numbers(figure: Figure) -> pd.DataFrame:
    """Read the numbers of a figure back from what is drawn, so that the two cannot differ.

    Names are in one line, however they are set in the picture.

    Returns:
        DataFrame: One row a point: panel, series, x, y; the axes' labels, with units, are in
            ``x_is`` and ``y_is``.
    """
    rows = []
    labels = [axes.get_xlabel() for axes in figure.axes if axes.get_xlabel()]
    for index, axes in enumerate(figure.axes):
        panel = axes.get_title(loc="left") or f"panel {index + 1}"
        for count, (label, x, y) in enumerate(_points(axes)):
            series = f"series {count + 1}" if str(label).startswith("_") else label
            rows.append(
                pd.DataFrame(
                    {
                        "panel": panel,
                        "series": series,
                        "x": np.asarray(x),
                        "y": np.asarray(y),
                        # Panels above others leave their label to the lowest one.
                        "x_is": axes.get_xlabel() or (labels or [""])[0],
                        "y_is": axes.get_ylabel() or figure.axes[0].get_ylabel(),
                    }
                )
            )
    if not rows:
        return pd.DataFrame()
    found = pd.concat(rows, ignore_index=True)
    names = ["panel", "series", "x_is", "y_is"]
    return found.assign(**{name: found[name].str.split().str.join(" ") for name in names})


PLACES = re.compile(rb'(?<= [dxy]=")[^"]*')
FINE = re.compile(rb"-?\d+\.\d{3,}")
"""A number of an SVG with more digits than anyone sees: one unit is a 72nd of an inch."""


def _rounded(places: re.Match[bytes]) -> bytes:
    return FINE.sub(lambda n: f"{float(n[0]):.2f}".rstrip("0").rstrip(".").encode(), places[0])


def svg(figure: Figure) -> bytes:
    """Return a figure as SVG, without the date that would make each one another."""
    file = BytesIO()
    with style():
        figure.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    return PLACES.sub(_rounded, file.getvalue())


def table_text(table: pd.DataFrame) -> str:
    """Return numbers as CSV."""
    return str(table.to_csv(index=False, float_format="%.8g", lineterminator="\n"))


def save(exhibit: Exhibit, folder: Path) -> Made:
    """Make an exhibit and write it: figures as SVG and CSV, tables as CSV, drawings as SVG."""
    made = make(exhibit)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / exhibit.name
    table = made.shown
    if exhibit.kind == "figure":
        path.with_suffix(".svg").write_bytes(svg(made.shown))
        if exhibit.drawing:
            return made
        table = numbers(made.shown)
    path.with_suffix(".csv").write_text(table_text(table), encoding="utf-8", newline="\n")
    return made
