"""Figures of Chapter 3 on the models: which n, the optimum, and how the finger bends."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from book.chapter_3.torque_and_bending import (
    DESIGNS,
    LENGTH,
    blocked_torque,
    settled_angles,
)
from book.companion.band import LABEL, shade
from book.companion.exhibit import figure
from book.companion.finger_drawing import draw_bent, draw_section
from book.companion.style import (
    BLUE,
    GREEN,
    GREY,
    MEASURED,
    ORANGE,
    PRINTED,
    PURPLE,
    SKY,
    VERMILION,
    sheet,
)
from softgrip.actuator.bending import Finger, free_bending
from softgrip.actuator.design import SCRIPT_MASS, SCRIPT_POWER, DesignProblem, objective
from softgrip.actuator.fem_results import BEAM, CHAMBERS, FemResult, read
from softgrip.actuator.frequency import natural_frequency
from softgrip.actuator.optimize import optimal_design
from softgrip.actuator.printed import (
    ANGLE_POWER,
    FREQUENCY_MASS,
    FREQUENCY_POWER,
    SUM_POWER,
    WEIGHT_POWER,
    table_3_1,
    table_3_2,
)
from softgrip.actuator.section import Section, torque
from softgrip.provenance import Provenance
from softgrip.simulator.fitted_rigs import design_1
from softgrip.units import DEG, MM, MPa

DASHES = ("-", "--", "-.", ":", "--", "-.", ":")
COLOURS = (BLUE, SKY, GREEN, ORANGE, VERMILION, PURPLE, GREY)
SHOWN_FLOORS = (0.0, 6 * MM, 12 * MM)
DRAGON_SKIN, FX_PRO = 0.34 * MPa, 0.26 * MPa
PUSHED_TO, BENT_TO = 0.25 * MPa, 0.15 * MPa
"""The largest pressures of the tests of torque and of bending."""
SIDE_VIEWS = 6
STATED = DesignProblem(fractional_power=SCRIPT_POWER)
"""The problem of Section 3.3 without a band, with the n of the author's script."""
DOTS: dict[str, Any] = {"ls": "none", "ms": 4.5}
LOOK: dict[str, dict[str, Any]] = {
    "Design 1(E1)": {"marker": "o", "color": MEASURED, **DOTS},
    "Design 2(E1)": {"marker": "s", "color": PURPLE, "mfc": "none", **DOTS},
    "Design 3(E2)": {"marker": "^", "color": VERMILION, "mfc": "none", **DOTS},
}
"""How a tested design is drawn."""


def optimum() -> Section:
    """Return the best section of Table 3.1."""
    return table_3_1()["Opt. parameters"]


def bent(section: Section, pressure: ArrayLike = BENT_TO, *, modulus: float = DRAGON_SKIN) -> Any:
    """Return the angle of Eq. (3.10), deg, with the n that gives the printed one."""
    finger = Finger(section, young_modulus=modulus, fractional_power=ANGLE_POWER)
    return free_bending(finger, pressure) / DEG


def bent_on_rig(design: str, pressure: ArrayLike = (BENT_TO,)) -> Any:
    """Return the angle of a design on the simulated rig, deg: the mean of its runs."""
    return settled_angles(DESIGNS[design](), pressure).mean(axis=0) / DEG


@figure("3.3", Provenance.PRINTED)
def figure_3_3() -> Figure:
    """Draw the section with its dimensions."""
    drawn, axes = sheet(3.6)
    draw_section(axes, optimum())
    best = optimum()
    a, b, w, t = (x / MM for x in (best.top, best.bottom, best.width, best.wall))
    for name, start, end, place in (
        ("a", (18, 0), (18, a), (19, a / 2)),
        ("b", (18, -b), (18, 0), (19, -b / 2)),
        ("w", (-w / 2, -6.5), (w / 2, -6.5), (0, -8.7)),
        ("t", (-w / 2, 8), (-w / 2 + t, 8), (-w / 2 - 2.5, 8)),
    ):
        axes.annotate("", end, start, arrowprops={"arrowstyle": "<->", "shrinkA": 0, "shrinkB": 0})
        axes.text(place[0], place[1], name, ha="center", va="center", style="italic")
    axes.text(-w / 2 - 1, 0, "neutral\nsurface", ha="right", va="center", fontsize=9, color=GREY)
    axes.set(xlim=(-25, 23), ylim=(-11, 23), xlabel="mm", ylabel="mm", aspect="equal")
    return drawn


