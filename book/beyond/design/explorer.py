"""The explorer of *Design yours*: from a rubber, a pressure and a mass to a section and its curves.

All of it is computed in the page, by the closed laws. The section is not the optimum: it is as wide
as its mass allows, with the thickest bottom and the thinnest wall.
"""

from typing import Any

import numpy as np

from book.companion.finger_drawing import RUBBER
from book.companion.style import BLUE, GREY, LUDWICK, ORANGE, PRINTED, SKY
from book.explore.finger_picture import ACROSS, LENGTH, UP
from book.explore.plot import Band, Bent, Dimension, Level, Line, Outline, Panel, Plot
from book.explore.scan import Numbers, scan
from softgrip.actuator.bending import Finger, bending_angle
from softgrip.actuator.buckling import buckling_pressure
from softgrip.actuator.design import SCRIPT_MASS, Bounds
from softgrip.actuator.frequency import natural_frequency
from softgrip.actuator.section import Section, torque
from softgrip.actuator.size import Layout, air_volume, finger_mass, rubber_volume
from softgrip.arrays import Number, chosen
from softgrip.materials.densities import density
from softgrip.materials.draws import draws
from softgrip.materials.table import material
from softgrip.units import DEG, ML, MM

POINTS = 12
"""Pressures above zero at which the curves are computed."""
LARGEST = 150.0
"""Pressure up to which the panels reach, kPa."""
WIDE = 1.96
"""Standard deviations of the logarithm to each side: 95 % of a normal distribution."""


def width_for(mass: Number, top: Number, rubber: str) -> Number:
    """Return how wide a section may be for a mass [kg] and a height a [m], within its limits, m.

    The rubber of a section is linear in its width.
    """
    bounds, layout = Bounds(), Layout()
    narrow, wide = bounds.width
    ends = [
        density(rubber) * rubber_volume(Section(top, bounds.bottom[1], w, bounds.wall[0]), layout)
        for w in bounds.width
    ]
    free = narrow + (mass - ends[0]) / (ends[1] - ends[0]) * (wide - narrow)
    return chosen(free < narrow, narrow, chosen(free > wide, wide, free))


def yours(rubber: str, pressure: Number, mass: Number, top: Number) -> dict[str, Any]:
    """Return a finger of six chambers: its section, its curves and what it weighs.

    Args:
        rubber: Of Table 5.1.
        pressure: kPa.
        mass: Largest of the rubber, g.
        top: a, mm.
    """
    of, layout, bounds = material(rubber), Layout(), Bounds()
    w = width_for(mass / 1e3, top * MM, rubber)
    section = Section(top * MM, bounds.bottom[1], w, bounds.wall[0])
    made = Finger(section, layout.length, of.young_modulus, of.fractional_power)
    share = np.arange(1, POINTS + 1) / POINTS
    over = [float(part) * pressure * 1e3 for part in share]
    bent = [bending_angle(made, each) for each in over]
    # The same for each draw of E and n: mean and spread of the angle's logarithm.
    sums = _sums(section, over, rubber)
    count = float(len(draws()[rubber]))
    middle = [first / count for first in sums[:POINTS]]
    spread = [
        np.sqrt(np.maximum(second / count - mean**2, 1e-18))
        for second, mean in zip(sums[POINTS:], middle, strict=True)
    ]
    half, b, t = w / 2 / MM, section.bottom / MM, section.wall / MM
    air = air_volume(section, layout)
    weighs = finger_mass(section, layout, density(rubber))
    tested = [np.exp(mean) / DEG for mean in middle]
    low = [np.exp(m - WIDE * s) / DEG for m, s in zip(middle, spread, strict=True)]
    high = [np.exp(m + WIDE * s) / DEG for m, s in zip(middle, spread, strict=True)]
    bears = buckling_pressure(made) / 1e3
    return {
        "rubber_x": [-half, half, half, -half],
        "rubber_y": [-b, -b, top, top],
        "chamber_x": [t - half, half - t, half - t, t - half],
        "chamber_y": [0.0, 0.0, top - t, top - t],
        "a_ends": [0.0, top],
        "pressure": [0.0, *(each / 1e3 for each in over)],
        "torque": [0.0, *(torque(section, each) for each in over)],
        "angle": [0.0, *(each / DEG for each in bent)],
        "tested": [0.0, *tested],
        "low": [0.0, *low],
        "high": [0.0, *high],
        "pushes": torque(section, over[-1]),
        "bends": bent[-1] / DEG,
        "bends_tested": tested[-1],
        "width": 2 * half,
        "mass": weighs * 1e3,
        "air": air / ML,
        "frequency": natural_frequency(made, SCRIPT_MASS),
        "bears": bears,
        "buckles": 1.0 * (bears < pressure),
        "heavy": 1.0 * (weighs * 1e3 > mass * 1.0001),
    }


