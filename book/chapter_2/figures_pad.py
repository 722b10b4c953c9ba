"""Figures of Chapter 2 on the pad: what it shows, place and pose of a contact."""

from functools import cache
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from book.chapter_2.contacts import PAD_SEED
from book.chapter_2.places import PlaceErrors, ideal_responses, place_errors, responses_to
from book.chapter_2.sliders_pad import draw_elements, draw_estimate, outline
from book.companion.exhibit import figure
from book.companion.style import BLUE, GREEN, ORANGE, VERMILION, WIDTH
from softgrip.arrays import Floats
from softgrip.logs.contacts import read_contacts
from softgrip.provenance import Provenance, data_file
from softgrip.simulator import pad_calibration_table
from softgrip.simulator.pad import make_pad, press
from softgrip.simulator.pad_objects import pad_object
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_pose import line_angle, place
from softgrip.tactile.contacts import KINDS, Contacts
from softgrip.tactile.pad_layout import THREE_TWO_THREE
from softgrip.units import DEG, MM

LOGS = ("simulated/pad-training.csv", "simulated/pad-objects.csv")
CALIBRATION = pad_calibration_table.FILE
GRASPS = (
    ("egg", (0.0, 2.0), 0.0, 0.30),
    ("tofu", (0.0, 0.0), 0.0, 0.09),
    ("small carrot", (0.0, 1.0), 0.0, 0.08),
    ("small carrot", (0.0, 0.0), 60.0, 0.08),
    ("small carrot", (0.0, 0.0), 90.0, 0.08),
    ("small carrot", (0.0, 0.0), -45.0, 0.08),
)
"""Figure 2.13: object, place (mm), angle (deg) and the force that Section 2.4 grasps with (N).
Places and angles are not printed."""
BALL, ROD, FORCE = "ball 20 mm", "rod 20 mm", 0.15
"""What the maps are drawn with, and its force, N."""


@cache
def contacts(name: str) -> Contacts:
    """Return the contacts of a simulated log below ``data/``."""
    return read_contacts(data_file(name).path)


@cache
def errors(name: str) -> PlaceErrors:
    """Return the errors of its contacts."""
    return place_errors(contacts(name), THREE_TWO_THREE)


@figure(
    "2.13",
    caption="Responses of the *simulated* pad to an egg, tofu and a carrot under the forces of "
    "Section 2.4, elements as squares, with the responses that are felt (above 0.05: the tofu "
    "stays below, with 0.01 N on each element); green, dashed: the profile of the object (places, "
    "angles and the layout are assumed); blue: the estimated place, and the direction of a line. "
    "Objects are smooth and level here.",
    alt="Six drawings of a pad with eight squares in rows of three, two and three. Under the egg "
    "the two middle squares are red and the one above them is pale; under the tofu all eight are "
    "almost white; under the carrot two or three squares that lie along it are pale red. A blue "
    "line runs along it or, where it lies askew, up to some twenty degrees off.",
    provenance=Provenance.SIMULATED,
    data=(CALIBRATION,),
)
def figure_2_13() -> Figure:
    """Draw the pad under six grasps."""
    drawn = Figure(figsize=(WIDTH, 7.2))
    pad = make_pad(PadParameters(), PAD_SEED)
    scale: Any = None
    panels = drawn.subplots(3, 2)
    for axes, letter, (name, (x, y), angle, force) in zip(
        panels.flat, "abcdef", GRASPS, strict=True
    ):
        item, pose = pad_object(name), Pose((x * MM, y * MM), angle * DEG)
        found = responses_to(pad, press(pad, item, pose, force))
        scale = draw_elements(axes, found, outline(item, pose))
        draw_estimate(axes, found, line=item.kind == "line")
        axes.set_title(f"({letter}) {name}, {force:.2f} N", fontsize=9.5)
        axes.set(xticks=[], yticks=[])
        axes.spines[["left", "bottom"]].set_visible(False)
    for axes in panels[-1]:
        axes.set_xlabel("along the pad (40 mm)", fontsize=9)
    for axes in panels[:, 0]:
        axes.set_ylabel("across (38 mm)", fontsize=9)
    drawn.colorbar(scale, ax=panels, location="bottom", shrink=0.7, aspect=30, label="response")
    return drawn


def _place_map(step: float) -> tuple[Floats, Floats]:
    """Return places of a ball, m, shape (N, 2), and where the ideal pad finds it."""
    x, y = np.arange(-12, 12.1, step) * MM, np.arange(-11, 11.1, step) * MM
    true = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    felt = [ideal_responses(BALL, Pose((float(a), float(b))), FORCE) for a, b in true]
    return true, place(np.array(felt), THREE_TWO_THREE)


