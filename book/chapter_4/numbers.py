"""Recomputation of the numbers printed in Chapter 4."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from typing import Literal

import control
import numpy as np

from book.chapter_4.controllers import own_loop
from book.chapter_4.pid_gains import pid_gains
from book.chapter_4.pushed import pushed
from book.companion.choices import choice
from book.companion.verdict import simulated
from softgrip.arrays import Number, chosen
from softgrip.control.pid import Gains, pid_state_space
from softgrip.control.step_metrics import settling_time
from softgrip.dynamics.second_order import SecondOrder, full_state_space
from softgrip.logs.staircase import judge_staircase
from softgrip.logs.steps import StepResponse, judge_step, judge_step_log
from softgrip.provenance import data_folder
from softgrip.pump.flow import Pump, PumpRun
from softgrip.pump.gas import ATMOSPHERE, capacity_growth
from softgrip.units import DEG, ML, REV

Parameter = Literal["area", "lead", "motor speed"]


def fastest(
    name: Parameter, areas: Sequence[float], leads: Sequence[float], speeds: Sequence[float]
) -> Number:
    """Return a parameter of the set with the largest pressure rate, Eq. (4.5).

    Args:
        name: Which.
        areas, leads, speeds: To choose from, in m^2, m and rev/s.

    >>> fastest("lead", areas=[6e-4], leads=[0.002, 0.008], speeds=[1.65, 3.3])
    0.008
    """
    which = ("area", "lead", "motor speed").index(name)
    rates = [
        (PumpRun(Pump(area, lead), speed * REV).flow, (area, lead, speed)[which])
        for area, lead, speed in product(areas, leads, speeds)
    ]
    fastest_rate, best = rates[0]
    for rate, value in rates[1:]:
        better = rate > fastest_rate
        fastest_rate, best = chosen(better, rate, fastest_rate), chosen(better, value, best)
    return best


def rate_ratio(small_area: float, large_area: float, short_lead: float, long_lead: float) -> float:
    """Divide the rate with large area and short lead by that with small area and long lead.

    >>> rate_ratio(2e-4, 8e-4, 0.002, 0.008)
    1.0
    """
    first, second = Pump(large_area, short_lead), Pump(small_area, long_lead)
    return first.displacement / second.displacement


@simulated
def model_error(model: str, log: str = "push-a") -> float:
    """Return the largest error of a pressure model above 0.10 MPa on a simulated push, in percent.

    ``model`` is "constant", "modified" or "filtered".
    """
    found = pushed(data_folder() / "simulated" / f"{log}.csv")
    return abs(100 * found.error(getattr(found, model)))


def growth_when_compressed(pressure: float = ATMOSPHERE, softening: float = 0.0) -> float:
    """Return c of Eq. (4.7), 1/Pa, for 90 mL of air that is closed in and compressed.

    Args:
        pressure: Absolute, Pa.
        softening: d2V_f/dP2 of the finger, m^3/Pa^2; 0 for a rigid one.
    """
    volume = 90 * ML * ATMOSPHERE / pressure
    return float(capacity_growth(pressure, volume, compliance_slope=softening))


@simulated
def settling_on_model(design: str, criterion: str = "settled", share: float = 1.0) -> float:
    """Return the settling time of a PID on the linear model it was designed on, in s.

    Args:
        design: "actuator" or "full"; the model is identified from logs of the simulated rig.
        criterion: Name of a field of `StepResponse`.
        share: Of the gains.
    """
    tuned = pid_gains(design)
    gains = replace(tuned, kp=share * tuned.kp, ki=share * tuned.ki, kd=share * tuned.kd)
    found, step = own_loop(design, gains, duration=20.0), choice("pid_step")
    band = choice("model_band") * step
    judged = judge_step(found.time, np.ravel(found.measured), step, window=0, band=band)
    return float(getattr(judged, criterion))


def settling_by_author(
    gains: Sequence[float],
    natural_frequency: float,
    damping_ratio: float,
    gain: float,
    band: float = 0.02,
) -> float:
    """Return the settling time, s, of the author's PID on pump and finger as his script has them.

    The loop is linear, without the motor's limit.

    Args:
        gains: Proportional, integral, derivative.
        natural_frequency: rad/s.
        damping_ratio: Dimensionless.
        gain: Numerator of the plant ``gain / (s (s^2 + 2 zeta w s + w^2))``.
        band: Half width about the set point, as a share of the step.
    """
    finger = SecondOrder(natural_frequency, damping_ratio, gain / natural_frequency**2)
    open_loop = control.series(pid_state_space(Gains(*gains)), full_state_space(finger, 1.0))
    time = np.linspace(0, 60, 12001)
    found = control.forced_response(control.feedback(open_loop), time, np.ones_like(time))
    return float(settling_time(time, np.ravel(found.outputs), final=1.0, band=band))


def gain_ratio(kp: float, ki: float, kd: float) -> float:
    """Return integral over derivative time of a PID, ``kp^2 / (ki kd)``.

    >>> gain_ratio(2.0, 1.0, 1.0)
    4.0
    """
    return kp**2 / (ki * kd)


def _step_log(design: str) -> StepResponse:
    return judge_step_log(
        data_folder() / "simulated" / f"pid-{design}.csv", band=choice("pid_band")
    )


@simulated
def settling_on_rig(design: str) -> float:
    """Return the time after which the simulated rig stays at its set point, s; both are fitted."""
    return float(_step_log(design).settled)


@simulated
def steady_state_error(design: str) -> float:
    """Return the size of the steady-state error on the simulated rig, in deg."""
    return abs(float(_step_log(design).steady_state_error)) / DEG


@simulated
def staircase_lag() -> float:
    """Return the delay of the angle behind the staircase on the simulated rig, in s."""
    return judge_staircase(data_folder() / "simulated" / "staircase.csv").lag