@figure("3.A", Provenance.PRINTED)
def figure_3_a() -> Figure:
    """Draw what n each of three printed results asks for."""
    drawn, axes = sheet(3.4)
    powers = np.linspace(1, 2.6, 81)
    fingers = [Finger(optimum(), fractional_power=float(n)) for n in powers]
    problems = [DesignProblem(fractional_power=float(n)) for n in powers]
    frequencies = [natural_frequency(f, FREQUENCY_MASS) / 2.62 for f in fingers]
    angles = [free_bending(f, BENT_TO) / (290 * DEG) for f in fingers]
    sums = [objective(p, optimum()) / 2.36 for p in problems]
    curves = (
        ("frequency, 2.62 rad/s, M in kg", frequencies, BLUE, "-", FREQUENCY_POWER),
        ("frequency, M in N", np.multiply(frequencies, 9.80665**0.5), SKY, "-", WEIGHT_POWER),
        ("angle, 290 deg", angles, ORANGE, "--", ANGLE_POWER),
        ("sum, 2.36", sums, GREEN, "-.", SUM_POWER),
    )
    for label, values, colour, dash, crossing in curves:
        axes.plot(powers, np.ravel(values), color=colour, ls=dash, label=label)
        axes.plot([crossing], [1], "o", color=colour)
    axes.axhline(1, color=GREY, lw=1)
    for printed in (2.174, 2.365, 2.5):
        axes.axvline(printed, color=GREY, ls=":", lw=1)
    axes.set(xlabel="n", ylabel="recomputed / printed", ylim=(0, 1.75), xlim=(1, 2.6))
    axes.legend(loc="upper center", ncols=1)
    return drawn


@figure("3.B", Provenance.PRINTED)
def figure_3_b() -> Figure:
    """Draw the objective over the heights above and below the neutral surface."""
    drawn, axes = sheet(3.6)
    bounds = STATED.bounds
    a, b = np.meshgrid(np.linspace(*bounds.top, 61), np.linspace(*bounds.bottom, 61))
    sections = Section(a, b, bounds.width[1], bounds.wall[0])
    values = objective(STATED, sections)
    frequency = natural_frequency(STATED.finger(sections), SCRIPT_MASS)
    allowed = a + b <= bounds.height[1] * (1 + 1e-9)
    filled = axes.contourf(a / MM, b / MM, np.where(allowed, values, np.nan), 12, cmap="cividis")
    drawn.colorbar(filled, label="sum of Eq. (3.20)")
    white: dict[str, Any] = {"colors": "white", "linestyles": "--", "linewidths": 1}
    ends = sorted(row.high for row in table_3_2()[1:])
    lines = axes.contour(a / MM, b / MM, frequency, ends, **white)
    axes.clabel(lines, fontsize=8)
    edge = bounds.height[1] / MM
    axes.plot([edge - 5, edge - 2], [5, 2], color="black", lw=1.4, label="largest height")
    best = optimal_design(STATED).section
    star: dict[str, Any] = {
        "color": VERMILION,
        "ms": 12,
        "mec": "white",
        "clip_on": False,
        "zorder": 5,
    }
    axes.plot([best.top / MM], [best.bottom / MM], "*", label="best", **star)
    axes.plot([20], [4], "o", color=SKY, mec="black", label="printed")
    axes.set(xlabel="a (mm)", ylabel="b (mm)", xlim=(14, 24), ylim=(2, 5))
    axes.grid(visible=False)
    drawn.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return drawn


@figure("3.9", Provenance.SIMULATED)
def figure_3_9() -> Figure:
    """Draw blocked torque over pressure: model and simulated rig."""
    drawn, axes = sheet(3.4)
    pressure = np.linspace(0, PUSHED_TO, 51)
    axes.plot(
        pressure / MPa, torque(optimum(), pressure), color=BLUE, label="Eq. (3.4), (E1) and (E2)"
    )
    tested = np.linspace(0, PUSHED_TO, 11)
    shade(axes, "torque", GREY, label=LABEL)
    for name, rig in DESIGNS.items():
        found = blocked_torque(rig().finger, tested)
        axes.plot(tested / MPa, found, **LOOK[name], label=f"{name}, simulated")
    ring = {"ms": 12, "mfc": "none", "color": PRINTED, "label": "printed, measured"}
    axes.plot([PUSHED_TO / MPa] * 2, [0.359, 0.15], "o", **ring)
    axes.set(xlabel="pressure (MPa)", ylabel="torque (N m)", ylim=(0, 0.56), xlim=(0, 0.26))
    axes.legend(loc="upper left")
    return drawn


