"""Recomputation of the numbers printed in Chapter 6."""

from typing import Any

import numpy as np

from softgrip.control.step_metrics import settling_time
from softgrip.gripper.gripper_loop import GripperRun, noise_gain, run_gripper, synchronization_error
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse, moore_penrose_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.reach import direction, project
from softgrip.gripper.shaping_filter import FAST, SLOW, filter_state_space
from softgrip.materials.arrays import Floats
from softgrip.units import DEG, REV

FILTERS = {"4.8/s": FAST, "2/s": SLOW}


def projection(spa: str, share: float = 0.333, digits: int | None = None) -> float:
    """Return an element of proj(Y_d) for equal angles of share pi, in pi rad, Eq. (6.25).

    With ``digits`` the direction q is cut to as many, and the result rounded.
    """
    q = direction(PRINTED).real
    q = q if digits is None else np.floor(10**digits * q) / 10**digits
    found = float(share * q.sum() * q[int(spa) - 1])
    return found if digits is None else round(found, digits)


def residual(spa: str, share: float = 0.333, digits: int | None = None) -> float:
    """Return an element of res(Y_d) for equal angles of share pi, in pi rad."""
    return share - projection(spa, share, digits)


def reference_degrees(finger: str, swapped: bool = False, digits: int | None = None) -> float:
    """Return the reference of the "left" (SPA 1) or "right" finger for 45 deg, in deg."""
    spa = "1" if (finger == "left") != swapped else "2"
    return 180 * projection(spa, 0.25, digits)


def inverse_denominator() -> float:
    """Return the common denominator of the mean of the elements' inverses."""
    return float(1 / mean_inverse(PRINTED).polynomials[0, 0])


def inverse_gap(frequency: float) -> float:
    """Return the largest difference of the printed inverse and Theorem 2's, in percent."""
    s = 1j * frequency
    ratio = mean_inverse(PRINTED)(s) / moore_penrose_inverse(PRINTED)(s)
    return float(100 * np.abs(ratio - 1).max())


def loop_gain(target: str) -> float:
    """Return k of the loop k/s that a printed H has at low frequencies, rad/s."""
    s = 1e-5j
    low_pass = filter_state_space(*FILTERS[target])(s).item()
    return float(abs(s * low_pass / (1 - low_pass)))


def step(target: str = "4.8/s", share: float = 0.333, period: float = 0.005) -> GripperRun:
    """Run the printed controller on the printed plant for 4 s; 5 ms stand for no sampling."""
    return run(period=period, printed=FILTERS[target], angle=share * np.pi)


def settling(
    target: str = "4.8/s", share: float = 0.333, band: float = 0.05, spa: str = ""
) -> float:
    """Return the settling time of both fingers, or of one, in s; ``band`` is a share."""
    found = step(target, share)
    times = settling_time(found.time, found.angles, final=targets(share), band=band)
    return float(times[int(spa) - 1] if spa else times.max())


def tracking_error(after: float) -> float:
    """Return the largest error from proj(Y_d) after a time [s], in deg."""
    found = step()
    error = np.abs(found.angles - targets(0.333)[:, None]) / DEG
    return float(error[:, found.time >= after].max())


def push_error(push: float) -> float:
    """Return the largest error when a push [rad] acts on the left finger for 1 s, in rad."""
    found = run(period=0.1, angle=0.333 * np.pi, push=lambda t: (push * (1.4 <= t < 2.4), 0.0))
    error = np.abs(found.angles - targets(0.333)[:, None])
    return float(error[:, found.time >= 1.4].max())


def noise_error(period: float = 0.1, noise: float = 2.0) -> float:
    """Return the larger RMS error of the two fingers from the sensors' noise, in deg."""
    low_pass = filter_state_space(*FAST)
    matrices = controller_matrices(PRINTED, mean_inverse(PRINTED), low_pass, period=period)
    return float(noise * noise_gain(PRINTED, matrices).max())


def peak_speed(target: str = "4.8/s", per_unit: float = 1 / REV, period: float = 0.1) -> float:
    """Return the largest motor speed of a step, in rev/s; a unit of U is so many rev/s."""
    return float(per_unit * np.abs(step(target, period=period).commands).max())


def highest_frequency(period: float = 0.1) -> float:
    """Return the highest frequency that samples at a period [s] can show, in rad/s."""
    return np.pi / period


def transient_difference(target: str = "4.8/s") -> float:
    """Return by how much the fingers are apart at most on the way to 45 deg, in deg."""
    apart = synchronization_error(step(target, 0.25).angles, targets(0.25))
    return float(apart.max() / DEG)


def outside(right: float) -> float:
    """Return which share of a target (pi/4, right pi/4) is outside the image of P."""
    return project(PRINTED, [np.pi / 4, right * np.pi / 4]).share


def targets(share: float) -> Floats:
    """Return proj(Y_d) for equal angles of share pi, rad."""
    return project(PRINTED, [share * np.pi] * 2).reached


def run(
    *, period: float, printed: tuple[Any, Any] = FAST, angle: float, **conditions: Any
) -> GripperRun:
    """Run the printed controller on the printed plant for 4 s."""
    goal, low_pass = project(PRINTED, [angle] * 2).reached, filter_state_space(*printed)
    loop = InternalModelController(PRINTED, goal, mean_inverse(PRINTED), low_pass, period=period)
    return run_gripper(PRINTED, loop, duration=4.0, points=round(period / 0.005), **conditions)
