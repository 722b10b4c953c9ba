"""Figures of Chapter 4 on control: steps and a staircase."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from book.chapter_4.identified_model import IdentifiedModel, identified_model
from book.chapter_4.pid_gains import pid_gains
from book.companion.exhibit import figure
from book.companion.style import GREY, LUDWICK, MEASURED, PRINTED, VERMILION, WIDTH
from softgrip.control.designs import linear_loop
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.minimum_time import farthest
from softgrip.control.pid import Gains
from softgrip.control.pressure_command import SET_PRESSURE
from softgrip.dynamics.second_order import full_state_space, state_space
from softgrip.logs.reader import kept_log, read_log
from softgrip.provenance import Provenance
from softgrip.units import DEG

STEPS = ("pid-actuator", "pid-full")
GAINS = "control/pid_gains.csv"


def loop(design: str, gains: Gains, model: IdentifiedModel, duration: float = 8.0) -> Any:
    """Run gains on the linear model that they were designed on, "actuator" or "full"."""
    if design == "actuator":
        return linear_loop(state_space(model.finger), gains, SET_PRESSURE, duration=duration)
    system = full_state_space(model.finger, model.pump_gain)
    return linear_loop(system, gains, SPEED_LIMIT, duration=duration)


@figure(
    "4.5",
    caption="A step to 60 deg with two PID controllers, tuned alike on different models: (a) on "
    "the finger alone, Eq. (4.14); (b) with the pump, Eq. (4.15). Each on its own linear model, "
    "and on a rig (those of the book on the *simulated* one). The text does not say how large its "
    "step was.",
    alt="Two panels of angle over time. On its own model controller (a) is at 60 degrees in half a "
    "second, on the simulated rig it swings for ten seconds. Controller (b) rises in about two "
    "seconds on both and stays near 60 degrees.",
    provenance=Provenance.SIMULATED,
    data=(*(f"simulated/{name}.csv" for name in STEPS), GAINS),
)
def figure_4_5(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw both controllers on their models and on a rig; ``logs`` gives two of another rig."""
    drawn = Figure(figsize=(WIDTH, 5.2))
    model = identified_model()
    panels = drawn.subplots(2, 1, sharex=True, sharey=True)
    paths = logs or tuple(kept_log(name) for name in STEPS)
    titles = ("(a) designed on the finger alone", "(b) designed on finger and pump")
    for axes, path, design, title in zip(panels, paths, ("actuator", "full"), titles, strict=True):
        log = read_log(path)
        axes.plot(log["time"], log["reference"] / DEG, color=PRINTED, lw=1, label="reference")
        axes.plot(
            log["time"], log["angle"] / DEG, color=MEASURED, lw=1, label=str(log.header.provenance)
        )
        found = loop(design, pid_gains(design), model)
        axes.plot(
            found.time, np.ravel(found.measured) / DEG, color=LUDWICK, ls="--", label="own model"
        )
        axes.set(title=title, ylabel="angle (deg)", xlim=(0, 15), ylim=(-5, 110))
    axes.set_xlabel("time (s)")
    handles, labels = panels[0].get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside upper center", ncols=3)
    return drawn


@figure(
    "4.7",
    caption="A staircase of 10 deg steps, held for 1.2 s each, with the controller of Figure 4.5 "
    "(b) on a rig (that of the book is the *simulated* one).",
    alt="The reference climbs to 60 degrees in steps and comes down again; the angle follows it as "
    "a smooth hill, about a second late.",
    provenance=Provenance.SIMULATED,
    data=("simulated/staircase.csv", GAINS),
)
def figure_4_7(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw the staircase; ``logs`` gives one of another rig."""
    drawn = Figure(figsize=(WIDTH, 3.2))
    axes = drawn.subplots()
    log = read_log((logs or (kept_log("staircase"),))[0])
    axes.plot(log["time"], log["reference"] / DEG, color=PRINTED, label="reference")
    axes.plot(
        log["time"], log["angle"] / DEG, color=MEASURED, lw=1, label=str(log.header.provenance)
    )
    axes.set(xlabel="time (s)", ylabel="angle (deg)")
    axes.legend(loc="upper right")
    return drawn


@figure(
    "4.C",
    caption="How far the finger can be moved in a given time by *any* controller within 5 rev/s, "
    "on the linear model of finger and pump that is identified from the simulated rig's logs. "
    "Dotted: the RMS error of the flex sensor, and the 0.2 s that the text gives for a commanded "
    "change.",
    alt="A curve that leaves the origin flat and then climbs; at 0.2 seconds it is still below the "
    "two degrees of the sensor's error.",
    provenance=Provenance.SIMULATED,
    data=("simulated/push-a.csv",),
)
def figure_4_c() -> Figure:
    """Draw the farthest angle that can be reached over time."""
    drawn = Figure(figsize=(WIDTH, 3.0))
    axes = drawn.subplots()
    time = np.linspace(0, 0.6, 25)
    axes.plot(time, _farthest(time) / DEG, color=LUDWICK)
    axes.axvline(0.2, color=GREY, ls=":")
    axes.axhline(2, color=VERMILION, ls=":")
    axes.set(xlabel="time (s)", ylabel="farthest (deg)", xlim=(0, 0.6), ylim=(0, None))
    return drawn


def _farthest(time: Any) -> Any:
    model = identified_model()
    return farthest(full_state_space(model.finger, model.pump_gain), SPEED_LIMIT, time)
