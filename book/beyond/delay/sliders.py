"""What the sliders of the page on delay move: the loop with a predictor, computed in the page."""

from itertools import chain
from typing import Any

import numpy as np

from book.chapter_6.figures_model import SPA
from book.chapter_6.sliders import filtered_mean_inverse, moved, swing
from book.companion.style import PRINTED
from book.explore.finger_picture import gripper as fingers
from book.explore.plot import Level, Line, Panel, Plot
from book.explore.scan import Numbers, scan
from book.explore.small_matrices import numbers, taken, times
from softgrip.arrays import Floats, Number, chosen
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.plant import PRINTED as GRIPPER
from softgrip.gripper.printed_loop import equal_targets
from softgrip.units import DEG

DURATION, POINTS = 6.0, 4
STEP = PERIOD / POINTS
LONGEST_DELAY, LARGEST_ERROR = 300.0, 50.0
"""ms and %: ends of the sliders."""
KEPT = int(LONGEST_DELAY / 1000 * (1 + LARGEST_ERROR / 100) / STEP) + 2
"""Points back to which angles are kept."""
FREE = (0.0, 0.0)


def late_step(delay: Number, error: Number, bandwidth: Number) -> dict[str, Any]:
    """Return a step to 60 deg of the printed fingers, late, with a predictor in the loop.

    Args:
        delay: From the command to the bending of both fingers, ms, 0 to `LONGEST_DELAY`.
        error: By how much the predictor takes it to be longer, %, down to -100, the printed loop,
            which knows of no delay.
        bandwidth: Cut-off of the low-pass of Remark 4, rad/s.
    """
    real_late = delay / 1000
    model_late = real_late * (1 + error / 100)
    pair, goal = GRIPPER.fingers, equal_targets().tolist()
    gains = [finger.gain for finger in pair]
    shaped = filtered_mean_inverse(GRIPPER, bandwidth)
    given = [
        *numbers(*shaped),
        *chain(*(swing(finger, STEP) for finger in pair)),
        *_hats(real_late),
        *_hats(model_late),
    ]
    mean = sum(goal) / 2

    def point(state: Numbers, row: Numbers, given: Numbers) -> tuple[Numbers, Numbers]:
        (due,), rest, left = row, iter(given), iter(state)
        A, B, C, D = (taken(rest, *each.shape) for each in shaped)
        swings = taken(rest, 2, 4)
        hats = taken(rest, 2, KEPT)
        filtered, command, apart = taken(left, 1, 3)[0], next(left), next(left)
        bodies = taken(left, 2, 5)  # the real fingers, and those of the model
        pasts = taken(left, 4, KEPT)  # of two fingers each
        angles = [[g * q for g, q in zip(gains, body[1::2], strict=True)] for body in bodies]
        now = [angle for body in angles for angle in body]
        pasts = [[new, *past[:-1]] for new, past in zip(now, pasts, strict=True)]
        late = [
            sum(weight * old for weight, old in zip(hats[k // 2], past, strict=True))
            for k, past in enumerate(pasts)
        ]
        seen = late[:2]
        # What the inverse sees: Y_d - (y - P u), both late.
        wanted = [
            aim - (angle - expected)
            for aim, angle, expected in zip(goal, seen, late[2:], strict=True)
        ]
        command = chosen(due, times(C, filtered)[0] + times(D, wanted)[0], command)
        after = [a + b for a, b in zip(times(A, filtered), times(B, wanted), strict=True)]
        inside = [chosen(due, new, old) for new, old in zip(after, filtered, strict=True)]
        shares = [angle / aim for angle, aim in zip(seen, goal, strict=True)]
        apart = np.maximum(apart, np.abs(shares[0] - shares[1]) * mean)
        ahead = [moved(body, command, STEP, swings, gains, FREE) for body in bodies]
        out = (*(angle / DEG for angle in seen), apart / DEG)
        return (*inside, command, apart, *chain(*ahead), *chain(*pasts)), out

    found = scan(point, [0.0] * (3 + 2 + 10 + 4 * KEPT), _due(), given)
    return {
        "time": STEP * np.arange(len(_due())),
        "SPA_1": found[0],
        "SPA_2": found[1],
        "goal_1": goal[0] / DEG,
        "goal_2": goal[1] / DEG,
        "apart": found[2][-1],
        "end": 100 * found[0][-1] / (goal[0] / DEG),
    }


def _hats(late: Number) -> list[Number]:
    """Return the weights of the kept points that give what was so long ago, straight between."""
    return [np.maximum(1 - np.abs(late / STEP - k), 0.0) for k in range(KEPT)]


def _due() -> Floats:
    """Return for each point whether a sample is due."""
    count = round(DURATION / STEP) + 1
    return np.asarray(np.arange(count) % POINTS == 0, dtype=np.float64)


LATE_PLOT = Plot(
    [
        Panel(
            [
                Level("goal_1", colour=PRINTED),
                Level("goal_2", colour=PRINTED, label="goals"),
                Line("time", "SPA_1", "SPA 1", colour=SPA[0]),
                Line("time", "SPA_2", "SPA 2", colour=SPA[1], dash="6 3"),
            ],
            x=(0, DURATION), y=(0, 110), x_label="time (s)", y_label="angle (deg)", share=0.64,
        ),
        fingers(("SPA_1", "SPA_2"), "time", SPA),
    ],
    title="at most {apart:.1f} deg apart; SPA 1 ends at {end:.0f} % of its goal",
)  # fmt: skip
