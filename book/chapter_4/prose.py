"""Computed numbers in the prose of Chapter 4."""

import numpy as np

from book.chapter_4.controllers import own_step
from book.chapter_4.figures import GAS_VOLUME
from book.chapter_4.tables import FINGER
from book.companion.claims import printed
from book.companion.drawn import drawn
from softgrip.control.designs import NOISE, STEP
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.pid import PERIOD
from softgrip.logs.pushes import HIGH, LOW, compare
from softgrip.logs.reader import kept_log, read_log
from softgrip.logs.staircase import judge_staircase
from softgrip.logs.steps import ANGLES, SHARES, StepResponse, judge_step_log
from softgrip.pump.flow import PARAMETER_SETS
from softgrip.pump.parts import SUPPLY
from softgrip.simulator.calibration import design_1
from softgrip.units import DEG, ML, REV, MPa


def _rate(name: str) -> float:
    """Return the rate of a set of parameters by that of the default one, Eq. (4.5)."""
    return PARAMETER_SETS[name].flow / PARAMETER_SETS["default"].flow


def _ceiling() -> float:
    """Return the pressure of the constant model with the whole syringe pushed, MPa."""
    swept = printed("4.4-syringe") * ML
    return swept / compare(kept_log("push-a")).capacity / MPa


def _end_of_sensor() -> float:
    """Return when the push bends the finger beyond what the flex sensor can tell, s."""
    log = read_log(kept_log("push-a"))
    return float(log["time"][np.argmax(log["angle"] >= design_1().sensors.angle_range)])


def _on_rig(design: str) -> StepResponse:
    return judge_step_log(kept_log(f"pid-{design}"))


WORDS = {
    "step": lambda: f"{STEP / DEG:.0f}",
    "speed_limit": lambda: f"{SPEED_LIMIT / REV:g}",
    "period": lambda: f"{1e3 * PERIOD:g}",
    "bits": lambda: f"{design_1().sensors.bits}",
    # Figures 4.3 and 4.4: mL, MPa
    "gas": lambda: f"{GAS_VOLUME / ML:.0f}",
    "larger_area": lambda: f"{_rate('larger area'):.1f}",
    "low": lambda: f"{LOW / MPa:.2f}",
    "high": lambda: f"{HIGH / MPa:.2f}",
    "ceiling": lambda: f"{_ceiling():.2f}",
    # Figure 4.A: deg, s, mL/MPa
    "sensor_end": lambda: f"{design_1().sensors.angle_range / DEG:.0f}",
    "sensor_end_at": lambda: f"{_end_of_sensor():.1f}",
    "held": lambda: f"{drawn('Figure 4.A', 'with pressure', 'holding')[1][-1]:.0f}",
    # Figure 4.5 and Table 4.C: s, and the bands in % and deg
    "tight_share": lambda: f"{100 * SHARES[0]:g}",
    "wide_share": lambda: f"{100 * SHARES[1]:g}",
    "tight_angle": lambda: f"{ANGLES[0] / DEG:g}",
    "wide_angle": lambda: f"{ANGLES[1] / DEG:g}",
    "own_actuator": lambda: f"{own_step('actuator').settled_5_deg:.1f}",
    "own_full": lambda: f"{own_step('full').settled_5_deg:.1f}",
    "rig_actuator": lambda: f"{_on_rig('actuator').settled_5_deg:.0f}",
    "rig_full": lambda: f"{_on_rig('full').settled_5_deg:.1f}",
    # Figures 4.7 and 4.C: deg
    "increment": lambda: f"{np.diff(drawn('Figure 4.7', 'reference')[1]).max():.0f}",
    "top": lambda: f"{drawn('Figure 4.7', 'reference')[1].max():.0f}",
    "lag": lambda: f"{judge_staircase(kept_log('staircase')).lag:.2f}",
    "sensor_error": lambda: f"{NOISE / DEG:g}",
    # Table 4.A: MPa, s, V
    "asked_pressure": lambda: f"{FINGER.gauge_pressure / MPa:g}",
    "asked_rise": lambda: f"{FINGER.rise_time:g}",
    "supply": lambda: f"{SUPPLY:g}",
}