def _sums(section: Section, over: Numbers, rubber: str) -> list[Number]:
    """Return the sums of the angle's logarithm and of its square over the draws, by pressure."""
    sides = [section.top, section.bottom, section.width, section.wall]

    def draw(state: Numbers, row: Numbers, given: Numbers) -> tuple[Numbers, Numbers]:
        E, n = row
        finger = Finger(Section(*given[:4]), Layout().length, E, n)
        logs = [np.log(bending_angle(finger, each)) for each in given[4:]]
        after = [old + new for old, new in zip(state, [*logs, *(x**2 for x in logs)], strict=True)]
        return after, after

    found = scan(draw, [0.0] * (2 * POINTS), draws()[rubber], [*sides, *over])
    return [column[-1] for column in found]


YOURS_PLOT = Plot(
    [
        Panel(
            [
                Outline("rubber_x", "rubber_y", "rubber", colour=GREY, fill=0.3),
                Outline("chamber_x", "chamber_y", "air", colour=SKY, fill=0.6),
                Level(0.0, label="neutral surface"),
                Dimension(-19.0, "a_ends", "a"),
            ],
            x=(-21, 21), y=(-10, 27), x_label="mm", equal=True, share=0.5, left=36,
        ),
        Panel(
            [
                Outline([-8, 0, 0, -8], [-8, -8, 26, 26], colour=GREY, fill=0.5),
                Bent([0, LENGTH, LENGTH, 0], "rubber_y", "bends", LENGTH, colour=RUBBER),
            ],
            x=ACROSS, y=UP, equal=True, bare=True, share=0.5,
        ),
        Panel(
            [Line("pressure", "torque", "torque", colour=BLUE)],
            x=(0, LARGEST), y=(0, 0.5), x_label="pressure (kPa)", y_label="torque (N m)",
            height=240, share=0.5, left=40,
        ),
        Panel(
            [
                Band("low", "high", "pressure", "draws of the test", colour=ORANGE),
                Line("pressure", "tested", "as tested", colour=ORANGE, dash="6 3"),
                Line("pressure", "angle", "as printed", colour=LUDWICK),
                Level("bears", "x", "buckles if held", colour=PRINTED),
            ],
            x=(0, LARGEST), y=(0, 500), x_label="pressure (kPa)", y_label="angle (deg)",
            height=240, share=0.5, left=40,
        ),
    ],
    title="w {width:.1f} mm, {mass:.1f} g of rubber, {air:.1f} mL of air: {pushes:.3f} N m, "
    "{bends:.0f} deg as printed and {bends_tested:.0f} as tested, {frequency:.2f} rad/s",
    cases=[
        ("heavy", "{mass:.1f} g is the least at this height: more than you allow"),
        ("buckles", "it buckles from {bears:.0f} kPa on if its tip is held: {mass:.1f} g, "
         "{pushes:.3f} N m, {bends:.0f} deg as printed, {bends_tested:.0f} as tested"),
    ],
)  # fmt: skip
