"""Chapter 3, figures and tables: the regulator of Section 3.4."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from book.chapter_3.regulators import designed_on, regulator
from book.chapter_4.identified_model import identified_model
from book.companion.band import LABEL, shade
from book.companion.choices import choice
from book.companion.exhibit import figure, table
from book.companion.own_logs import in_place
from book.companion.simulated_logs import STEP_DURATION
from book.companion.style import (
    BLUE,
    GREEN,
    GREY,
    LINEAR,
    MEASURED,
    PRINTED,
    VERMILION,
    WIDTH,
    sheet,
)
from softgrip.control.limited_lqr import best_within_limit, limited_loop
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.lqr import FINGER, Weights, linear_settling_time, lqr_gain, step_response
from softgrip.control.lqr_bound import (
    certificate,
    closed_loop_poles,
    settling_at_the_bound,
    settling_floor,
)
from softgrip.control.minimum_time import largest_step, minimum_settling_time
from softgrip.control.rig_controller import Tracking
from softgrip.control.step_metrics import settling_time
from softgrip.dynamics.second_order import full_state_space
from softgrip.logs.reader import read_log
from softgrip.logs.steps import StepResponse, judge_step, judge_step_log
from softgrip.provenance import Provenance
from softgrip.reads import remembered
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.fitted_rigs import design_1
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG

LOGS = ("lqr-printed", "lqr-fast")
FASTER = Weights(p=30_000.0, q=(1.0, 0.03, 0.0))
"""Weights with which the linear loop settles within 2 % in 0.8 s."""
PRINTED_TIME = 0.8
BANDS = {"2 %": 0.02, "5 %": 0.05, "10 %": 0.1}


def step_size() -> float:
    """Return the step of Figure 3.12, rad: fitted, as none is printed."""
    return choice("lqr_step")


def criteria() -> tuple[float, float, float]:
    """Return bands of settling times, shares of the step: two usual ones, and the fitted one."""
    return 0.02, 0.05, choice("lqr_band") / step_size()


RUNS = 100
SHARE = (5, 95)
"""Of the runs, percent: between which a table says where they lie."""
STEPS = np.arange(10, 91, 10)
"""Of Figure 3.D, deg."""
RATE = Weights().q[1]
"""The printed weight on the rate."""
P = np.logspace(0, 6, 37)
"""The p of Figure 3.C."""


@figure("3.12", Provenance.SIMULATED)
def figure_3_12(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw both regulators on their models and on a rig; ``logs`` gives those of another rig."""
    paths = in_place(logs, LOGS)
    drawn = Figure(figsize=(WIDTH, 3.5 * len(paths)))
    panels = drawn.subplots(2 * len(paths), 1, sharex=True, height_ratios=(2, 1) * len(paths))
    model = identified_model()
    places = ("printed", "(a) printed weights"), ("fast", "(b) faster design")
    for k, (path, (design, title)) in enumerate(zip(paths, places, strict=False)):
        angle, command = panels[2 * k : 2 * k + 2]
        log = read_log(path)
        finger, weights = designed_on(design, model)
        step = float(log["reference"][-1])
        found = limited_loop(finger, model.pump_gain, lqr_gain(finger, weights), step)
        rig = str(log.header.provenance)
        angle.plot(log["time"], log["reference"] / DEG, color=PRINTED, lw=1, label="reference")
        if not logs and design == "printed":
            shade(angle, "lqr", MEASURED, label=LABEL)
        angle.plot(log["time"], log["angle"] / DEG, color=MEASURED, lw=1, label=rig)
        angle.plot(found.time, found.measured / DEG, color=LINEAR, ls="--", label="own model")
        # A row of a log tells the command that was held until its time.
        command.step(log["time"], log["command"] / SPEED_LIMIT, color=MEASURED, lw=0.7, where="pre")
        command.step(found.time, found.command / SPEED_LIMIT, color=LINEAR, ls="--", where="post")
        angle.axvline(PRINTED_TIME, color=GREY, ls=":")
        angle.set(title=title, ylabel="angle (deg)", xlim=(0, 6), ylim=(-5, None))
        command.set(ylabel="u", ylim=(-1.1, 1.1))
    panels[-1].set_xlabel("time (s)")
    drawn.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return drawn


