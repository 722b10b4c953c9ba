"""What the sliders of Chapter 2 move."""

from collections.abc import Sequence
from dataclasses import replace
from functools import reduce
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from book.chapter_2.figures_pad import FORCE, draw_elements, draw_estimate, outline
from book.chapter_2.forces import weight_points
from book.chapter_2.logs import TRAINING, contacts
from book.companion.style import GREY, still, style
from book.explore.plot import Dots, Line, Outline, Panel, Plot
from book.explore.scan import Numbers, scan, total
from softgrip.arrays import Floats, Number
from softgrip.errors import InvalidInputError
from softgrip.reads import remembered
from softgrip.simulator.pad import ideal_responses
from softgrip.simulator.pad_objects import pad_object
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_kind import bagged_neighbours
from softgrip.tactile.element import STATED_MODULUS, Element, Shape, cross_section, shortening
from softgrip.tactile.element_sensitivity import AT_REST, resistance_under
from softgrip.tactile.fast_kind import FastKind
from softgrip.tactile.pad_layout import THREE_TWO_THREE
from softgrip.units import DEG, GRAM_FORCE, MM

POISSON = 0.49
FAR = 1e9
"""Squared distance of a point that is left out, in bandwidths: its weight is 0."""


def element(shape: Shape, load: Number, cut: Number) -> dict[str, Any]:
    """Return an element 6 mm wide and 3 mm high, before and under a load.

    Each slice is shortened by its own stress as in Eq. (2.1), and widened by Poisson's ratio.

    Args:
        shape: "cylinder", "hemisphere" or "pyramid".
        load: N, >= 0.
        cut: Width of the flat top as a part of the base's, above 0; a cylinder has 1 in any case.
    """
    made = Element(shape, cut=1.0 if shape == "cylinder" else cut)
    part = np.linspace(0, 1, 401)
    height = part * made.height

    def slice_(state: Numbers, row: Numbers, given: Numbers) -> tuple[Numbers, Numbers]:
        sunk, above, strain_below, first = state
        (y,), (force, cut) = row, given
        area = cross_section(replace(made, cut=cut), y)
        strain = force / (STATED_MODULUS * area)
        # Trapezoids between slices; the first one has none below it.
        sunk = sunk + (1 - first) * (y - above) * (strain + strain_below) / 2
        half = made.width / 2 * (area / made.base_area) ** 0.5
        wider = half * (1 + POISSON * strain)
        return (sunk, y, strain, 0.0), (half / MM, wider / MM, (y - sunk) / MM)

    half, widened, lowered = scan(slice_, (0.0, 0.0, 0.0, 1.0), height, (load, made.cut))
    moved, stretched = shortening(made, load), load / (STATED_MODULUS * made.top_area)
    return {
        "half_width": half,
        "height": height / MM,
        "half_width_under": widened,
        "height_under": lowered,
        "moved": moved / MM,
        "changed": resistance_under(made, load) / AT_REST,
        "stretched": stretched,
        "beyond": stretched > 0.5,
    }


ELEMENT_PLOT = Plot(
    [
        Panel(
            [
                Outline("half_width", "height", "before", colour=GREY, dash="5 3", fill=0,
                        mirrored=True),
                Outline("half_width_under", "height_under", "under the load", mirrored=True),
            ],
            x=(-5, 5), y=(0, 3.4), x_label="mm", y_label="mm", equal=True,
        )
    ],
    title="shorter by {moved:.3f} mm, resistance {changed:.3f} times",
    cases=[
        (
            "beyond",
            "shorter by {moved:.3f} mm, resistance {changed:.3f} times; "
            "strain {stretched:.1f} at the top: beyond a linear law",
        )
    ],
)  # fmt: skip


def bandwidth(sigma: Number) -> dict[str, Any]:
    """Return the Nadaraya-Watson regressor on the simulated layer's 69 points.

    Its errors are root mean squares on points, and on whole weights, that are left out.

    Args:
        sigma: Bandwidth of Eq. (2.7), V, > 0.
    """
    points, targets = (values.tolist() for values in weight_points())
    grid = np.linspace(-0.5, 4.5, 251)

    def at(_: Numbers, row: Numbers, given: Numbers) -> tuple[Numbers, Numbers]:
        return (), (average(row[0], points, targets, given[0]),)

    def without(_: Numbers, row: Numbers, given: Numbers) -> tuple[Numbers, Numbers]:
        x, force, number = row
        others = [1.0 * (number != k) for k in range(len(points))]
        lighter = [1.0 * (force != t) for t in targets]
        return (), tuple(
            (average(x, points, targets, given[0], kept) - force) ** 2 for kept in (others, lighter)
        )

    (curve,) = scan(at, (), grid, (sigma,))
    rows = np.column_stack([points, targets, np.arange(len(points))])
    by_point, by_weight = (
        (total(squares) / len(points)) ** 0.5 for squares in scan(without, (), rows, (sigma,))
    )
    return {
        "voltage": grid,
        "force": curve / GRAM_FORCE,
        "points": by_point / GRAM_FORCE,
        "weights": by_weight / GRAM_FORCE,
    }


def average(
    x: Number,
    points: Sequence[float],
    targets: Sequence[float],
    sigma: Number,
    kept: Numbers | None = None,
) -> Number:
    """Return the average of the targets at x, weighted by the Gaussian kernel, Eq. (2.6).

    The weights are relative to that of the nearest point, as in `kernel_average.gaussian`; points
    that are not kept, 0 in place of 1, have none.
    """
    squares = [((x - p) / sigma) ** 2 for p in points]
    if kept is not None:
        squares = [s + FAR * (1 - keep) for s, keep in zip(squares, kept, strict=True)]
    nearest = reduce(np.minimum, squares)
    weights = [np.exp((nearest - s) / 2) for s in squares]
    return sum(w * t for w, t in zip(weights, targets, strict=True)) / sum(weights)


def bandwidth_plot() -> Plot:
    """Return the plot of `bandwidth`."""
    voltage, force = weight_points()
    return Plot(
        [
            Panel(
                [
                    Dots(voltage.tolist(), (force / GRAM_FORCE).tolist(),
                         "weights on the simulated layer", radius=2.5),
                    Line("voltage", "force", "regressor"),
                ],
                x=(-0.5, 4.5), y=(-5, 80), x_label="voltage (V)", y_label="force (gf)",
            )
        ],
        title="left out: points {points:.1f} gf, weights {weights:.1f} gf",
    )  # fmt: skip


@remembered
def _classifier() -> FastKind:
    training = contacts(TRAINING)
    return FastKind.from_fitted(bagged_neighbours().fit(training.responses, training.kinds))


def kind_of(responses: Floats) -> str:
    """Return the kind that the bagging classifier tells; "nothing" where no element responds."""
    return _classifier().predict(responses) if responses.max() > 0 else "nothing"


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
    kind = kind_of(responses)
    with style():
        drawn, axes = still(3.9, left=0.12)
        draw_elements(axes, responses, outline(found, pose))
        draw_estimate(axes, responses, line=kind == "line")
        axes.set(xlabel="mm", ylabel="mm")
        axes.set_title(f"{item}: felt as {kind}, is {found.kind}", fontsize=9.5)
    return drawn
