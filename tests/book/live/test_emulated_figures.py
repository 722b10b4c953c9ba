"""The chapters' figures from logs of the firmware, emulated, beside those of the simulated rig."""

from functools import partial

import numpy as np
import pytest

from book.chapter_3.regulators import regulator
from book.chapter_4.controllers import controller
from book.chapter_6.controllers import gripper_controller, own_model, target_angles
from book.companion.exhibit import exhibit
from softgrip.control.rig_controller import Tracking
from softgrip.logs.fingers import fingers_of
from softgrip.logs.reader import read_log
from softgrip.logs.steps import judge_step_log
from softgrip.provenance import data_file
from softgrip.rig.connect import connect
from softgrip.rig.record import record
from softgrip.units import DEG
from tests.board.emulated import needs_emulator

pytestmark = needs_emulator


def kept(name):
    return data_file(f"simulated/{name}.csv").path


def apart(first, second):
    """Root mean square of the difference of the angles of two logs, rad."""
    one, other = fingers_of(read_log(first)), fingers_of(read_log(second))
    count = min(one.shape[1], other.shape[1])
    return np.sqrt(np.mean((one[:, :count] - other[:, :count]) ** 2))


def drawn(title, logs):
    return exhibit(title).make(tuple(logs))


@pytest.mark.parametrize(
    ("title", "law", "kept_logs"),
    [
        ("Figure 4.5", partial(controller, "full"), ("pid-actuator", "pid-full")),
        ("Figure 3.12", partial(regulator, "fast"), ("lqr-printed", "lqr-fast")),
    ],
)
def test_a_step_of_the_finger(title, law, kept_logs, tmp_path):
    path, (other, own) = tmp_path / "step.csv", map(kept, kept_logs)
    duration, step = (float(read_log(own)[name][-1]) for name in ("time", "reference"))
    with connect("emulated") as rig:
        rig.home()
        record(rig, Tracking(law(), step), duration, path, reference=step)
    # Two runs of one finger: the sensor's noise in both, and a start that the board's
    # acceleration limit and its clock delay by a period or two.
    assert apart(path, own) < 5 * DEG
    found, before = judge_step_log(path), judge_step_log(own)
    assert abs(found.steady_state_error - before.steady_state_error) < 2 * DEG
    assert drawn(title, (other, path)).axes


def test_two_fingers_on_one_pump(tmp_path):
    path, targets = tmp_path / "slow.csv", target_angles(own_model())
    duration = float(read_log(kept("gripper-slow-1"))["time"][-1])
    with connect("emulated:gripper") as rig:
        rig.home()
        record(rig, gripper_controller("2/s"), duration, path, reference=targets)
    # From run to run the fingers differ too.
    assert apart(path, kept("gripper-slow-1")) < 6 * DEG
    others = (kept(f"gripper-{kind}-1") for kind in ("open", "fast", "push"))
    free, fast, pushed = others
    assert drawn("Figure 6.7", (free, fast, path, pushed)).axes