@figure(
    "2.C",
    caption="Place of a point contact by the centroid of the responses. (a) A ball of 20 mm, 0.15 "
    "N, on an ideal *simulated* pad: from the true place (end of each line) to the estimated one "
    "(dot). (b) Share of the simulated contacts whose error is up to a value, by kind, on the pad "
    "of the logs; to lines it is counted square to them.",
    alt="Two panels. In the first, lines run from a grid of true places to dots that gather on "
    "eight squares and on the straight connections between neighbours: a ball that meets one "
    "element only is found in its middle. In the second, three curves rise: errors of lines are "
    "the smallest, with a median of 0.8 millimetres, then points with 2.5, then surfaces with 4.",
    provenance=Provenance.SIMULATED,
    data=LOGS[:1],
)
def figure_2_c() -> Figure:
    """Draw how true places move to estimated ones, and the distribution of the errors."""
    drawn = Figure(figsize=(WIDTH, 6.4))
    upper, lower = drawn.subplots(2, 1, height_ratios=(3, 2))
    draw_elements(upper, np.zeros(THREE_TWO_THREE.elements))
    true, found = (values / MM for values in _place_map(2.0))
    upper.plot([true[:, 0], found[:, 0]], [true[:, 1], found[:, 1]], color=BLUE, lw=0.7)
    upper.plot(*found.T, ".", color=VERMILION, ms=5)
    upper.set(xlabel="mm", ylabel="mm", title="(a) ideal pad")
    for kind, colour, dash in zip(KINDS, (BLUE, ORANGE, GREEN), ("-", "--", ":"), strict=True):
        off = errors(LOGS[0]).place[contacts(LOGS[0]).kinds == kind]
        felt = np.sort(off[np.isfinite(off)]) / MM
        share = np.arange(1, felt.size + 1) / off.size
        lower.plot(felt, share, color=colour, ls=dash, label=kind)
    lower.set(xlabel="error (mm)", ylabel="share", title="(b) 630 contacts", xlim=(0, 12))
    lower.set(ylim=(0, 1))
    lower.legend(loc="lower right")
    return drawn


@figure(
    "2.D",
    caption="Angle of a line contact by the principal axis of the responses, *simulated*. (a) Its "
    "error over the true angle, for a rod of 20 mm through the middle of an ideal pad and 3 mm "
    "beside it, 0.15 N: while the same two elements are felt, the estimate stays and the error "
    "grows with the angle. (b) Those of the 210 lines of the training log that two elements or "
    "more felt, with rough objects, tilt, noise and drift.",
    alt="Two panels. In the first, both curves are saw-teeth about zero, with peaks up to 26 "
    "degrees through the middle and 21 beside it. In the second, most points lie within fifteen "
    "degrees of the diagonal, many on horizontal rows at 0, 61, 90 and minus 61 degrees, where two "
    "elements are felt; a few lie far off.",
    provenance=Provenance.SIMULATED,
    data=LOGS[:1],
)
def figure_2_d() -> Figure:
    """Draw the error of the angle on the ideal pad, and the angles of the log."""
    drawn = Figure(figsize=(WIDTH, 6.4))
    upper, lower = drawn.subplots(2, 1, height_ratios=(2, 3))
    true = np.arange(-90, 91, 2.0)
    rods = ((0.0, "through the middle", BLUE, "-"), (3.0, "3 mm beside", ORANGE, "--"))
    for offset, words, colour, dash in rods:
        error = [_signed_error(offset * MM, value * DEG) / DEG for value in true]
        upper.plot(true, error, color=colour, ls=dash, label=words)
    upper.set(ylabel="error (deg)", title="(a) ideal pad", xticks=np.arange(-90, 91, 30))
    upper.set(ylim=(-32, 45))
    upper.legend(loc="upper center", ncols=2)
    log = contacts(LOGS[0]).take(contacts(LOGS[0]).kinds == "line")
    found = line_angle(log.responses, THREE_TWO_THREE) / DEG
    given = log.angles / DEG
    # The estimate nearest to the truth: a line at 89 deg is one at -91 deg.
    found = given + (found - given + 90) % 180 - 90
    told = np.isfinite(found)  # one element alone has no direction
    lower.plot([-90, 90], [-90, 90], color=GREEN, lw=1)
    lower.plot(given[told], found[told], "o", color=BLUE, ms=3.5, mfc="none")
    lower.set(xlabel="true angle (deg)", ylabel="estimated (deg)", title=f"(b) {told.sum()} lines")
    lower.set(xticks=np.arange(-90, 91, 30), yticks=np.arange(-90, 91, 30))
    return drawn


def _signed_error(offset: float, angle: float) -> float:
    """Return estimate less truth, rad, of a rod beside the middle by an offset, m."""
    middle = (-offset * np.sin(angle), offset * np.cos(angle))
    found = line_angle(ideal_responses(ROD, Pose(middle, angle), FORCE), THREE_TWO_THREE)
    return float((found - angle + np.pi / 2) % np.pi - np.pi / 2)
