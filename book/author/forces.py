"""Regressors on the author's force readings of 2020 beside the simulated layer of Chapter 2.

``python -m book.author.forces`` keeps their errors and the repeatability of the readings, for pages
that are built where the readings cannot be had. No reading is kept.
"""

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from IPython.display import SVG
from matplotlib.figure import Figure
from sklearn.linear_model import LinearRegression
from sklearn.neighbors import KNeighborsRegressor
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import PolynomialFeatures

from book.chapter_2.forces import weight_points
from book.companion.save import svg
from book.companion.style import BLUE, GREEN, MEASURED, ORANGE, SKY, VERMILION, sheet, style
from softgrip.arrays import Floats
from softgrip.kept import Kept
from softgrip.provenance import Provenance
from softgrip.tactile import published_readings
from softgrip.tactile.accuracy import CONFIDENCE
from softgrip.tactile.force_comparison import (
    cross_validated,
    regressors,
    resampled_root_mean_squares,
    root_mean_square,
)
from softgrip.tactile.nadaraya_watson import NadarayaWatson, best_bandwidth

LINE, PARABOLA = "ordinary least squares", "parabola"
READING, LEVEL = "a reading", "a level"
PUBLISHED, SIMULATED = "author, 2020", "simulated"
CURVES = {
    LINE: (ORANGE, "-"),
    PARABOLA: (VERMILION, (0, (1, 1))),
    "neural network": (GREEN, "-."),
    "k-nearest neighbours": (SKY, "-"),
    "Nadaraya-Watson": (BLUE, "--"),
}
"""The regressors of Figure 2.9 and a parabola, with colour and dash."""

Points = tuple[Floats, Floats]


def models() -> dict[str, Any]:
    """Return the regressors of `CURVES`, not fitted: Chapter 2's, and a parabola."""
    parabola = make_pipeline(PolynomialFeatures(2), LinearRegression())
    known = {**regressors(), PARABOLA: parabola}
    return {name: known[name] for name in CURVES}


def points(sensor: str) -> Points:
    """Return signal and force, N, of a sensor's readings, shapes (N,).

    Raises:
        DataUnavailableError, DataFileError: As `published_readings.load`, for the author's.
    """
    if sensor == SIMULATED:
        return weight_points()
    found = published_readings.load()
    return found.signal, found.force


def at_best(signal: Floats, force: Floats, groups: Floats) -> dict[str, Any]:
    """Return two regressors with the settings that are best for the readings left out: flattered.

    Args:
        signal, force: Shapes (N,).
        groups: What is left out together, shape (N,).
    """

    def error(k: int) -> float:
        said = cross_validated(KNeighborsRegressor(k), signal, force, groups=groups)
        return root_mean_square(said - force)

    return {
        "k-nearest neighbours, best k": KNeighborsRegressor(min(range(1, 11), key=error)),
        "Nadaraya-Watson, best width": NadarayaWatson(
            best_bandwidth(signal[:, None], force, groups=groups)
        ),
    }


@dataclass(frozen=True)
class RegressorError:
    """What a regressor errs by on readings that it was not trained on.

    Attributes:
        sensor, regressor: Whose readings, and a key of `models` or `at_best`.
        left_out: What is left out at a time, `READING` or `LEVEL`.
        error: Root mean square, N.
        low, high: Of its 95 % interval, levels drawn anew, N.
        beyond, beyond_low, beyond_high: Error less that of the line, and its interval, N.
    """

    sensor: str
    regressor: str
    left_out: str
    error: float
    low: float
    high: float
    beyond: float
    beyond_low: float
    beyond_high: float


