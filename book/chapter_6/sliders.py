"""What the sliders of Chapter 6 draw."""

import numpy as np
from matplotlib.figure import Figure

from book.chapter_6.figures_model import SPA
from book.companion.style import PRINTED, still, style
from softgrip.gripper.gripper_loop import run_gripper
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED as GRIPPER
from softgrip.gripper.plant import FingerDynamics, Gripper
from softgrip.gripper.reach import project
from softgrip.gripper.shaping_filter import low_pass
from softgrip.units import DEG


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


def draw_step(bandwidth: float, spread: float, noise: float) -> Figure:
    """Draw a step to 60 deg at 100 ms with the low-pass of Remark 4.

    Args:
        bandwidth: Cut-off of the filter, rad/s.
        spread: Factor on the difference of the two fingers; 1 is that of Eq. (6.26).
        noise: RMS of each measured angle, deg.
    """
    return _draw(bandwidth, spread, noise, 0.0)


def draw_push(bandwidth: float, spread: float, disturbance: float) -> Figure:
    """Draw a step as `draw_step` without noise, and a force on the left finger from 2.5 s on.

    Args:
        bandwidth, spread: As of `draw_step`.
        disturbance: By how much the force alone would bend the finger, deg.
    """
    return _draw(bandwidth, spread, 0.0, disturbance)


def _draw(bandwidth: float, spread: float, noise: float, disturbance: float) -> Figure:
    gripper, pushed = as_far_apart(spread), disturbance * DEG
    goal = project(gripper, [np.pi / 3] * 2).reached
    matrices = controller_matrices(gripper, mean_inverse(gripper), low_pass(bandwidth))
    controller = InternalModelController(matrices, goal)
    found = run_gripper(
        gripper,
        controller,
        duration=5.0,
        noise=noise * DEG,
        push=lambda t: (pushed if t >= 2.5 else 0.0, 0.0),
        points=5,
    )
    peak = float(np.abs(found.commands).max())
    with style():
        drawn, axes = still(3.0)
        for k, (colour, dash) in enumerate(zip(SPA, ("-", "--"), strict=True)):
            axes.axhline(goal[k] / DEG, color=PRINTED, lw=1, ls=":")
            axes.plot(
                found.time, found.angles[k] / DEG, color=colour, ls=dash, label=f"SPA {k + 1}"
            )
        axes.set(xlabel="time (s)", ylabel="angle (deg)", xlim=(0, 5), ylim=(0, 90))
        axes.set_title(f"largest command {peak:.1f} units")
        axes.legend(loc="lower right", ncols=2)
    return drawn
