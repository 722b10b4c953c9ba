"""The PID controllers of Chapter 4 with their kept gains, from angles to motor speed."""

from typing import Literal, get_args

import numpy as np

from book.chapter_4.identified_model import identified_model
from book.chapter_4.pid_gains import pid_gains
from book.companion.choices import choice
from book.companion.simulated_logs import STEP_DURATION
from softgrip.control.designs import linear_loop
from softgrip.control.loop import SPEED_LIMIT, Controller, LoopResult
from softgrip.control.pid import PID, Gains
from softgrip.control.pressure_command import SET_PRESSURE, PressureAsSpeed, PressureByPlunger
from softgrip.control.rig_controller import Tracking
from softgrip.dynamics.second_order import full_state_space, state_space
from softgrip.errors import InvalidInputError
from softgrip.logs.steps import StepResponse, judge_step
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.fitted_rigs import design_1
from softgrip.simulator.simulation import Simulation

Name = Literal["actuator", "actuator by plunger", "full"]
"""The (4.14) design under its two readings of `control.pressure_command`, and the (4.15) one."""


def controller(name: Name, stage: str = "tuned") -> Controller:
    """Return a controller with its kept gains, from angles to motor speed.

    Args:
        name: Which.
        stage: Of the tuning; see `pid_gains`.

    Raises:
        InvalidInputError: If the name is not one of `Name`.
    """
    if name not in get_args(Name):
        raise InvalidInputError("name", expected=f"one of {get_args(Name)}", got=name)
    if name == "full":
        return PID(pid_gains("full", stage), limits=(-SPEED_LIMIT, SPEED_LIMIT))
    pid = PID(pid_gains("actuator", stage), limits=(-SET_PRESSURE, SET_PRESSURE))
    if name == "actuator":
        return PressureAsSpeed(pid)
    return PressureByPlunger(pid, identified_model().pump_gain)


def own_loop(
    design: str, gains: Gains | None = None, *, duration: float = 8.0, step: float | None = None
) -> LoopResult:
    """Run a PID, with its tuned gains if none are given, on the linear model it was designed on.

    ``design`` is "actuator" or "full"; the model is identified from logs of the simulated rig. The
    step [rad] is that of the logs if none is given.
    """
    model = identified_model()
    if design == "actuator":
        system, limit = state_space(model.finger), SET_PRESSURE
    else:
        system, limit = full_state_space(model.finger, model.pump_gain), SPEED_LIMIT
    step = choice("pid_step") if step is None else step
    return linear_loop(system, gains or pid_gains(design), limit, step=step, duration=duration)


def settled_on_rig(name: Name, step: float) -> float:
    """Return the time in which a step, rad, settles on the simulated rig within the fitted band, s.

    The median of seven runs.
    """
    rig = Simulation(design_1(), runs=7, seed=SEED)
    made = drive(rig, Tracking(controller(name), step), duration=STEP_DURATION)
    angle = made.measured.angle[:, 0].T
    found = judge_step(made.time, angle, step, band=choice("pid_band"))
    return float(np.median(found.settled))


def own_step(design: str) -> StepResponse:
    """Judge the step of `own_loop`, as the step of a log is judged."""
    found = own_loop(design, duration=STEP_DURATION)
    step = choice("pid_step")
    band = choice("model_band") * step
    return judge_step(found.time, np.ravel(found.measured), step, window=0, band=band)