@figure("3.C", Provenance.PRINTED)
def figure_3_c() -> Figure:
    """Draw poles and settling times over p."""
    drawn, (poles_axes, time_axes) = sheet(5.2, 2, 1, sharex=True)
    poles = np.array([closed_loop_poles(FINGER, Weights(p=x)) for x in P]).real
    poles_axes.semilogx(P, poles[:, 0], color=BLUE, label="real pole")
    poles_axes.semilogx(P, poles[:, 1], color=GREY, ls="-.", label="pair")
    poles_axes.axhline(
        certificate(FINGER, Weights()).pole_bound, color=VERMILION, ls="--", lw=1, label="bound"
    )
    poles_axes.set(ylabel="real part (rad/s)", ylim=(-6, 0.2))
    poles_axes.legend(loc="lower left")
    as_printed = settling_over_p(RATE).T
    for name, settled, colour in zip(BANDS, as_printed, (BLUE, LINEAR, GREEN), strict=True):
        time_axes.loglog(P, settled, color=colour, label=f"within {name}")
    time_axes.loglog(
        P, settling_over_p(RATE / 10)[:, 0], color=BLUE, ls="--", label="2 %, a tenth of q2"
    )
    time_axes.axhline(PRINTED_TIME, color=PRINTED, ls=":")
    for axes in (poles_axes, time_axes):
        axes.axvline(Weights().p, color=PRINTED, ls=":")
    time_axes.set(xlabel="p", ylabel="settling time (s)", ylim=(0.4, 30))
    time_axes.set_yticks([0.5, 1, 2, 5, 10, 20], ["0.5", "1", "2", "5", "10", "20"])
    time_axes.legend(loc="upper right")
    return drawn


@remembered
def settling_over_p(q2: float) -> Any:
    """Return the settling times of the linear loop within each of `BANDS`, s, row by row of `P`."""
    rows = []
    for p in P:
        time, angle = step_response(FINGER, Weights(p=float(p), q=(1.0, q2, 0.0)))
        rows.append([settling_time(time, angle, final=1.0, band=b) for b in BANDS.values()])
    return np.array(rows)


@figure("3.D", Provenance.SIMULATED)
def figure_3_d() -> Figure:
    """Draw the bound on any controller, and the regulator, over the step."""
    drawn, axes = sheet(3.2)
    model = identified_model()
    for (name, band), colour in zip(BANDS.items(), (BLUE, LINEAR, GREEN), strict=True):
        least = [least_time(float(step), band) for step in STEPS]
        axes.plot(STEPS, least, "o-", color=colour, label=f"within {name}")
    reached = best_within_limit(model.finger, model.pump_gain, STEPS * DEG, 0.02)
    axes.plot(STEPS, [best.time for best in reached], color=BLUE, ls="--", label="LQR, 2 %")
    axes.axhline(PRINTED_TIME, color=PRINTED, ls=":")
    axes.set(xlabel="step (deg)", ylabel="settling time (s)", xlim=(0, 95), ylim=(0, None))
    axes.legend(loc="lower right")
    return drawn


@remembered
def least_time(step: float, band: float) -> float:
    """Return the least settling time of any controller on the identified finger, s.

    Args:
        step: deg.
        band: Share of the step.
    """
    model = identified_model()
    system, change = full_state_space(model.finger, model.pump_gain), step * DEG
    return minimum_settling_time(system, change, SPEED_LIMIT, band=band * change)


