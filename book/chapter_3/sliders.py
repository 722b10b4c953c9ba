"""What the sliders of Chapter 3 move."""

from textwrap import wrap
from typing import Any

import control
import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from book.chapter_3.regulators import designed_on
from book.chapter_4.identified_model import IdentifiedModel, identified_model
from book.companion.finger_drawing import RUBBER, draw_bent, draw_section
from book.companion.style import BLUE, GREY, LINEAR, ORANGE, PRINTED, SKY, WIDTH, style
from book.explore import finger_picture
from book.explore.finger_picture import ACROSS, LENGTH, UP
from book.explore.plot import Band, Bent, Dimension, Level, Line, Outline, Panel, Plot
from book.explore.scan import Numbers, scan
from book.explore.settled import entered
from book.explore.small_matrices import times
from softgrip.actuator.bending import Finger, bending_angle, free_bending
from softgrip.actuator.design import (
    SCRIPT_MASS,
    SCRIPT_POWER,
    DesignProblem,
    FrequencyBand,
    InfeasibleDesignError,
)
from softgrip.actuator.frequency import natural_frequency
from softgrip.actuator.optimize import optimal_design
from softgrip.actuator.section import Section, torque
from softgrip.arrays import Number
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.lqr import derivatives_from_full_state, input_gain
from softgrip.control.pid import PERIOD
from softgrip.control.spectral_factor import spectral_gain
from softgrip.control.state_feedback import fed_back
from softgrip.dynamics.second_order import full_state_space
from softgrip.reads import remembered
from softgrip.units import DEG, MM, MPa


def _draw(finger: Finger, pressure: float, title: str, axis: tuple[float, float]) -> Figure:
    """Draw a section, its torque and its bending up to a pressure, Pa; `axis` holds axis ends."""
    section = finger.section
    over = np.linspace(0, pressure, 31)
    pushed, bent = torque(section, over), free_bending(finger, over) / DEG
    frequency = natural_frequency(finger, SCRIPT_MASS)
    with style(), mpl.rc_context({"figure.constrained_layout.use": False}):
        # Axes at fixed places: a layout engine would move them from frame to frame.
        drawn = Figure(figsize=(WIDTH, 3.8))
        left = drawn.add_axes((0.09, 0.54, 0.36, 0.36))
        side = drawn.add_axes((0.05, 0.1, 0.42, 0.36))
        upper = drawn.add_axes((0.6, 0.58, 0.34, 0.32))
        lower = drawn.add_axes((0.6, 0.15, 0.34, 0.32))
        draw_section(left, section)
        left.set(xlim=(-18, 18), ylim=(-8, 27), xlabel="mm", aspect="equal")
        left.set_title(title, fontsize=9.5)
        draw_bent(side, section, finger.length, bent[-1] * DEG, ORANGE, "bent")
        side.set(xlim=ACROSS, ylim=UP, aspect="equal")
        side.set_axis_off()
        drawn.text(0.09, 0.03, f"{frequency:.2f} rad/s with {SCRIPT_MASS} kg", fontsize=9.5)
        upper.plot(over / MPa, pushed, color=BLUE)
        upper.set(ylim=(0, 0.75), xlim=(0, axis[0]))
        upper.set_title(f"torque {pushed[-1]:.3f} N m", fontsize=9.5)
        lower.plot(over / MPa, bent, color=ORANGE)
        lower.set(ylim=(0, axis[1]), xlim=(0, axis[0]), xlabel="pressure (MPa)")
        lower.set_title(f"angle {bent[-1]:.0f} deg", fontsize=9.5)
        upper.tick_params(labelbottom=False)
    return drawn


LARGEST = 0.15
"""Pressure up to which a finger is drawn, MPa."""


def finger(top: Number, bottom: Number, wall: Number) -> dict[str, Any]:
    """Return a section 30 mm wide, its torque and bending over pressure, n as in the script.

    Args:
        top, bottom, wall: a, b and t, mm.
    """
    section = Section(top * MM, bottom * MM, 30 * MM, wall * MM)
    made = Finger(section, fractional_power=SCRIPT_POWER)
    over = np.linspace(0, LARGEST, 31)
    pushed, bent = torque(section, over * MPa), bending_angle(made, over * MPa) / DEG
    half, inner = section.width / 2 / MM, 15 - wall
    return {
        "rubber_x": [-half, half, half, -half],
        "rubber_y": [-bottom, -bottom, top, top],
        "a_ends": [0.0, top],
        "b_ends": [-bottom, 0.0],
        "t_ends": [inner, half],
        "chamber_x": [-inner, inner, inner, -inner],
        "chamber_y": [0.0, 0.0, top - wall, top - wall],
        "pressure": over,
        "torque": pushed,
        "angle": bent,
        "frequency": natural_frequency(made, SCRIPT_MASS),
        "most": pushed[-1],
        "widest": bent[-1],
    }


