"""What the sliders of Chapter 4 draw."""

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator

from book.chapter_4.controllers import own_loop
from book.chapter_4.pid_gains import pid_gains
from book.chapter_4.pushed import pushed
from book.companion.choices import choice
from book.companion.style import GREY, LINEAR, LUDWICK, MEASURED, PRINTED, VERMILION, still, style
from softgrip.control.pid import Gains
from softgrip.control.step_metrics import settling_time
from softgrip.logs.pushes import reference_noise
from softgrip.logs.reader import kept_log
from softgrip.pump.finger import Finger
from softgrip.pump.flow import TABLE_4_1, Pump, flow
from softgrip.pump.gas import ATMOSPHERE, capacity, closed_volume_pressure
from softgrip.pump.pressure import pressure
from softgrip.pump.sizing import sizings
from softgrip.units import DEG, ML, MM, REV, MPa

VOLUMES = {"60 mL": 60 * ML, "200 mL": 200 * ML}
BESIDE = 30 * ML
"""Air in finger and tube, beside that of the full syringe; assumed."""
AREAS = dict(zip(("60 mL", "200 mL"), TABLE_4_1["area"], strict=True))


def draw_pump(syringe: str, lead: float, speed: float) -> Figure:
    """Draw the pressure of a full syringe by Eq. (4.5) and by the exact gas law.

    Args:
        syringe: "60 mL" or "200 mL".
        lead: mm.
        speed: Motor speed, rev/s.
    """
    air = flow(speed * REV, Pump(AREAS[syringe], lead * MM))
    full = VOLUMES[syringe]
    gas = full + BESIDE
    time = np.linspace(0, min(20.0, 0.92 * full / air), 80)
    linear = pressure(time, air, capacity(ATMOSPHERE, gas))
    exact = closed_volume_pressure(air * time, gas) - ATMOSPHERE
    with style():
        drawn, axes = still(3.0)
        axes.plot(time, exact / MPa, color=MEASURED, label=f"gas law, {gas / ML:.0f} mL closed")
        axes.plot(time, linear / MPa, color=LINEAR, ls="--", label="Eq. (4.5), C constant")
        axes.axhline(0.15, color=GREY, lw=1, ls=":")
        axes.set(xlabel="time (s)", ylabel="pressure (MPa)", xlim=(0, 20), ylim=(0, 0.2))
        axes.set_title(f"{air / ML:.1f} mL/s")
        axes.xaxis.set_major_locator(MultipleLocator(5))
        axes.legend(loc="lower right")
    return drawn


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


def draw_sizing(pressure: float, volume: float, rise: float) -> Figure:
    """Draw the torque that each combination of parts has over what it needs.

    Args:
        pressure: Wanted gauge pressure, MPa.
        volume: Of the finger at rest, mL; at pressure it holds a quarter more.
        rise: Rise time, s.
    """
    finger = Finger(pressure * MPa, volume * ML, 1.25 * volume * ML, 2 * ML, rise)
    judged = sizings(finger)[::-1]
    names = [
        f"{s.syringe.name}, {s.screw.name}, {s.motor.name.removeprefix('NEMA 17, ')}"
        for s in judged
    ]
    with style():
        drawn, axes = still(3.6, left=0.36)
        colours = [LUDWICK if s.feasible else VERMILION for s in judged]
        axes.barh(names, [min(s.margin, 8) for s in judged], color=colours)
        axes.axvline(1.5, color=GREY, ls="--", lw=1)
        count = sum(s.feasible for s in judged)
        axes.set(
            xlabel="torque over need", xlim=(0, 8), title=f"{count} of {len(judged)} can do it"
        )
        axes.tick_params(axis="y", labelsize=8.5)
    return drawn


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
