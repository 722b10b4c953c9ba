"""The three simulated grasps of Section 2.4: how the force comes to rest, and whether it holds.

Given, and so never claimed as found: the desired forces and the weights, as printed, and the
friction, which Section 2.4 does not print and was fitted to its lift forces. The gains follow from
`tuned_gains` and the stiffest of the three contacts; nothing was chosen by how a grasp came out.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from book.chapter_2.forces import to_force
from book.companion.choices import choice
from softgrip.arrays import Floats
from softgrip.control.pid import PERIOD, Gains
from softgrip.control.step_metrics import step_metrics
from softgrip.reads import remembered
from softgrip.simulator.fitted_rigs import fitted_layer, fitted_pad
from softgrip.simulator.force_layer import volts
from softgrip.simulator.pad import make_pad
from softgrip.simulator.pad_grasp import GraspRecord, grasp
from softgrip.simulator.pad_gripper import GraspGripper, Squeeze, squeeze
from softgrip.simulator.pad_objects import pad_object
from softgrip.simulator.pad_surface import Pose
from softgrip.simulator.pad_tests import PAD_SEED
from softgrip.tactile.force_control import largest_loop_gain, tuned_gains
from softgrip.tactile.friction import lift_force, printed_grasps
from softgrip.units import MM

OBJECTS = {
    "egg": ("egg", Pose((0.0, 2 * MM))),
    "tofu": ("tofu", Pose((0.0, 0.0))),
    "carrot": ("small carrot", Pose((0.0, 1 * MM))),
}
"""Object of the pad and how it lies (assumed), by the printed name."""
RUNS, SEED = 200, 2027
BAND = 0.1
"""Of the settling time, as a share: a step of the servo alone is 6 % of the carrot's force."""
END = 1.0
"""s at the end of a record that count as rest."""


@remembered
def squeezes() -> Mapping[str, Squeeze]:
    """Return how the force rises on each object, by its printed name."""
    pad = make_pad(fitted_pad(), PAD_SEED)
    return MappingProxyType(
        {
            name: squeeze(pad, pad_object(item), pose, GraspGripper())
            for name, (item, pose) in OBJECTS.items()
        }
    )


def friction() -> float:
    """Return the fitted friction coefficient of the simulated fingers."""
    return choice("friction")


def desired_force(name: str) -> float:
    """Return the printed contact force of an object, N."""
    return float(printed_grasps()[name].contact)


@remembered
def largest_stiffness() -> float:
    """Return the stiffness of the stiffest contact at its desired force, N/m."""
    return max(found.stiffness(desired_force(name)) for name, found in squeezes().items())


@remembered
def count_forces() -> Floats:
    """Return the force that the regressor says for each count of the converter, N."""
    layer = fitted_layer()
    return to_force(volts(np.arange(layer.largest_count + 1), layer))


def study_gains(factor: float = 1.0) -> Gains:
    """Return the gains for the command as a change, one pair for all objects, times a factor."""
    gripper = GraspGripper()
    delay = (gripper.delay + 0.5) * PERIOD
    return tuned_gains(largest_stiffness() / factor, gripper.lag, delay)


def position_gains() -> Gains:
    """Return those for the command as a position: half the gain at which it turns unstable."""
    return Gains(kp=largest_loop_gain(GraspGripper().lag) / 2 / largest_stiffness())


@remembered
def study(name: str, factor: float = 1.0) -> GraspRecord:
    """Simulate the grasps of an object, by its printed name; gains as of `study_gains`."""
    gains = study_gains(factor)
    return grasp(squeezes()[name], gains, desired_force(name), count_forces(), runs=RUNS, seed=SEED)


@remembered
def position_study(name: str, opening: float = 0.0) -> GraspRecord:
    """Simulate the same with the command as a position, from an opening, m: by default none."""
    return grasp(
        squeezes()[name],
        position_gains(),
        desired_force(name),
        count_forces(),
        command="position",
        gripper=replace(GraspGripper(), opening=opening),
        runs=RUNS,
        seed=SEED,
    )


def at_rest(record: GraspRecord, values: Floats) -> Floats:
    """Return the mean over the end of a record of values of shape (runs, samples)."""
    found: Floats = values[:, record.time >= record.time[-1] - END].mean(axis=-1)
    return found


def held_share(name: str, coefficient: float) -> float:
    """Return the share of the simulated grasps whose true lift force at rest bears the weight."""
    record = study(name)
    lift = lift_force(at_rest(record, record.force), coefficient)
    return float(np.mean(lift >= float(printed_grasps()[name].weight)))


@dataclass(frozen=True)
class GraspSummary:
    """What came of the simulated grasps of an object.

    Attributes:
        overshoot: Of the measured force, median share of the desired one.
        settling_time: From the open gripper until the measured force stays within `BAND`, s,
            median.
        steady_error: Desired less measured force at rest, N, mean.
        ripple: Deviation of the measured force at rest in time, N, mean.
        force, force_deviation: True force at rest, N, mean and deviation over the grasps.
        peak: Largest true force, N, mean.
    """

    overshoot: float
    settling_time: float
    steady_error: float
    ripple: float
    force: float
    force_deviation: float
    peak: float


def summary(record: GraspRecord) -> GraspSummary:
    """Return the measures of a batch of grasps."""
    found = step_metrics(record.time, record.measured, target=record.desired, band=BAND, window=END)
    rest = record.time >= record.time[-1] - END
    true = at_rest(record, record.force)
    return GraspSummary(
        overshoot=float(np.median(found.overshoot)),
        settling_time=float(np.median(found.settling_time)),
        steady_error=float(found.steady_state_error.mean()),
        ripple=float(record.measured[:, rest].std(axis=-1).mean()),
        force=float(true.mean()),
        force_deviation=float(true.std()),
        peak=float(record.force.max(axis=-1).mean()),
    )
