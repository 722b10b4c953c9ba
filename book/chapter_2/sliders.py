"""What the sliders of Chapter 2 draw."""

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from book.chapter_2.figures_force import draw_points
from book.chapter_2.figures_pad import FORCE, draw_elements, draw_estimate, outline
from book.chapter_2.forces import weight_points
from book.chapter_2.logs import TRAINING, contacts
from book.companion.style import BLUE, GREY, WIDTH, still, style
from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.reads import remembered
from softgrip.simulator.pad import ideal_responses
from softgrip.simulator.pad_objects import pad_object
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_kind import bagged_neighbours
from softgrip.tactile.element import STATED_MODULUS, Element, Shape, cross_section, shortening
from softgrip.tactile.element_sensitivity import AT_REST, resistance_under
from softgrip.tactile.fast_kind import FastKind
from softgrip.tactile.nadaraya_watson import NadarayaWatson, left_out_error
from softgrip.tactile.pad_layout import THREE_TWO_THREE
from softgrip.units import DEG, GRAM_FORCE, MM

POISSON = 0.49


def outlines(element: Element, force: float) -> tuple[Floats, Floats]:
    """Return the right side of an element before and after, shape (2, n) each: half width, height.

    Each slice is shortened by its own stress as in Eq. (2.1), and widened by Poisson's ratio.

    Args:
        element: With a flat top.
        force: N, >= 0.
    """
    height = np.linspace(0, element.height, 401)
    area = cross_section(element, height)
    half = element.width / 2 * np.sqrt(area / element.base_area)
    strain = force / (STATED_MODULUS * area)
    steps = np.diff(height) * (strain[1:] + strain[:-1]) / 2
    sunk = height - np.concatenate([[0], np.cumsum(steps)])
    return np.stack([half, height]), np.stack([half * (1 + POISSON * strain), sunk])


def draw_element(shape: Shape, load: float, cut: float) -> Figure:
    """Draw an element 6 mm wide and 3 mm high before and under a load.

    Args:
        shape: "cylinder", "hemisphere" or "pyramid".
        load: N, >= 0.
        cut: Width of the flat top as a part of the base's, above 0; a cylinder has 1 in any case.
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


def draw_bandwidth(bandwidth: float) -> Figure:
    """Draw the Nadaraya-Watson regressor on the simulated layer's 69 points.

    The title says its error on points, and on whole weights, that are left out.

    Args:
        bandwidth: sigma of Eq. (2.7), V, > 0.
    """
    voltage, force = weight_points()
    model = NadarayaWatson(bandwidth).fit(voltage[:, None], force)
    grid = np.linspace(-0.5, 4.5, 1001)
    points, weights = (
        left_out_error(voltage[:, None], force, bandwidth, groups=groups) / GRAM_FORCE
        for groups in (None, force)
    )
    with style():
        drawn, axes = still(3.2)
        draw_points(axes)
        axes.plot(grid, model.predict(grid[:, None]) / GRAM_FORCE, color=BLUE, label="regressor")
        axes.set(
            xlabel="voltage (V)",
            ylabel="force (gf)",
            ylim=(-5, 80),
            title=f"left out: points {points:.1f} gf, weights {weights:.1f} gf",
        )
        axes.legend(loc="upper left")
    return drawn


@remembered
def _classifier() -> FastKind:
    training = contacts(TRAINING)
    return FastKind.from_fitted(bagged_neighbours().fit(training.responses, training.kinds))


def draw_touch(item: str, x: float, angle: float) -> Figure:
    """Draw a smooth object on an ideal simulated pad, 0.15 N, and what the classifier says.

    Args:
        item: Name of an object of `pad_objects`.
        x: Place of its middle along the pad, mm.
        angle: Of its length, deg.
    """
    found, pose = pad_object(item), Pose((x * MM, 0.0), angle * DEG)
    try:
        responses = ideal_responses(item, pose, FORCE)
    except InvalidInputError:
        responses = np.zeros(THREE_TWO_THREE.elements)  # it lies beside all elements
    kind = _classifier().predict(responses) if responses.max() > 0 else "nothing"
    with style():
        drawn, axes = still(3.9, left=0.12)
        draw_elements(axes, responses, outline(found, pose))
        draw_estimate(axes, responses, line=kind == "line")
        axes.set(xlabel="mm", ylabel="mm")
        axes.set_title(f"{item}: felt as {kind}, is {found.kind}", fontsize=9.5)
    return drawn
