"""What one step of each method costs a processor.

``python -m book.beyond.delay.step_time`` writes ``data/delay/step_time.csv``. Each controller is
the one that drives a rig, for one run; its time is the processor's own, by the thread's clock.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from time import thread_time_ns

import numpy as np
from numpy.typing import ArrayLike

from book.beyond.delay.methods import best_feedforward
from book.beyond.delay.policy import PolicyLaws, policy_for
from book.chapter_6.controllers import gripper_controller, own_model, target_angles
from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.rig_controller import CommandSequence, RigController
from softgrip.control.state_feedback import SPEED_DIGITS
from softgrip.gripper.delayed_plant import DelayedGripper
from softgrip.gripper.internal_model import InternalModelController
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.predictive import PredictiveController, predictive_law
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.shaping_filter import filter_state_space
from softgrip.gripper.smith_predictor import smith_matrices
from softgrip.kept import Kept

DELAY = 0.2
"""s, that the controllers know."""
STEPS = 2000


@dataclass(frozen=True)
class StepTime:
    """Times of a step, microseconds of the processor.

    Attributes:
        method: One of `methods.METHODS`.
        middle, high: Median and 99th percentile.
    """

    method: str
    middle: float
    high: float


class _OneRun:
    """Laws of one rig and one run as a controller."""

    def __init__(self, law: PolicyLaws) -> None:
        self.law = law

    def update(self, measured: ArrayLike) -> Floats:
        """Return the command, shape (1,), from angles of shape (fingers, 1)."""
        return np.asarray(self.law.update(np.asarray(measured).T[None])[0])


def predictive_controller(plant: DelayedGripper) -> PredictiveController:
    """Return the predictive controller of a rig, as it drives one."""
    law = predictive_law(plant, target_angles(plant.gripper), limit=SPEED_LIMIT)
    return PredictiveController(law, digits=SPEED_DIGITS)


def smith_controller(plant: DelayedGripper, ahead: str, back: str) -> InternalModelController:
    """Return a Smith predictor of a rig by the names of its filters, as it drives one."""
    low_pass, feedback = (filter_state_space(*FILTERS[name]) for name in (ahead, back))
    matrices = smith_matrices(
        plant, mean_inverse(plant.gripper), low_pass,
        feedback_filter=None if ahead == back else feedback,
    )  # fmt: skip
    return InternalModelController(matrices, target_angles(plant.gripper), digits=SPEED_DIGITS)


def controllers(plant: DelayedGripper) -> dict[str, Callable[[], RigController]]:
    """Return what makes the controller of each method for one run."""
    target = target_angles(plant.gripper)
    return {
        "printed, 4.8/s": lambda: gripper_controller("4.8/s", model=plant.gripper),
        "printed, 2/s": lambda: gripper_controller("2/s", model=plant.gripper),
        "mean angle": lambda: gripper_controller("LQR", model=plant.gripper),
        "best feedforward": lambda: CommandSequence(best_feedforward(plant, target).command),
        "Smith, 2/s": lambda: smith_controller(plant, "2/s", "2/s"),
        "filtered Smith": lambda: smith_controller(plant, "4.8/s", "2/s"),
        "predictive": lambda: predictive_controller(plant),
        "learned": lambda: _OneRun(PolicyLaws([policy_for(plant)], [plant], target[None])),
    }


def made(steps: int = STEPS) -> Iterator[StepTime]:
    """Time all methods."""
    rng = np.random.default_rng(0)
    plant = DelayedGripper(own_model(), (DELAY, DELAY))
    for name, make in controllers(plant).items():
        controller, taken = make(), []
        for k in range(steps):
            seen = target_angles(own_model()) * min(k % 50 / 20, 1) + 0.03 * rng.normal(size=2)
            one = seen if name == "predictive" else seen[:, None]
            start = thread_time_ns()
            controller.update(one)
            taken.append((thread_time_ns() - start) / 1e3)
        middle, high = np.percentile(taken, [50, 99])
        yield StepTime(name, float(middle), float(high))


KEPT = Kept(
    "delay/step_time.csv",
    StepTime,
    made,
    "python -m book.beyond.delay.step_time",
    notes="microseconds of one processor of the machine that made this file",
    number=".2g",
)

if __name__ == "__main__":
    KEPT.main()