@figure("3.10", Provenance.SIMULATED)
def figure_3_10() -> Figure:
    """Draw free bending over pressure: model and simulated rig."""
    drawn, axes = sheet(3.8)
    pressure = np.linspace(0, BENT_TO, 61)
    rubbers = (("(E1)", DRAGON_SKIN, 2.5, BLUE), ("(E2)", FX_PRO, 1.538, ORANGE))
    for name, modulus, tabled, colour in rubbers:
        for n, dash in ((ANGLE_POWER, "-"), (tabled, ":")):
            finger = Finger(optimum(), young_modulus=modulus, fractional_power=n)
            angle, label = free_bending(finger, pressure) / DEG, f"Eq. (3.10) {name}, n = {n:g}"
            axes.plot(pressure / MPa, angle, color=colour, ls=dash, label=label)
    tested = np.linspace(0, BENT_TO, 11)
    for name, printed in zip(DESIGNS, (206, 201, 232), strict=True):
        axes.plot(tested / MPa, bent_on_rig(name, tested), **LOOK[name], label=f"{name}, simulated")
        axes.plot([BENT_TO / MPa], [printed], "o", ms=12, mfc="none", color=PRINTED)
    shade(axes, "bending-1", GREY, label=LABEL)
    axes.set(xlabel="pressure (MPa)", ylabel="angle (deg)", ylim=(0, 640), xlim=(0, 0.157))
    axes.legend(loc="upper left", fontsize=8.5)
    return drawn


@figure("3.11", Provenance.PRINTED)
def figure_3_11() -> Figure:
    """Draw the bent finger at each pressure."""
    drawn, panels = sheet(4.2, 2, 3, sharex=True, sharey=True)
    for axes, pressure in zip(panels.flat, np.linspace(0, BENT_TO, SIDE_VIEWS), strict=True):
        angle = float(bent(optimum(), pressure))
        # The rubber that stretches lies above the neutral surface, which keeps its length.
        draw_bent(axes, optimum(), LENGTH, angle * DEG, BLUE, f"{pressure / MPa:.2f} MPa")
        axes.set_title(f"{pressure / MPa:.2f} MPa\n{angle:.0f} deg", fontsize=9.5)
        axes.set_aspect("equal")
        axes.set(xlim=(-50, 105), ylim=(-95, 35))
    for axes in panels[-1]:
        axes.set_xlabel("mm")
    for axes in panels[:, 0]:
        axes.set_ylabel("mm")
    return drawn


def parts_of_finest(chambers: int, result: str) -> tuple[list[float], list[float]]:
    """Return sizes of the elements, m, and what they give as parts of what the finest do.

    Args:
        chambers: Of the finger.
        result: "torque" or "angle".
    """
    rows = [r for r in read("convergence") if r.chambers == chambers]
    finest = getattr(min(rows, key=lambda r: r.size), result)
    return [r.size for r in rows], [getattr(r, result) / finest for r in rows]


def over_grooves() -> tuple[list[float], list[float], list[float]]:
    """Return floors of the grooves, m, torque over Eq. (3.4), and angle over the measured one."""
    rows = read("groove_floor")
    push, angle = torque(optimum(), 1.0), 206 * DEG / BENT_TO
    return (
        [r.groove_floor for r in rows],
        [float(r.torque / push) for r in rows],
        [r.angle / angle for r in rows],
    )


def judges() -> list[tuple[str, FemResult, str]]:
    """Return the finite-element fingers that are drawn: label, result and dash."""
    beam = next(r for r in read("table_3_1") if r.chambers == BEAM)
    floors = [r for r in read("groove_floor") if r.groove_floor in SHOWN_FLOORS]
    dashes = ("-.", "--", "-")
    grooved = [
        (f"six chambers, groove at {r.groove_floor / MM:.0f} mm", r, dash)
        for r, dash in zip(floors, dashes, strict=True)
    ]
    return [("one chamber", beam, ":"), *grooved]


def _variants(axes: Any, pressure: Any, value: Any) -> None:
    """Draw a model for all sections of Table 3.1."""
    for (name, section), dash, colour in zip(table_3_1().items(), DASHES, COLOURS, strict=True):
        label = name.replace("Opt. parameters", "Optimum")
        axes.plot(pressure / MPa, value(section), color=colour, ls=dash, lw=1.3, label=label)


