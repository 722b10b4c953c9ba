"""Figures of Chapter 3 with finite elements beside the models."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from book.chapter_3.figures import CALIBRATION, OPTIMUM, TABLE_3_1
from book.chapter_3.torque_and_bending import blocked_torque, settled_angles
from book.companion.exhibit import figure
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
    WIDTH,
)
from softgrip.actuator.bending import Finger, free_bending
from softgrip.actuator.fem_results import BEAM, CHAMBERS, FemResult, read
from softgrip.actuator.printed import ANGLE_POWER, table_3_1
from softgrip.actuator.section import torque
from softgrip.provenance import Provenance
from softgrip.simulator.calibration import design_1
from softgrip.units import DEG, MM, MPa

FEM = tuple(f"fem/{name}.csv" for name in ("table_3_1", "groove_floor", "convergence"))
DASHES = ("-", "--", "-.", ":", "--", "-.", ":")
COLOURS = (BLUE, SKY, GREEN, ORANGE, VERMILION, PURPLE, GREY)
SHOWN_FLOORS = (0.0, 6 * MM, 12 * MM)


def _judges() -> list[tuple[str, FemResult, str]]:
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
        axes.plot(pressure / MPa, value(section), color=colour, ls=dash, lw=1.3,
                  label=name.replace("Opt. parameters", "Optimum"))  # fmt: skip


@figure(
    "3.5",
    caption="Torque of a finger held straight, over pressure. (a) Eq. (3.4) for the optimum and "
    "its variances. (b) The optimum: Eq. (3.4); finite elements of a finger with one chamber along "
    "its length, and with six chambers between grooves whose depth is not printed; and the blocked "
    "test on the *simulated* rig, which is calibrated to the printed measurement.",
    alt="Two panels. In the first the seven lines fan out from zero to between 0.3 and 0.51 newton "
    "metres at 0.25 megapascal, the optimum on top. In the second the finite elements with one "
    "chamber give almost nothing, 0.04; those with six chambers 0.10, 0.35 or 0.48 depending on "
    "the groove; the simulated test ends at 0.36.",
    provenance=Provenance.SIMULATED,
    data=(TABLE_3_1, *FEM[:2], CALIBRATION),
)
def figure_3_5() -> Figure:
    """Draw torque over pressure: variances, finite elements, simulated test."""
    drawn = Figure(figsize=(WIDTH, 6.4))
    upper, lower = drawn.subplots(2, 1, sharex=True, sharey=True)
    pressure = np.linspace(0, 0.25, 26) * MPa
    _variants(upper, pressure, lambda section: torque(section, pressure))
    upper.legend(loc="upper left", fontsize=8.5)
    upper.set(ylabel="torque (N m)", title="(a) model", ylim=(0, 0.56))
    lower.plot(pressure / MPa, torque(OPTIMUM, pressure), color=BLUE, label="Eq. (3.4)")
    for label, found, dash in _judges():
        lower.plot(pressure / MPa, found.torque * pressure, color=GREEN, ls=dash, label=label)
    tested = np.linspace(0, 0.25, 11) * MPa
    lower.plot(tested / MPa, blocked_torque(design_1().finger, tested), "o", color=MEASURED, ms=4,
               label="simulated test")  # fmt: skip
    lower.plot([0.25], [0.359], "o", ms=11, mfc="none", color=PRINTED, label="printed, measured")
    drawn.legend(*lower.get_legend_handles_labels(), loc="outside lower center", ncols=2,
                 fontsize=8.5)  # fmt: skip
    lower.set(ylabel="torque (N m)", title="(b) optimum, judged", xlabel="pressure (MPa)")
    return drawn


@figure(
    "3.6",
    caption="Bending angle of the free finger, over pressure. (a) Eq. (3.10) with the n that gives "
    "the printed 290 deg, for the optimum and its variances. (b) The optimum: Eq. (3.10); linear "
    "finite elements, which stand for small angles and are drawn on as far as they can be; and the "
    "test on the *simulated* rig, which is calibrated to the printed measurement.",
    alt="Two panels. In the first the seven curves end between 180 and 290 degrees at 0.15 "
    "megapascal, the optimum on top. In the second the finite elements with six chambers rise so "
    "steeply that they leave the panel, the more the deeper the grooves; those with one chamber "
    "reach 18 degrees; the simulated test rises steeply and then flattens, to 206.",
    provenance=Provenance.SIMULATED,
    data=(TABLE_3_1, *FEM[:2], CALIBRATION),
)
def figure_3_6() -> Figure:
    """Draw bending angle over pressure: variances, finite elements, simulated test."""
    drawn = Figure(figsize=(WIDTH, 6.4))
    upper, lower = drawn.subplots(2, 1, sharex=True, sharey=True)
    pressure = np.linspace(0, 0.15, 61) * MPa

    def bent(section: Any) -> Any:
        return free_bending(Finger(section, fractional_power=ANGLE_POWER), pressure) / DEG

    _variants(upper, pressure, bent)
    upper.legend(loc="upper left", fontsize=8.5)
    upper.set(ylabel="angle (deg)", title="(a) model", ylim=(0, 320))
    lower.plot(pressure / MPa, bent(OPTIMUM), color=BLUE, label="Eq. (3.10), n = 1.56")
    for label, found, dash in _judges():
        lower.plot(pressure / MPa, found.angle * pressure / DEG, color=GREEN, ls=dash, label=label)
    tested = np.linspace(0, 0.15, 11) * MPa
    angles = settled_angles(design_1(), tested).mean(axis=0)
    lower.plot(tested / MPa, angles / DEG, "o", color=MEASURED, ms=4, label="simulated test")
    lower.plot([0.15], [206], "o", ms=11, mfc="none", color=PRINTED, label="printed, measured")
    drawn.legend(*lower.get_legend_handles_labels(), loc="outside lower center", ncols=2,
                 fontsize=8.5)  # fmt: skip
    lower.set(ylabel="angle (deg)", title="(b) optimum, judged", xlabel="pressure (MPa)")
    return drawn


@figure(
    "3.E",
    caption="What the finite elements hang on. Above: torque and bending angle by pressure over "
    "the size of the elements, as parts of those on the finest mesh. Below: the same over the "
    "depth of the grooves between the six chambers, which no place prints; the torque as a part of "
    "Eq. (3.4), the angle of the printed 206 deg at 0.15 MPa.",
    alt="Two panels. Above, the curves of six chambers stay within three per cent of one, those of "
    "one chamber come from twenty per cent below, and all close in on one as the elements get "
    "smaller. Below, the torque rises from 0.2 to 0.95 of the equation as the groove gets "
    "shallower; the angle rises a little and then falls, from eighteen to three times the printed "
    "one.",
    provenance=Provenance.SIMULATED,
    data=FEM[1:],
)
def figure_3_e() -> Figure:
    """Draw mesh convergence, and the influence of the grooves."""
    drawn = Figure(figsize=(WIDTH, 5.6))
    upper, lower = drawn.subplots(2, 1)
    for chambers, colour in ((BEAM, VERMILION), (CHAMBERS, BLUE)):
        rows = [r for r in read("convergence") if r.chambers == chambers]
        finest = min(rows, key=lambda r: r.size)
        words = "one chamber" if chambers == BEAM else "six chambers"
        for name, dash, marker in (("torque", "-", "o"), ("angle", "--", "s")):
            parts = [getattr(r, name) / getattr(finest, name) for r in rows]
            upper.plot([r.size / MM for r in rows], parts, dash, marker=marker, color=colour, ms=4,
                       label=f"{name}, {words}")  # fmt: skip
    upper.set(xlabel="size of the elements (mm)", ylabel="part of the finest")
    upper.invert_xaxis()
    upper.legend(fontsize=8.5)
    rows = list(read("groove_floor"))
    floors = [r.groove_floor / MM for r in rows]
    push = torque(OPTIMUM, 1.0)
    full = 206 * DEG / (0.15 * MPa)
    lower.plot(floors, [r.torque / push for r in rows], "-o", color=BLUE, ms=4, label="torque")
    lower.plot(floors, [r.angle / full for r in rows], "--s", color=ORANGE, ms=4, label="angle")
    lower.set(xlabel="floor of the groove above the neutral surface (mm)", ylabel="part",
              yscale="log")  # fmt: skip
    lower.legend(fontsize=8.5)
    return drawn
