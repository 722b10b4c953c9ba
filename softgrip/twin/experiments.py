"""The one place where the twin meets the simulator: one experiment on many rigs, repeated on each.

A faster simulator needs to give `Records` of the same runs, from the same streams of chance, and
nothing else of the twin changes.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields

import numpy as np

from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.pid import PERIOD
from softgrip.control.rig_controller import RigController
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.sensors import Measurement
from softgrip.simulator.simulation import LARGEST_STEP, Simulation, Truth


@dataclass(frozen=True)
class Records:
    """What was recorded of an experiment on some rigs, SI; runs are repeats on one rig.

    Attributes:
        time: Shape (N,), even.
        command: Held *until* each time, as in logs, shape (rigs, N).
        pressure, angle: As measured, shapes (rigs, runs, N) and (rigs, runs, fingers, N).
        true_pressure, true_angle: Without the sensors, same shapes.
        plunger: Its travel, shape (rigs, runs, N).
    """

    time: Floats
    command: Floats
    pressure: Floats
    angle: Floats
    true_pressure: Floats
    true_angle: Floats
    plunger: Floats


STIFF = 2.0
"""Largest product of step and fastest rate: the classical Runge-Kutta method is stable to 2.78."""


def step_for(rig: RigParameters) -> float:
    """Return a step, s, that is short enough for all rates of decay of a rig."""
    rates = [1 / rig.sensors.pressure_lag, 1 / rig.sensors.angle_lag]
    largest = np.exp(3 * rig.spread.damping)
    for finger in rig.fingers:
        # Where it is at rest dry friction is a damper, the steepest that it ever is.
        friction = finger.friction / finger.friction_rate
        rates.append((largest * finger.damping + friction) / finger.inertia)
        rates += [1 / time for time in finger.memory_time]
    return min(LARGEST_STEP, STIFF / max(rates))


def _record(command: Floats, seen: Measurement, true: Truth) -> Records:
    """Return the records of the runs of one rig; here the axis of rigs has one element."""
    return Records(
        np.asarray(seen.time),
        command[None],
        *(
            np.moveaxis(values, 0, -1).swapaxes(0, -2)[None]
            for values in (seen.pressure, seen.angle, true.pressure, true.angle, true.plunger)
        ),
    )


def _joined(parts: Sequence[Records]) -> Records:
    """Return the records of several rigs as one."""
    names = [field.name for field in fields(Records)][1:]
    return Records(
        parts[0].time, *(np.concatenate([getattr(one, name) for one in parts]) for name in names)
    )


def open_loop(
    rigs: Sequence[RigParameters],
    commands: Sequence[Floats],
    *,
    runs: int = 1,
    plunger: float = 0.0,
    seed: int = SEED,
) -> Records:
    """Send each rig its commands; the records begin at the end of the first period.

    Args:
        rigs: Their parameters.
        commands: Motor speeds of each, rad/s, shape (N,), of one length.
        runs: Repeats on each rig.
        plunger: Travel at the start, m.
        seed: Of all chance, the same on all rigs.
    """
    made = []
    for rig, sequence in zip(rigs, commands, strict=True):
        own = Simulation(rig, runs=runs, seed=seed, plunger=plunger, step=step_for(rig))
        seen, true = own.open_loop(sequence)
        made.append(_record(sequence, seen, true))
    return _joined(made)


def closed_loop(
    rigs: Sequence[RigParameters],
    controllers: Sequence[Callable[[], RigController]],
    duration: float,
    *,
    runs: int = 1,
    period: float = PERIOD,
    seed: int = SEED,
) -> Records:
    """Run a controller on each rig, from rest; the records begin before it moves.

    Args:
        rigs: Their parameters.
        controllers: What makes the controller of each.
        duration: s.
        runs, seed: As of `open_loop`.
        period: Of rig and controller, s.
    """
    made = []
    for rig, controller in zip(rigs, controllers, strict=True):
        own = Simulation(rig, runs=runs, seed=seed, period=period, step=step_for(rig))
        run = drive(own, controller(), duration=duration, limit=SPEED_LIMIT)
        # What differs between the runs of a controller is not of interest.
        made.append(_record(run.command[:, 0], run.measured, run.truth))
    return _joined(made)
