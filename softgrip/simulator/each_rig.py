"""One run of each of several rigs through the same commands, as their sensors would feel it.

This is what a fit to logs asks of the simulated rig, for the slopes by its parameters above all.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.simulator.compiled import drive_compiled
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
    made = drive_compiled(
        run,
        commands,
        duration=len(commands) * period,
        limit=np.inf,
        keep=("felt_pressure", "felt_angle"),
    )
    assert made.felt_pressure is not None
    assert made.felt_angle is not None
    pressure, angle = (np.moveaxis(one, 0, -1) for one in (made.felt_pressure, made.felt_angle))
    return pressure[1:], np.minimum(np.moveaxis(angle, 0, 1)[1:], rigs[0].sensors.angle_range)
