"""Figures and tables of Chapter 2 on the contact force."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from book.chapter_2.force_logs import CYCLE_FORCES, read
from book.chapter_2.forces import (
    RANDOM,
    WHOLE,
    kept_comparison,
    kept_drift,
    weighed_objects,
    weight_bandwidth,
    weight_points,
)
from book.companion.exhibit import figure, table
from book.companion.style import BLUE, GREEN, GREY, MEASURED, ORANGE, SKY, VERMILION, sheet
from softgrip.arrays import Floats
from softgrip.provenance import Provenance
from softgrip.simulator.force_tests import REPETITIONS
from softgrip.tactile.force import Weighing, table_2_2
from softgrip.tactile.force_comparison import regressors
from softgrip.tactile.nadaraya_watson import left_out_error, tried_bandwidths
from softgrip.units import GRAM_FORCE

FOUR = {
    "ordinary least squares": ORANGE,
    "neural network": GREEN,
    "k-nearest neighbours": SKY,
    "Nadaraya-Watson": BLUE,
}
"""The regressors of Figure 2.9, and their colours."""

SHOWN_START = 2.0
"""h after the calibration, of the hours in Figure 2.G (a)."""

LINEAR_BELOW = 0.1
"""gf, of the axis of Figure 2.H, which is logarithmic above."""

CORRECTIONS = {
    "without": ("as read", GREY, ":", "s"),
    "repaired": ("a line at the start (Section 2.3)", ORANGE, "--", "o"),
    "between": ("lines at both ends (ours)", BLUE, "-", "^"),
}


def draw_points(axes: Any) -> None:
    """Draw the 69 points, force (gf) over voltage."""
    voltage, force = weight_points()
    axes.plot(voltage, force / GRAM_FORCE, "o", color=MEASURED, ms=2.5, label="weights")


@figure("2.8", Provenance.SIMULATED)
def figure_2_8() -> Figure:
    """Draw the response of the layer, its cycles and its hysteresis."""
    drawn, (first, second, third) = sheet(8.2, 3, 1)
    voltage, force = weight_points()
    first.plot(force / GRAM_FORCE, voltage, "o", color=MEASURED, ms=3, label="weights")
    first.set(title="(a) response", xlabel="weight (gf)", ylabel="voltage (V)")
    log = read("cycles")
    length = len(log) // (len(CYCLE_FORCES) * REPETITIONS)
    for k, (peak, colour) in enumerate(zip(CYCLE_FORCES, (SKY, ORANGE, BLUE), strict=True)):
        for cycle, dash in enumerate(("-", "--", ":")):
            start = (k * REPETITIONS + cycle) * length
            rows = log.iloc[start : start + length]
            time = rows["time [s]"] - rows["time [s]"].iloc[0]
            label = f"{peak:g} N, cycle {cycle + 1}"
            line = {"color": colour, "ls": dash, "lw": 1.2, "label": label}
            second.plot(time, rows["voltage [V]"], **line)
            third.plot(rows["weight [N]"], rows["voltage [V]"], **line)
    handles = [axes for axes in second.lines if "cycle 1" in str(axes.get_label())]
    second.legend(handles, [f"{peak:g} N" for peak in CYCLE_FORCES], loc="upper right")
    second.set(title="(b) cycles", xlabel="time of the cycle (s)", ylabel="voltage (V)")
    third.set(title="(c) hysteresis", xlabel="force (N)", ylabel="voltage (V)")
    return drawn


@figure("2.9", Provenance.SIMULATED)
def figure_2_9() -> Figure:
    """Draw the fits of four regressors."""
    drawn, panels = sheet(5.4, 2, 2, sharex=True, sharey=True)
    voltage, force = weight_points()
    grid: Floats = np.linspace(0, 4.05, 811)
    errors, fitted = kept_comparison() / GRAM_FORCE, regressors()
    for axes, (name, colour) in zip(panels.ravel(), FOUR.items(), strict=True):
        draw_points(axes)
        said = fitted[name].fit(voltage[:, None], force).predict(grid[:, None]) / GRAM_FORCE
        axes.plot(grid, said, color=colour, label=name)
        row = errors.loc[name]
        axes.set(title=f"{name}\n{row[RANDOM]:.1f} / {row[WHOLE]:.1f} gf", ylim=(-15, 85))
    for axes in panels[:, 0]:
        axes.set_ylabel("force (gf)")
    for axes in panels[1]:
        axes.set_xlabel("voltage (V)")
    return drawn


@figure("2.G", Provenance.SIMULATED)
def figure_2_g() -> Figure:
    """Draw what the correction of drift repairs."""
    drawn, (upper, lower) = sheet(6.0, 2, 1)
    errors = kept_drift() / GRAM_FORCE
    within = errors.loc[SHOWN_START]
    over = (errors**2).groupby(level="start").mean() ** 0.5
    for name, (label, colour, dash, marker) in CORRECTIONS.items():
        shown = {"color": colour, "ls": dash, "marker": marker, "label": label}
        upper.plot(12 * within.index.to_numpy() - 6, within[name], **shown)
        lower.plot(over.index, over[name], **shown)
    upper.set(title="(a) within the hour", xlabel="time in the hour (min)")
    lower.set(title="(b) over the hours", xlabel="time from calibration to start (h)")
    for axes in (upper, lower):
        axes.set(ylabel="error (gf)", ylim=(0, None))
    drawn.legend(*upper.get_legend_handles_labels(), loc="outside lower center", fontsize=9)
    return drawn


@figure("2.H", Provenance.SIMULATED)
def figure_2_h() -> Figure:
    """Draw the error of what is left out over the bandwidth."""
    drawn, axes = sheet(3.4)
    voltage, force = weight_points()
    points, tried = voltage[:, None], tried_bandwidths(voltage[:, None])
    for whole, colour, dash in ((False, ORANGE, "--"), (True, BLUE, "-")):
        groups = force if whole else None
        errors = [left_out_error(points, force, float(b), groups=groups) for b in tried]
        label = "a weight at a time" if whole else "a point at a time"
        axes.plot(tried, np.array(errors) / GRAM_FORCE, dash, color=colour, label=label)
        best = weight_bandwidth(whole)
        least = left_out_error(points, force, best, groups=groups) / GRAM_FORCE
        axes.plot([best], [least], "o", color=VERMILION, label=f"best, {label}")
    axes.set(xlabel="bandwidth (V)", ylabel="error (gf)", xscale="log")
    # Readings of a weight that are alike leave no error.
    axes.set_yscale("symlog", linthresh=LINEAR_BELOW)
    axes.set_ylim(-LINEAR_BELOW / 5, None)
    axes.legend(*(x[::2] for x in axes.get_legend_handles_labels()), loc="lower right")
    return drawn


def _measured(weighing: Weighing) -> str:
    return f"{weighing.measured / GRAM_FORCE:.2f} ± {weighing.deviation / GRAM_FORCE:.2f}"


@table("2.2", Provenance.SIMULATED)
def table_2_2_beside_ours() -> pd.DataFrame:
    """Tabulate Table 2.2 beside the simulated layer."""
    ours = weighed_objects()
    return pd.DataFrame(
        {
            "object": name,
            "true": f"{row.true / GRAM_FORCE:.0f}",
            "printed": _measured(row),
            "accuracy": f"{100 * row.accuracy:.1f}",
            "simulated": _measured(ours[name]),
            "simulated accuracy": f"{100 * ours[name].accuracy:.1f}",
        }
        for name, row in table_2_2().items()
    )


@table("2.H", Provenance.PRINTED)
def table_2_h() -> pd.DataFrame:
    """Tabulate intervals and tests of Table 2.2."""
    rows = []
    for name, row in table_2_2().items():
        low, high = (limit / GRAM_FORCE for limit in row.interval())
        rows.append(
            {
                "object": name,
                "true": f"{row.true / GRAM_FORCE:.0f}",
                "mean, 95 %": f"{low:.2f} to {high:.2f}",
                "p of the bias": f"{row.bias_p:.3f}",
                "accuracy of the mean": f"{100 * row.accuracy:.1f}",
                "of one": f"{100 * row.accuracy_of_one:.1f}",
                "deviation (N)": f"{row.deviation:.4f}",
            }
        )
    every = table_2_2().values()
    rows.append(
        {
            "object": "mean",
            "true": "",
            "mean, 95 %": "",
            "p of the bias": "",
            "accuracy of the mean": f"{100 * np.mean([r.accuracy for r in every]):.1f}",
            "of one": f"{100 * np.mean([r.accuracy_of_one for r in every]):.1f}",
            "deviation (N)": f"{np.mean([r.deviation for r in every]):.4f}",
        }
    )
    return pd.DataFrame(rows)


@table("2.I", Provenance.SIMULATED)
def table_2_i() -> pd.DataFrame:
    """Tabulate the comparison of regressors."""
    return pd.DataFrame(
        {
            "regressor": name,
            "a fifth at random": f"{row[RANDOM]:.2f}",
            "a weight at a time": f"{row[WHOLE]:.2f}",
        }
        for name, row in (kept_comparison() / GRAM_FORCE).iterrows()
    )
