"""Answers of the questions and tasks of Chapter 4, where they are numbers."""

from collections.abc import Sequence
from math import inf

import control
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from book.chapter_4.identified_model import identified_model
from book.chapter_4.pid_gains import pid_gains
from book.chapter_4.sliders import AREAS, BESIDE, VOLUMES, capacity_filter, pid, sizing
from book.companion.choices import choice
from softgrip.control.pid import PERIOD, Gains, pid_step
from softgrip.dynamics.second_order import full_state_space
from softgrip.pump.elastance import transitions
from softgrip.pump.flow import Pump, flow, parameter_set
from softgrip.pump.gas import ATMOSPHERE
from softgrip.pump.observability import observable_rank
from softgrip.units import DEG, ML, MM, REV, MPa

PRESSURE = 0.15 * MPa
"""Gauge pressure of the first task, Pa: the dotted level of its explorer."""


def time_to_pressure(syringe: str, lead: float = 8.0, speed: float = 2.0) -> float:
    """Return when a full syringe has the finger at `PRESSURE` by the gas law, s.

    Args:
        syringe: "60 mL" or "200 mL".
        lead: mm.
        speed: Of the motor, rev/s.
    """
    gas = VOLUMES[syringe] + BESIDE
    swept = gas * PRESSURE / (ATMOSPHERE + PRESSURE)
    return swept / flow(speed * REV, Pump(AREAS[syringe], lead * MM))


def constant_share() -> float:
    """Return the share of `PRESSURE` that a constant capacity gives where the gas law has it.

    From the swept share x of the gas follow ``P_0 x`` and ``P_0 x / (1 - x)``: no part is in it.
    """
    return ATMOSPHERE / (ATMOSPHERE + PRESSURE)


def rank_by_angle(coupling: float) -> int:
    """Return how many of capacity and angle the angle shows, with another corner in Eq. (4.10).

    Args:
        coupling: Below the diagonal of A: what the capacity does to the next angle.
    """
    steps = np.tile([[1, 0.1], [coupling, 1]], (100, 1, 1))
    return int(observable_rank(steps, [[0, 1]]))


def rank_by_pressure(flows: Sequence[float]) -> int:
    """Return how many of pressure and elastance the pressure shows.

    Args:
        flows: m^3/s, one a sample.
    """
    return int(observable_rank(transitions(flows, PERIOD), [[1, 0]]))


def flow_of_the_default_pump() -> float:
    """Return the flow of the first set of Table 4.1, mL/s."""
    return parameter_set("default").flow / ML


def filter_error(noise: float) -> float:
    """Return by how much the filter misses the pressure at most above 0.10 MPa, %.

    Args:
        noise: As of `sliders.capacity_filter`.
    """
    return abs(float(capacity_filter(noise)["error"]))


def left_without_integral() -> float:
    """Return the error at the end of the explorer's record with no integral gain, deg."""
    return abs(choice("pid_step") / DEG - float(pid(1.0, 0.0, 1.0)["angle"][-1]))


def period_matrix(kp: float, ki: float, kd: float) -> NDArray[np.float64]:
    """Return what a period makes of the loop of the explorer, without the motor's limit, (6, 6).

    The state: of the plant (three), the error before, the integral and the derivative part.

    Args:
        kp, ki, kd: Factors on the tuned gains.
    """
    model, tuned = identified_model(), pid_gains("full")
    gains = Gains(kp * tuned.kp, ki * tuned.ki, kd * tuned.kd, tuned.derivative_filter)
    held = control.sample_system(full_state_space(model.finger, model.pump_gain), PERIOD, "zoh")

    def after(state: NDArray[np.float64]) -> NDArray[np.float64]:
        *plant, last, integral, derivative = state
        error = -plant[1]
        speed, integral, derivative = pid_step(
            gains, (-inf, inf), error, error - last, integral, derivative, anti_windup=False
        )
        return np.array([*(held.A @ plant + held.B[:, 0] * speed), error, integral, derivative])

    return np.column_stack([after(unit) for unit in np.eye(6)])


def least_derivative(kp: float = 1.5, ki: float = 1.0) -> float:
    """Return the factor on the derivative gain below which the loop of the explorer is unstable.

    Args:
        kp, ki: Factors on the other gains.
    """
    return float(
        brentq(lambda kd: np.abs(np.linalg.eigvals(period_matrix(kp, ki, kd))).max() - 1, 0.1, 1.0)
    )


def largest_pressure(volume: float, rise: float) -> float:
    """Return the largest pressure of the slider that some parts of Table 4.A reach, MPa.

    Args:
        volume: Of the finger at rest, mL.
        rise: Rise time, s.
    """
    pressures = np.arange(0.2, 0.05, -0.001)
    return float(next(p for p in pressures if sizing(p, volume, rise)["count"] > 0))