@table("3.C", Provenance.SIMULATED)
def table_3_c(logs: tuple[Path | str, ...] = ()) -> pd.DataFrame:
    """Tabulate settling times under each criterion; ``logs`` gives those of another rig."""
    model = identified_model()
    limits = [settling_at_the_bound(Weights(), band) for band in criteria()]
    floors = [settling_floor(FINGER, Weights(), band) for band in criteria()]
    least = [least_time(step_size() / DEG, band) for band in criteria()]
    rows = [
        ("printed weights", "linear", *_linear(Weights())),
        ("p to infinity", "linear", *(f"{x:.2f}" for x in limits), "0"),
        ("any p, proved", "linear", *(f"above {x:.2f}" for x in floors), "0"),
        ("p = 3e4, q2 = 0.03", "linear", *_linear(FASTER)),
        ("any controller", "5 rev/s", *(f"{x:.2f}" for x in least), "0"),
    ]
    paths = in_place(logs, LOGS)
    names = (("printed weights", "printed"), ("faster design", "fast"))
    for path, (words, design) in zip(paths, names, strict=False):
        finger, weights = designed_on(design, model)
        own = limited_loop(
            finger, model.pump_gain, lqr_gain(finger, weights), step_size(), duration=STEP_DURATION
        )
        rig = f"{read_log(path).header.provenance} rig"
        rows += [
            (
                words,
                "5 rev/s",
                *_told(
                    judge_step(
                        own.time, own.measured, step_size(), window=0, band=choice("lqr_band")
                    )
                ),
            ),
            (words, rig, *_told(judge_step_log(path, band=choice("lqr_band")))),
            (words, f"simulated, {RUNS} runs", *_told(_runs(design))),
        ]
    return pd.DataFrame(
        rows,
        columns=[
            "design",
            "run on",
            "2 %",
            "5 %",
            f"{choice('lqr_band') / DEG:.1f} deg",
            "error (deg)",
        ],
    )


def _linear(weights: Weights) -> list[str]:
    return [*(f"{linear_settling_time(FINGER, weights, band):.2f}" for band in criteria()), "0"]


def _runs(design: str) -> StepResponse:
    rig = Simulation(design_1(), runs=RUNS, seed=SEED)
    made = drive(rig, Tracking(regulator(design), step_size()), duration=STEP_DURATION)
    return judge_step(made.time, made.measured.angle[:, 0].T, step_size(), band=choice("lqr_band"))


def _told(found: StepResponse) -> list[str]:
    times = (found.settled_2_percent, found.settled_5_percent, found.settled)
    return [
        *(_spread(time, "{:.2f}") for time in times),
        _spread(found.steady_state_error / DEG, "{:+.1f}"),
    ]


def _spread(values: Any, form: str) -> str:
    # Nearest: between a time and never there is nothing to interpolate.
    low, middle, high = (
        form.format(x) if np.isfinite(x) else "never"
        for x in np.percentile(values, [SHARE[0], 50, SHARE[1]], method="nearest")
    )
    return middle if np.size(values) == 1 else f"{middle} ({low} to {high})"


@table("3.D", Provenance.SIMULATED)
def table_3_d() -> pd.DataFrame:
    """Tabulate the largest step that can settle in the printed time."""
    columns = {"identified": False, "as printed": True}
    return pd.DataFrame(
        {"within": name, **{words: f"{settled_step(band, as_printed=printed):.1f}"
                            for words, printed in columns.items()}}
        for name, band in BANDS.items()
    )  # fmt: skip


@remembered
def settled_step(band: float, *, as_printed: bool = False) -> float:
    """Return the largest step that any controller settles in the printed time, deg.

    Args:
        band: Share of the step.
        as_printed: Whether the finger has the printed frequency and damping ratio.
    """
    model = identified_model()
    finger = designed_on("printed", model)[0] if as_printed else model.finger
    plant = full_state_space(finger, model.pump_gain)
    return float(largest_step(plant, SPEED_LIMIT, PRINTED_TIME, band=band)) / DEG