FINGER_PLOT = Plot(
    [
        Panel(
            [
                Outline("rubber_x", "rubber_y", "rubber", colour=GREY, fill=0.3),
                Outline("chamber_x", "chamber_y", "air", colour=SKY, fill=0.6),
                Level(0.0, label="neutral surface"),
                Dimension(-19.0, "a_ends", "a"),
                Dimension(-19.0, "b_ends", "b"),
                Dimension([-15.0, 15.0], -8.0, "w"),
                Dimension("t_ends", 10.0, "t"),
            ],
            x=(-21, 21), y=(-10, 26), x_label="mm", equal=True, share=0.5, left=36,
        ),
        Panel(
            [
                Outline([-8, 0, 0, -8], [-8, -8, 26, 26], colour=GREY, fill=0.5),
                Bent([0, LENGTH, LENGTH, 0], "rubber_y", "widest", LENGTH, colour=RUBBER),
            ],
            x=ACROSS, y=UP, equal=True, bare=True, share=0.5,
        ),
        Panel(
            [Line("pressure", "torque", "torque", colour=BLUE)],
            x=(0, LARGEST), y=(0, 0.75), x_label="pressure (MPa)", y_label="torque (N m)",
            height=230, share=0.5, left=40,
        ),
        Panel(
            [Line("pressure", "angle", "bending", colour=ORANGE)],
            x=(0, LARGEST), y=(0, 300), x_label="pressure (MPa)", y_label="angle (deg)",
            height=230, share=0.5, left=40,
        ),
    ],
    title=f"{{most:.3f}} N m and {{widest:.0f}} deg at {LARGEST:g} MPa, {{frequency:.2f}} rad/s",
)  # fmt: skip


def draw_best(low: float, pressure: float, modulus: float, width: float = 0.4) -> Figure:
    """Draw the best section for a frequency band, as Eq. (3.20) finds it, n and M as in the script.

    Args:
        low: Least frequency of the band, rad/s.
        pressure: MPa.
        modulus: Young's modulus, MPa.
        width: Of the band, rad/s.
    """
    problem = DesignProblem(
        pressure=pressure * MPa,
        young_modulus=modulus * MPa,
        fractional_power=SCRIPT_POWER,
        band=FrequencyBand(low, low + width),
    )
    try:
        section = optimal_design(problem).section
    except InfeasibleDesignError as error:
        return _refused(str(error))
    title = f"a {section.top / MM:.1f}, b {section.bottom / MM:.1f}, w {section.width / MM:.1f} mm"
    return _draw(problem.finger(section), pressure * MPa, title, (0.25, 500))


def _refused(message: str) -> Figure:
    """Draw what an infeasible problem says of itself."""
    with style():
        drawn = Figure(figsize=(WIDTH, 3.8))
        text = "\n".join(wrap(message.replace("; ", ";\n"), 58, replace_whitespace=False))
        drawn.text(0.04, 0.5, text, va="center", fontsize=9.5)
    return drawn


DURATION = 4.0
BAND = 0.05
"""Of the step, within which it is settled."""


@remembered
def _model() -> IdentifiedModel:
    return identified_model()


def lqr(p: Number, q2: Number, step: Number) -> dict[str, Any]:
    """Return a step of the regulator on the printed model, with the motor's limit.

    It is `limited_loop` a sample at a time, but for the rounding of the command to 1e-6 rad/s.

    Args:
        p, q2: Of Eq. (3.29); q_1 = 1, q_3 = 0 and R = 1.
        step: deg.
    """
    model = _model()
    finger, _ = designed_on("printed", model)
    w, z = finger.natural_frequency, finger.damping_ratio
    scale = SPEED_LIMIT / input_gain(finger, model.pump_gain, SPEED_LIMIT)
    gain = [scale * k for k in spectral_gain(2 * z * w, w**2, p, (1.0, q2, 0.0))]
    held = control.sample_system(full_state_space(finger, model.pump_gain), PERIOD, "zoh")
    moves, derivatives = np.hstack([held.A, held.B]), derivatives_from_full_state(finger)

    def sample(state: Numbers, row: Numbers, given: Numbers) -> tuple[Numbers, Numbers]:
        *plant, before, settled = state
        (time,), (*gain, final) = row, given
        angle, rate, acceleration = times(derivatives, plant)
        speed = fed_back(gain, final - angle, rate, acceleration)
        speed = np.minimum(np.maximum(speed, -SPEED_LIMIT), SPEED_LIMIT)
        excess = np.abs(angle / final - 1) - BAND
        settled = entered(time, PERIOD, before, excess, settled)
        out = angle / final, speed / SPEED_LIMIT, settled, excess
        return (*times(moves, plant, [speed]), excess, settled), out

    time = PERIOD * np.arange(round(DURATION / PERIOD) + 1)
    angle, share, settled, excess = scan(sample, [0.0] * 5, time, (*gain, step * DEG))
    return {
        "time": time,
        "angle": angle,
        "command": share,
        "settled": settled[-1],
        "late": 1.0 * (excess[-1] > 0),
    }


LQR_PLOT = Plot(
    [
        Panel(
            [
                Band([1 - BAND], [1 + BAND], label=f"within {100 * BAND:g} %", colour=PRINTED),
                Level(0.8, "x", "printed settling time", colour=PRINTED),
                Line("time", "command", "command u", colour=GREY, dash="6 3", step=True),
                Line("time", "angle", "angle / step", colour=LINEAR),
            ],
            x=(0, DURATION), y=(-1.1, 1.4), x_label="time (s)", y_label="share", share=0.64,
        ),
        finger_picture.finger("angle", "time", "step"),
    ],
    title=f"within {100 * BAND:g} % after {{settled:.2f}} s",
    cases=[("late", f"not within {100 * BAND:g} % in {DURATION:g} s")],
)  # fmt: skip
