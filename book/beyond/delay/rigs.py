"""The grippers of the ensemble's rigs, as their own step tests identify them.

``python -m book.beyond.delay.rigs`` writes ``data/delay/rigs.csv``. Each rig of `book.twin.fitted`
is put through Section 6.4's steps in open loop, and each finger is identified from the mean of its
runs, as the book's own gripper is. What differs from run to run is kept with it.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from book.twin.fitted import ensemble
from book.twin.laboratory import Laboratory
from book.twin.space import space
from softgrip.arrays import Floats
from softgrip.gripper.gripper_batch import GripperBatch
from softgrip.gripper.plant import FingerDynamics, Gripper
from softgrip.kept import Kept
from softgrip.reads import remembered

BETWEEN = (0.0, 1.0, 0.5, 0.25, 0.75)
"""Where a finger lies between the left one, 0, and the right one, 1: of a gripper of two to five
fingers these are the first."""


@dataclass(frozen=True)
class RigRow:
    """What a rig's step tests say, and its spread from run to run.

    Attributes:
        rig: Its number in the ensemble.
        left_damping, left_stiffness, left_gain: As of `FingerDynamics`, the input in rad/s.
        right_damping, right_stiffness, right_gain: The same.
        spread_stiffness, spread_damping: Standard deviations of the logarithm from run to run.
        angle_noise: Root mean square of the flex sensor's, rad.
    """

    rig: int
    left_damping: float
    left_stiffness: float
    left_gain: float
    right_damping: float
    right_stiffness: float
    right_gain: float
    spread_stiffness: float
    spread_damping: float
    angle_noise: float

    def gripper(self, fingers: int) -> Gripper:
        """Return its gripper of two to five fingers, more than two lying between the two."""
        ends = np.log(
            [
                (self.left_damping, self.left_stiffness, self.left_gain),
                (self.right_damping, self.right_stiffness, self.right_gain),
            ]
        )
        return Gripper(
            tuple(
                FingerDynamics(*np.exp((1 - place) * ends[0] + place * ends[1]).tolist())
                for place in BETWEEN[:fingers]
            )
        )


def made() -> Iterator[RigRow]:
    """Identify the fingers of all rigs."""
    lab = Laboratory(dict(zip(space(), ensemble().T.copy(), strict=True)))
    found = lab.gripper_fingers
    w, z, gain = found.natural_frequency, found.damping_ratio, found.gain
    each = np.stack([2 * z * w, w * w, gain * w * w], axis=-1).reshape(len(w), -1)
    own = ("spread.gripper_stiffness", "spread.gripper_damping", "sensors.angle_noise")
    rest = np.stack([lab[name] for name in own], axis=1)
    for rig, (usable, numbers) in enumerate(
        zip(np.all(found.usable, axis=1).tolist(), np.hstack([each, rest]).tolist(), strict=True)
    ):
        if usable:
            yield RigRow(rig, *numbers)


KEPT = Kept(
    "delay/rigs.csv",
    RigRow,
    made,
    "python -m book.beyond.delay.rigs",
    notes="by the ensemble of data/calibration/ensemble.csv; SI, the input of a finger in rad/s",
)


@remembered
def rigs() -> tuple[RigRow, ...]:
    """Return the kept rigs."""
    return KEPT.read()


def real_fingers(row: RigRow, fingers: int, *, runs: int, seed: int) -> GripperBatch:
    """Return the fingers as they are in each run, shape (runs, fingers): what no controller knows.

    Args:
        row: The rig.
        fingers: How many.
        runs, seed: Of the spread; a finger's numbers do not hang on how many fingers there are.
    """
    known = GripperBatch.of(row.gripper(fingers))
    chance = np.random.default_rng((seed, 0, row.rig)).standard_normal((2, len(BETWEEN), runs))
    stiffness, damping = (
        np.exp(share * own[:fingers].T)
        for share, own in zip((row.spread_stiffness, row.spread_damping), chance, strict=True)
    )
    return GripperBatch(
        known.damping * damping, known.stiffness * stiffness, np.repeat(known.gain, runs, axis=0)
    )


def sensor_noise(row: RigRow, fingers: int, periods: int, *, runs: int, seed: int) -> Floats:
    """Return the noise of the flex sensors, rad, shape (fingers, runs, periods)."""
    random = np.random.default_rng((seed, 1, row.rig))
    drawn = random.standard_normal((len(BETWEEN), runs, periods))
    return np.asarray(row.angle_noise * drawn[:fingers])


if __name__ == "__main__":
    KEPT.main()
