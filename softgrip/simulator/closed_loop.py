"""A controller on the simulated rig, with all that its sensors tell."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT, Controller, LoopResult, run_loop
from softgrip.simulator.angle_plant import AnglePlant
from softgrip.simulator.sensors import Measurement
from softgrip.simulator.simulation import Simulation, together


@dataclass(frozen=True)
class ClosedLoop:
    """A loop on the simulated rig.

    Attributes
    ----------
    result
        Reference, measured angle and command, shape (runs, N) where they differ by run.
    measured
        All that the sensors said at the N samples, with a leading axis of samples.
    true_angle
        rad, shape (runs, N): what a real rig would not tell.
    """

    result: LoopResult
    measured: Measurement
    true_angle: Floats


def run_on_rig(
    rig: Simulation, controlled_by: Controller, reference: ArrayLike, *, duration: float
) -> ClosedLoop:
    """Run a controller on a simulated rig, commands limited to 5 rev/s.

    Parameters
    ----------
    rig
        At rest; its period is the loop's.
    controlled_by
        From angles to motor speed.
    reference
        rad: a number or an array of ``N = round(duration / period) + 1`` samples.
    duration
        s.
    """
    plant = _Recorder(rig)
    result = run_loop(
        plant, controlled_by, reference, duration=duration, period=rig.period, limit=SPEED_LIMIT
    )
    # The loop ends with the command of its last sample carried out.
    seen, angles = plant.measured[:-1], plant.angles[:-1]
    return ClosedLoop(result, together(seen), np.stack(angles, axis=-1))


class _Recorder(AnglePlant):
    """An `AnglePlant` that keeps what it measured."""

    def __init__(self, rig: Simulation) -> None:
        super().__init__(rig)
        self.measured: list[Measurement] = []
        self.angles: list[Floats] = []

    def advance(self, command: ArrayLike, duration: float) -> Floats:
        found = self.rig.advance(command) if duration else self.rig.measure()
        self.measured.append(found)
        self.angles.append(self.rig.truth.angle[0])
        angle: Floats = found.angle[0]
        return angle
