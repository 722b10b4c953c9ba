"""The methods on the whole simulated rig, as a check on the linear fingers of the sweep.

``python -m book.beyond.delay.full_rig`` writes ``data/delay/full_rig.csv``. Motor, gas, rubber with
its memory, sensors and converter are those of each rig of the ensemble; what is late is the
command, by whole periods. The methods know what they know in the sweep: the linear fingers that the
rig's step tests identify.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from book.beyond.delay.methods import METHODS, known_targets
from book.beyond.delay.rigs import rigs
from book.beyond.delay.sweep import REFERENCE, SEED, SPENT, interval
from book.twin import rigs as making
from book.twin.fitted import ensemble
from book.twin.space import space
from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.gripper.delayed_batch import BatchLaw, LateMeasures, LateMotion, late_measures
from softgrip.gripper.delayed_plant import DelayedGripper
from softgrip.gripper.internal_model import PERIOD
from softgrip.kept import Kept
from softgrip.simulator.drive import drive
from softgrip.simulator.gripper_steps import OPEN_LOOP_DURATION
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG, REV

DELAYS = (0, 100, 200, 300)
"""ms, whole periods."""


@dataclass(frozen=True)
class FullCell:
    """Measures of a method on whole rigs, one run each, with 95 % intervals over the rigs.

    Attributes:
        delay: Of the command, ms.
        method: One of `METHODS`.
        settling, settling_low, settling_high: Median, s; what does not settle counts as the record.
        apart, apart_low, apart_high: Mean, deg.
        apart_gain, apart_gain_low, apart_gain_high: By how much less than the printed loop at 2/s.
        missed: Mean, s.
        travel: Mean, rev.
    """

    delay: int
    method: str
    settling: float
    settling_low: float
    settling_high: float
    apart: float
    apart_low: float
    apart_high: float
    apart_gain: float
    apart_gain_low: float
    apart_gain_high: float
    missed: float
    travel: float


class OfRigs:
    """Laws of some rigs as one controller of a batch with a run of each."""

    def __init__(self, law: BatchLaw) -> None:
        self.law = law

    def update(self, measured: ArrayLike) -> Floats:
        """Return motor speeds, rad/s, shape (runs,), from angles, rad, (fingers, runs)."""
        return np.asarray(self.law.update(np.asarray(measured).T[:, None])[:, 0])


def measured(method: str, delay: int, *, every: int = 1) -> LateMeasures:
    """Run a method on each rig that is compared on, or on some, with a delay of so many ms."""
    rows = rigs()[SPENT::every]
    values = [dict(zip(space(), own.tolist(), strict=True)) for own in ensemble()]
    known = [DelayedGripper(row.gripper(2), (delay / 1000,) * 2) for row in rows]
    targets = known_targets(known)
    rig = Simulation([making.gripper(values[row.rig]) for row in rows], seed=SEED, period=PERIOD)
    made = drive(
        rig, OfRigs(METHODS[method](known, targets)), duration=OPEN_LOOP_DURATION,
        limit=SPEED_LIMIT, delay=round(delay / 1000 / PERIOD),
    )  # fmt: skip
    angles = made.truth.angle.transpose(2, 1, 0)[:, :, None]
    commands = made.command.T[:, None, 1:]
    return late_measures(LateMotion(made.time, angles, commands, PERIOD), targets)


def made() -> Iterator[FullCell]:
    """Run all methods with all delays."""
    for delay in DELAYS:
        found = {name: measured(name, delay) for name in METHODS}
        reference = found[REFERENCE].apart[:, 0] / DEG
        for name, one in found.items():
            settling = np.minimum(one.settling[:, 0], OPEN_LOOP_DURATION)
            apart = one.apart[:, 0] / DEG
            yield FullCell(
                delay, name, *interval(settling, "median"), *interval(apart, "mean"),
                *interval(reference - apart, "mean"),
                float(one.missed.mean()), float(one.travel.mean() / REV),
            )  # fmt: skip


KEPT = Kept(
    "delay/full_rig.csv",
    FullCell,
    made,
    "python -m book.beyond.delay.full_rig",
    notes="settling in s, apart in deg, missed in s, travel in rev; percentile bootstrap over rigs",
    number=".4g",
)

if __name__ == "__main__":
    KEPT.main()
