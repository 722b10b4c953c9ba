"""Chapter 6, figures and tables: many grippers at once, and the best feedforward in the limit."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from book.chapter_6 import finger_count
from book.chapter_6.filters import label
from book.companion.claims import claim_of
from book.companion.exhibit import figure, table
from book.companion.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    LUDWICK,
    ORANGE,
    OTHER,
    PURPLE,
    VERMILION,
    sheet,
)
from softgrip.arrays import Floats
from softgrip.gripper.batch_loop import unaware
from softgrip.gripper.gripper_batch import GripperBatch, Trial, can_rest, draw_grippers
from softgrip.gripper.internal_model import ControllerMatrices, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.monte_carlo import Outcome, simulate
from softgrip.gripper.optimal_feedforward import FeedforwardProgram
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.reach import project
from softgrip.gripper.shaping_filter import filter_state_space
from softgrip.gripper.uncertainty import STIFFNESS_BOUND
from softgrip.provenance import Provenance
from softgrip.reads import remembered
from softgrip.units import DEG, REV

PAIRS, SEED = 10_000, 6
TARGET = tuple(project(PRINTED, [45 * DEG] * 2).reached.tolist())
LIMIT, IN_TIME, HIGH = 5.0, 1.5, 95
"""Of the commands; when the best of them settle the nominal pair, s; a high percentile."""
LATEST = 2.5
"""Settling time up to which the best commands are looked for, s."""
BANDS = (0.02, 0.05)
LIMITS = {"1 (u a share)": 1.0, "5 (u in rev/s)": 5.0, "31.4 (u in rad/s)": 5 * REV}
"""The largest command by what U may be: the text names no unit of it."""
BEST = "best feedforward"
CONTROLS = {"4.8/s": (ORANGE, "--"), "2/s": (LUDWICK, "-"), BEST: (OTHER, "-.")}
"""The printed loops by their filters, the best command beside them, and how each is drawn."""


def printed_loop(name: str) -> ControllerMatrices:
    """Return Figure 6.3 with a printed H(s), at 100 ms; its model does not know the limit."""
    low_pass = filter_state_space(*FILTERS[name])
    return unaware(controller_matrices(PRINTED, mean_inverse(PRINTED), low_pass))


@remembered
def outcome(name: str, *, pairs: int = PAIRS) -> Outcome:
    """Return what comes of drawn pairs, or of the nominal one alone with ``pairs=1``."""
    grippers = draw_grippers(PRINTED, pairs, seed=SEED) if pairs > 1 else GripperBatch.of(PRINTED)
    if name != BEST:
        return simulate(grippers, printed_loop(name), Trial(TARGET, limit=LIMIT, bands=BANDS))
    best = FeedforwardProgram(PRINTED, TARGET, limit=LIMIT).settled_by(IN_TIME)
    trial = Trial(TARGET, limit=LIMIT, bands=BANDS, feedforward=tuple(best.command.tolist()))
    return simulate(grippers, None, trial)


@figure("6.D", Provenance.SIMULATED)
def figure_6_d() -> Figure:
    """Draw what more fingers and more spread cost."""
    drawn, (top, low) = sheet(5.0, 2, 1, sharex=True)
    points = finger_count.KEPT.read()
    styles = zip((BLUE, ORANGE, GREEN, PURPLE), ("-", "--", "-.", ":"), strict=True)
    for count, (colour, line) in zip(finger_count.COUNTS, styles, strict=True):
        own = [p for p in points if p.fingers == count]
        spread = [100 * p.spread for p in own]
        for axes, values in (
            (top, [p.worst_residual for p in own]),
            (low, [100 * p.worst_sync for p in own]),
        ):
            axes.plot(spread, values, color=colour, ls=line, label=f"{count} fingers")
    for axes in (top, low):
        axes.axvline(100 * STIFFNESS_BOUND, color=GREY, lw=0.8, label="printed spread")
    top.set(title="(a) kept at rest", ylabel="error (deg)", ylim=(0, None), xlim=(0, 20))
    low.set(title="(b) on the way", xlabel="spread of the stiffness (± %)", ylabel="difference (%)")
    low.set_ylim(0, None)
    top.legend(loc="upper left")
    return drawn


def settling_times(name: str) -> Floats:
    """Return the settling times of the pairs that do, within the wider of the bands, s."""
    times = outcome(name).settling[1].max(axis=1)
    return np.asarray(times[np.isfinite(times)])


APART = np.arange(0, 26, 1.0)
"""Edges of the bins of a histogram, percent."""


@figure(
    "6.E", Provenance.SIMULATED, sources=f"drawn from seed {SEED}; plant and filters of Section 6.4"
)
def figure_6_e() -> Figure:
    """Draw the histograms of settling time and synchronization."""
    drawn, (top, low) = sheet(5.6, 2, 1)
    for name, (colour, line) in CONTROLS.items():
        found, times = outcome(name), settling_times(name)
        for axes, values, edges, words in (
            (top, times, np.arange(0, 3.01, 0.1), f"{label(name)}: {times.size / PAIRS:.0%}"),
            (low, 100 * found.synchronization, APART, label(name)),
        ):
            share = 100 * np.histogram(values, edges)[0] / PAIRS
            middle = (edges[:-1] + edges[1:]) / 2
            axes.plot(middle, share, ds="steps-mid", color=colour, ls=line, label=words)
    top.set(title="(a) both settled", xlabel="time (s)", ylabel="pairs (%)", xlim=(0, 3))
    low.set(title="(b) farthest apart", xlabel="difference (%)", ylabel="pairs (%)", xlim=(0, 25))
    top.set_ylim(0, 20)
    top.legend(loc="upper left")
    low.legend(loc="upper right")
    return drawn


@remembered
def trade_off(limit: float) -> tuple[Floats, Floats]:
    """Return the times by which commands within a limit settle the pair, s, and what that costs.

    From the first that can be kept on: the least largest difference, a share of the way.
    """
    best = FeedforwardProgram(PRINTED, TARGET, limit=limit).trade_off(LATEST)
    times, apart = np.array([(b.settling, b.worst_sync) for b in best]).T
    return times, apart


@figure(
    "6.F",
    Provenance.PRINTED,
    sources="computed from Eq. (6.27) by linear programs; nothing measured",
)
def figure_6_f() -> Figure:
    """Draw the least difference over the settling time."""
    drawn, axes = sheet(3.6)
    styles = ((BLACK, "-"), (BLUE, "--"), (VERMILION, "-."))
    for (name, limit), (colour, line) in zip(LIMITS.items(), styles, strict=True):
        times, apart = trade_off(limit)
        axes.plot(times, 100 * apart, color=colour, ls=line, marker=".", label=f"limit {name}")
    for name in FILTERS:
        found = outcome(name, pairs=1)
        when = float(found.settling[0].max())
        if np.isfinite(when):
            apart = 100 * found.synchronization[0]
            axes.plot(when, apart, "^", color=CONTROLS[name][0], label=label(name))
    axes.axvline(float(claim_of(6, "6.4-settling-fast").printed), color=GREY, ls=":")
    axes.set(xlabel="both within 2 % after (s)", ylabel="farthest apart (%)")
    axes.set(xlim=(0.5, 2.6), ylim=(0, None))
    axes.legend(loc="upper right")
    return drawn


@table(
    "6.E", Provenance.SIMULATED, sources=f"drawn from seed {SEED}; plant and filters of Section 6.4"
)
def table_6_e() -> pd.DataFrame:
    """Tabulate what comes of the pairs."""
    rows = []
    for name in CONTROLS:
        found = outcome(name)
        when = found.settling.max(axis=2)
        settled = np.isfinite(when)
        median, most = np.percentile(found.synchronization, [50, HIGH])
        rows.append(
            {
                "control": label(name),
                "within 2 %": f"{settled[0].mean():.0%}",
                "within 5 %": f"{settled[1].mean():.0%}",
                "time (s)": f"{np.median(when[1, settled[1]]):.2f}",
                "apart (%)": f"{100 * median:.1f}",
                f"apart, {HIGH}th (%)": f"{100 * most:.1f}",
            }
        )
    drawn = draw_grippers(PRINTED, PAIRS, seed=SEED)
    possible = {
        f"within {100 * b:.0f} %": f"{can_rest(drawn, TARGET, b).mean():.0%}" for b in BANDS
    }
    return pd.DataFrame([*rows, {"control": "at all possible", **possible}]).fillna("")


@table(
    "6.F",
    Provenance.PRINTED,
    sources="computed from Eq. (6.27) by linear programs; nothing measured",
)
def table_6_f() -> pd.DataFrame:
    """Tabulate the least settling times."""
    rows = []
    for name, limit in LIMITS.items():
        row = {"limit": name}
        for band in (0.02, 0.05, 0.1):
            first = next(FeedforwardProgram(PRINTED, TARGET, limit, band).trade_off())
            row[f"{100 * band:.0f} %"] = f"{first.settling:.1f}"
        rows.append(row)
    return pd.DataFrame(rows)
