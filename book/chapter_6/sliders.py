"""What the sliders of Chapter 6 move."""

from collections.abc import Sequence
from itertools import chain
from typing import Any

import numpy as np

from book.chapter_6.figures_model import SPA
from book.chapter_6.plane_of_angles import in_plane
from book.companion.style import BLUE, MEASURED, ORANGE, PRINTED, VERMILION
from book.explore.finger_picture import gripper as fingers
from book.explore.plot import Dots, Level, Line, Panel, Plot
from book.explore.scan import Numbers, scan
from book.explore.small_matrices import Matrix, bilinear, matrix, numbers, taken, times
from softgrip.arrays import Floats, Number, chosen
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.plant import PRINTED as GRIPPER
from softgrip.gripper.plant import FingerDynamics, Gripper
from softgrip.gripper.shaping_filter import low_pass
from softgrip.units import DEG

DURATION, POINTS = 5.0, 5
PUSHED_FROM = 2.5
"""s."""


def as_far_apart(spread: float) -> Gripper:
    """Return two fingers about the mean of the printed ones, as far apart as these times a factor.

    At 1 they are those of Eq. (6.26).
    """
    mean = GRIPPER.mean
    return Gripper(
        tuple(
            FingerDynamics(
                mean.damping + spread * (finger.damping - mean.damping),
                mean.stiffness + spread * (finger.stiffness - mean.stiffness),
                finger.gain,
            )
            for finger in GRIPPER.fingers
        )
    )


def gripper_step(bandwidth: Number, spread: Number, noise: Number) -> dict[str, Any]:
    """Return a step to 60 deg at 100 ms with the low-pass of Remark 4.

    Args:
        bandwidth: Cut-off of the filter, rad/s.
        spread: Factor on the difference of the two fingers; 1 is that of Eq. (6.26).
        noise: RMS of each measured angle, deg.
    """
    return _run(bandwidth, spread, noise, 0.0)


def gripper_push(bandwidth: Number, spread: Number, disturbance: Number) -> dict[str, Any]:
    """Return a step as `gripper_step` without noise, and a force on the left finger from 2.5 s on.

    Args:
        bandwidth, spread: As of `gripper_step`.
        disturbance: By how much the force alone would bend the finger, deg.
    """
    return _run(bandwidth, spread, 0.0, disturbance)


def _run(bandwidth: Number, spread: Number, noise: Number, disturbance: Number) -> dict[str, Any]:
    """Return what `run_gripper` does with an `InternalModelController`, point by point.

    A second writing: python-control and SciPy make neither fingers nor filter discrete for symbols.
    """
    gripper = as_far_apart(spread)
    fingers, speeds = gripper.fingers, [finger.velocity_gain for finger in gripper.fingers]
    # Eq. (6.25) at rest, for the same angle of both.
    along = np.pi / 3 * sum(speeds) / sum(v**2 for v in speeds)
    goal = [along * v for v in speeds]
    shaped = filtered_mean_inverse(gripper, bandwidth)
    given = [
        *numbers(*shaped), *goal, noise * DEG, disturbance * DEG,
        *chain(*(swing(finger, t) for t in (PERIOD, PERIOD / POINTS) for finger in fingers)),
    ]  # fmt: skip
    gains = [finger.gain for finger in fingers]

    def point(state: Numbers, row: Numbers, given: Numbers) -> tuple[Numbers, Numbers]:
        (due, pushed, *errors), rest = row, iter(given)
        A, B, C, D = (taken(rest, *each.shape) for each in shaped)
        aim, (noise, force) = taken(rest, 1, 2)[0], taken(rest, 1, 2)[0]
        model_swing, real_swing = taken(rest, 2, 4), taken(rest, 2, 4)
        left = iter(state)
        filtered, model, real = taken(left, 1, 3)[0], taken(left, 1, 5)[0], taken(left, 1, 5)[0]
        command, peak = left
        angles = [g * q for g, q in zip(gains, real[1::2], strict=True)]
        # What the inverse sees: Y_d - (y - P u).
        wanted = [
            goal - (angle + noise * e - g * q)
            for goal, angle, e, g, q in zip(aim, angles, errors, gains, model[1::2], strict=True)
        ]
        command = chosen(due, times(C, filtered)[0] + times(D, wanted)[0], command)
        peak = chosen(due, np.maximum(peak, np.abs(command)), peak)
        sampled = (
            *(a + b for a, b in zip(times(A, filtered), times(B, wanted), strict=True)),
            *moved(model, command, PERIOD, model_swing, gains, (0.0, 0.0)),
        )
        inside = [
            chosen(due, new, old) for new, old in zip(sampled, (*filtered, *model), strict=True)
        ]
        forces = pushed * force, 0.0
        real = moved(real, command, PERIOD / POINTS, real_swing, gains, forces)
        return (*inside, *real, command, peak), (*(angle / DEG for angle in angles), peak)

    found = scan(point, [0.0] * 15, _rows(), given)
    return {
        "time": PERIOD / POINTS * np.arange(len(_rows())),
        "SPA_1": found[0],
        "SPA_2": found[1],
        "goal_1": goal[0] / DEG,
        "goal_2": goal[1] / DEG,
        "peak": found[2][-1],
    }


def _rows() -> Floats:
    """Return, for each point, whether a sample is due and the finger is pushed, and the noise."""
    samples = round(DURATION / PERIOD)
    due = np.arange(samples * POINTS + 1) % POINTS == 0
    due[-1] = False
    begins = [k * PERIOD + j * PERIOD / POINTS for k in range(samples + 1) for j in range(POINTS)]
    pushed = np.array(begins[: len(due)]) >= PUSHED_FROM
    noise = np.zeros((len(due), 2))
    noise[due] = np.random.default_rng(0).standard_normal((samples, 2))
    return np.column_stack([due, pushed, noise])


