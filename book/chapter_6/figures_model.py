"""Chapter 6, figures and tables: the linear model, what one pump reaches, how the loop does it."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from book.chapter_6 import filters
from book.chapter_6.numbers import COMPARED
from book.companion.claims import claim_of
from book.companion.exhibit import figure, table
from book.companion.style import BLACK, BLUE, GREEN, GREY, ORANGE, PRINTED, PURPLE, VERMILION, sheet
from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.step_metrics import settling_time
from softgrip.gripper.gripper_loop import run_gripper
from softgrip.gripper.internal_model import PERIOD, InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED as GRIPPER
from softgrip.gripper.printed_loop import FILTERS, FINE, equal_targets, run_printed
from softgrip.gripper.reach import outside_share, project
from softgrip.gripper.robustness import (
    box,
    continuous_stability,
    sampled_stability,
    structured_gain,
)
from softgrip.gripper.shaping_filter import (
    FAST,
    bandwidth,
    far_pole,
    filter_state_space,
    plant_inside,
    rounding_margin,
)
from softgrip.gripper.synchronization import synchronization_error
from softgrip.gripper.uncertainty import deviation, finger_response
from softgrip.provenance import Provenance
from softgrip.reads import remembered
from softgrip.units import DEG, REV

SPA = (BLUE, GREEN)
"""Colours of the two fingers: the text draws the first one blue, the second one green."""

PUSH, PUSHED = 0.2, (1.4, 2.4)
"""Push on SPA 1, the left one of the text [rad], from when to when [s]; the start is printed."""
NOISE = 2 * DEG
"""Of the sensors, RMS, rad (Section 6.4)."""


def push(time: float) -> tuple[float, float]:
    """Return what pushes the fingers, rad."""
    return (PUSH if PUSHED[0] <= time < PUSHED[1] else 0.0), 0.0


@figure("6.6", Provenance.PRINTED)
def figure_6_6() -> Figure:
    """Draw the step, the step with noise, and the step with a push."""
    drawn, panels = sheet(6.0, 3, 1, sharex=True, sharey=True)
    runs = {
        "(a) nominal": run_printed(period=FINE),
        "(b) sensor noise": run_printed(noise=NOISE),
        "(c) push on SPA 1": run_printed(push=push),
    }
    for axes, (title, found) in zip(panels, runs.items(), strict=True):
        for k, goal in enumerate(equal_targets()):
            axes.plot(found.time, found.angles[k] / DEG, color=SPA[k], label=f"SPA {k + 1}")
            axes.axhline(goal / DEG, color=PRINTED, ls="--", lw=1)
        axes.set(title=title, ylabel="angle (deg)", xlim=(0, 5), ylim=(0, 80))
    panels[2].axvspan(*PUSHED, color=GREY, alpha=0.15, lw=0)
    panels[2].set_xlabel("time (s)")
    panels[0].legend(loc="lower right", ncols=2)
    return drawn


LOW_TO_HIGH = np.geomspace(0.05, 100, 300)
"""Frequencies at which targets are split, rad/s."""
ASKED = {"equal angles": np.ones(2), "nearest at rest": equal_targets()}
"""Targets, of which only the direction matters."""


def apart(target: str) -> tuple[Floats, Floats]:
    """Return the time [s], and how far the fingers are apart [rad] by a printed filter."""
    found = run_printed(target, period=FINE)
    return found.time, synchronization_error(found.angles, equal_targets())


@figure("6.A", Provenance.PRINTED)
def figure_6_a() -> Figure:
    """Draw the unreachable share over frequency and the synchronization error over time."""
    drawn, (upper, lower) = sheet(4.8, 2, 1)
    for words, colour, dash in (("equal angles", VERMILION, "-"), ("nearest at rest", BLUE, "--")):
        share = 100 * outside_share(GRIPPER, ASKED[words], LOW_TO_HIGH)
        upper.semilogx(LOW_TO_HIGH, share, color=colour, ls=dash, label=words)
    upper.set(title="(a)", xlabel="frequency (rad/s)", ylabel="outside Im P (%)", ylim=(0, 10))
    upper.legend(loc="center left")
    for name, colour in zip(FILTERS, (BLUE, ORANGE), strict=True):
        time, difference = apart(name)
        lower.plot(time, difference / DEG, color=colour, label=filters.label(name))
    measured = float(claim_of(6, "6.4-measured-transient-difference").printed)
    lower.axhline(measured, color=GREY, ls=":", label="printed, measured")
    lower.set(title="(b)", xlabel="time (s)", ylabel="apart (deg)", xlim=(0, 4), ylim=(0, None))
    lower.legend(loc="upper right")
    return drawn


@figure("6.B", Provenance.PRINTED)
def figure_6_b() -> Figure:
    """Draw the printed filters, those of the rule, and the peaks by which the rule is known."""
    drawn, (upper, lower) = sheet(6.0, 2, 1, sharex=True)
    for (name, printed), colour in zip(FILTERS.items(), (BLUE, ORANGE), strict=True):
        c = filters.CROSSOVER[name]
        ours = filters.designed(name, c, filters.author_plant())
        gain = np.abs(filter_state_space(*printed)(1j * COMPARED)).ravel()
        upper.loglog(COMPARED, gain, color=colour, label=f"{name}, printed")
        few = COMPARED[::8]
        upper.loglog(few, np.abs(ours.complementary(1j * few)), "o", ms=3, color=colour, mfc="none",
                     label=f"{name}, by the rule for {c:g}/s")  # fmt: skip
        loop = filters.as_printed(name)
        lower.semilogx(COMPARED, loop.mixed_sensitivity(COMPARED), color=colour, label="peaks")
        used = loop.coprime_gain(COMPARED) * loop.largest_margin * filters.KEPT
        lower.semilogx(COMPARED, used, color=colour, ls="--", label="margin used")
    upper.set(title="(a)", ylabel="|H|", ylim=(1e-4, 2))
    upper.legend(loc="lower left")
    lower.axhline(1, color=GREY, lw=1)
    lower.set(title="(b)", xlabel="frequency (rad/s)", ylabel="mixed sensitivity", ylim=(0.4, 2))
    lower.legend(*(part[:2] for part in lower.get_legend_handles_labels()), loc="upper right")
    return drawn


PERIODS, DELAYS = np.linspace(0.01, 0.3, 30), (0, 1, 2)
"""Sampling periods, s, and by how many of them the command is late."""


@figure("6.C", Provenance.PRINTED)
def figure_6_c() -> Figure:
    """Draw the stability margin over the period, by discretisation and delay."""
    drawn, axes = sheet(3.4)
    for delay, colour in zip(DELAYS, (BLUE, ORANGE, PURPLE), strict=True):
        for method, dash in (("bilinear", "-"), ("zoh", "--")):
            label = f"{delay} late" if method == "bilinear" else None
            axes.plot(PERIODS, margins(method, delay), color=colour, ls=dash, label=label)
    axes.plot([], [], color=BLACK, label="bilinear rule")
    axes.plot([], [], color=BLACK, ls="--", label="as if held")
    axes.axhline(0, color=GREY, lw=1)
    axes.axvline(PERIOD, color=GREY, ls=":")
    axes.set(xlabel="period (s)", ylabel="margin", xlim=(0, 0.3), ylim=(-0.3, 0.2))
    axes.legend(loc="lower left", ncols=2)
    return drawn


@remembered
def margins(method: str, delay: int) -> Floats:
    """Return the worst margin of the corners of the box at each of `PERIODS`.

    ``method`` is as of `controller_matrices`.
    """
    corners = box(GRIPPER, points=2)
    return np.array([_margin(float(period), method, delay, corners) for period in PERIODS])


def _margin(period: float, method: Any, delay: int, corners: Any) -> float:
    matrices = controller_matrices(
        GRIPPER, mean_inverse(GRIPPER), filter_state_space(*FAST), period=period, method=method
    )
    return min(sampled_stability(matrices, real, delay_samples=delay).margin for real in corners)


CRITERIA = {"2 %": 0.02, "5 %": 0.05, "6.9 %": 0.069, "7 %": 0.07, "10 %": 0.1, "1 deg": DEG}
"""Half widths of the settling band: shares of the target, or an angle.

