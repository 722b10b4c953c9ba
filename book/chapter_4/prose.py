"""Computed numbers in the prose of Chapter 4."""

from pathlib import Path

import numpy as np

from book.chapter_4.controllers import own_step, settled_on_rig
from book.chapter_4.figures import GAS_VOLUME, PUSHES
from book.chapter_4.numbers import steady_state_error
from book.chapter_4.pushed import pushed
from book.chapter_4.tables import LEAST_MARGIN, finger_to_drive
from book.chapter_4.tasks import (
    constant_share,
    filter_error,
    flow_of_the_default_pump,
    largest_pressure,
    least_derivative,
    left_without_integral,
    rank_by_angle,
    rank_by_pressure,
    time_to_pressure,
)
from book.companion.choices import choice
from book.companion.claims import printed
from book.companion.drawn import drawn
from softgrip.control.designs import NOISE, STEP
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.pid import PERIOD
from softgrip.logs.pushes import HIGH, reference_noise
from softgrip.logs.reader import kept_log, read_log
from softgrip.logs.staircase import judge_staircase
from softgrip.logs.steps import ANGLES, SHARES, StepResponse, judge_step_log
from softgrip.pump.flow import PARAMETER_SETS
from softgrip.pump.parts import SUPPLY
from softgrip.simulator.fitted_rigs import design_1
from softgrip.units import DEG, ML, REV, MPa


def _rate(name: str) -> float:
    """Return the rate of a set of parameters by that of the default one, Eq. (4.5)."""
    return PARAMETER_SETS[name].flow / PARAMETER_SETS["default"].flow


def _ceiling() -> float:
    """Return the pressure of the constant model with the whole syringe pushed, MPa."""
    swept = printed("4.4-syringe") * ML
    return swept / pushed(kept_log("push-a")).capacity / MPa


def _below() -> float:
    """Return the pressure below which the constant capacity is fitted, MPa."""
    return choice("capacity_below") / MPa


def _pushes() -> list[Path]:
    return [kept_log(name) for name in PUSHES]


def _constant_ends() -> tuple[float, float]:
    """Return between which percents of the measured pressures the constant models end."""
    found = map(pushed, _pushes())
    shares = [100 * float(one.constant[-1] / one.measured[-1]) for one in found]
    return min(shares), max(shares)


def _likely() -> list[float]:
    """Return the largest errors of the filter with the noise of largest likelihood, %."""
    found = (pushed(path, reference_noise()) for path in _pushes())
    return [100 * abs(one.error(one.filtered)) for one in found]


def _end_of_sensor() -> float:
    """Return when the push bends the finger beyond what the flex sensor can tell, s."""
    log = read_log(kept_log("push-a"))
    return float(log["time"][np.argmax(log["angle"] >= design_1().sensors.angle_range)])


def _largest_pressure() -> float:
    """Return up to which pressure some parts drive the rig's finger, MPa."""
    finger = finger_to_drive()
    return largest_pressure(finger.volume_at_rest / ML, finger.rise_time)


def _on_rig(design: str) -> StepResponse:
    return judge_step_log(kept_log(f"pid-{design}"), band=choice("pid_band"))


