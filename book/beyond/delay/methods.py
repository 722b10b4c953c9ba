"""The methods that are held side by side: what each makes of a rig's known fingers and delays."""

from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np

from book.beyond.delay.policy import PolicyLaws, policy_for
from book.chapter_6.controllers import gripper_controller, target_angles
from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.errors import InvalidInputError
from softgrip.gripper.delayed_batch import BatchLaw, LinearLaws, PredictiveLaws, Sequences
from softgrip.gripper.delayed_plant import DelayedGripper
from softgrip.gripper.internal_model import PERIOD, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.optimal_feedforward import FeedforwardProgram, OptimalFeedforward
from softgrip.gripper.plant import Gripper
from softgrip.gripper.predictive import predictive_law
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.shaping_filter import filter_state_space
from softgrip.gripper.smith_predictor import smith_matrices
from softgrip.simulator.sampled_law import sampled_law

COMMANDS = 4
"""Commands on their way that all models keep, so that they are of one size: 400 ms."""
LIKELY, LONGEST = 0.8, 2.8
"""s: where the search for the earliest settling begins, and the latest that is tried."""
LOOKED_AT = 4
"""Points of a period at which the best feedforward looks at the fingers."""
FAST, SLOW = "4.8/s", "2/s"

Known = Sequence[DelayedGripper]
Make = Callable[[Known, Floats], BatchLaw]
"""From what is known of the rigs, and their targets (rad, (rigs, fingers)), to their laws."""


def known_targets(known: Known) -> Floats:
    """Return what each rig goes for: of 45 deg for all what its pump can hold, (rigs, fingers)."""
    return np.stack([target_angles(one.gripper) for one in known])


def _printed(name: str) -> Make:
    low_pass = filter_state_space(*FILTERS[name])

    def make(known: Known, targets: Floats) -> BatchLaw:
        laws = [
            controller_matrices(one.gripper, mean_inverse(one.gripper), low_pass, period=PERIOD)
            for one in known
        ]
        return LinearLaws(laws, targets)

    return make


def _smith(ahead: str, back: str) -> Make:
    low_pass, feedback = (filter_state_space(*FILTERS[name]) for name in (ahead, back))

    def make(known: Known, targets: Floats) -> BatchLaw:
        laws = [
            smith_matrices(
                one, mean_inverse(one.gripper), low_pass,
                feedback_filter=None if ahead == back else feedback, commands=COMMANDS,
            )
            for one in known
        ]  # fmt: skip
        return LinearLaws(laws, targets)

    return make


def _mean_angle(known: Known, targets: Floats) -> BatchLaw:
    laws = [
        sampled_law(gripper_controller("LQR", model=one.gripper), len(one.delays)) for one in known
    ]
    goals = targets.mean(axis=1)[:, None]
    return LinearLaws([one.matrices for one in laws], goals, SPEED_LIMIT)


def best_feedforward(plant: DelayedGripper, target: Floats) -> OptimalFeedforward:
    """Return the command that settles the known fingers as early as any can, most together.

    A delay that all have is left out: it moves no command. Of fingers without other differences of
    their delays only the first two are looked at: the rest lie between them, and stay there.

    Raises:
        InvalidInputError: If nothing settles within `LONGEST`.
    """
    late = tuple(round(own - plant.transport, 9) for own in plant.delays)
    gripper, goal = plant.gripper, tuple(target.tolist())
    if not any(late) and len(late) > 2:
        gripper, late = Gripper(gripper.fingers[:2]), late[:2]
        goal = tuple((gripper.velocity_gains * goal[0] / gripper.velocity_gains[0]).tolist())
    return _earliest(gripper, late, goal)


@lru_cache(maxsize=4096)
def _earliest(
    gripper: Gripper, late: tuple[float, ...], target: tuple[float, ...]
) -> OptimalFeedforward:
    program = FeedforwardProgram(gripper, target, limit=SPEED_LIMIT, delays=late, points=LOOKED_AT)

    def settled(periods: int) -> OptimalFeedforward | None:
        try:
            return program.settled_by(periods * PERIOD)
        except InvalidInputError:
            return None

    # What settles by a time settles by all later ones.
    periods, last = round(LIKELY / PERIOD), round(LONGEST / PERIOD)
    best = settled(periods)
    if best is None:
        later = (settled(k) for k in range(periods + 1, last + 1))
        best = next((one for one in later if one is not None), None)
        if best is None:
            raise InvalidInputError("plant", expected=f"one settled by {LONGEST:g} s", got=gripper)
        return best
    while periods > 1 and (earlier := settled(periods - 1)) is not None:
        best, periods = earlier, periods - 1
    return best


def _feedforward(known: Known, targets: Floats) -> BatchLaw:
    return Sequences(
        np.stack(
            [best_feedforward(one, own).command for one, own in zip(known, targets, strict=True)]
        )
    )


def _predictive(known: Known, targets: Floats) -> BatchLaw:
    return PredictiveLaws(
        [
            predictive_law(one, own, limit=SPEED_LIMIT, commands=COMMANDS)
            for one, own in zip(known, targets, strict=True)
        ]
    )


def _learned(known: Known, targets: Floats) -> BatchLaw:
    return PolicyLaws([policy_for(one) for one in known], known, targets)


METHODS: dict[str, Make] = {
    "printed, 4.8/s": _printed(FAST),
    "printed, 2/s": _printed(SLOW),
    "mean angle": _mean_angle,
    "best feedforward": _feedforward,
    "Smith, 2/s": _smith(SLOW, SLOW),
    "filtered Smith": _smith(FAST, SLOW),
    "predictive": _predictive,
    "learned": _learned,
}
"""By name; the two printed ones and the regulator of the mean know of no delay."""
KNOW_DELAY = ("Smith, 2/s", "filtered Smith", "predictive")
"""Those whose model has the delay, and may have a wrong one."""