Two lie on either side of the overshoot of SPA 1.
"""


@table("6.A", Provenance.PRINTED)
def table_6_a() -> pd.DataFrame:
    """Tabulate projections and residuals."""
    rows = []
    for words, angle in (("π/3", np.pi / 3), ("0.333 π", 0.333 * np.pi), ("π/4", np.pi / 4)):
        found = project(GRIPPER, [angle, angle])
        row = {"both fingers": words}
        for k in (0, 1):
            row[f"proj, SPA {k + 1}"] = f"{found.reached[k] / np.pi:.4f}"
            row[f"residual, SPA {k + 1}"] = f"{found.residual[k] / np.pi:.4f}"
            row[f"deg, SPA {k + 1}"] = f"{found.reached[k] / DEG:.2f}"
        rows.append(row)
    return pd.DataFrame(rows)


@table("6.B", Provenance.PRINTED)
def table_6_b() -> pd.DataFrame:
    """Tabulate the filters, what can be read from them, and what the rule gives."""
    columns = {}
    for name, printed in FILTERS.items():
        low_pass = filter_state_space(*printed)
        (damping, stiffness), slack = plant_inside(*printed), rounding_margin(*printed)
        s = 1e-4j
        loop = low_pass(s).item() / (1 - low_pass(s).item())
        author, c = filters.author_plant(), filters.CROSSOVER[name]
        peaks = filters.as_printed(name)
        free = filters.designed(name, c, author, hold=False)
        columns[name] = {
            "gain at 0": f"{low_pass(0).item().real:.4f}",
            "bandwidth (rad/s)": f"{bandwidth(low_pass):.2f}",
            "largest gain": f"{np.abs(low_pass(1j * COMPARED)).max():.3f}",
            "relative degree": f"{len(printed[1]) - len(printed[0])}",
            "loop at low frequency": f"{abs(loop * s):.3f}/s",
            "plant inside, 1/s": f"{damping:.3f} ± {slack[0]:.3f}",
            "plant inside, 1/s²": f"{stiffness:.3f} ± {slack[1]:.3f}",
            "peaks are equal for (rad/s)": f"{filters.crossover_of_peaks(*printed):.3f}",
            "kept of the largest margin": f"{peaks.margin / peaks.largest_margin:.4f}",
            "far pole (rad/s)": f"{far_pole(*printed):.1f}",
        }
        for words, finger, crossover in (
            ("author's plant", author, c),
            ("author's plant, c as named", author, float(name.removesuffix("/s"))),
            ("SPA 1", GRIPPER.fingers[0], c),
            ("SPA 2", GRIPPER.fingers[1], c),
            ("mean finger", GRIPPER.mean, c),
        ):
            off = filters.deviations(name, filters.designed(name, crossover, finger))
            columns[name][f"off, {words} (%)"] = f"{np.abs(off).max():.2f}"
        columns[name]["far pole left free (rad/s)"] = f"{np.abs(free.controller.poles()).max():.0f}"
        columns[name]["and the peak lower by (%)"] = f"{100 * (1 - free.cost / peaks.cost):.2f}"
    return pd.DataFrame(columns).rename_axis("named for the target loop").reset_index()


@table("6.C", Provenance.PRINTED)
def table_6_c() -> pd.DataFrame:
    """Tabulate settling times by criterion."""
    rows = []
    for name, angle, claim in (
        ("4.8/s", np.pi / 3, "6.4-simulated-settling"),
        ("4.8/s", np.pi / 4, "6.4-settling-fast"),
        ("2/s", np.pi / 4, "6.4-settling-slow"),
    ):
        for period in (FINE, PERIOD):
            found = run_printed(name, period=period, angle=angle)
            row = {"H": name, "step": f"{angle / DEG:.0f} deg", "period (s)": f"{period:g}"}
            for words, band in CRITERIA.items():
                settled = settling_time(
                    found.time,
                    found.angles,
                    final=equal_targets(angle),
                    band=band,
                    absolute="deg" in words,
                )
                row[words] = f"{settled[0]:.2f}, {settled[1]:.2f}"
            rows.append(row | {"printed": claim_of(6, claim).printed})
    return pd.DataFrame(rows)


@table("6.D", Provenance.PRINTED)
def table_6_d() -> pd.DataFrame:
    """Tabulate what the motor's limit does."""
    rows = []
    for name, printed in FILTERS.items():
        matrices = controller_matrices(GRIPPER, mean_inverse(GRIPPER), filter_state_space(*printed))
        free = run_printed(name, duration=8.0)
        for unit, limit in (("rad/s", SPEED_LIMIT), ("rev/s", SPEED_LIMIT / REV)):
            row = {
                "H": name,
                "unit": unit,
                "peak of u": f"{np.abs(free.commands).max():.1f}",
                "integral of u": f"{free.commands.sum() * PERIOD:.3f}",
                "peak over limit": f"{np.abs(free.commands).max() / limit:.2f}",
            }
            for words, known in (("model knows", limit), ("model does not", np.inf)):
                controller = InternalModelController(matrices, equal_targets(), limit=known)
                found = run_gripper(GRIPPER, controller, duration=8.0, limit=limit, points=1)
                row[f"end, {words}"] = f"{found.angles[0, -1] / equal_targets()[0]:.2f}"
            rows.append(row)
    return pd.DataFrame(rows)