def filtered_mean_inverse(
    gripper: Gripper, bandwidth: Number
) -> tuple[Matrix, Matrix, Matrix, Matrix]:
    """Return the sampled `filtered_inverse` of `mean_inverse` and `low_pass`, for symbols too.

    Args:
        gripper: Two fingers.
        bandwidth: Cut-off of the low-pass, rad/s, > 0.
    """
    unit = low_pass(1.0)
    # A low-pass of another cut-off is the same one in another unit of time.
    A, B, C = (matrix(part.tolist()) for part in (unit.A, unit.B, unit.C))
    A, B = bandwidth * A, bandwidth * B
    columns, D = [], []
    for finger in gripper.fingers:
        share = 1 / (len(gripper.fingers) * finger.gain)
        columns.append(share * (A @ (A @ B + finger.damping * B) + finger.stiffness * B))
        D.append(share * (C @ A @ A @ B))
    return bilinear(A, A @ matrix([columns]), C, matrix([D]), PERIOD)


def swing(finger: FingerDynamics, time: Number) -> tuple[Number, Number, Number, Number]:
    """Return damping and stiffness, and the two free motions of a finger after a time [s].

    These are ``exp(-damping t / 2)`` times ``cos(w t)`` and ``sin(w t) / w``: `free_motion` of
    `softgrip.dynamics.second_order` for a finger that swings, ``stiffness > damping**2 / 4``.
    """
    half = finger.damping / 2
    w = np.sqrt(finger.stiffness - half**2)
    decay = np.exp(-half * time)
    return finger.damping, finger.stiffness, decay * np.cos(w * time), decay * np.sin(w * time) / w


def moved(
    state: Numbers,
    command: Number,
    time: float,
    swings: Sequence[Numbers],
    gains: Numbers,
    forces: Numbers,
) -> list[Number]:
    """Return the states of `plant.state_space` after a time in which the command is held: exact.

    The pump's state ramps. What deviates from the ramp that each finger then follows moves freely.

    Args:
        state: Integral of the command, then angle and rate over gain of each finger.
        command: Held.
        time: s.
        swings: Of `swing`, after that time, one a finger.
        gains: Of the fingers, rad/s^3.
        forces: On each, by the angle that it would bend the finger alone, rad.
    """
    pumped, *rest = state
    after = [pumped + time * command]
    for k, ((damping, stiffness, c, s), gain, force) in enumerate(
        zip(swings, gains, forces, strict=True)
    ):
        slope = command / stiffness
        ramp = (pumped - damping * slope) / stiffness + force / gain
        angle, rate = rest[2 * k] - ramp, rest[2 * k + 1] - slope
        after += [
            ramp + slope * time + (c + damping / 2 * s) * angle + s * rate,
            slope - stiffness * s * angle + (c - damping / 2 * s) * rate,
        ]
    return after


FARTHEST = 20.0
"""Frequency up to which the path of the foot is drawn, rad/s."""


def reach(frequency: Number, spread: Number, first: Number, second: Number) -> dict[str, Any]:
    """Return what one pump reaches of a target, in the plane of both angles.

    Args:
        frequency: At which command and target swing, rad/s; 0 is at rest.
        spread: As of `gripper_step`.
        first, second: The target, deg.
    """
    gripper, target = as_far_apart(spread), (first, second)
    here = in_plane(gripper, frequency)
    foot = here.foot(target)
    x, y = here.path(target, np.linspace(0, 2 * np.pi, 91))
    every = in_plane(gripper, np.geomspace(0.05, FARTHEST, 80)).foot(target)
    long = np.array([-10.0, 140.0])
    return {
        "line_1": long * np.cos(here.turned),
        "line_2": long * np.sin(here.turned),
        "path_1": x,
        "path_2": y,
        "feet_1": every[0],
        "feet_2": every[1],
        "miss_1": [first, foot[0]],
        "miss_2": [second, foot[1]],
        "foot_1": foot[0],
        "foot_2": foot[1],
        "missed": 100 * here.missed(target),
        "turned": here.turned / DEG,
    }


REACH_PLOT = Plot(
    [
        Panel(
            [
                Line("path_1", "path_2", "both angles, swinging", colour=ORANGE, width=1.4),
                Line("line_1", "line_2", "line of one pump", colour=BLUE),
                Line("feet_1", "feet_2", "foot at all frequencies", colour=PRINTED, dash="2 3"),
                Line("miss_1", "miss_2", "out of reach", colour=VERMILION, dash="6 3"),
                Dots("first", "second", "target", colour=MEASURED, radius=4.5),
                Dots("foot_1", "foot_2", "nearest", colour=VERMILION, radius=4.5),
            ],
            x=(-4, 95), y=(-4, 95), x_label="angle of SPA 1 (deg)", y_label="angle of SPA 2 (deg)",
            equal=True, share=0.6,
        ),
        fingers(("foot_1", "foot_2"), "", SPA, share=0.4),
    ],
    title="{missed:.1f} % of the target is out of reach; the line stands at {turned:.1f} deg",
)  # fmt: skip


GRIPPER_PLOT = Plot(
    [
        Panel(
            [
                Level("goal_1", colour=PRINTED),
                Level("goal_2", colour=PRINTED, label="goals"),
                Line("time", "SPA_1", "SPA 1", colour=SPA[0]),
                Line("time", "SPA_2", "SPA 2", colour=SPA[1], dash="6 3"),
            ],
            x=(0, DURATION), y=(0, 90), x_label="time (s)", y_label="angle (deg)", share=0.64,
        ),
        fingers(("SPA_1", "SPA_2"), "time", SPA),
    ],
    title="largest command {peak:.1f} units",
)  # fmt: skip
