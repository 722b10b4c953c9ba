"""The numbers of Section 6.4 as the simulated gripper gives them."""

import numpy as np

from book.chapter_6.controllers import gripper_controller, own_model, target_angles
from book.chapter_6.logs import PUSH_FROM, PUSH_UNTIL, RUNS, names_of, push_left
from book.companion.choices import choice
from softgrip.arrays import Floats
from softgrip.control.step_metrics import final_value
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.plant import FingerDynamics
from softgrip.gripper.uncertainty import (
    bounding_weight,
    deviation,
    excited_band,
    finger_response,
    parameter_bounds,
)
from softgrip.logs.fingers import GripperLogs, each_identified, read_runs
from softgrip.provenance import data_file
from softgrip.reads import remembered
from softgrip.simulator import statics
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.fitted_rigs import printed_gripper
from softgrip.simulator.gripper_steps import step_identifies
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG


def logs_of(kind: str) -> GripperLogs:
    """Read the kept logs of a kind, such as "open"."""
    return read_runs([data_file(name).path for name in names_of(kind)])


def ends(kind: str) -> Floats:
    """Return the mean angle of each finger over the last second, rad, shape (fingers,)."""
    logs = logs_of(kind)
    return np.asarray(final_value(logs.time, logs.angles.mean(axis=0), window=1.0))


@remembered
def identified(kind: str) -> list[list[FingerDynamics]]:
    """Return what each of the kept logs identifies, ``found[finger][run]``."""
    return each_identified(logs_of(kind))


@remembered
def identified_without_noise() -> list[list[FingerDynamics]]:
    """Return what the runs of the open-loop logs identify without their sensors."""
    return step_identifies(
        printed_gripper(),
        choice("gripper_travel"),
        runs=RUNS,
        seed=SEED,
        speed=choice("gripper_speed"),
    )[1]


WEIGHED = np.geomspace(0.5, 80, 60)
"""Frequencies at which weights are compared with deviations, rad/s."""


@remembered
def largest_weight(speed: float) -> float | None:
    """Return the largest W_T of Eq. (6.18) for the left finger, pushed at a motor speed.

    A weight of second order, fitted to the models that the runs identify without noise.

    Args:
        speed: rad/s, > 0.

    Returns:
        float or None: A share; None where not every run identifies a model.
    """
    _, found = step_identifies(
        printed_gripper(), choice("gripper_travel"), runs=RUNS, seed=SEED, speed=speed
    )
    if len(found[0]) < RUNS:
        return None
    responses = np.array([finger_response(model, WEIGHED) for model in found[0]])
    weight = bounding_weight(WEIGHED, deviation(responses, responses.mean(axis=0)))
    return float(np.abs(weight(1j * WEIGHED)).max())


def bounds(found: list[list[FingerDynamics]]) -> Floats:
    """Return the largest deviations of damping and stiffness, shares, shape (fingers, 2)."""
    return np.array([parameter_bounds(runs) for runs in found])


def band(kind: str) -> tuple[float, float]:
    """Return the excited band of the command of some logs, rad/s."""
    return excited_band(logs_of(kind).commands[0, 1:], PERIOD, share=choice("excited_share"))


@remembered
def push_response(*, runs: int = 50) -> tuple[Floats, Floats]:
    """Return by how much a push on the left finger moves both, against the same runs without it.

    Returns:
        tuple: Time since the push begins, s, shape (N,), and the median over the runs, rad, shape
            (fingers, N).
    """
    pushed, free = (
        drive(
            Simulation(printed_gripper(), runs=runs, seed=SEED, period=PERIOD),
            gripper_controller("2/s"),
            duration=12.0,
            push=push,
        )
        for push in (push_left, None)
    )
    off = np.median(pushed.truth.angle - free.truth.angle, axis=-1)
    after = pushed.time > PUSH_FROM - PERIOD / 2
    return pushed.time[after] - PUSH_FROM, off[after].T


def recovery(within: float = 1 * DEG) -> Floats:
    """Return the time from the end of the push until each finger stays within an angle, s.

    Shape (fingers,); 0 for a finger that the push does not move so far.
    """
    time, off = push_response()
    last = [time[np.flatnonzero(np.abs(one) > within)[-1:]].sum() for one in off]
    return np.maximum(np.array(last) - (PUSH_UNTIL - PUSH_FROM), 0.0)


def volume_for(count: int, angle: float) -> float:
    """Return what the plunger must sweep to bend so many fingers by an angle [rad], m^3.

    The fingers are those of the simulated gripper, in turn.
    """
    return float(statics.volume_for(printed_gripper(spread=False), count, angle))


def desired() -> Floats:
    """Return what of 45 deg for both fingers the gripper's own model can reach, rad."""
    return target_angles(own_model())
