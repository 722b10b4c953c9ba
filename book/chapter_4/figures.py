"""Figures of Chapter 4."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from book.chapter_4.controllers import own_loop
from book.chapter_4.identified_model import identified_model
from book.chapter_4.pushed import pushed
from book.companion.band import LABEL, shade
from book.companion.claims import printed, printed_text
from book.companion.exhibit import figure
from book.companion.own_logs import in_place
from book.companion.style import (
    GREY,
    LINEAR,
    LUDWICK,
    MEASURED,
    OTHER,
    PRINTED,
    VERMILION,
    WIDTH,
    sheet,
)
from softgrip.control.designs import NOISE
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.minimum_time import farthest
from softgrip.dynamics.second_order import full_state_space
from softgrip.logs.gaps import period_of
from softgrip.logs.pump import pump_of
from softgrip.logs.pushes import prior, reference_noise
from softgrip.logs.reader import kept_log, read_log
from softgrip.logs.steps import find_step
from softgrip.provenance import Provenance, data_folder
from softgrip.pump.capacity import estimate
from softgrip.pump.elastance import ElastanceModel
from softgrip.pump.flow import PARAMETER_SETS
from softgrip.pump.gas import ATMOSPHERE, capacity
from softgrip.pump.pressure import pressure
from softgrip.pump.printed_filter import open_loop_capacity, printed_filter, run_printed
from softgrip.units import DEG, ML, MM, MPa

GAS_VOLUME = 90 * ML
"""Air of a full 60 mL syringe and a finger with its tube, about 30 mL; it is not printed."""
PUSHES = ("push-a", "push-b", "push-c", "push-d")
PANELS = ("(a) default", "(b) larger syringe", "(c) smaller lead", "(d) higher speed")
HOLD = "simulated/step-60-1.csv"
STEPS = ("pid-actuator", "pid-full")


@figure("4.3", Provenance.PRINTED)
def figure_4_3() -> Figure:
    """Draw the pressure over time for each design parameter."""
    drawn = Figure(figsize=(WIDTH, 6.4))
    time = np.linspace(0, 6, 61)
    constant = capacity(ATMOSPHERE, GAS_VOLUME)
    names = ("larger area", "smaller lead", "higher speed")
    words = (
        f"A = {printed_text('table-4.1-area-200-ml')} m²",
        f"l = {printed('table-4.1-lead-monocarrier') / MM:g} mm",
        f"{printed_text('table-4.1-speed-higher')} rev/s",
    )
    for axes, letter, name, word in zip(
        drawn.subplots(3, 1, sharex=True), "abc", names, words, strict=True
    ):
        for label, run, look in (
            ("default", "default", {"color": LUDWICK}),
            (word, name, {"color": LINEAR, "ls": "--"}),
        ):
            rise = pressure(time, PARAMETER_SETS[run].flow, constant)
            axes.plot(time, rise / MPa, label=label, **look)
        axes.set(title=f"({letter}) {name}", ylabel="pressure (MPa)")
        axes.legend(loc="upper left")
    axes.set_xlabel("time (s)")
    return drawn


@figure("4.4", Provenance.SIMULATED)
def figure_4_4(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw the three models against four pushes; ``logs`` puts others in their place."""
    drawn = Figure(figsize=(WIDTH, 5.4))
    paths = logs or tuple(kept_log(name) for name in PUSHES)
    rows = -(-len(paths) // 2)
    panels = np.ravel(drawn.subplots(rows, 2, sharey=True, squeeze=False))
    names = PANELS if not logs else tuple(Path(path).stem for path in paths)
    for axes, path, name in zip(panels, paths, names, strict=False):
        _draw_push(axes, path, name)
    drawn.legend(
        *panels[0].get_legend_handles_labels(),
        loc="outside upper center",
        ncols=4,
        columnspacing=0.9,
    )
    return drawn


def _draw_push(axes: Any, path: Path | str, name: str) -> None:
    found = pushed(path)
    axes.plot(found.time, found.measured / MPa, color=MEASURED, lw=3, label=str(found.provenance))
    axes.plot(found.time, found.constant / MPa, color=LINEAR, ls="--", label="constant")
    axes.plot(found.time, found.modified / MPa, color=OTHER, ls="-.", label="modified")
    axes.plot(found.time, found.filtered / MPa, color=LUDWICK, ls=":", lw=2.2, label="filter")
    models = (found.constant, found.modified, found.filtered)
    errors = ", ".join(f"{100 * found.error(model):+.0f}" for model in models)
    axes.set_title(f"{name}\n{errors} %", fontsize=9.5)
    axes.set(xlabel="time (s)", ylabel="MPa", ylim=(0, None))


@figure("4.A", Provenance.SIMULATED)
def figure_4_a() -> Figure:
    """Draw the capacity by the printed filter and by the one that measures pressure."""
    drawn = Figure(figsize=(WIDTH, 3.2))
    noise, hold = reference_noise(), data_folder() / HOLD
    push = pushed(kept_log("push-a"), noise)
    angle = read_log(kept_log("push-a"))["angle"]
    seen = push.estimated.capacity
    turned = open_loop_capacity(angle, 1.0, 0.0)
    # Where noise pushes the elastance below zero the filter has no capacity.
    told = np.isfinite(seen)
    gain = float(turned[told] @ (seen - push.capacity)[told] / (turned[told] @ turned[told]))
    first, second = drawn.subplots(1, 2, sharey=True)
    _draw_capacity(first, push.time, angle, seen, push.estimated.capacity_std, gain)
    log = read_log(hold)
    flow = pump_of(hold, log).displacement * log["command"]
    model = ElastanceModel(period_of(log), noise, prior(push.capacity))
    held = estimate(log["pressure"], flow, log["angle"], model, time=log["time"])
    _draw_capacity(second, held.time, log["angle"], held.capacity, held.capacity_std, gain)
    first.set(title="pushing", xlabel="time (s)", ylabel="capacity (mL/MPa)", ylim=(0, 2600))
    second.set(title="holding 60 deg", xlabel="time (s)")
    first.legend(loc="upper left")
    return drawn


def _draw_capacity(axes: Any, time: Any, angle: Any, seen: Any, std: Any, gain: float) -> None:
    unit = ML / MPa
    kalman = printed_filter(
        gain,
        capacity=float(seen[0]),
        capacity_std=float(0.3 * seen[0]),
        capacity_step=0.0,
        angle_std=0.1,
        angle_step=0.02,
        sensor=0.035,
    )
    printed = run_printed(kalman, angle)[0][:, 0]
    axes.plot(time, printed / unit, color=VERMILION, ls="--", label="as printed")
    axes.plot(time, seen / unit, color=LUDWICK, label="with pressure")
    axes.fill_between(
        time, (seen - 2 * std) / unit, (seen + 2 * std) / unit, color=LUDWICK, alpha=0.2, lw=0
    )


@figure("4.5", Provenance.SIMULATED)
def figure_4_5(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw both controllers on their models and on a rig; ``logs`` gives those of another rig."""
    paths = in_place(logs, STEPS)
    drawn, rows = sheet(2.6 * len(paths), len(paths), 1, sharex=True, sharey=True, squeeze=False)
    panels = rows[:, 0]
    names = ("(a) designed on the finger alone", "(b) designed on finger and pump")
    titles = tuple(Path(path).name for path in logs) or names
    for axes, path, design, title in zip(panels, paths, ("actuator", "full"), titles, strict=False):
        if not logs:
            shade(axes, f"pid-{design}", MEASURED, label=LABEL)
        if logs:
            _draw_step(axes, path, design)
            axes.set(title=title, ylabel="angle (deg)")
            continue
        _draw_log(axes, path, lw=1)
        found = own_loop(design, duration=15.0)
        angle = np.ravel(found.measured) / DEG
        axes.plot(found.time, angle, color=LUDWICK, ls="--", label="own model")
        axes.set(title=title, ylabel="angle (deg)", xlim=(0, 15), ylim=(-5, None))
    panels[-1].set_xlabel("time since the step (s)" if logs else "time (s)")
    drawn.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return drawn


def _draw_step(axes: Any, path: Path | str, design: str) -> None:
    """Draw the step of a reader's log since its begin, and the book's model in the same step."""
    step = find_step(path)
    _draw_log(axes, path, lw=1, begun=step.begun)
    way = step.target - step.initial
    found = own_loop(design, duration=float(max(step.time[-1], 1.0)), step=abs(way))
    angle = (step.initial + np.sign(way) * np.ravel(found.measured)) / DEG
    model = "the book's model, same step"
    axes.plot(found.time, angle, color=LUDWICK, ls="--", label=model)


def _draw_log(axes: Any, path: Path | str, *, lw: float | None, begun: float = 0.0) -> None:
    """Draw reference and angle of a log since a time [s], the reference in a line of this width."""
    log = read_log(path)
    time = log["time"] - begun
    axes.plot(time, log["reference"] / DEG, color=PRINTED, lw=lw, label="reference")
    label = str(log.header.provenance)
    axes.plot(time, log["angle"] / DEG, color=MEASURED, lw=1, label=label)


@figure("4.7", Provenance.SIMULATED)
def figure_4_7(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw the staircase; ``logs`` gives one of another rig."""
    drawn, axes = sheet(3.2)
    if not logs:
        shade(axes, "staircase", MEASURED, label=LABEL)
    _draw_log(axes, in_place(logs, ("staircase",))[0], lw=None)
    axes.set(xlabel="time (s)", ylabel="angle (deg)")
    drawn.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return drawn


@figure("4.C", Provenance.SIMULATED)
def figure_4_c() -> Figure:
    """Draw the farthest angle that can be reached over time."""
    drawn, axes = sheet(3.0)
    time, model = np.linspace(0, 0.6, 25), identified_model()
    reached = farthest(full_state_space(model.finger, model.pump_gain), SPEED_LIMIT, time)
    axes.plot(time, reached / DEG, color=LUDWICK)
    axes.axvline(printed("4.4-time-to-change"), color=GREY, ls=":")
    axes.axhline(NOISE / DEG, color=VERMILION, ls=":")
    axes.set(xlabel="time (s)", ylabel="farthest (deg)", xlim=(0, 0.6), ylim=(0, None))
    return drawn