def _interval(values: Floats) -> tuple[float, float]:
    low, high = np.quantile(values, ((1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2))
    return float(low), float(high)


def regressor_errors(
    sensor: str, left_out: str, chosen: Collection[str] = ()
) -> Iterator[RegressorError]:
    """Leave readings out and yield the errors of regressors.

    Args:
        sensor, left_out: As of `RegressorError`.
        chosen: Their names; all if empty.
    """
    signal, force = points(sensor)
    groups = force if left_out == LEVEL else np.arange(force.size, dtype=np.float64)
    known = {**models(), **at_best(signal, force, groups)}

    def errors(model: Any) -> Floats:
        return cross_validated(model, signal, force, groups=groups) - force

    line = errors(LinearRegression())
    drawn_line = resampled_root_mean_squares(line, force)
    for name in chosen or known:
        found = errors(known[name])
        drawn = resampled_root_mean_squares(found, force)
        error, of_line = root_mean_square(found), root_mean_square(line)
        beyond = _interval(drawn - drawn_line)
        yield RegressorError(
            sensor, name, left_out, error, *_interval(drawn), error - of_line, *beyond
        )


@dataclass(frozen=True)
class Repeatability:
    """How alike the forces are that the straight line says at one true force.

    Attributes:
        readings, levels: Their numbers; levels with one reading only do not count.
        least, pooled, largest: Deviation of the line's forces within a level, N.
        above: Number of levels where it is above 0.05 N.
    """

    readings: int
    levels: int
    least: float
    pooled: float
    largest: float
    above: int


LIMIT = 0.05
"""N: what Section 2.2 says that the deviation of a single piece of fabric would easily exceed."""


def repeatability(signal: Floats, force: Floats, limit: float = LIMIT) -> Repeatability:
    """Measure the repeatability of readings, with a line fitted to all of them.

    Args:
        signal, force: Shapes (N,).
        limit: N.
    """
    said = LinearRegression().fit(signal[:, None], force).predict(signal[:, None])
    at_level = [said[force == level] for level in np.unique(force)]
    repeated = [values for values in at_level if values.size > 1]
    variances = np.array([values.var(ddof=1) for values in repeated])
    weights = np.array([values.size - 1 for values in repeated])
    deviations = np.sqrt(variances)
    return Repeatability(
        int(sum(values.size for values in repeated)),
        len(repeated),
        float(deviations.min()),
        float(np.sqrt(np.average(variances, weights=weights))),
        float(deviations.max()),
        int(np.count_nonzero(deviations > limit)),
    )


def _all_errors() -> Iterator[RegressorError]:
    for sensor in (PUBLISHED, SIMULATED):
        for left_out in (READING, LEVEL):
            yield from regressor_errors(sensor, left_out)


_SOURCE = (
    "WuteYANG/Modeling-soft-sensor-by-NN at 46c7f6b4, Processed_09142020.csv, and "
    "simulated/force-weights.csv, reduced by: python -m book.author.forces"
)
ERRORS = Kept(
    "author/force_errors.csv",
    RegressorError,
    _all_errors,
    _SOURCE,
    notes="Errors in N. No reading is contained.",
    number=".5f",
    provenance=Provenance.PUBLIC,
)
REPEATABILITY = Kept(
    "author/force_repeatability.csv",
    Repeatability,
    lambda: [repeatability(*points(PUBLISHED))],
    _SOURCE,
    notes="Deviations in N. No reading is contained.",
    number=".5f",
    provenance=Provenance.PUBLIC,
)


def kept_errors(sensor: str, left_out: str) -> dict[str, RegressorError]:
    """Read the kept errors of a sensor, by regressor; see `RegressorError`."""
    rows = ERRORS.read()
    return {r.regressor: r for r in rows if (r.sensor, r.left_out) == (sensor, left_out)}


def error_if_curved_as_simulated() -> float:
    """Return what the line would err by, N, on readings as scattered as the author's.

    If the sensor were as curved as the simulated layer: both parts add as squares.
    """
    scatter = REPEATABILITY.read()[0].pooled
    return float(np.hypot(scatter, kept_errors(SIMULATED, LEVEL)[LINE].error))


def _with_interval(value: float, low: float, high: float, sign: str = "") -> str:
    return f"{value:{sign}.3f} ({low:{sign}.3f} to {high:{sign}.3f})"


def error_table(sensor: str) -> pd.DataFrame:
    """Tabulate a sensor's kept errors, N, with their 95 % intervals."""
    by_reading, by_level = (kept_errors(sensor, left_out) for left_out in (READING, LEVEL))
    return pd.DataFrame(
        {
            "regressor": name,
            "a reading left out": f"{by_reading[name].error:.4f}",
            "a weight left out": _with_interval(row.error, row.low, row.high),
            "difference to the line": _with_interval(
                row.beyond, row.beyond_low, row.beyond_high, "+"
            )
            if name != LINE
            else "",
        }
        for name, row in by_level.items()
    )


def draw_fits() -> Figure:
    """Draw the regressors on the readings that can be had: the author's and the simulated ones."""
    sensors = [PUBLISHED, SIMULATED] if published_readings.available() else [SIMULATED]
    drawn, panels = sheet(2.9 * len(sensors) + 0.6, len(sensors), 1, squeeze=False)
    for axes, sensor in zip(panels[:, 0], sensors, strict=True):
        signal, force = points(sensor)
        grid = np.linspace(signal.min(), signal.max(), 601)
        axes.plot(signal, force, "o", color=MEASURED, ms=2.5, label="readings")
        for name, model in models().items():
            colour, dash = CURVES[name]
            said = model.fit(signal[:, None], force).predict(grid[:, None])
            axes.plot(grid, said, color=colour, ls=dash, label=name)
        unit = "V" if sensor == SIMULATED else "no unit given"
        axes.set(title=sensor, xlabel=f"signal ({unit})", ylabel="force (N)")
    handles = panels[0, 0].get_legend_handles_labels()
    drawn.legend(*handles, loc="outside lower center", ncols=2)
    return drawn


def show_fits() -> SVG:
    """Show `draw_fits` in the book's style."""
    with style():
        return SVG(svg(draw_fits()))  # type: ignore[no-untyped-call]


if __name__ == "__main__":
    ERRORS.main()
    REPEATABILITY.main()
