"""Figures of Chapter 4."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from book.companion.exhibit import figure
from book.companion.style import LINEAR, LUDWICK, MEASURED, OTHER, VERMILION, WIDTH
from softgrip.logs.gaps import intervals
from softgrip.logs.pump import pump_of
from softgrip.logs.pushes import compare, prior, reference_noise
from softgrip.logs.reader import kept_log, read_log
from softgrip.provenance import Provenance, data_folder
from softgrip.pump.capacity import estimate
from softgrip.pump.elastance import ElastanceModel
from softgrip.pump.flow import PARAMETER_SETS
from softgrip.pump.gas import ATMOSPHERE, capacity
from softgrip.pump.pressure import pressure
from softgrip.pump.printed_filter import printed_filter, run_printed
from softgrip.units import ML, MPa

GAS_VOLUME = 90 * ML
"""Air of a full 60 mL syringe and a finger with its tube, about 30 mL; it is not printed."""
PUSHES = ("push-a", "push-b", "push-c", "push-d")
PANELS = (
    "(a) default",
    "(b) larger syringe",
    "(c) smaller lead",
    "(d) higher speed",
)
HOLD = "simulated/step-60-1.csv"


@figure(
    "4.3",
    caption="Pressure by Eq. (4.5) for the values of Table 4.1, one changed at a time. The "
    "capacity is not printed; here it is that of 90 mL of air at atmospheric pressure, held "
    "constant. It sets the scale of all lines alike, and their ratios not at all.",
    alt="Three panels of straight lines from the origin. A larger syringe makes the pressure rise "
    "2.5 times as fast, a quarter of the lead makes it rise a quarter as fast, and double the "
    "motor speed twice as fast.",
    provenance=Provenance.PRINTED,
)
def figure_4_3() -> Figure:
    """Draw the pressure over time for each design parameter."""
    drawn = Figure(figsize=(WIDTH, 6.4))
    time = np.linspace(0, 6, 61)
    constant = capacity(ATMOSPHERE, GAS_VOLUME)
    names = ("larger area", "smaller lead", "higher speed")
    words = ("A = 16.62e-4 m²", "l = 2 mm", "3.30 rev/s")
    for axes, letter, name, word in zip(
        drawn.subplots(3, 1, sharex=True), "abc", names, words, strict=True
    ):
        default, changed = PARAMETER_SETS["default"], PARAMETER_SETS[name]
        axes.plot(
            time, pressure(time, default.flow, constant) / MPa, color=LUDWICK, label="default"
        )
        axes.plot(
            time, pressure(time, changed.flow, constant) / MPa, color=LINEAR, ls="--", label=word
        )
        axes.set(title=f"({letter}) {name}", ylabel="pressure (MPa)")
        axes.legend(loc="upper left")
    axes.set_xlabel("time (s)")
    return drawn


@figure(
    "4.4",
    caption="Pushes (those of the book of the *simulated* rig) against three models: capacity held "
    "constant, Eq. (4.5), fitted below 0.03 MPa; capacity that changes with the swept volume, "
    "Eq. (4.7), fitted to the whole push; and the capacity that a Kalman filter holds at each "
    "sample. In (b) the 200 mL syringe starts with 60 mL of air like the others; full, it would "
    "rise about as slowly as (a). The models' largest errors above 0.10 MPa are in the titles.",
    alt="Four panels of pressure over time. The simulated pressure curves upward; the constant "
    "model runs straight and stays far below it at high pressure, the modified model follows it "
    "closely, and the filter lags a little behind.",
    provenance=Provenance.SIMULATED,
    data=tuple(f"simulated/{name}.csv" for name in PUSHES),
)
def figure_4_4(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw the three models against four pushes; ``logs`` puts others in their place."""
    drawn = Figure(figsize=(WIDTH, 5.4))
    paths = logs or tuple(kept_log(name) for name in PUSHES)
    rows = -(-len(paths) // 2)
    panels = np.ravel(drawn.subplots(rows, 2, sharey=True, squeeze=False))
    names = PANELS if not logs else tuple(Path(path).stem for path in paths)
    for axes, path, name in zip(panels, paths, names, strict=False):
        _draw_push(axes, path, name)
    handles, labels = panels[0].get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside upper center", ncols=4, columnspacing=0.9)
    return drawn


def _draw_push(axes: Any, path: Path | str, name: str) -> None:
    found = compare(path)
    axes.plot(found.time, found.measured / MPa, color=MEASURED, lw=3, label=str(found.provenance))
    axes.plot(found.time, found.constant / MPa, color=LINEAR, ls="--", label="constant")
    axes.plot(found.time, found.modified / MPa, color=OTHER, ls="-.", label="modified")
    axes.plot(found.time, found.filtered / MPa, color=LUDWICK, ls=":", lw=2.2, label="filter")
    models = (found.constant, found.modified, found.filtered)
    errors = ", ".join(f"{100 * found.error(model):+.0f}" for model in models)
    axes.set_title(f"{name}\n{errors} %", fontsize=9.5)
    axes.set(xlabel="time (s)", ylabel="MPa", ylim=(0, 0.17))


@figure(
    "4.A",
    caption="The capacity as two filters have it, on the *simulated* rig: while the pump pushes, "
    "and while it holds a bent finger. The filter as printed, Eq. (4.8) to (4.10), cannot see the "
    "capacity: with the gain that fits the push best it goes on falling while nothing moves. The "
    "filter that uses the pressure is moved by the pressure that still falls while the finger "
    "bends, then rests; its band of two standard deviations opens, for with the pump at rest "
    "nothing tells of the capacity. The flex sensor ends at 100 deg, which the push passes at 2.3 "
    "s: what the printed filter is given from then on is constant.",
    alt="Two panels of capacity over time. During the push both filters fall. During the hold the "
    "printed filter goes on falling in a straight line; the other rises by a third within three "
    "seconds and is then level, in a band that widens.",
    provenance=Provenance.SIMULATED,
    data=("simulated/push-a.csv", HOLD),
)
def figure_4_a() -> Figure:
    """Draw the capacity by the printed filter and by the one that measures pressure."""
    drawn = Figure(figsize=(WIDTH, 3.2))
    push, hold = compare(kept_log("push-a")), data_folder() / HOLD
    angle = read_log(kept_log("push-a"))["angle"]
    seen = push.estimated.capacity
    turned = np.cumsum(angle) - angle
    gain = float(turned @ (seen - push.capacity) / (turned @ turned))
    first, second = drawn.subplots(1, 2, sharey=True)
    _draw_capacity(first, push.time, angle, seen, push.estimated.capacity_std, gain)
    log = read_log(hold)
    flow = pump_of(hold, log).displacement * log["command"]
    model = ElastanceModel(log.header.period, reference_noise(), prior(push.capacity))
    steps = intervals(log["time"], log.header.period)
    held = estimate(log["pressure"], flow, log["angle"], model, steps=steps)
    _draw_capacity(second, held.time, log["angle"], held.capacity, held.capacity_std, gain)
    first.set(title="pushing", xlabel="time (s)", ylabel="capacity (mL/MPa)", ylim=(0, 2200))
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
