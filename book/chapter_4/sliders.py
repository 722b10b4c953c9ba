"""What the sliders of Chapter 4 move."""

from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from book.chapter_4.controllers import own_loop
from book.chapter_4.pid_gains import pid_gains
from book.chapter_4.pushed import pushed
from book.companion.choices import choice
from book.companion.style import LINEAR, LUDWICK, MEASURED, PRINTED, VERMILION, still, style
from book.explore.plot import Bars, Level, Line, Panel, Plot
from softgrip.arrays import Number
from softgrip.control.pid import Gains
from softgrip.control.step_metrics import settling_time
from softgrip.logs.pushes import reference_noise
from softgrip.logs.reader import kept_log
from softgrip.pump.finger import Finger
from softgrip.pump.flow import TABLE_4_1, Pump, flow
from softgrip.pump.gas import ATMOSPHERE, capacity, closed_volume_pressure
from softgrip.pump.parts import MOTORS, SCREWS, SYRINGES
from softgrip.pump.pressure import pressure
from softgrip.pump.sizing import loads
from softgrip.units import DEG, ML, MM, REV, MPa

VOLUMES = {"60 mL": 60 * ML, "200 mL": 200 * ML}
BESIDE = 30 * ML
"""Air in finger and tube, beside that of the full syringe; assumed."""
AREAS = dict(zip(("60 mL", "200 mL"), TABLE_4_1["area"], strict=True))


def pump(syringe: str, lead: Number, speed: Number) -> dict[str, Any]:
    """Return the pressure of a full syringe by Eq. (4.5) and by the exact gas law.

    Args:
        syringe: "60 mL" or "200 mL".
        lead: mm.
        speed: Motor speed, rev/s.
    """
    air = flow(speed * REV, Pump(AREAS[syringe], lead * MM))
    full = VOLUMES[syringe]
    gas = full + BESIDE
    time = np.linspace(0, 1, 80) * np.minimum(20.0, 0.92 * full / air)
    linear = pressure(time, air, capacity(ATMOSPHERE, gas))
    exact = closed_volume_pressure(air * time, gas) - ATMOSPHERE
    return {"time": time, "gas": exact / MPa, "constant": linear / MPa, "flow": air / ML}


PUMP_PLOT = Plot(
    [
        Panel(
            [
                Level(0.15, label="0.15 MPa"),
                Line("time", "gas", "gas law, syringe and 30 mL closed", colour=MEASURED),
                Line("time", "constant", "Eq. (4.5), C constant", colour=LINEAR, dash="6 3"),
            ],
            x=(0, 20), y=(0, 0.2), x_label="time (s)", y_label="pressure (MPa)",
        )
    ],
    title="{syringe}: {flow:.1f} mL/s",
)  # fmt: skip


def draw_filter(noise: float) -> Figure:
    """Draw what the filter holds of a simulated push, with its capacity noise scaled.

    Args:
        noise: Factor on the estimated noise of the elastance.
    """
    levels = reference_noise()
    scaled = replace(levels, elastance_step=noise * levels.elastance_step)
    found = pushed(kept_log("push-a"), scaled)
    seen, std = found.estimated.capacity, found.estimated.capacity_std
    unit = ML / MPa
    with style():
        drawn, axes = still(3.0)
        low, high = (seen - 2 * std) / unit, (seen + 2 * std) / unit
        axes.fill_between(found.time, low, high, color=LUDWICK, alpha=0.2, lw=0)
        axes.plot(found.time, seen / unit, color=LUDWICK, label="filter, simulated push")
        axes.axhline(found.capacity / unit, color=LINEAR, ls="--", label="constant")
        error = 100 * found.error(found.filtered)
        axes.set(xlabel="time (s)", ylabel="capacity (mL/MPa)", ylim=(0, 2000))
        axes.set_title(f"largest error above 0.10 MPa: {error:+.0f} %")
        axes.legend(loc="upper right")
    return drawn


PARTS = [*product(SYRINGES, SCREWS, MOTORS)]
NAMES = [
    f"{syringe.name}, {screw.name}, {motor.name.removeprefix('NEMA 17, ')}"
    for syringe, screw, motor in PARTS
]
MARGIN = 1.5


def sizing(pressure: Number, volume: Number, rise: Number) -> dict[str, Any]:
    """Return the torque that each combination of parts has over what it needs.

    Args:
        pressure: Wanted gauge pressure, MPa.
        volume: Of the finger at rest, mL; at pressure it holds a quarter more.
        rise: Rise time, s.
    """
    wanted = Finger(pressure * MPa, volume * ML, 1.25 * volume * ML, 2 * ML, rise)
    margins, fit = [], []
    for syringe, screw, motor in PARTS:
        swept, speed, _, needed, available = loads(wanted, syringe, screw, motor, syringe.volume)
        margins.append(available / needed)
        fit.append(
            1.0
            * (swept <= syringe.volume)
            * (speed <= motor.speed_limit)
            * (available >= MARGIN * needed)
        )
    return {"margin": margins, "fits": fit, "count": sum(fit), "all": float(len(PARTS))}


SIZING_PLOT = Plot(
    [
        Panel(
            [
                Bars("margin", NAMES, "fits", colour=LUDWICK, other=VERMILION,
                     label="can do it; else vermilion"),
                Level(MARGIN, "x", "1.5 times what it needs"),
            ],
            x=(0, 8), y=NAMES, x_label="torque over need", left=168, height=330,
        )
    ],
    title="{count:.0f} of {all:.0f} can do it",
)  # fmt: skip


def draw_pid(kp: float, ki: float, kd: float) -> Figure:
    """Draw the step of the (4.15) controller on its model, with scaled gains.

    Args:
        kp, ki, kd: Factors on the tuned gains.
    """
    tuned = pid_gains("full")
    gains = Gains(kp * tuned.kp, ki * tuned.ki, kd * tuned.kd, tuned.derivative_filter)
    found, step = own_loop("full", gains), choice("pid_step")
    angle = np.ravel(found.measured)
    settled = float(settling_time(found.time, angle, final=step, band=0.05))
    with style():
        drawn, axes = still(3.0)
        axes.axhspan(0.95 * step / DEG, 1.05 * step / DEG, color=PRINTED, alpha=0.2, lw=0)
        axes.plot(found.time, angle / DEG, color=LUDWICK)
        words = f"within 5 % after {settled:.1f} s" if settled < 8 else "not within 5 % in 8 s"
        axes.set(xlabel="time (s)", ylabel="angle (deg)", xlim=(0, 8), ylim=(0, 160), title=words)
    return drawn
