"""A learned policy: a command that is linear in what was seen and sent, found by evolution.

``python -m book.beyond.delay.policy`` trains one for each delay and writes
``data/delay/policies.csv``. The rigs that it learns on are drawn about the book's own gripper
within the printed bounds, with seeds of their own: no rig and no noise of the comparison is among
them. Nothing is said to it of fingers or delay but what it sees.
"""

from collections.abc import Iterator, Sequence
from dataclasses import astuple, dataclass

import cma
import numpy as np

from book.chapter_6.controllers import own_model, target_angles
from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.gripper.delayed_batch import late_measures, run_late
from softgrip.gripper.delayed_plant import DelayedGripper
from softgrip.gripper.gripper_batch import GripperBatch, draw_grippers
from softgrip.gripper.internal_model import PERIOD
from softgrip.kept import Kept
from softgrip.reads import remembered
from softgrip.simulator.gripper_steps import OPEN_LOOP_DURATION
from softgrip.units import DEG

DELAYS = (0.0, 0.05, 0.1, 0.15, 0.2, 0.3)
"""s, for which a policy is trained; another delay takes the nearest."""
TRAINING_SEED = 7_000_001
"""Of rigs and noise to learn on."""
TRAINING_RIGS, POPULATION, GENERATIONS, WIDTH = 64, 16, 200, 0.3
APART_COST = 20.0
"""s of being off the target that a difference of one whole target counts as."""
LOOKED_AT = 10
"""Points of a period."""
TRAVEL_COST = 0.005
"""s by rad: what the motor's travel counts as, without which policies chatter."""


@dataclass(frozen=True)
class Policy:
    """Weights of a trained policy.

    Attributes:
        delay: It was trained for, s.
        error, rate, bend: Of one less the mean share, and of its first and second differences.
        apart: Of the largest difference of two fingers' shares.
        sent_1, sent_2, sent_3, sent_4: Of the last commands, as shares of the limit.
        cost: That it reached on what it learned from, s.
    """

    delay: float
    error: float
    rate: float
    bend: float
    apart: float
    sent_1: float
    sent_2: float
    sent_3: float
    sent_4: float
    cost: float

    @property
    def weights(self) -> Floats:
        """As numbers, shape (8,)."""
        return np.array(astuple(self)[1:9])


class PolicyLaws:
    """A policy of each rig; commands are in units in which all known rigs are equally strong.

    Args:
        weights: Of each rig, shape (rigs, 8), or (rigs, runs, 8).
        known: What is known of each rig: only how far a command bends its fingers in the end.
        targets: rad, shape (rigs, fingers).
    """

    def __init__(
        self, weights: Sequence[Floats] | Floats, known: Sequence[DelayedGripper], targets: Floats
    ) -> None:
        stacked = np.asarray(weights)
        self._weights = stacked if stacked.ndim == 3 else stacked[:, None]
        self._targets = targets[:, None]
        strength = [
            float(np.mean(one.gripper.velocity_gains / own))
            for one, own in zip(known, targets, strict=True)
        ]
        self._unit = 1 / np.array(strength)[:, None]
        self._means: list[Floats] = []
        self._sent: list[Floats] = []

    def update(self, angles: Floats) -> Floats:
        """Return commands, rad/s, shape (rigs, runs), from angles, (rigs, runs, fingers)."""
        shares = angles / self._targets
        mean, none = shares.mean(axis=-1), np.zeros(shares.shape[:2])
        one, two = (self._means[k] if len(self._means) > k else none for k in (0, 1))
        last = [self._sent[k] if len(self._sent) > k else none for k in range(4)]
        seen = [1 - mean, mean - one, mean - 2 * one + two, np.ptp(shares, axis=-1), *last]
        drive = sum(self._weights[..., k] * part for k, part in enumerate(seen))
        command = np.clip(drive * self._unit, -SPEED_LIMIT, SPEED_LIMIT)
        self._means = [mean, one]
        self._sent = [command / self._unit, *last[:3]]
        return np.asarray(command)


def costs(candidates: Floats, delay: float, *, seed: int = TRAINING_SEED) -> Floats:
    """Return what candidates cost on rigs to learn on, s, shape (candidates,).

    Args:
        candidates: Weights, shape (candidates, 8).
        delay: Of all fingers, s.
        seed: Of rigs and noise.
    """
    nominal = own_model()
    targets = target_angles(nominal)[None]
    drawn = draw_grippers(nominal, TRAINING_RIGS, seed=seed)
    count, periods = len(candidates), round(OPEN_LOOP_DURATION / PERIOD)
    noise = np.random.default_rng((seed, 2)).standard_normal((1, 2, TRAINING_RIGS, periods))
    damping, stiffness, gain = (
        np.tile(one, (count, 1)) for one in (drawn.damping, drawn.stiffness, drawn.gain)
    )
    every = GripperBatch(damping, stiffness, gain)
    known = [DelayedGripper(nominal, (delay, delay))]
    law = PolicyLaws(np.repeat(candidates, TRAINING_RIGS, axis=0)[None], known, targets)
    motion = run_late(
        [every], np.full((1, 2), delay), law, np.tile(2 * DEG * noise, (1, 1, count, 1)),
        limit=SPEED_LIMIT, points=LOOKED_AT,
    )  # fmt: skip
    found = late_measures(motion, targets)
    each = found.missed + APART_COST * found.apart / targets.mean() + TRAVEL_COST * found.travel
    return np.asarray(each.reshape(count, TRAINING_RIGS).mean(axis=1))


def trained(delay: float) -> Policy:
    """Return the policy that evolution finds for a delay, s."""
    start = np.array([1.0, *[0.0] * 7])
    options = {"popsize": POPULATION, "seed": 1, "verbose": -9}
    strategy = cma.CMAEvolutionStrategy(start, WIDTH, options)
    for _ in range(GENERATIONS):
        drawn = np.array(strategy.ask())
        strategy.tell(list(drawn), costs(drawn, delay).tolist())
    best = np.asarray(strategy.result.xfavorite)
    numbers: list[float] = [delay, *best.tolist(), float(costs(best[None], delay)[0])]
    return Policy(*numbers)


def made() -> Iterator[Policy]:
    """Train a policy for each delay."""
    yield from map(trained, DELAYS)


KEPT = Kept(
    "delay/policies.csv",
    Policy,
    made,
    "python -m book.beyond.delay.policy",
    notes="by evolution on drawn rigs, none of which is compared on",
    exact=("delay",),
)


@remembered
def policies() -> tuple[Policy, ...]:
    """Return the kept policies."""
    return KEPT.read()


def policy_for(plant: DelayedGripper) -> Floats:
    """Return the weights of the policy that was trained for the delay nearest to a gripper's."""
    own = float(np.mean(plant.delays))
    return min(policies(), key=lambda one: abs(one.delay - own)).weights


if __name__ == "__main__":
    KEPT.main()
