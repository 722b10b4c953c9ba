"""Recomputation of the numbers printed in Chapter 6, by linear model and on the rig."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np

from book.chapter_6 import comparison, filters, results
from book.chapter_6 import speed as gripper_speed
from book.companion.verdict import simulated
from softgrip.arrays import Number
from softgrip.control.step_metrics import settling_time
from softgrip.gripper.gripper_loop import GripperRun, noise_gain
from softgrip.gripper.internal_model import PERIOD, controller_matrices
from softgrip.gripper.inversion import mean_inverse, moore_penrose_inverse
from softgrip.gripper.plant import FingerDynamics, Gripper
from softgrip.gripper.printed_loop import FINE, equal_targets, run_loop
from softgrip.gripper.reach import direction, project
from softgrip.gripper.shaping_filter import far_pole, filter_state_space, plant_inside
from softgrip.reads import remembered
from softgrip.units import DEG, ML, REV

COMPARED = np.geomspace(0.1, 100, 200)
"""Frequencies at which filters are compared, rad/s."""


def fingers(
    stiffness: Sequence[float], damping: Sequence[float] = (1.0, 1.0), gain: float = 1.0
) -> Gripper:
    """Return two fingers of Eq. (6.26); damping and gain are of any size if they do not matter."""
    pairs = zip(damping, stiffness, strict=True)
    return Gripper(tuple(FingerDynamics(C, K, gain) for C, K in pairs))


def projection(
    spa: str, stiffness: Sequence[float], share: float, digits: int | None = None
) -> float:
    """Return an element of proj(Y_d) for equal angles of share pi, in pi rad, Eq. (6.25).

    With ``digits`` the direction q is cut to as many, and the result rounded.
    """
    q = direction(fingers(stiffness)).real
    q = q if digits is None else np.floor(10**digits * q) / 10**digits
    found = float(share * q.sum() * q[("spa1", "spa2").index(spa)])
    return found if digits is None else round(found, digits)


def rest_angle(
    other_angle: float, other: float, own: float, deviation: float = 0.0, way: int = 0
) -> float:
    """Return where a finger rests if another one rests at an angle under the same pressure.

    >>> rest_angle(50.0, 3.0, 2.0), rest_angle(50.0, 3.0, 2.0, 20.0, way=1)
    (75.0, 50.0)

    Args:
        other_angle: Of the other, in any unit, which is that of the result.
        other, own: Stiffnesses, the input alike.
        deviation: Of both from these, %: the own one up and the other down if `way` is 1.
        way: 1, -1, or 0 for none.
    """
    off = way * deviation / 100
    return other_angle * other * (1 - off) / (own * (1 + off))


def inverse_denominator(gain: float) -> float:
    """Return the common denominator of the mean of the elements' inverses."""
    return float(1 / mean_inverse(fingers([1.0, 1.0], gain=gain)).polynomials[0, 0])


def inverse_gap(frequency: float, damping: Sequence[float], stiffness: Sequence[float]) -> float:
    """Return the largest difference of the printed inverse and Theorem 2's, in percent."""
    s, of = 1j * frequency, fingers(stiffness, damping)
    ratio = mean_inverse(of)(s) / moore_penrose_inverse(of)(s)
    return float(100 * np.abs(ratio - 1).max())


Coefficients = tuple[tuple[float, ...], tuple[float, ...]]


def low_pass(numerator: Sequence[float], denominator: Sequence[float]) -> Coefficients:
    """Return numerator and denominator of H, which is 1 at rest, highest power first.

    Args:
        numerator: Its last coefficient is the denominator's too.
        denominator: Without the first coefficient, which is 1, and the last.
    """
    return tuple(numerator), (1.0, *denominator, numerator[-1])


def target_loop(
    numerator: Sequence[float], denominator: Sequence[float], asymptote: float
) -> float:
    """Return c of the target loop c/s that a filter is the optimum of, rad/s.

    Args:
        numerator, denominator: As of `low_pass`.
        asymptote: Of the weights that it is the optimum for; see `fixed_order_shaping.weights`.
    """
    return filters.crossover_of_peaks(*low_pass(numerator, denominator), asymptote)


def stiffness_inside(numerator: Sequence[float], denominator: Sequence[float]) -> float:
    """Return the stiffness by mass of the plant in the loop H / (1 - H), as `target_loop`."""
    return plant_inside(*low_pass(numerator, denominator))[1]


def filter_coefficient(
    coefficient: str,
    natural_frequency: float,
    damping_ratio: float,
    crossover: float,
    held_by: Mapping[str, Sequence[float]] | None = None,
) -> float:
    """Return a coefficient of the H that the rule gives, its denominator starting with 1.

    Args:
        coefficient: "num" or "den" and the power of s, such as ``num-3``.
        natural_frequency: Of the finger that is shaped, rad/s.
        damping_ratio: Of that finger.
        crossover: Of the target loop, rad/s.
        held_by: Arguments of `low_pass`: the filter that has the far pole, if that is held.
    """
    finger = filters.author_plant(natural_frequency, damping_ratio)
    held = far_pole(*low_pass(**held_by)) if held_by else None
    top, low = filters.shaped(float(crossover), finger, held).coefficients
    part, _, power = coefficient.partition("-")
    return float((top if part == "num" else low)[::-1][int(power)])


def natural_frequency(stiffness: Number) -> Number:
    """Return the natural frequency of an element of Eq. (6.26), rad/s."""
    return FingerDynamics(1.0, stiffness, 1.0).natural_frequency


def linear_range_degrees() -> float:
    """Return 4 pi / 9 rad, the range of the linear model, in deg."""
    return float(4 * np.pi / 9 / DEG)


