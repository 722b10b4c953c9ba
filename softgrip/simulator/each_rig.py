"""One run of each of several rigs through the same commands, as their sensors would feel it.

This is what a fit to logs asks of the simulated rig, for the slopes by its parameters above all.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.simulator.parameters import RigParameters, Spread
from softgrip.simulator.simulation import Simulation


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
        [replace(rig, spread=Spread()) for rig in rigs],
        period=period,
        plunger=plunger,
    )
    run.push(torque)
    pressure = np.empty((len(commands), len(rigs)))
    angle = np.empty((len(commands), len(rigs[0].fingers), len(rigs)))
    for k, command in enumerate(commands):
        run.hold(command)
        pressure[k], angle[k] = run.felt
    return pressure, np.minimum(angle, rigs[0].sensors.angle_range)
