"""What the sliders of Chapter 5 move."""

from typing import Any

import numpy as np

from book.chapter_5.figures_materials import measured_curve
from book.chapter_5.matched_model import resting_angle
from book.companion.style import LINEAR, LUDWICK, MEASURED, OTHER
from book.explore.plot import Dots, Level, Line, Panel, Plot, Span
from softgrip.arrays import Number, check_positive
from softgrip.materials import ludwick, yeoh
from softgrip.materials.facts import facts
from softgrip.materials.least_squares import LinearFit, linear_fit
from softgrip.materials.powerlaw import EXPONENTS, SCALES, predictors
from softgrip.materials.table import Material, fractional_powers, properties, table_5_1
from softgrip.reads import remembered
from softgrip.units import MPa


@remembered
def _fit() -> LinearFit:
    known = table_5_1().values()
    return linear_fit(predictors(*properties(known).T), fractional_powers(known))


def new_material(E: Number, MV: Number, TS: Number) -> dict[str, Number]:
    """Return the predicted n of a new material, and the 95 % interval for measuring it.

    Args:
        E, TS: Young's modulus (100 % modulus) and tensile strength, MPa.
        MV: Mixed viscosity, Pa s.
    """
    check_positive(young_modulus=E, mixed_viscosity=MV, tensile_strength=TS)
    given = zip((E * MPa, MV, TS * MPa), SCALES, EXPONENTS, strict=True)
    value, half = _fit().response([(v / scale) ** power for v, scale, power in given], 0.95)
    known = properties(table_5_1().values())
    inside: Number = 1.0
    for v, low, high in zip((E * MPa, MV, TS * MPa), known.min(0), known.max(0), strict=True):
        inside = inside * (v >= low) * (v <= high)
    return {"n": value, "low": value - half, "high": value + half, "outside": 1 - inside}


def new_material_plot() -> Plot:
    """Return the plot of `new_material`: the predicted n among the ten known ones."""
    ranked = sorted(table_5_1().values(), key=lambda m: m.fractional_power)
    names = [material.name for material in ranked]
    return Plot(
        [
            Panel(
                [
                    Span("low", "high", "95 %", colour=LUDWICK),
                    Level("n", "x", "predicted", colour=LUDWICK, dash="", width=2.4),
                    Dots([m.fractional_power for m in ranked], names, "known", colour=MEASURED),
                ],
                x=(0, 4), y=names[::-1], x_label="fractional power n", left=168, height=290,
            )
        ],
        title="n = {n:.2f}, 95 %: {low:.2f} to {high:.2f}",
        cases=[("outside", "n = {n:.2f}, 95 %: {low:.2f} to {high:.2f} (extrapolated)")],
    )  # fmt: skip


def _of(material: str) -> Material:
    return table_5_1()[material]


def ludwick_law(material: str, n: Number) -> dict[str, Any]:
    """Return true stress over strain: measured, by Yeoh's law, and by Ludwick's with a chosen n.

    Args:
        material: Of Table 5.1.
        n: Its power.
    """
    known = facts()[material]
    strain = np.linspace(0, known.peak_strain, 60)
    measured = measured_curve(material)
    seen = ([], []) if measured is None else (measured[0], measured[1] / MPa)
    return {
        "strain": strain,
        "measured_strain": seen[0],
        "measured": seen[1],
        "Yeoh": (1 + strain) * yeoh.stress(1 + strain, known.yeoh) / MPa,
        "Ludwick": ludwick.stress(strain, _of(material).young_modulus, n) / MPa,
        "printed": _of(material).fractional_power,
        "end": known.peak_strain,
        "top": 1.15 * (1 + known.peak_strain) * known.peak_stress / MPa,
    }


def ludwick_plot() -> Plot:
    """Return the plot of `ludwick_law`."""
    return Plot(
        [
            Panel(
                [
                    Line("measured_strain", "measured", "measured", colour=MEASURED, width=3.2),
                    Line("strain", "Yeoh", "Yeoh, fitted", colour=OTHER, width=1.4),
                    Line("strain", "Ludwick", "Ludwick", colour=LUDWICK, dash="6 3"),
                ],
                x=(0, "end"), y=(0, "top"),
                x_label="engineering strain", y_label="true stress (MPa)",
            )
        ],
        title="{material}, n = {n:.2f}, printed {printed:.3f}",
    )  # fmt: skip


LARGEST = 180.0
"""Angle up to which springs are drawn, deg."""


def straight_spring(n: Number, first: Number, second: Number) -> dict[str, Any]:
    """Return the forces of two springs that agree at one angle, as parts of one that holds another.

    Args:
        n: Power of Ludwick's spring, Eq. (5.12); the other one is linear, Eq. (5.9).
        first: Where they agree, deg.
        second: Where the force holds Ludwick's spring, deg.
    """
    angle = np.linspace(0, LARGEST, 91)
    rest = resting_angle(first, second, n)
    return {
        "angle": angle,
        "Ludwick": (angle / second) ** n,
        "linear": angle / rest,
        "agree": (first / second) ** n,
        "rest": rest,
        "missed": rest - second,
        "outside": 1.0 * (rest > LARGEST),
    }


def straight_spring_plot() -> Plot:
    """Return the plot of `straight_spring`: two springs under one force."""
    told = "the linear spring rests at {rest:.1f} deg: {missed:+.1f} deg"
    return Plot(
        [
            Panel(
                [
                    Line("angle", "Ludwick", "Ludwick", colour=LUDWICK),
                    Line("angle", "linear", "linear", colour=LINEAR, dash="6 3"),
                    Level(1.0, label="the force"),
                    Level("second", "x", colour=LUDWICK),
                    Level("rest", "x", colour=LINEAR),
                    Dots("first", "agree", "they agree", colour=MEASURED, radius=5),
                    Dots("second", 1.0, colour=LUDWICK, radius=5),
                    Dots("rest", 1.0, colour=LINEAR, radius=5),
                ],
                x=(0, LARGEST), y=(0, 1.8),
                x_label="angle (deg)", y_label="force, as a part of the one that holds the finger",
            )
        ],
        title=told,
        cases=[("outside", f"{told} (outside)")],
    )  # fmt: skip
