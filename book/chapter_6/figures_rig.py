"""Chapter 6, figures and tables: the experiments, steps, uncertainty, control, a push."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from book.chapter_6 import filters
from book.chapter_6 import speed as gripper_speed
from book.chapter_6.comparison import ENTRIES, RIGS, criteria, judged, robustness_margin
from book.chapter_6.logs import names_of
from book.chapter_6.results import (
    bounds,
    desired,
    ends,
    identified,
    identified_without_noise,
    largest_weight,
    recovery,
)
from book.companion.band import LABEL, shade
from book.companion.choices import choice
from book.companion.exhibit import figure, table
from book.companion.style import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PRINTED,
    SKY,
    VERMILION,
    YELLOW,
    sheet,
)
from softgrip.arrays import Floats
from softgrip.control.step_metrics import final_value
from softgrip.errors import InvalidInputError
from softgrip.gripper.plant import FingerDynamics
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.uncertainty import bounding_weight, deviation, excited_band, finger_response
from softgrip.logs.fingers import GripperLogs, each_identified, read_runs, run_deviation
from softgrip.provenance import Provenance, data_folder
from softgrip.units import DEG, REV

MODELLED = np.geomspace(0.5, 80, 100)
"""Frequencies at which identified models are compared, rad/s."""
SIDES = (("left", BLUE, "-"), ("right", GREEN, "--"))
PRINTED_BAND = {"6.4": (6.0, 63.0), "6.5": (6.0, 50.0)}
"""rad/s, that the text calls excited."""


def groups(logs: Sequence[Path | str], kinds: Sequence[str]) -> list[GripperLogs]:
    """Read logs in equal parts, one for each kind; those of the book if none are given."""
    paths = [*logs] or [data_folder() / name for kind in kinds for name in names_of(kind)]
    size, rest = divmod(len(paths), len(kinds))
    if not size or rest:
        raise InvalidInputError(
            "logs", expected=f"as many runs of each of {len(kinds)} tests", got=len(paths)
        )
    return [read_runs(paths[size * k : size * (k + 1)]) for k in range(len(kinds))]


def _steps(axes: Any, time: Floats, runs: Floats, colour: str, dash: str, label: str) -> None:
    """Draw runs of angles [rad], shape (runs, N), and their mean."""
    angles = runs / DEG
    axes.plot(time, angles.T, color=colour, lw=0.4, alpha=0.5, label="_runs")
    axes.plot(time, angles.mean(axis=0), color=colour, ls=dash, label=label)


def model_deviation(models: Sequence[FingerDynamics], frequency: Floats) -> Floats:
    """Return `deviation` of models, their mean response being nominal, shape (N,)."""
    found = np.array([finger_response(model, frequency) for model in models])
    return deviation(found, found.mean(axis=0))


def _bands(axes: Any, runs: GripperLogs, printed: tuple[float, float]) -> None:
    excited = excited_band(runs.commands[0, 1:], runs.period, share=choice("excited_share"))
    axes.axvspan(*excited, color=YELLOW, alpha=0.3, lw=0, label="excited")
    axes.axvspan(*printed, fill=False, ec=PRINTED, ls=":", label="printed as excited")
    axes.axvline(np.pi / runs.period, color=VERMILION, lw=1)


def _bound(axes: Any) -> None:
    axes.set(xscale="log", yscale="log", xlabel="frequency (rad/s)", ylabel="deviation")
    axes.set_title("(b) bound on |W|")


@figure("6.4", Provenance.SIMULATED)
def figure_6_4(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw repeated steps and their deviations; ``logs`` gives runs of another gripper."""
    (runs,) = groups(logs, ("open",))
    drawn, (steps, weights) = sheet(6.2, 2, 1)
    _bands(weights, runs, PRINTED_BAND["6.4"])
    frequency = MODELLED
    identified_by_finger = each_identified(runs)
    for k, (side, colour, dash) in enumerate(SIDES):
        if not logs:
            shade(steps, f"open-{side}", colour, label="_band" if k else LABEL)
        _steps(steps, runs.time, runs.angles[:, k], colour, dash, side)
        weights.plot(*run_deviation(runs, k), ".", color=colour, ms=3, label=f"{side}, records")
        bound = model_deviation(identified_by_finger[k], frequency)
        weights.plot(frequency, bound, dash, color=colour, label=f"{side}, models")
        fitted = np.abs(bounding_weight(frequency, bound)(1j * frequency)).ravel()
        weights.plot(frequency, fitted, ":", color=colour, lw=1.2, label=f"{side}, weight")
    steps.set(title="(a) steps in open loop", xlabel="time (s)", ylabel="angle (deg)")
    steps.legend(loc="lower right")
    _bound(weights)
    weights.set(xlim=(0.5, 80), ylim=(0.01, 30))
    drawn.legend(*weights.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return drawn


@figure("6.5", Provenance.SIMULATED)
def figure_6_5(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw steps at two speeds; ``logs`` gives other runs, those at high speed first.

    The histogram is then that of these runs.
    """
    both = groups(logs, ("open", "low-speed"))
    spreads = {spread.speed: spread for spread in gripper_speed.kept_errors()}
    words = (
        ("high speed", BLUE, "-", gripper_speed.printed_speed("high")),
        ("low speed", ORANGE, "--", gripper_speed.printed_speed("low")),
    )
    drawn, (steps, weights, errors) = sheet(7.4, 3, 1)
    ends = [final_value(runs.time, runs.angles[:, 0], window=1.0) / DEG for runs in both]
    rests = [
        rest - rest.mean() if logs else spreads[speed].measured
        for rest, (*_, speed) in zip(ends, words, strict=True)
    ]
    most = np.ceil(np.abs(np.concatenate(rests)).max())
    bins = np.linspace(-most, most, 17).tolist()
    for runs, found, (label, colour, dash, _) in zip(both, rests, words, strict=True):
        pushed = runs.time[np.flatnonzero(runs.commands[0])[-1]]
        _steps(steps, runs.time - pushed, runs.angles[:, 0], colour, dash, label)
        weights.plot(*run_deviation(runs, 0), ".", color=colour, ms=4, label=label)
        look = {"color": colour, "ls": dash, "lw": 1.6, "histtype": "step"}
        errors.hist(found, bins, label=f"{label} ({found.std(ddof=1):.2f} deg)", **look)
    excited = "printed as excited"
    weights.axvspan(*PRINTED_BAND["6.5"], fill=False, ec=PRINTED, ls=":", label=excited)
    steps.set(title="(a) steps of the left finger", ylabel="angle (deg)")
    steps.set_xlabel("time since the push ended (s)")
    _bound(weights)
    errors.set(title="(c) errors at rest", xlabel="error (deg)", ylabel="runs")
    errors.set_ylim(top=1.5 * errors.get_ylim()[1])  # leaves room for the legend
    errors.legend(loc="upper right")
    steps.legend(loc="lower right")
    weights.legend(loc="lower right")
    return drawn


@figure("6.7", Provenance.SIMULATED)
def figure_6_7(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw the three experiments; ``logs`` gives others: open, 4.8/s, 2/s, pushed."""
    free, fast, slow, pushed = groups(logs, ("open", "fast", "slow", "push"))
    drawn, panels = sheet(7.4, 3, 1)
    for k, (side, colour, dash) in enumerate(SIDES):
        _steps(panels[0], free.time, free.angles[:, k], colour, dash, side)
        mean = slow.angles[:, k].mean(axis=0) / DEG
        panels[1].plot(slow.time, mean, dash, color=colour, label=f"{side}, 2/s")
        look = (SKY, ORANGE)[k], (":", "-.")[k], f"{side}, 4.8/s"
        _steps(panels[1], fast.time, fast.angles[:, k], *look)
        _steps(panels[2], pushed.time, pushed.angles[:, k], colour, dash, side)
        for axes in panels[1:]:
            axes.axhline(pushed.references[k, -1] / DEG, color=PRINTED, lw=0.8)
    times = [time for time, _ in pushed.events]
    if len(times) == 2:
        panels[2].axvspan(*times, color=GREY, alpha=0.3, lw=0)
    titles = ("(a) open loop", "(b) scheme of Figure 6.3", "(c) a push on the left finger")
    for axes, title in zip(panels, titles, strict=True):
        axes.set(title=title, ylabel="angle (deg)", ylim=(-5, 85))
        axes.legend(loc="upper left" if axes is panels[1] else "lower right", ncols=2)
    panels[2].set(xlabel="time (s)", ylim=(-5, 60))
    panels[0].set(ylim=(-5, 60))
    return drawn


ENDS = (5, 95)
"""Percent of the runs between which a measure is told."""


def middle_and_ends(values: Floats, scale: float = 1.0, digits: int = 1) -> str:
    """Return the median with the points at `ENDS`, such as ``2.3 [1.9, 2.8]``.

    A run that never settles is infinite, so the points are runs and not between them.
    """
    points = np.percentile(values, (50, *ENDS), method="nearest") / scale
    middle, low, high = (f"{x:.{digits}f}" if np.isfinite(x) else "never" for x in points)
    return f"{middle} [{low}, {high}]"


@table("6.H", Provenance.SIMULATED)
def table_6_h() -> pd.DataFrame:
    """Tabulate the controllers."""
    rows = []
    for name in ENTRIES:
        found, margin = judged(name), robustness_margin(name)
        _, _, other = name.partition(", ")
        rows.append(
            {
                "controller": f"same, {other}" if other else filters.label(name),
                "settled": middle_and_ends(found.settling["2 deg"]),
                "overshoot (%)": middle_and_ends(found.overshoot, 0.01, 0),
                "out of step": middle_and_ends(found.synchronization, DEG),
                "error": middle_and_ends(found.error, DEG),
                "peak": middle_and_ends(found.peak, REV),
                "tolerated": "any" if margin is None else f"{margin:.0%}",
            }
        )
    return pd.DataFrame(rows)


@table("6.I", Provenance.SIMULATED)
def table_6_i() -> pd.DataFrame:
    """Tabulate what is identified beside what is printed."""
    found, quiet = identified("open"), identified_without_noise()
    means = np.array([[(f.damping, f.stiffness) for f in runs] for runs in found]).mean(axis=1)
    noisy, bare = 100 * bounds(found), 100 * bounds(quiet)
    rows = [
        ("damping by mass (1/s)", "2.45 and 2.66", means[:, 0], "{:.2f}"),
        ("stiffness by mass (1/s²)", "3.06 and 3.61", means[:, 1], "{:.2f}"),
        ("largest deviation of the damping (%)", "14.3", noisy[:, 0], "{:.1f}"),
        ("the same without sensor noise (%)", "", bare[:, 0], "{:.1f}"),
        ("largest deviation of the stiffness (%)", "5.9", noisy[:, 1], "{:.1f}"),
        ("the same without sensor noise (%)", "", bare[:, 1], "{:.1f}"),
        ("angle at rest (deg)", "50 and 39.5", ends("open") / DEG, "{:.1f}"),
        ("reachable of 45 deg (deg)", "48.24 and 40.86", desired() / DEG, "{:.2f}"),
        ("back within 1 deg after a push on the left finger (s)", "", recovery(), "{:.1f}"),
    ]
    return pd.DataFrame(
        {"": what, "printed": text, "left": form.format(v[0]), "right": form.format(v[1])}
        for what, text, v, form in rows
    )


@table("6.J", Provenance.SIMULATED)
def table_6_j() -> pd.DataFrame:
    """Tabulate settling times by criterion."""
    rows = []
    for name in FILTERS:
        for rig in RIGS:
            found = judged(name, rig)
            times = {key: middle_and_ends(found.settling[key]).split()[0] for key in criteria()}
            rows.append(
                {
                    "filter": filters.label(name),
                    "gripper": rig,
                    **times,
                    "overshoot (%)": f"{100 * np.median(found.overshoot):.0f}",
                }
            )
    return pd.DataFrame(rows)


@table("6.K", Provenance.SIMULATED)
def table_6_k() -> pd.DataFrame:
    """Tabulate the spread over the speed."""
    return pd.DataFrame(
        {
            "speed (rev/s)": f"{spread.speed:.2g}",
            "true": f"{spread.true.std(ddof=1):.2f}",
            "measured": f"{spread.measured.std(ddof=1):.2f}",
            "weight (%)": _percent(largest_weight(spread.speed * REV)),
        }
        for spread in gripper_speed.kept_errors()
    )


def _percent(share: float | None) -> str:
    return "none" if share is None else f"{100 * share:.1f}"
