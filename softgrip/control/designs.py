"""The two PID designs of Section 4.3: on the finger alone, Eq. (4.14), and with the pump, (4.15).

Both follow one procedure: Ziegler and Nichols' rule on the step response of the linear model, then
`tuning.tune` in place of trial and error, at 25 ms, with the limit of the command and the noise of
the flex sensor. The text names no gain, no objective, no step and no measure of "good": the
objective (`Itae()`), the step (60 deg, from Section 5.4) and the noise (2 deg, from Section 6.4)
are assumptions, alike for both.
"""

from dataclasses import dataclass

import control
import numpy as np

from softgrip.arrays import Floats, check_positive
from softgrip.control.loop import SPEED_LIMIT, LoopResult, run_loop
from softgrip.control.pid import PID, Gains
from softgrip.control.pressure_command import SET_PRESSURE
from softgrip.control.state_space_plant import StateSpacePlant
from softgrip.control.tuning import Tuned, tune
from softgrip.control.ziegler_nichols import (
    ReactionCurve,
    integrating_reaction_curve,
    reaction_curve,
    ziegler_nichols,
)
from softgrip.dynamics.second_order import SecondOrder, full_state_space, state_space
from softgrip.units import DEG

STEP = 60 * DEG
"""Step for which the gains are tuned, rad."""

NOISE = 2 * DEG
"""Root mean square of the flex sensor's noise in the tuning, rad (Section 6.4)."""

NOISY_RUNS = 8
"""Runs over which the objective is averaged, so that the gains do not fit one noise."""

TUNING_TIME = 8.0
"""Length of each loop of the tuning, s."""


@dataclass(frozen=True)
class Design:
    """A controller and what it was designed on.

    Attributes:
        system: The linear model, to angle [rad].
        limit: Largest command, in the unit of the model's input.
        curve: Reaction curve of the model.
        tuned: From the gains of Ziegler and Nichols to the last ones.
    """

    system: control.StateSpace
    limit: float
    curve: ReactionCurve
    tuned: Tuned

    @property
    def gains(self) -> Gains:
        """The gains after tuning."""
        return self.tuned.gains


def actuator_design(finger: SecondOrder, *, step: float = STEP, evaluations: int = 300) -> Design:
    """Design a PID from angle error to pressure [Pa] on the finger, as if pressure came at once.

    The command is limited to 0.15 MPa, up to which Section 4.3 takes the finger as linear.

    Args:
        finger: The finger's linear model.
        step: Step to tune for, rad, > 0.
        evaluations: Most loops of the tuning, >= 1.
    """
    system = state_space(finger)
    curve = reaction_curve(*unit_step(system), window=2)  # a model's own response has no noise
    return _design(system, SET_PRESSURE, curve, step, evaluations)


def full_design(
    finger: SecondOrder, pump_gain: float, *, step: float = STEP, evaluations: int = 300
) -> Design:
    """Design a PID from angle error to motor speed [rad/s] on pump and finger.

    The command is limited to 5 rev/s. Since the model integrates, its reaction curve is the ramp in
    which its step response ends.

    Args:
        finger, step, evaluations: As for `actuator_design`.
        pump_gain: ``A l / (2 pi C_i)``, Pa/s per rad/s, > 0, with the capacity at the start
            (Section 4.3).
    """
    system = full_state_space(finger, pump_gain)
    curve = integrating_reaction_curve(*unit_step(system))
    return _design(system, SPEED_LIMIT, curve, step, evaluations)


def unit_step(system: control.StateSpace) -> tuple[Floats, Floats]:
    """Return time [s] and response to a unit step, over ten of its longest time constants.

    A pole at zero has none and does not count.
    """
    rates = -system.poles().real
    time = np.linspace(0, 10 / float(np.min(rates[rates > 1e-9])), 20001)
    found = control.forced_response(system, time, np.ones((1, time.size)), squeeze=False)
    return time, np.asarray(found.outputs[0], dtype=np.float64)


def linear_loop(
    system: control.StateSpace,
    gains: Gains,
    limit: float,
    *,
    step: float = STEP,
    duration: float = TUNING_TIME,
    noise: float = 0.0,
    runs: int = 1,
) -> LoopResult:
    """Run a PID on the linear model that it was designed on, from rest to a step.

    Args:
        system, gains: Model and gains.
        limit: Of the command, > 0; the controller knows of it.
        step: rad, > 0.
        duration: s.
        noise: Root mean square of the measurement's noise, rad, >= 0.
        runs: Number of runs, which differ in their noise.
    """
    check_positive(step=step)
    plant = StateSpacePlant(system, initial=np.zeros((system.nstates, runs)), noise=noise)
    pid = PID(gains, limits=(-limit, limit))
    return run_loop(plant, pid, step, duration=duration, limit=limit)


def _design(
    system: control.StateSpace, limit: float, curve: ReactionCurve, step: float, evaluations: int
) -> Design:
    def trial(gains: Gains) -> LoopResult:
        return linear_loop(system, gains, limit, step=step, noise=NOISE, runs=NOISY_RUNS)

    return Design(
        system, limit, curve, tune(trial, ziegler_nichols(curve), evaluations=evaluations)
    )
