"""The pad drawn as its elements, and what the slider of Chapter 2 draws with it."""

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from book.chapter_2.places import ideal_responses
from book.companion.style import BLACK, BLUE, GREEN, still, style
from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.simulator.pad_objects import PadObject, pad_object
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_pose import FELT, line_angle, place
from softgrip.tactile.pad_layout import ELEMENT_SIDE, PAD_SIZE, THREE_TWO_THREE
from softgrip.units import DEG, MM

COLOURS = LinearSegmentedColormap.from_list("touch", ["#FFFFFF", "#FC9272", "#A50F15"])
"""White at rest to dark red, ever darker: light and dark tell the same without colour."""
FORCE = 0.15
"""Contact force of the slider, N: the middle of those of the logs."""
Classifier = Callable[[Floats], str]


def outline(item: PadObject, pose: Pose) -> Floats:
    """Return the profile that an object shows where it faces the pad, mm, shape (N, 2).

    That of a point contact is the circle or ellipse in which its surface has risen by the height
    of an element's half, 1.5 mm: it has no edge.
    """
    if item.kind == "point":
        turn = np.linspace(0, 2 * np.pi, 61)
        # Of a paraboloid, which at this height a ball still is.
        half = np.minimum(np.sqrt(2 * 1.5 * MM * np.array(item.radii)), item.radii)
        shape = np.stack([half[0] * np.cos(turn), half[1] * np.sin(turn)], axis=1)
    else:
        half = np.array(item.size) / 2
        if item.kind == "line":
            half[1] = min(half[1], np.sqrt(2 * 1.5 * MM * item.radii[1]))
        shape = half * np.array([(1, 1), (-1, 1), (-1, -1), (1, -1), (1, 1)])
    cosine, sine = np.cos(pose.angle), np.sin(pose.angle)
    turned = shape @ np.array([[cosine, sine], [-sine, cosine]])
    found: Floats = (turned + pose.place) / MM
    return found


def draw_elements(axes: Any, responses: Floats, profile: Floats | None = None) -> Any:
    """Draw the elements as squares, white at rest to dark red, with the responses that are felt.

    Returns
    -------
    ScalarMappable
        What a colour bar takes.
    """
    scale = ScalarMappable(cmap=COLOURS)
    scale.set_clim(0, 1)
    length, width = (value / MM for value in PAD_SIZE)
    side = ELEMENT_SIDE / MM
    axes.add_patch(Rectangle((-length / 2, -width / 2), length, width, fc="none", ec=BLACK, lw=0.8))
    for (x, y), response in zip(THREE_TWO_THREE.places / MM, responses, strict=True):
        axes.add_patch(
            Rectangle((x - side / 2, y - side / 2), side, side, fc=scale.to_rgba(response),
                      ec=BLACK, lw=0.8)
        )  # fmt: skip
        if response > FELT:
            ink = "white" if response > 0.6 else BLACK
            axes.text(x, y + side / 2 - 0.4, f"{response:.2f}", ha="center", va="top",
                      fontsize=8, color=ink)  # fmt: skip
    if profile is not None:
        axes.plot(*profile.T, color=GREEN, ls="--", lw=1.8)
    axes.set(xlim=(-length / 2 - 1, length / 2 + 1), ylim=(-width / 2 - 1, width / 2 + 1))
    axes.set(aspect="equal")
    axes.grid(False)
    return scale


def draw_estimate(axes: Any, responses: Floats, *, line: bool) -> None:
    """Draw the estimated place as a cross, and the direction of a line through it, if any."""
    x, y = place(responses, THREE_TWO_THREE) / MM
    if not np.isfinite(x):
        return
    axes.plot(x, y, "x", color=BLUE, ms=8, mew=2)
    angle = float(line_angle(responses, THREE_TWO_THREE))
    if line and np.isfinite(angle):
        along = 14 * np.array([-1, 1])
        axes.plot(x + along * np.cos(angle), y + along * np.sin(angle), color=BLUE, lw=1.2)


def draw_pad(item: str, x: float, angle: float, classifier: Classifier | None = None) -> Figure:
    """Draw what the simulated pad says of an object on it: an ideal pad, a smooth object, 0.15 N.

    Parameters
    ----------
    item
        Name of an object of `pad_objects`.
    x
        Place of its middle along the pad, mm.
    angle
        Of its length, deg.
    classifier
        Gives the contact kind for responses of shape (8,); without it the true kind is shown.
    """
    found, pose = pad_object(item), Pose((x * MM, 0.0), angle * DEG)
    try:
        responses = ideal_responses(item, pose, FORCE)
    except InvalidInputError:
        responses = np.zeros(THREE_TWO_THREE.elements)  # it lies beside all elements
    felt = bool(responses.max() > 0)
    kind = found.kind if classifier is None else classifier(responses) if felt else "nothing"
    with style():
        drawn, axes = still(3.9, left=0.12)
        draw_elements(axes, responses, outline(found, pose))
        draw_estimate(axes, responses, line=kind == "line")
        axes.set(xlabel="mm", ylabel="mm")
        told = f"{kind} (true)" if classifier is None else f"felt as {kind}, is {found.kind}"
        axes.set_title(f"{item}: {told}", fontsize=9.5)
    return drawn
