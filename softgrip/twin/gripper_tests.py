"""The tests of the gripper in Section 6.4 on many rigs."""

from functools import partial

import numpy as np

from softgrip.arrays import Floats
from softgrip.control.rig_controller import CommandSequence, RigController
from softgrip.control.state_feedback import SPEED_DIGITS
from softgrip.control.step_metrics import final_value, settling_time
from softgrip.gripper.internal_model import (
    PERIOD,
    InternalModelController,
    controller_matrices,
)
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import Gripper
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.reach import project
from softgrip.gripper.shaping_filter import filter_state_space
from softgrip.gripper.uncertainty import excited_band
from softgrip.simulator.gripper_calibration import OPEN_LOOP_DURATION
from softgrip.twin import rigs
from softgrip.twin.experiments import closed_loop
from softgrip.twin.laboratory import Laboratory
from softgrip.twin.statics import volume_for
from softgrip.twin.step_tests import Measures
from softgrip.units import DEG, ML, REV

SIDES = ("left", "right")
LOOPS, STEPS = 50, 200
"""Runs of a closed loop of which the median is taken, and of the steps at two speeds."""
END, REST = 1.0, 5.0
"""s: the end of a record that counts as rest; and the time after a slow push."""
WANTED = 45 * DEG
"""Of both fingers, rad."""


def steps(lab: Laboratory) -> Measures:
    """Return what the seven steps in open loop say: angles at rest, models, and their spread.

    deg; damping and stiffness by mass, 1/s and 1/s^2, means of the runs; the larger of the two
    fingers' largest deviations, %; and the band in which the command is excited, rad/s.
    """
    test = lab.gripper_open
    ends = final_value(test.time, test.angle.mean(axis=1), window=END) / DEG
    each = lab.identified_fingers(test.angle)
    shape = test.angle.shape[:-1]
    w, z = (x.reshape(shape) for x in (each.natural_frequency, each.damping_ratio))
    elements = {"damping": 2 * z * w, "stiffness": w * w}
    found = {f"angle-{side}": ends[:, k] for k, side in enumerate(SIDES)}
    for name, values in elements.items():
        mean, off = _over_runs(values)
        found |= {f"{name}-{side}": mean[:, k] for k, side in enumerate(SIDES)}
        found[f"deviation-{name}"] = 100 * off.max(axis=1)
    return {**found, **_excited(test.command, lab["choice.excited_share"])}


def _over_runs(values: Floats) -> tuple[Floats, Floats]:
    """Return the mean over the runs that identify a model, and the largest deviation as a share.

    Args:
        values: Shape (rigs, runs, fingers), NaN where a run identifies none.

    Returns:
        tuple: Shape (rigs, fingers) each, NaN where no run does.
    """
    told = np.isfinite(values)
    with np.errstate(invalid="ignore"):
        mean = np.where(told, values, 0.0).sum(axis=1) / told.sum(axis=1)
    off = np.where(told, np.abs(values / mean[:, None] - 1), 0.0).max(axis=1)
    return mean, np.where(np.isnan(mean), np.nan, off)


def _excited(command: Floats, share: Floats) -> Measures:
    bands = [
        excited_band(own[1:], PERIOD, share=float(part))
        for own, part in zip(command, share, strict=True)
    ]
    low, high = np.transpose(bands)
    return {"excited-low": low, "excited-high": high}


def speeds(lab: Laboratory) -> Measures:
    """Return the deviation of the left finger's angle at rest at two speeds, deg, as measured.

    And the band in which the slow command is excited, rad/s.
    """
    found: Measures = {}
    for name in ("gripper_speed", "low_speed"):
        speed = lab[f"choice.{name}"] * REV
        test, ends = lab.gripper_steps(speed, STEPS, rest=REST)
        last = round(END / PERIOD)
        rest = [
            angle[:, 0, end - last : end].mean(axis=-1)
            for angle, end in zip(test.angle, ends, strict=True)
        ]
        found[name] = np.std(rest, axis=1, ddof=1) / DEG
    return {**found, **_excited(test.command, lab["choice.excited_share"])}


def _controller(gripper: Gripper | None, target_loop: str, target: Floats) -> RigController:
    if gripper is None:
        return CommandSequence([])
    low_pass = filter_state_space(*FILTERS[target_loop])
    matrices = controller_matrices(gripper, mean_inverse(gripper), low_pass, period=PERIOD)
    return InternalModelController(matrices, target, digits=SPEED_DIGITS)


def loops(lab: Laboratory) -> Measures:
    """Return what the scheme of Figure 6.3 does with either filter, medians of the runs.

    Settling time of both fingers about their own ends, s; error of the worse finger at rest, and
    the largest difference of the shares of their ways, deg; all without the sensors. NaN where the
    steps identify no model.
    """
    unknown = np.full(2, np.nan)
    targets = np.array(
        [unknown if one is None else project(one, [WANTED] * 2).reached for one in lab.grippers]
    )
    band = lab["choice.gripper_band"] / 100
    found: Measures = {}
    for target_loop in FILTERS:
        controllers = [
            partial(_controller, gripper, target_loop, target)
            for gripper, target in zip(lab.grippers, targets, strict=True)
        ]
        made = closed_loop(
            lab.rigs(rigs.gripper), controllers, OPEN_LOOP_DURATION, runs=LOOPS, period=PERIOD
        )
        angle = made.true_angle
        ends = final_value(made.time, angle)
        allowed = band[:, None, None] * np.abs(ends)
        settled = settling_time(
            made.time, angle / allowed[..., None], final=ends / allowed, band=1.0, absolute=True
        )
        shares = angle / targets[:, None, :, None]
        apart = np.ptp(shares, axis=2) * targets.mean(axis=1)[:, None, None]
        measures = {
            "settling": np.where(np.isnan(targets[:, :1]), np.nan, settled.max(axis=2)),
            "error": np.abs(ends - targets[:, None]).max(axis=2) / DEG,
            "apart": apart.max(axis=2) / DEG,
        }
        found |= {f"{name}-{target_loop}": np.median(v, axis=1) for name, v in measures.items()}
    return found


def volume(lab: Laboratory) -> Measures:
    """Return the volume that bends three fingers by a right angle, mL, Section 6.3."""
    made = [volume_for(rig, 3, np.pi / 2) / ML for rig in lab.rigs(rigs.gripper)]
    return {"three": np.array(made)}


FAST = {"gripper steps": steps, "gripper speeds": speeds, "gripper loops": loops, "volume": volume}