Printed = Mapping[str, Any]
"""Printed coefficients by name: the arguments of `fingers`, or those of `low_pass`."""


@remembered
def _step(gripper: Gripper, coefficients: Coefficients, angle: float, period: float) -> GripperRun:
    return run_loop(gripper, coefficients, angle=angle, period=period, duration=4.0)


def settling(plant: Printed, H: Printed, share: float, band: float = 0.05) -> float:
    """Return the settling time of both fingers, s; 5 ms stand for no sampling.

    Args:
        plant, H: The fingers and the filter.
        share: Of pi: the angle that is wanted of both.
        band: As a share of the target.
    """
    gripper, angle = fingers(**plant), share * np.pi
    found = _step(gripper, low_pass(**H), angle, FINE)
    final = equal_targets(angle, gripper)
    return float(settling_time(found.time, found.angles, final=final, band=band).max())


def tracking_error(plant: Printed, H: Printed, share: float, after: float) -> float:
    """Return the largest error from proj(Y_d) after a time [s], in deg; the rest as `settling`."""
    gripper, angle = fingers(**plant), share * np.pi
    found = _step(gripper, low_pass(**H), angle, FINE)
    error = np.abs(found.angles - equal_targets(angle, gripper)[:, None]) / DEG
    return float(error[:, found.time >= after].max())


def push_error(plant: Printed, H: Printed, share: float, push: float) -> float:
    """Return the largest error when a push [rad] acts on the left finger for 1 s, in rad.

    The rest is as for `settling`, sampled each 0.1 s.
    """
    gripper, angle = fingers(**plant), share * np.pi
    found = run_loop(
        gripper,
        low_pass(**H),
        angle=angle,
        period=PERIOD,
        duration=4.0,
        push=lambda t: (push * (1.4 <= t < 2.4), 0.0),
    )
    error = np.abs(found.angles - equal_targets(angle, gripper)[:, None])
    return float(error[:, found.time >= 1.4].max())


def noise_error(plant: Printed, H: Printed, noise: float, period: float = PERIOD) -> float:
    """Return the larger RMS error of the two fingers from the sensors' noise, in deg."""
    gripper, filtered = fingers(**plant), filter_state_space(*low_pass(**H))
    matrices = controller_matrices(gripper, mean_inverse(gripper), filtered, period=period)
    return float(noise * noise_gain(gripper, matrices).max())


def peak_speed(
    plant: Printed, H: Printed, share: float, per_unit: float = 1 / REV, period: float = PERIOD
) -> float:
    """Return the largest motor speed of a step, in rev/s; a unit of U is so many rev/s."""
    found = _step(fingers(**plant), low_pass(**H), share * np.pi, period)
    return float(per_unit * np.abs(found.commands).max())


def highest_frequency(milliseconds: float) -> float:
    """Return the highest frequency that samples at a period [ms] can show, in rad/s."""
    return np.pi / (milliseconds / 1000)


def outside(right: float, stiffness: Sequence[float]) -> float:
    """Return which share of a target (pi/4, right pi/4) is outside the image of P."""
    return project(fingers(stiffness), [np.pi / 4, right * np.pi / 4]).share


SIDE = {"left": 0, "right": 1}
PARAMETER = {"damping": 0, "stiffness": 1}


@simulated
def deviation_of_runs(parameter: str) -> float:
    """Return the larger of the two fingers' largest deviations over seven logs, in percent."""
    found = results.bounds(results.identified("open"))
    return float(100 * found[:, PARAMETER[parameter]].max())


@simulated
def excited(kind: str, end: str) -> float:
    """Return an end of the band in which the command of some logs is excited, rad/s."""
    return results.band(kind)[("low", "high").index(end)]


@simulated
def spread_at_rest(speed: Literal["high", "low"]) -> float:
    """Return the measured standard deviation at rest of the left finger, in deg.

    ``speed`` is "high" or "low", as of `speed.printed_speed`.
    """
    found = {spread.speed: spread for spread in gripper_speed.kept_errors()}
    return float(found[gripper_speed.printed_speed(speed)].measured.std(ddof=1))


@simulated
def angle_at_rest(side: str, kind: str = "open") -> float:
    """Return the mean of the last second of seven logs of a kind, in deg."""
    return float(results.ends(kind)[SIDE[side]] / DEG)


@simulated
def settled_on_rig(controller: str, criterion: str = "fitted", rig: str = "as it is") -> float:
    """Return the settling time of both fingers on the simulated gripper, median of 50 runs, s.

    ``rig`` is a key of `comparison.RIGS`.
    """
    return float(np.median(comparison.judged(controller, rig).settling[criterion]))


@simulated
def tracking_error_on_rig(controller: str) -> float:
    """Return how far a finger's true end lies from its target, median of 50 runs, in deg."""
    return float(np.median(comparison.judged(controller).error)) / DEG


@simulated
def transient_difference_on_rig(controller: str) -> float:
    """Return the largest difference of the shares of their ways, median of 50 runs, in deg."""
    return float(np.median(comparison.judged(controller).synchronization)) / DEG


@simulated
def identified(finger: str, parameter: str) -> float:
    """Return what the simulated gripper's steps identify, the mean of the runs, SI by mass."""
    runs = results.identified("open")[SIDE[finger]]
    return float(np.mean([getattr(one, parameter) for one in runs]))


@simulated
def volume_of_fingers(count: int, angle: float) -> float:
    """Return the volume that bends so many fingers by an angle [rad], in mL."""
    return results.volume_for(count, angle) / ML
