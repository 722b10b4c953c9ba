"""Step responses of a rod by PyElastica: reads a run a line as JSON, answers each with a line.

It is started by `elastica.py` with a Python that has PyElastica, which the package does not need.
"""

import json
import sys
from time import perf_counter

import elastica
import numpy as np


class Simulator(
    elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing, elastica.Damping
):
    """A rod that is held, pushed and damped."""


def run(
    *,
    elements: int,
    length: float,
    radius: float,
    young_modulus: float,
    density: float,
    tip_mass: float,
    force: float,
    damping: float,
    step: float,
    seconds: float,
    kept: int,
) -> dict[str, object]:
    """Return the seconds that the steps took, and `kept` times and tip angles, s and rad.

    Making the rod is not timed. The force acts from the first step on, and does not turn.
    """
    simulator = Simulator()
    rod = elastica.CosseratRod.straight_rod(
        elements, np.zeros(3), np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), length, radius,
        density, youngs_modulus=young_modulus, shear_modulus=young_modulus / 3,
    )  # fmt: skip
    rod.mass[-1] += tip_mass
    simulator.append(rod)
    simulator.constrain(rod).using(
        elastica.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
    )
    push = np.array([0, force, 0])
    simulator.add_forcing_to(rod).using(
        elastica.EndpointForces, np.zeros(3), push, ramp_up_time=1e-9
    )
    simulator.dampen(rod).using(
        elastica.AnalyticalLinearDamper, uniform_damping_constant=damping, time_step=step
    )
    simulator.finalize()
    stepper, steps = elastica.PositionVerlet(), round(seconds / step)
    time, times, angles = np.float64(0), [], []
    every = max(1, steps // kept)
    start = perf_counter()
    for index in range(steps):
        time = stepper.step(simulator, time, np.float64(step))
        if index % every == 0:
            tangent = rod.director_collection[2, :, -1]
            times.append(float(time))
            angles.append(float(np.arctan2(tangent[1], tangent[0])))
    return {"seconds": perf_counter() - start, "times": times, "angles": angles}


if __name__ == "__main__":
    for line in sys.stdin:
        with np.errstate(all="ignore"):  # an unstable run is a finding, not a failure
            print(json.dumps(run(**json.loads(line))), flush=True)