@table("6.G", Provenance.PRINTED)
def table_6_g() -> pd.DataFrame:
    """Tabulate robust stability."""
    around, inverse = box(GRIPPER, points=2), mean_inverse(GRIPPER)
    weights = np.array(
        [
            deviation(
                [finger_response(g.fingers[k], COMPARED) for g in around],
                finger_response(nominal, COMPARED),
            )
            for k, nominal in enumerate(GRIPPER.fingers)
        ]
    )
    rows, even = [], np.ones((2, 1))
    for name, printed in FILTERS.items():
        low_pass = filter_state_space(*printed)
        at = (GRIPPER, inverse, low_pass)
        matrices = controller_matrices(*at)
        rows.append(
            {
                "H": name,
                "largest weight": f"{weights.max():.3f}",
                "structured gain": f"{structured_gain(*at, weights, COMPARED).max():.3f}",
                "tolerated weight": f"{1 / structured_gain(*at, even, COMPARED).max():.2f}",
                "decay rate, continuous (1/s)": _worst(
                    continuous_stability(GRIPPER, real, inverse, low_pass).margin for real in around
                ),
                **{
                    f"margin at 100 ms, {delay} late": _worst(
                        sampled_stability(matrices, real, delay_samples=delay).margin
                        for real in around
                    )
                    for delay in DELAYS
                },
            }
        )
    return pd.DataFrame(rows)


def _worst(margins: Iterable[float]) -> str:
    return f"{min(margins):.3f}"
