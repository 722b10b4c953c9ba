"""How short the steps of the integration must be for a rig."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.rig_batch import run_count

LARGEST_STEP = 0.025
"""s. Under abrupt commands, against a step 16 times shorter, the error is below 2e-4 rad and 5 Pa:
a tenth and a hundredth of a count of the converter. A test measures it."""
STIFF = 2.0
"""Largest product of step and fastest rate: the classical Runge-Kutta method is stable to 2.78."""
STEPS = np.unique([part * 2**k // 2 for part in (2, 3) for k in range(16)])
"""Numbers of steps in a period, 1, 2, 3, 4, 6, ...: few, so that many rigs of a batch share one,
and a rig's own hangs on no other."""


def steps_for(rigs: RigParameters, period: float) -> NDArray[np.intp]:
    """Return how many steps in a period [s] are short enough for all rates of decay, (rigs,)."""
    rates: list[Any] = [1 / LARGEST_STEP * STIFF]
    rates += [1 / rigs.sensors.pressure_lag, 1 / rigs.sensors.angle_lag]
    largest = np.exp(3 * rigs.spread.damping)
    for finger in rigs.fingers:
        # Where it is at rest dry friction is a damper, the steepest that it ever is.
        friction = finger.friction / finger.friction_rate
        rates.append((largest * finger.damping + friction) / finger.inertia)
        rates += [1 / time for time in finger.memory_time]
    fastest = np.max(np.broadcast_arrays(*rates, np.zeros(run_count(rigs))), axis=0)
    least = np.ceil(fastest * period / STIFF - 1e-9)
    return np.asarray(STEPS[np.minimum(np.searchsorted(STEPS, least), STEPS.size - 1)])
