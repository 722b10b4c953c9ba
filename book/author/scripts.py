"""The author's published scripts: their inputs from ``data/author/scripts.toml``, our functions."""

import tomllib
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import control
import numpy as np

from softgrip.actuator.bending import Finger, bending_angle, elongation
from softgrip.actuator.design import Bounds, DesignProblem, FrequencyBand, Range
from softgrip.actuator.frequency import natural_frequency
from softgrip.actuator.section import Section, torque
from softgrip.arrays import Floats
from softgrip.control.lqr import Weights, integrating_finger
from softgrip.control.lqr import step_response as lqr_response
from softgrip.control.step_metrics import StepMetrics, step_metrics
from softgrip.control.ziegler_nichols import RULE
from softgrip.dynamics.second_order import SecondOrder
from softgrip.provenance import data_file
from softgrip.reads import remembered
from softgrip.units import DEG, MM, MPa

FILE = "author/scripts.toml"


@remembered
def inputs(script: str) -> Mapping[str, Any]:
    """Return the inputs of a script, in the units of the file: a key of it, such as "design"."""
    with data_file(FILE).path.open("rb") as stream:
        return MappingProxyType(tomllib.load(stream)[script])


def _bounds() -> Bounds:
    ranges = inputs("design")["bounds"].items()
    return Bounds(**{name: (low * MM, high * MM) for name, (low, high) in ranges})


def design_problem(band: Range | None = None) -> DesignProblem:
    """Return the design script's problem, for its own band or another one, rad/s."""
    script = inputs("design")
    low, high = band or script["band"]
    return DesignProblem(
        pressure=script["pressure"] * MPa,
        young_modulus=script["young_modulus"] * MPa,
        fractional_power=script["fractional_power"],
        length=script["length"] * MM,
        torque_scale=script["torque_scale"],
        angle_scale=script["angle_scale"] * DEG,
        combined=script["combined"],
        bounds=_bounds(),
        band=FrequencyBand(low, high, script["mass"], script["mass"]),
    )


def checked_finger(fractional_power: float | None = None) -> Finger:
    """Return the finger of the check script, which is Design 1, with its n or another one."""
    script, problem = inputs("check"), design_problem()
    section = Section(*(script[name] * MM for name in ("top", "bottom", "width", "wall")))
    n = script["fractional_power"] if fractional_power is None else fractional_power
    return Finger(section, problem.length, problem.young_modulus, n)


def checked_torque() -> float:
    """Return the torque of Design 1 at the script's pressure, N m."""
    return float(torque(checked_finger().section, design_problem().pressure))


def checked_angle(*, wall_subtracted: bool = False, fractional_power: float | None = None) -> float:
    """Return the angle of Design 1 at the script's pressure, deg.

    Args:
        wall_subtracted: Whether the elongation has ``(A_c - A_w) / A_w`` in the place of ``A_c /
            A_w`` of Eq. (3.10), as the check script has it, not the design script.
        fractional_power: n, of the script if None.
    """
    finger, pressure = checked_finger(fractional_power), design_problem().pressure
    longer = elongation(finger.section, pressure, finger.young_modulus)
    if wall_subtracted:
        longer -= pressure / finger.young_modulus
    return float(bending_angle(finger, pressure, elongated=False) * longer) / DEG


def checked_frequency(mass: float | None = None, fractional_power: float | None = None) -> float:
    """Return the natural frequency of Design 1, rad/s, with the scripts' M and n or others."""
    found = inputs("design")["mass"] if mass is None else mass
    return float(natural_frequency(checked_finger(fractional_power), found))


def control_model(*, as_written: bool = False) -> SecondOrder:
    """Return the finger of the control script.

    Args:
        as_written: Whether the last row of A has damping and stiffness in each other's place, as
            the script has it against Eq. (3.28). That is a finger too: with the square root of the
            damping for its natural frequency.
    """
    script = inputs("control")
    w, zeta = script["natural_frequency"], script["damping_ratio"]
    if not as_written:
        return SecondOrder(w, zeta)
    written = (2 * zeta * w) ** 0.5
    return SecondOrder(written, w**2 / (2 * written))


def control_plant(*, as_written: bool = False) -> control.StateSpace:
    """Return the integrator and the finger of the control script, with its gain."""
    finger = control_model(as_written=as_written)
    w, zeta = finger.natural_frequency, finger.damping_ratio
    return integrating_finger(2 * zeta * w, w**2, inputs("control")["gain"])


def control_weights() -> Weights:
    """Return the weights of the control script's regulator."""
    script = inputs("control")
    return Weights(script["p"], tuple(script["q"]), script["R"])


def lqr_metrics(finger: SecondOrder, weights: Weights) -> StepMetrics:
    """Return the measures of a regulator's step response, without limit or sampling; 2 % band."""
    return step_metrics(*lqr_response(finger, weights, points=20001), target=1.0)


def pid_response(*, as_written: bool = False) -> tuple[Floats, Floats]:
    """Return time [s] and response to a unit step of the control script's PID loop.

    Its derivative has no filter; the loop is proper all the same, as the plant is of third order.
    """
    script = inputs("control")
    plant = control_plant(as_written=as_written)
    through = control.tf([script["gain"]], np.poly(plant.poles()).real)
    pid = control.tf([script["kd"], script["kp"], script["ki"]], [1, 0])
    loop = control.feedback(pid * through, 1)
    time = np.linspace(0, 60, 60001)
    found = control.forced_response(loop, time, np.ones_like(time), squeeze=False)
    return time, np.asarray(found.outputs[0], dtype=np.float64)


def pid_metrics(*, as_written: bool = False) -> StepMetrics:
    """Return the measures of the control script's PID loop; 2 % band."""
    return step_metrics(*pid_response(as_written=as_written), target=1.0)


def gain_ratio(kp: float, ki: float, kd: float) -> float:
    """Return ``kp**2 / (ki kd)``, which is integral time by derivative time.

    >>> from softgrip.control.ziegler_nichols import ReactionCurve, ziegler_nichols
    >>> gains = ziegler_nichols(ReactionCurve(delay=0.7, slope=0.1))
    >>> round(gain_ratio(gains.kp, gains.ki, gains.kd), 9)
    4.0
    """
    return kp**2 / (ki * kd)


def gain_ratio_by_rule() -> float:
    """Return the `gain_ratio` of Ziegler and Nichols' rule, which is the same for every plant."""
    _, integral, derivative = RULE["PID"]
    return integral / derivative
