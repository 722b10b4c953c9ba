"""Grasps of an elastic disc on the simulated gripper, in place of the photographs of Figure 6.8."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from book.chapter_6.controllers import gripper_controller
from book.companion.choices import choice
from softgrip.arrays import Floats
from softgrip.control.rig_controller import CommandSequence, RigController
from softgrip.gripper.grasp import DiscBetweenFingers, ElasticDisc
from softgrip.gripper.internal_model import PERIOD
from softgrip.reads import remembered
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import drive
from softgrip.simulator.fitted_rigs import printed_gripper
from softgrip.simulator.gripper_steps import push_commands
from softgrip.simulator.simulation import Simulation
from softgrip.units import REV

STEP = 0.002
"""Of the integration, s; half of it changes no force by more than 2 % (a test measures it)."""
SAMPLE = 0.02
"""Of what is kept, s; the controller sees each fifth."""
DURATION = 5.0
STIFFNESS = {"soft": 50.0, "medium": 200.0, "stiff": 2000.0}
"""N/m (assumed; nothing is said of the banana, the mochi, the bottle and the toy)."""
DRIVES: dict[str, Callable[[], RigController]] = {
    "slow push": lambda: CommandSequence(_push(0.5 * REV)),
    "fast push": lambda: CommandSequence(_push(5 * REV)),
    "scheme, 2/s": lambda: gripper_controller("2/s"),
}
"""A push is twice that of the open-loop step; the scheme goes for the same angles as without a
disc, which lie beyond its surface."""


def _push(speed: float) -> Floats:
    return push_commands(2 * choice("gripper_travel"), printed_gripper().pump, speed)


@dataclass(frozen=True)
class Grasp:
    """A grasp over time.

    Attributes:
        time: s, shape (N,).
        angles: rad, shape (2, N).
        place: Of the disc's centre, m from the middle, shape (N,).
        forces: Of left and right finger on the disc, N, shape (2, N).
        contact: The disc between the fingers.
    """

    time: Floats
    angles: Floats
    place: Floats
    forces: Floats
    contact: DiscBetweenFingers

    @property
    def apart(self) -> float:
        """Time between the first touches of the two fingers, s; infinite if one never touches."""
        first = [self.time[force > 0][:1] for force in self.forces]
        return float(abs(first[0] - first[1])[0]) if all(map(len, first)) else float("inf")


@remembered
def grasp(stiffness: float, by: str, *, equal: bool = False, step: float = STEP) -> Grasp:
    """Simulate a grasp by the median gripper.

    Args:
        stiffness: Of the disc, N/m.
        by: One of `DRIVES`.
        equal: Whether both fingers are as the left one.
        step: Of the integration, s.
    """
    contact = DiscBetweenFingers(ElasticDisc(stiffness))
    gripper = printed_gripper(spread=False)
    if equal:
        gripper = replace(gripper, fingers=(gripper.fingers[0],) * 2)
    rig = Simulation(gripper, seed=SEED, contact=contact, step=step, period=SAMPLE)
    made = drive(rig, DRIVES[by](), duration=DURATION, every=round(PERIOD / SAMPLE))
    angles, place = made.truth.angle[..., 0].T, made.truth.contact[:, 0, 0]
    forces = stiffness * contact.touches(angles, place).dent
    return Grasp(made.time, angles, place, forces, contact)
