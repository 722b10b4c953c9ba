"""Recomputation of the numbers printed in Chapter 4."""

from itertools import product

from book.chapter_4.controllers import own_step
from book.companion.verdict import simulated
from softgrip.logs.pushes import compare
from softgrip.logs.staircase import judge_staircase
from softgrip.logs.steps import StepResponse, judge_step_log
from softgrip.provenance import data_folder
from softgrip.pump.flow import TABLE_4_1, Pump, PumpRun, parameter_set
from softgrip.pump.gas import ATMOSPHERE, capacity_growth
from softgrip.units import DEG, ML, REV

SETTLING = {"simulated": (5.0, 2.5), "measured": (3.95, 2.38)}
"""Settling times in s that Sections 4.3 and 4.4 print: actuator's model alone, full model."""


def fastest(name: str) -> float:
    """Return a parameter of the set of Table 4.1 with the largest pressure rate, Eq. (4.5)."""
    sets = product(*TABLE_4_1.values())
    best = max(sets, key=lambda values: PumpRun(Pump(*values[:2]), values[2]).flow)
    found = dict(zip(TABLE_4_1, best, strict=True))
    return found[name] / (REV if name == "motor_speed" else 1)


def rate_ratio() -> float:
    """Divide the rate with small lead and large area by that with large lead and small area."""
    (small, large), (long, short), (speed, _) = TABLE_4_1.values()
    return PumpRun(Pump(large, short), speed).flow / PumpRun(Pump(small, long), speed).flow


def lead_time_ratio() -> float:
    """Divide the time to a pressure with the smaller lead by that with the larger one."""
    return parameter_set("default").flow / parameter_set("smaller lead").flow


def settling_reduction(kind: str) -> float:
    """Return by how much the full model's settling time is shorter, in percent."""
    alone, full = SETTLING[kind]
    return 100 * (1 - full / alone)


@simulated
def model_error(model: str, log: str = "push-a") -> float:
    """Return the largest error of a pressure model above 0.10 MPa on a simulated push, in percent.

    ``model`` is "constant", "modified" or "filtered".
    """
    found = compare(data_folder() / "simulated" / f"{log}.csv")
    return abs(100 * found.error(getattr(found, model)))


def growth_when_compressed(pressure: float = ATMOSPHERE) -> float:
    """Return c of Eq. (4.7) for gas in a closed rigid volume, 1/Pa: its capacity falls."""
    return float(capacity_growth(pressure, 90 * ML))


@simulated
def settling_on_model(design: str, criterion: str = "settled_5_percent") -> float:
    """Return the settling time of a tuned PID on the linear model it was designed on, in s.

    ``design`` is "actuator" or "full"; the model is identified from logs of the simulated rig.
    """
    return float(getattr(own_step(design), criterion))


def _step_log(design: str) -> StepResponse:
    return judge_step_log(data_folder() / "simulated" / f"pid-{design}.csv")


@simulated
def settling_on_rig(design: str) -> float:
    """Return the time after which the simulated rig stays within 5 deg of 60 deg, in s."""
    return float(_step_log(design).settled_5_deg)


@simulated
def steady_state_error(design: str) -> float:
    """Return the size of the steady-state error on the simulated rig, in deg."""
    return abs(float(_step_log(design).steady_state_error)) / DEG


@simulated
def staircase_lag() -> float:
    """Return the delay of the angle behind the staircase on the simulated rig, in s."""
    return judge_staircase(data_folder() / "simulated" / "staircase.csv").lag
