"""Answers of the tasks of *Design yours*, where they are numbers."""

from typing import Any

import numpy as np

from book.beyond.design.explorer import yours
from softgrip.actuator.limits import DRAGON_SKIN_20
from softgrip.actuator.printed import table_3_1
from softgrip.actuator.size import Layout, rubber_volume

LOW_TOP, HIGH_TOP = 14.0, 20.0
"""Ends of the explorer's slider of a, mm."""
MOST_MASS = 36.0
"""Right end of its slider of the mass, g."""
FIRST: dict[str, Any] = {
    "rubber": "Dragon Skin 20",
    "pressure": 100.0,
    "mass": 25.0,
    "top": 16.0,
}
"""Where the explorer starts."""
SOFTEST = "Ecoflex 00-10"


def highest() -> dict[str, Any]:
    """Return what the explorer says at its largest height, with nothing else moved."""
    return yours(**{**FIRST, "top": HIGH_TOP})


def heights() -> list[float]:
    """Return the torque along the slider of the height, N m: where it is largest is the answer."""
    tops = np.linspace(LOW_TOP, HIGH_TOP, 61)
    return [float(yours(**{**FIRST, "top": float(top)})["pushes"]) for top in tops]


def both_bear() -> float:
    """Return the same at the largest height and mass of the explorer, kPa."""
    most = {"rubber": SOFTEST, "top": HIGH_TOP, "mass": MOST_MASS}
    return float(yours(**{**FIRST, **most})["bears"])


def softest_bears() -> float:
    """Return from which pressure the softest rubber buckles where the explorer starts, kPa."""
    return float(yours(**{**FIRST, "rubber": SOFTEST})["bears"])


def split_mass() -> tuple[float, float]:
    """Return the rubber of the upper and of the lower part of Design 1, g."""
    section, layout = table_3_1()["Opt. parameters"], Layout()
    lower = float(section.bottom * section.width * layout.length)
    whole = float(rubber_volume(section, layout))
    return 1e3 * DRAGON_SKIN_20 * (whole - lower), 1e3 * DRAGON_SKIN_20 * lower