def _judged(drawn: Figure, axes: Any, value: str) -> None:
    """Name what the second panel of Figures 3.5 and 3.6 shows."""
    handles = axes.get_legend_handles_labels()
    drawn.legend(*handles, loc="outside lower center", ncols=2, fontsize=8.5)
    axes.set(ylabel=value, title="(b) optimum, judged", xlabel="pressure (MPa)")


@figure("3.5", Provenance.SIMULATED)
def figure_3_5() -> Figure:
    """Draw torque over pressure: variances, finite elements, simulated test."""
    drawn, (upper, lower) = sheet(6.4, 2, 1, sharex=True, sharey=True)
    pressure = np.linspace(0, PUSHED_TO, 26)
    _variants(upper, pressure, lambda section: torque(section, pressure))
    upper.legend(loc="upper left", fontsize=8.5)
    upper.set(ylabel="torque (N m)", title="(a) model", ylim=(0, 0.56))
    lower.plot(pressure / MPa, torque(optimum(), pressure), color=BLUE, label="Eq. (3.4)")
    for label, found, dash in judges():
        lower.plot(pressure / MPa, found.torque * pressure, color=GREEN, ls=dash, label=label)
    tested = np.linspace(0, PUSHED_TO, 11)
    torques = blocked_torque(design_1().finger, tested)
    lower.plot(tested / MPa, torques, "o", color=MEASURED, ms=4, label="simulated test")
    lower.plot(
        [PUSHED_TO / MPa], [0.359], "o", ms=11, mfc="none", color=PRINTED, label="printed, measured"
    )
    _judged(drawn, lower, "torque (N m)")
    return drawn


@figure("3.6", Provenance.SIMULATED)
def figure_3_6() -> Figure:
    """Draw bending angle over pressure: variances, finite elements, simulated test."""
    drawn, (upper, lower) = sheet(6.4, 2, 1, sharex=True, sharey=True)
    pressure = np.linspace(0, BENT_TO, 61)
    _variants(upper, pressure, lambda section: bent(section, pressure))
    upper.legend(loc="upper left", fontsize=8.5)
    upper.set(ylabel="angle (deg)", title="(a) model", ylim=(0, 320))
    eq_3_10 = f"Eq. (3.10), n = {ANGLE_POWER:g}"
    lower.plot(pressure / MPa, bent(optimum(), pressure), color=BLUE, label=eq_3_10)
    for label, found, dash in judges():
        lower.plot(pressure / MPa, found.angle * pressure / DEG, color=GREEN, ls=dash, label=label)
    tested = np.linspace(0, BENT_TO, 11)
    lower.plot(
        tested / MPa,
        bent_on_rig("Design 1(E1)", tested),
        "o",
        color=MEASURED,
        ms=4,
        label="simulated test",
    )
    lower.plot(
        [BENT_TO / MPa], [206], "o", ms=11, mfc="none", color=PRINTED, label="printed, measured"
    )
    _judged(drawn, lower, "angle (deg)")
    return drawn


@figure("3.E", Provenance.SIMULATED)
def figure_3_e() -> Figure:
    """Draw mesh convergence, and the influence of the grooves."""
    drawn, (upper, lower) = sheet(5.6, 2, 1)
    for chambers, colour in ((BEAM, VERMILION), (CHAMBERS, BLUE)):
        words = "one chamber" if chambers == BEAM else "six chambers"
        for name, dash, marker in (("torque", "-", "o"), ("angle", "--", "s")):
            sizes, parts = parts_of_finest(chambers, name)
            look = {"marker": marker, "color": colour, "ms": 4, "label": f"{name}, {words}"}
            upper.plot(np.array(sizes) / MM, parts, dash, **look)
    upper.set(xlabel="size of the elements (mm)", ylabel="part of the finest")
    upper.invert_xaxis()
    upper.legend(fontsize=8.5)
    floors, torques, angles = over_grooves()
    lower.plot(np.array(floors) / MM, torques, "-o", color=BLUE, ms=4, label="torque")
    lower.plot(np.array(floors) / MM, angles, "--s", color=ORANGE, ms=4, label="angle")
    lower.set(xlabel="floor of the groove above the neutral surface (mm)")
    lower.set(ylabel="part", yscale="log")
    lower.legend(fontsize=8.5)
    return drawn
