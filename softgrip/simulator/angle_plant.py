"""The simulated rig as a sampled control loop sees it: a motor speed in, an angle out."""

from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.simulator.simulation import Simulation


class AnglePlant:
    """A rig that tells its measured angle alone.

    Parameters
    ----------
    rig
        Which is driven; its truth stays at hand there.
    """

    def __init__(self, rig: Simulation) -> None:
        self.rig = rig

    def advance(self, command: ArrayLike, duration: float) -> Floats:
        """Hold a motor speed (rad/s) for a period, then return the measured angle, rad, (runs,).

        A duration of 0 moves nothing and measures.
        """
        angle: Floats = (self.rig.advance(command) if duration else self.rig.measure()).angle[0]
        return angle
