"""What the sliders of Section 2.2 draw."""

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from book.companion.style import BLUE, GREY, WIDTH, style
from softgrip.arrays import Floats
from softgrip.tactile.element import STATED_MODULUS, Element, Shape, cross_section, shortening
from softgrip.tactile.element_sensitivity import AT_REST, resistance_under
from softgrip.units import MM

POISSON = 0.49


def outlines(element: Element, force: float) -> tuple[Floats, Floats]:
    """Return the right side of an element before and after, shape (2, n) each: half width, height.

    Each slice is shortened by its own stress as in Eq. (2.1), and widened by Poisson's ratio.

    Parameters
    ----------
    element
        With a flat top.
    force
        N, >= 0.
    """
    height = np.linspace(0, element.height, 401)
    area = cross_section(element, height)
    half = element.width / 2 * np.sqrt(area / element.base_area)
    strain = force / (STATED_MODULUS * area)
    steps = np.diff(height) * (strain[1:] + strain[:-1]) / 2
    sunk = height - np.concatenate([[0], np.cumsum(steps)])
    return np.stack([half, height]), np.stack([half * (1 + POISSON * strain), sunk])


def draw_element(shape: Shape, load: float, cut: float) -> Figure:
    """Draw an element 6 mm wide and 3 mm high before and under a load, by Eq. (2.1).

    Parameters
    ----------
    shape
        "cylinder", "hemisphere" or "pyramid".
    load
        N, >= 0.
    cut
        Width of the flat top as a part of the base's, above 0; a cylinder has 1 in any case.
    """
    element = Element(shape, cut=1.0 if shape == "cylinder" else cut)
    before, after = outlines(element, load)
    moved = shortening(element, load)
    changed = resistance_under(element, load) / AT_REST
    stretched = load / (STATED_MODULUS * element.top_area)
    # Axes at a fixed place: a layout engine would move them from frame to frame.
    with style(), mpl.rc_context({"figure.constrained_layout.use": False}):
        drawn = Figure(figsize=(WIDTH, 3.0))
        axes = drawn.add_axes((0.12, 0.2, 0.85, 0.62))
        for (half, height), colour, dash in ((before, GREY, "--"), (after, BLUE, "-")):
            x, y = np.r_[-half, half[::-1]] / MM, np.r_[height, height[::-1]] / MM
            axes.plot(x, y, color=colour, ls=dash)
            if colour == BLUE:
                axes.fill(x, y, color=BLUE, alpha=0.15)
        axes.set(xlim=(-5, 5), ylim=(0, 3.4), xlabel="mm", ylabel="mm", aspect="equal")
        axes.set_title(
            f"shorter by {moved / MM:.3f} mm, resistance {changed:.3f} times", fontsize=9.5
        )
        if stretched > 0.5:
            drawn.text(0.12, 0.93, f"strain {stretched:.1f} at the top: beyond a linear law",
                       fontsize=9)  # fmt: skip
    return drawn
