"""The bands of acceptance as a table, a calibration as a table and as a picture."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from book.companion.style import GREY, LUDWICK, MEASURED, WIDTH, style
from softgrip.board.calibration import BoardCalibration, SensorCurve, nominal
from softgrip.logs.reader import read_log
from softgrip.rig.acceptance import Experiment, judge
from softgrip.units import DEG


def bands_table(logs: Mapping[Experiment, Path | str]) -> pd.DataFrame:
    """Tabulate each band of each log's experiment, pass or fail, and what was mended in the log.

    Args:
        logs: Of steps, by experiment.
    """
    rows = []
    for experiment, path in logs.items():
        log = read_log(path)
        told = "; ".join((str(log.header.provenance), *log.repairs))
        rows += [
            {
                "experiment": f"{experiment}, {told}",
                "quantity": band.quantity,
                "band": f"{band.low:.3g} to {band.high:.3g} {band.unit} ({band.place})",
                "found": f"{band.found:.3g}" if np.isfinite(band.found) else "never",
                "verdict": "pass" if band.passed else "**fail**",
            }
            for band in judge(path, experiment)
        ]
    return pd.DataFrame(rows)


def lines_table(measured: BoardCalibration) -> pd.DataFrame:
    """Tabulate what a count is worth by measured curves and by the lines of the data sheets."""
    sheet = nominal(len(measured.angles))
    lines: list[tuple[str, str, float, SensorCurve, SensorCurve]]
    lines = [("pressure", "Pa", 1.0, measured.pressure, sheet.pressure)]
    lines += [
        (f"angle {k}", "deg", DEG, *pair)
        for k, pair in enumerate(zip(measured.angles, sheet.angles, strict=True), 1)
    ]
    return pd.DataFrame(
        {
            "sensor": sensor,
            "unit": unit,
            "a count": f"{_count(found) / scale:.4g}",
            "by the data sheet": f"{_count(told) / scale:.4g}",
            "residual": f"{found.residual / scale:.2g}",
        }
        for sensor, unit, scale, found, told in lines
    )


def _count(curve: SensorCurve) -> float:
    """Return what a count is worth, in the mean over the counts that were measured."""
    ends = curve.value([curve.low_count, curve.high_count])
    return float(np.ptp(ends)) / (curve.high_count - curve.low_count)


def draw_calibration(
    counts: ArrayLike, known: ArrayLike, line: SensorCurve, *, unit: str, factor: float
) -> Figure:
    """Draw pairs, their curve, and below what it leaves over.

    Args:
        counts, known, line: As of `fit_sensor`.
        unit, factor: For the axes: values are multiplied by the factor.
    """
    x, y = np.asarray(counts, dtype=np.float64), np.asarray(known, dtype=np.float64)
    with style():
        drawn = Figure(figsize=(WIDTH, 3.6))
        above, below = drawn.subplots(2, 1, sharex=True, height_ratios=(2, 1))
        over = np.linspace(x.min(), x.max(), 100)
        above.plot(over, factor * line.value(over), color=LUDWICK, label="fitted")
        above.plot(x, factor * y, "o", color=MEASURED, label="readings")
        above.set(ylabel=unit)
        above.legend(loc="upper left")
        below.plot(x, factor * (y - line.value(x)), "o", color=MEASURED)
        below.axhline(0, color=GREY, lw=1)
        below.set(xlabel="counts of the converter", ylabel=f"left over ({unit})")
        drawn.align_ylabels()
    return drawn