WORDS = {
    "step": lambda: f"{choice('pid_step') / DEG:.0f}",
    "speed_limit": lambda: f"{SPEED_LIMIT / REV:g}",
    "period": lambda: f"{1e3 * PERIOD:g}",
    "bits": lambda: f"{design_1().sensors.bits}",
    # Figures 4.3 and 4.4: mL, MPa
    "gas": lambda: f"{GAS_VOLUME / ML:.0f}",
    "larger_area": lambda: f"{_rate('larger area'):.1f}",
    "area_time_share": lambda: f"{100 / _rate('larger area'):.0f}",
    "speed_times": lambda: f"{_rate('higher speed'):.0f}",
    "lead_share": lambda: f"{100 * _rate('smaller lead'):.0f}",
    "low": lambda: f"{_below():.2f}",
    "high": lambda: f"{HIGH / MPa:.2f}",
    "ceiling": lambda: f"{_ceiling():.2f}",
    "constant_ends": lambda: "{:.0f} to {:.0f}".format(*_constant_ends()),
    "likely": lambda: f"{min(_likely()):.0f} to {max(_likely()):.0f}",
    "push_ends": lambda: f"{min(pushed(path).measured[-1] for path in _pushes()) / MPa:.2f}",
    # Figure 4.A: deg, s, mL/MPa
    "sensor_end": lambda: f"{design_1().sensors.angle_range / DEG:.0f}",
    "sensor_end_at": lambda: f"{_end_of_sensor():.1f}",
    "held": lambda: f"{drawn('Figure 4.A', 'with pressure', 'holding')[1][-1]:.0f}",
    # Figure 4.5 and Table 4.C: s, and the bands in % and deg
    "tight_share": lambda: f"{100 * SHARES[0]:g}",
    "wide_share": lambda: f"{100 * SHARES[1]:g}",
    "tight_angle": lambda: f"{ANGLES[0] / DEG:g}",
    "wide_angle": lambda: f"{ANGLES[1] / DEG:g}",
    "own_actuator": lambda: f"{own_step('actuator').settled:.1f}",
    "own_full": lambda: f"{own_step('full').settled:.1f}",
    "rig_actuator": lambda: f"{_on_rig('actuator').settled:.1f}",
    "rig_full": lambda: f"{_on_rig('full').settled:.1f}",
    "rig_error": lambda: f"{steady_state_error('actuator'):.0f}",
    "pid_band": lambda: f"{choice('pid_band') / DEG:.0f}",
    "model_band": lambda: f"{100 * choice('model_band'):.0f}",
    "integral_share": lambda: f"{100 * choice('actuator_ki'):.0f}",
    "other_step": lambda: f"{STEP / DEG:.0f}",
    "other_actuator": lambda: f"{settled_on_rig('actuator', STEP):.1f}",
    "other_full": lambda: f"{settled_on_rig('full', STEP):.1f}",
    # Figures 4.7 and 4.C: deg
    "increment": lambda: f"{np.diff(drawn('Figure 4.7', 'reference')[1]).max():.0f}",
    "top": lambda: f"{drawn('Figure 4.7', 'reference')[1].max():.0f}",
    "lag": lambda: f"{judge_staircase(kept_log('staircase')).lag:.2f}",
    "sensor_error": lambda: f"{NOISE / DEG:g}",
    # Table 4.A: MPa, s, V
    "asked_pressure": lambda: f"{finger_to_drive().gauge_pressure / MPa:g}",
    "asked_rise": lambda: f"{finger_to_drive().rise_time:g}",
    "supply": lambda: f"{SUPPLY:g}",
    "least_margin": lambda: f"{LEAST_MARGIN:g}",
    # Of the finger, mL, and what the explorer of Table 4.A says of it, MPa
    "rest_volume": lambda: f"{design_1().finger.rest_volume / ML:.1f}",
    "largest_pressure": lambda: f"{_largest_pressure():.2f}",
    # Questions before explorers: %, at both ends of the slider, and deg
    "stiff_filter": lambda: f"{filter_error(0.01):.0f}",
    "nervous_filter": lambda: f"{filter_error(30):.0f}",
    "no_integral": lambda: f"{left_without_integral():.1f}",
    # Tasks: s, %; states that are observable, mL/s; a factor
    "time_small": lambda: f"{time_to_pressure('60 mL'):.1f}",
    "time_large": lambda: f"{time_to_pressure('200 mL'):.1f}",
    "constant_share": lambda: f"{100 * constant_share():.0f}",
    "rank_printed": lambda: f"{rank_by_angle(0.0)}",
    "rank_coupled": lambda: f"{rank_by_angle(0.01)}",
    "rank_at_rest": lambda: f"{rank_by_pressure([0.0] * 100)}",
    "rank_moved": lambda: f"{rank_by_pressure([flow_of_the_default_pump() * ML] + [0.0] * 99)}",
    "default_flow": lambda: f"{flow_of_the_default_pump():.1f}",
    "least_derivative": lambda: f"{least_derivative():.2f}",
}
