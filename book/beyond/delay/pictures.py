"""Pictures of the page *Delay, and fingers that stay together*."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from book.beyond.delay.kept import cell
from book.beyond.delay.methods import METHODS
from book.beyond.delay.sweep import DELAYS, FINGERS, Cell
from book.chapter_6.controllers import own_model, target_angles
from book.companion.style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, sheet
from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.gripper.delayed_batch import LateMotion, run_late
from softgrip.gripper.delayed_plant import DelayedGripper, delayed_outside_share
from softgrip.gripper.gripper_batch import GripperBatch
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.synchronization import synchronization_error
from softgrip.units import DEG

LINES: dict[str, tuple[str, str, str]] = {
    "printed, 4.8/s": (GREY, ":", "v"),
    "printed, 2/s": (BLACK, "--", "s"),
    "mean angle": (ORANGE, "-.", "^"),
    "best feedforward": (GREEN, ":", "x"),
    "Smith, 2/s": (BLUE, "-", "o"),
    "predictive": (VERMILION, "-", "D"),
    "learned": (GREY, "-", "*"),
}
"""Colour, dash and mark of each method drawn; the filtered predictor stands in the table."""
RESPONSES = ("printed, 4.8/s", "printed, 2/s", "Smith, 2/s", "predictive")
DELAY = 0.3
"""Of the responses, s."""
DURATION = 6.0


def response(method: str, delay: float = DELAY, duration: float = DURATION) -> LateMotion:
    """Return a step of the book's own gripper, known exactly and without noise."""
    known = [DelayedGripper(own_model(), (delay, delay))]
    targets = target_angles(own_model())[None]
    return run_late(
        [GripperBatch.of(own_model())],
        np.full((1, 2), delay),
        METHODS[method](known, targets),
        np.zeros((1, 2, 1, round(duration / PERIOD))),
        limit=SPEED_LIMIT,
    )


def draw_responses() -> Figure:
    """Draw both angles, and how far they are apart, for a late step by each method."""
    drawn, axes = sheet(4.2, 2, len(RESPONSES), sharex=True, sharey="row")
    targets = target_angles(own_model())
    for (top, low), method in zip(axes.T, RESPONSES, strict=True):
        made = response(method)
        angles = made.angles[0, :, 0]
        for own, target, colour, dash, name in zip(
            angles, targets, (BLUE, ORANGE), ("-", "--"), ("left", "right"), strict=True
        ):
            top.axhline(target / DEG, color=GREY, lw=0.7, ls=":")
            top.plot(made.time, own / DEG, color=colour, ls=dash, label=name)
        low.plot(made.time, synchronization_error(angles, targets) / DEG, color=BLACK)
        top.set(title=method, ylim=(0, 90))
        low.set(xlabel="time (s)", xlim=(0, DURATION), ylim=(0, None))
    axes[0, 0].set(ylabel="angle (deg)")
    axes[1, 0].set(ylabel="apart (deg)")
    axes[0, 0].legend(fontsize=8, loc="lower right")
    return drawn


def _curve(axes: Axes, method: str, x: Sequence[float], cells: Sequence[Cell]) -> None:
    colour, dash, mark = LINES[method]
    low, middle, high = np.array([(one.low, one.value, one.high) for one in cells]).T
    axes.fill_between(x, low, high, color=colour, alpha=0.18, lw=0)
    axes.plot(x, middle, color=colour, ls=dash, marker=mark, ms=4, lw=1.3, label=method)


def draw_apart() -> Figure:
    """Draw how far fingers are apart over the delay, and over their number, by method."""
    drawn, (left, right) = sheet(3.8, 1, 2)
    for method in LINES:
        _curve(left, method, DELAYS, [cell(method, "apart", d) for d in DELAYS])
        over = [cell(method, "apart", DELAYS[-1], fingers=n) for n in FINGERS]
        _curve(right, method, FINGERS, over)
    left.set(xlabel="delay (ms)", ylabel="apart on the way (deg)", title="(a) two fingers")
    right.set(xlabel="fingers", xticks=FINGERS, title=f"(b) {DELAYS[-1]} ms")
    right.legend(fontsize=7.5, loc="lower right")
    for axes in (left, right):
        axes.set_ylim(0, None)
    return drawn


def draw_settling() -> Figure:
    """Draw when fingers have settled over the delay, and with a delay that is taken wrongly."""
    drawn, (left, right) = sheet(3.6, 1, 2, sharey=True)
    for method in LINES:
        _curve(left, method, DELAYS, [cell(method, "settling", d) for d in DELAYS])
    for method in ("Smith, 2/s", "predictive"):
        for wrong, dash in ((-30, ":"), (0, "-"), (30, "--")):
            found = [cell(method, "settling", d, wrong=wrong) for d in DELAYS[1:]]
            right.plot(
                DELAYS[1:],
                [one.value for one in found],
                color=LINES[method][0], ls=dash, marker=LINES[method][2], ms=4,
                label=f"{method}, {wrong:+d} %" if wrong else method,
            )  # fmt: skip
    left.set(
        xlabel="delay (ms)", ylabel="settled after (s)", title="(a) delay known", ylim=(0, 9.5)
    )
    right.set(xlabel="delay (ms)", title="(b) taken wrongly")
    left.legend(fontsize=7.5, loc="upper left")
    right.legend(fontsize=7.5, loc="upper left")
    return drawn


FREQUENCIES: Floats = np.linspace(0.0, 6.0, 121)
"""rad/s."""
DIFFERENCES = (0.0, 0.025, 0.05, 0.1)
"""Of the fingers' delays, s."""


def draw_reach() -> Figure:
    """Draw which share of the target no command reaches, for differences of the delays."""
    drawn, axes = sheet(3.0)
    target = target_angles(own_model())
    for difference, colour, dash in zip(
        DIFFERENCES, (BLACK, BLUE, ORANGE, VERMILION), ("-", "--", "-.", ":"), strict=True
    ):
        plant = DelayedGripper(own_model(), (0.1 + difference, 0.1))
        share = 100 * delayed_outside_share(plant, target, FREQUENCIES)
        axes.plot(FREQUENCIES, share, color=colour, ls=dash, label=f"{1000 * difference:g} ms")
    axes.set(xlabel="frequency (rad/s)", ylabel="out of reach (%)", xlim=(0, 6), ylim=(0, None))
    axes.legend(title="difference")
    return drawn
