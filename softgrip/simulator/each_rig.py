"""One run of each of several rigs through the same commands, as their sensors would feel it.

This is what a fit to logs asks of the simulated rig, for the slopes by its parameters above all.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.simulator.laws import AMOUNT, SENSED_ANGLE, SENSED_PRESSURE
from softgrip.simulator.parameters import RigParameters, Spread
from softgrip.simulator.simulation import LARGEST_STEP, Simulation

FASTEST = 2.2
"""Rate of what dies out, times the step of the integration: above 2.78 Runge-Kutta diverges."""


def felt(
    rigs: Sequence[RigParameters],
    commands: Floats,
    *,
    period: float,
    plunger: float = 0.0,
    torque: ArrayLike = 0.0,
) -> tuple[Floats, Floats]:
    """Return what the sensors of each rig feel, without noise, converter or spread.

    Args:
        rigs: As many fingers and branches of memory each, one pump and range of the sensors.
        commands: Motor speeds, rad/s, one a period, shape (samples,).
        period: s.
        plunger: Travel at the start, m.
        torque: From outside, N m, of a shape that broadcasts to (fingers, rigs).

    Returns:
        tuple: Gauge pressure, Pa, shape (samples, rigs), and angles up to the sensor's range, rad,
            shape (samples, fingers, rigs), at the end of each period.
    """
    run = Simulation(
        replace(rigs[0], spread=Spread()),
        runs=len(rigs),
        period=period,
        plunger=plunger,
        step=min(LARGEST_STEP, FASTEST / max(map(_fastest, rigs))),
    )
    run.push(torque)
    _each_its_own(run, rigs)
    pressure = np.empty((len(commands), len(rigs)))
    angle = np.empty((len(commands), len(rigs[0].fingers), len(rigs)))
    for k, command in enumerate(commands):
        run._hold(command)
        pressure[k] = run._state[SENSED_PRESSURE]
        angle[k] = run._plant.fingers(run._state)[SENSED_ANGLE]
    return pressure, np.minimum(angle, rigs[0].sensors.angle_range)


def _fastest(rig: RigParameters) -> float:
    """Return the largest rate at which something dies out, 1/s."""
    bends = [(one.damping + one.friction / one.friction_rate) / one.inertia for one in rig.fingers]
    return max(1 / rig.sensors.pressure_lag, 1 / rig.sensors.angle_lag, *bends)


def _each_its_own(run: Simulation, rigs: Sequence[RigParameters]) -> None:
    """Give each run of a batch that has not begun the parameters of its own rig."""
    plant, parameters = run._plant, run.parameters

    def of_fingers(name: str) -> Floats:
        return np.array([[getattr(one, name) for one in rig.fingers] for rig in rigs]).T

    def of_rigs(part: str, name: str) -> Floats:
        return np.array([getattr(getattr(rig, part), name) for rig in rigs])

    plant.stiffness, plant.damping = of_fingers("stiffness"), of_fingers("damping")
    plant.power, plant.inertia = of_fingers("fractional_power"), of_fingers("inertia")
    plant.friction, plant.slow = of_fingers("friction"), of_fingers("friction_rate") ** 2
    plant.torque_per_pressure = of_fingers("torque_per_pressure")
    plant.memory, plant.relaxation = of_fingers("memory"), 1 / of_fingers("memory_time")
    plant.ballooning = of_fingers("ballooning").sum(axis=0)
    plant.rest = of_fingers("rest_volume").sum(axis=0) + of_rigs("gas", "dead_volume")
    plant.leakage, atmosphere = of_rigs("gas", "leakage"), of_rigs("gas", "atmosphere")
    lags: dict[str, Any] = {
        name: of_rigs("sensors", name) for name in ("pressure_lag", "angle_lag")
    }
    gas: dict[str, Any] = {"atmosphere": atmosphere}
    plant.parameters = replace(
        parameters,
        gas=replace(parameters.gas, **gas),
        sensors=replace(parameters.sensors, **lags),
    )
    run._state[AMOUNT] = atmosphere * (run._syringe[-1] + plant.rest)
