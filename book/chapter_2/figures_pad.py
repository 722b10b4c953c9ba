"""Figures and tables of Chapter 2 on the pad: what it shows, place and angle of a contact."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from book.chapter_2.logs import OBJECTS, TRAINING, contacts, errors
from book.companion.claims import printed
from book.companion.exhibit import figure, table
from book.companion.style import BLACK, BLUE, GREEN, ORANGE, VERMILION, WIDTH
from softgrip.arrays import Floats
from softgrip.provenance import Provenance, data_rows
from softgrip.simulator.fitted_rigs import PAD, fitted_pad
from softgrip.simulator.pad import ideal_responses, make_pad, press, responses_to
from softgrip.simulator.pad_objects import PadObject, pad_object
from softgrip.simulator.pad_surface import Pose
from softgrip.simulator.pad_tests import PAD_SEED
from softgrip.tactile.contact_pose import FELT, line_angle, place
from softgrip.tactile.contacts import KINDS
from softgrip.tactile.pad_layout import ELEMENT_SIDE, PAD_SIZE, THREE_TWO_THREE
from softgrip.units import DEG, MM

LOGS = (TRAINING, OBJECTS)


@dataclass(frozen=True)
class DrawnGrasp:
    """A grasp of Figure 2.13: object, how it lies, and the claim of its force in Section 2.4."""

    name: str
    pose: Pose
    claim: str

    @property
    def item(self) -> PadObject:
        """What is grasped."""
        return pad_object(self.name)

    @property
    def force(self) -> float:
        """N."""
        return printed(self.claim)

    @property
    def responses(self) -> Floats:
        """What the pad feels, shape (elements,)."""
        pad = make_pad(fitted_pad(), PAD_SEED)
        return responses_to(pad, press(pad, self.item, self.pose, self.force))


GRASPS = (
    DrawnGrasp("egg", Pose((0.0, 2 * MM)), "2.4-desired-force-egg"),
    DrawnGrasp("tofu", Pose((0.0, 0.0)), "2.4-desired-force-tofu"),
    DrawnGrasp("small carrot", Pose((0.0, 1 * MM)), "2.4-desired-force-carrot"),
    *(
        DrawnGrasp("small carrot", Pose((0.0, 0.0), angle * DEG), "2.4-desired-force-carrot")
        for angle in (60, 90, -45)
    ),
)
"""Places and angles are not printed."""
BALL, ROD, FORCE = "ball 20 mm", "rod 20 mm", 0.15
"""What the maps are drawn with, and its force, N."""
BESIDE = 3.0
"""How far the second rod of Figure 2.D lies beside the middle, mm."""


COLOURS = LinearSegmentedColormap.from_list("touch", ["#FFFFFF", "#FC9272", "#A50F15"])
"""White at rest to dark red, ever darker: light and dark tell the same without colour."""


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

    Returns:
        ScalarMappable: What a colour bar takes.
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


@figure("2.13", Provenance.SIMULATED)
def figure_2_13() -> Figure:
    """Draw the pad under six grasps."""
    drawn = Figure(figsize=(WIDTH, 7.2))
    scale: Any = None
    panels = drawn.subplots(3, 2)
    for axes, letter, grasp in zip(panels.flat, "abcdef", GRASPS, strict=True):
        found = grasp.responses
        scale = draw_elements(axes, found, outline(grasp.item, grasp.pose))
        draw_estimate(axes, found, line=grasp.item.kind == "line")
        axes.set_title(f"({letter}) {grasp.name}, {grasp.force:.2f} N", fontsize=9.5)
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


@figure("2.C", Provenance.SIMULATED)
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


@figure("2.D", Provenance.SIMULATED)
def figure_2_d() -> Figure:
    """Draw the error of the angle on the ideal pad, and the angles of the log."""
    drawn = Figure(figsize=(WIDTH, 6.4))
    upper, lower = drawn.subplots(2, 1, height_ratios=(2, 3))
    true = np.arange(-90, 91, 2.0)
    rods = ((0.0, "through the middle", BLUE, "-"), (BESIDE, f"{BESIDE:g} mm beside", ORANGE, "--"))
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


def _row(name: str, log: str, chosen: Any) -> dict[str, object]:
    """Return errors of some contacts of a log."""
    off = errors(log)
    at, angle = off.place[chosen] / MM, off.angle[chosen] / DEG
    felt, told = at[np.isfinite(at)], angle[np.isfinite(angle)]
    return {
        "contacts": name,
        "number": int(at.size),
        "elements felt": f"{off.elements[chosen].mean():.1f}",
        "place: median (mm)": f"{np.median(felt):.1f}",
        "place: 90 % (mm)": f"{np.percentile(felt, 90):.1f}",
        "nothing felt": int(at.size - felt.size),
        "angle: median (deg)": f"{np.median(told):.0f}" if told.size else "",
        "angle: 90 % (deg)": f"{np.percentile(told, 90):.0f}" if told.size else "",
    }


@table("2.C", Provenance.SIMULATED)
def table_2_c() -> pd.DataFrame:
    """Tabulate the errors by kind, by number of elements, and by food."""
    learned, tested = (contacts(name) for name in LOGS)
    rows = [_row(f"training, {kind}", LOGS[0], learned.kinds == kind) for kind in KINDS]
    counts = errors(LOGS[0]).elements
    for least, most, words in ((2, 2, "two"), (3, 3, "three"), (4, 8, "four and more")):
        chosen = (learned.kinds == "line") & (counts >= least) & (counts <= most)
        rows.append(_row(f"training, line felt by {words}", LOGS[0], chosen))
    foods = dict.fromkeys(tested.objects.tolist())
    rows += [_row(food, LOGS[1], tested.objects == food) for food in sorted(foods)]
    return pd.DataFrame(rows)


PARAMETERS = {
    "pad.young_modulus [Pa]": "Young's modulus of elements and cover (Pa)",
    "pad.cut [1]": "width of an element's flat top, of its base",
    "pad.cover [m]": "thickness of the cover (m)",
    "pad.spread [m]": "half the side of the square that presses an element (m)",
    "pad.rest_spread [1]": "deviation between elements: resistance at rest",
    "pad.gain_spread [1]": "the same: change of resistance",
    "pad.stiffness_spread [1]": "the same: stiffness",
    "pad.height_spread [m]": "the same: height (m)",
    "pad.repeatability [1]": "deviation from contact to contact: change of resistance",
    "pad.noise [V]": "noise of an element's voltage (V)",
    "pad.tilt [rad]": "deviation of how level an object is held (rad)",
    "layer.soft_force [N]": "force over which the layer becomes conductive (N)",
    "layer.memory_fast [1]": "part of a force that the layer feels late, fast",
    "layer.memory_slow [1]": "the same, slow",
    "layer.voltage_noise [V]": "noise of the layer's voltage (V)",
    "layer.seating [1]": "deviation from weight to weight: part that is felt",
    "layer.object_seating [1]": "the same, from object to object",
}
"""Words for the fitted parameters of pad and layer."""


@table("2.D", Provenance.SIMULATED)
def table_2_d() -> pd.DataFrame:
    """Tabulate the fitted parameters of the simulated pad, with what the prints leave to them."""
    return pd.DataFrame(
        {
            "parameter": PARAMETERS[row["parameter [unit]"]],
            "value": f"{float(row['value']):.3g}",
            "90 % interval": f"{float(row['low']):.3g} to {float(row['high']):.3g}"
            if row["low"]
            else "",
            "by the prints": row["status"],
        }
        for row in data_rows(PAD)
    )
