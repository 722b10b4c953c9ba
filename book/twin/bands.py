"""Bands of the ensemble for the chapters' figures: the same experiment on each of its rigs."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from book.companion import band
from book.twin import finger_loops, gripper_tests, rigs
from book.twin.fitted import best_rig, ensemble
from book.twin.laboratory import Laboratory
from book.twin.space import space
from softgrip.arrays import Floats
from softgrip.kept import Kept
from softgrip.simulator.statics import FULL_PRESSURE, settled_angle
from softgrip.units import DEG, MPa

CENTRAL = (5, 95)
STRIDE = 4
"""Samples of 25 ms from point to point."""
TORQUE_UNTIL = 0.25 * MPa
"""Where Figure 3.9 ends, Pa."""


@dataclass(frozen=True)
class Point:
    """A point of a band, in the units of the figure."""

    curve: str
    x: float
    low: float
    high: float


def laboratory() -> Laboratory:
    """Return the ensemble's rigs, all with the experiments of the best one."""
    columns = dict(zip(space(), ensemble().T.copy(), strict=True))
    for name, best in zip(space(), best_rig().tolist(), strict=True):
        if name.startswith("choice."):
            columns[name] = np.full_like(columns[name], best)
    return Laboratory(columns)


def curves(lab: Laboratory) -> Iterator[tuple[str, Floats, Floats]]:
    """Return name, x, and y of each rig, shape (rigs, N), of each curve."""
    straight = rigs.design_1(lab.values).finger.torque_per_pressure
    pressures = np.linspace(0, TORQUE_UNTIL, 26)
    yield "torque", pressures / MPa, np.multiply.outer(straight, pressures)
    pressures = np.linspace(0, FULL_PRESSURE, 31)
    for name, make in (("1", rigs.design_1), ("2", rigs.design_2), ("3", rigs.design_3)):
        finger = make(lab.values).finger
        angles = np.stack([settled_angle(finger, p) for p in pressures], axis=1)
        yield f"bending-{name}", pressures / MPa, angles / DEG
    for name, make in (("step", rigs.design_1), ("step-fx", rigs.design_3)):
        for degrees in (60, 90):
            test = lab.step_test(make, np.full(lab.count, degrees * DEG), keep=("angle",))
            yield f"{name}-{degrees}", test.time, test.angle[:, :, 0].mean(axis=1) / DEG
    for name, (time, angle) in finger_loops.responses(lab).items():
        yield name, time, angle[lab.known] / DEG
    opened = lab.gripper_open
    for k, side in enumerate(gripper_tests.SIDES):
        yield f"open-{side}", opened.time, opened.angle.mean(axis=1)[:, k] / DEG


def points() -> Iterator[Point]:
    """Run the experiments on the ensemble."""
    for name, x, y in curves(laboratory()):
        stride = STRIDE if x.size > 100 else 1
        low, high = np.percentile(y[:, ::stride], CENTRAL, axis=0)
        for one in zip(x[::stride].tolist(), low.tolist(), high.tolist(), strict=True):
            yield Point(name, *one)


KEPT = Kept(
    band.FILE,
    Point,
    points,
    source="python -m book.twin bands",
    notes="MPa, N m, s, deg: as the figures have them",
    number=".4g",
)
