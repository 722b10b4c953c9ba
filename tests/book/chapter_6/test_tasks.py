"""The answers to Chapter 6's tasks, found again on the sliders and in runs of the loop."""

import numpy as np
import pytest

from book.chapter_6 import sliders, tasks
from book.chapter_6.figures_study import LIMITS
from softgrip.gripper.gripper_loop import run_gripper
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.printed_loop import equal_targets
from softgrip.gripper.reach import outside_share
from softgrip.gripper.shaping_filter import low_pass
from softgrip.units import DEG
from tests.book.explore.page_laws import page_laws

FINE = 0.02
"""Grid on which an answer is looked for, deg or rad/s: finer than what is told."""


def slider(law, name):
    """Return the positions of a slider of the page."""
    found = page_laws()[law].ranges[name]
    return found.low, found.high, found.step


def test_positions_that_the_tasks_name_are_on_the_sliders():
    for law, name, wanted in (
        ("reach", "first", tasks.FIRST),
        ("reach", "frequency", tasks.SWINGING),
        ("gripper_step", "bandwidth", tasks.FROM),
        ("gripper_step", "bandwidth", tasks.TO),
        ("gripper_push", "disturbance", tasks.PUSH),
    ):
        low, high, step = slider(law, name)
        assert low < wanted < high
        assert (wanted - low) / step == pytest.approx(round((wanted - low) / step), abs=1e-6)


@pytest.mark.parametrize("frequency", [0.0, tasks.SWINGING])
def test_best_target_beside_the_first_is_found_by_trying_all(frequency):
    low, high, _ = slider("reach", "second")
    tried = np.arange(low, high, FINE)
    # Not by the plane of angles: by the column of P, as Figure 6.A.
    missed = [
        float(outside_share(PRINTED, (tasks.FIRST, x), [frequency])[0]) for x in tried.tolist()
    ]
    second, share = tasks.partner(frequency)
    # Near the least the share is flat, and at rest it has a kink there.
    assert second == pytest.approx(tried[np.argmin(missed)], abs=0.05)
    assert share == pytest.approx(min(missed), abs=1e-3)
    assert (share < 1e-6) == (frequency == 0)


def test_fingers_that_are_alike_miss_nothing_of_equal_angles_at_any_frequency():
    for frequency in (0.0, tasks.SWINGING, 8.0):
        found = sliders.reach(frequency, 0.0, tasks.FIRST, tasks.FIRST)
        assert float(found["missed"]) < 1e-5


@pytest.mark.parametrize("bandwidth", [tasks.FROM, tasks.TO])
def test_first_command_is_the_largest_of_the_step(bandwidth):
    peak = sliders.gripper_step(bandwidth, 1.0, 0.0)["peak"]
    assert tasks.first_command(bandwidth) == pytest.approx(float(peak), rel=1e-9)


@pytest.mark.parametrize("limit", [*LIMITS.values()][1:])
def test_largest_bandwidth_is_the_last_whose_step_the_motor_follows(limit):
    found = tasks.largest_bandwidth(limit)
    low, high, step = slider("gripper_step", "bandwidth")
    tried = np.arange(low, high + step / 2, step)
    follows = [float(sliders.gripper_step(x, 1.0, 0.0)["peak"]) <= limit for x in tried]
    last = tried[np.flatnonzero(follows)[-1]]
    assert last <= found < last + step


def test_without_sampling_the_first_command_goes_with_the_third_power():
    """By the limit of its transform: s times it, at s without end."""
    row = mean_inverse(PRINTED)(1e7)
    first = [(low_pass(b)(1e7).item() * row @ equal_targets()).real for b in (tasks.FROM, tasks.TO)]
    assert first[1] / first[0] == pytest.approx((tasks.TO / tasks.FROM) ** 3, rel=1e-4)


def ends(push):
    """Run the loop under a push [deg] on SPA 1 for so long that all rests; ends less goals, deg."""
    matrices = controller_matrices(PRINTED, mean_inverse(PRINTED), low_pass(3.0))
    found = run_gripper(
        PRINTED,
        InternalModelController(matrices, equal_targets()),
        duration=20.0,
        push=lambda _: (push * DEG, 0.0),
        points=1,
    )
    return (found.angles[:, -1] - equal_targets()) / DEG


def test_half_of_a_push_that_stays_is_kept():
    assert tasks.kept_of_push(tasks.PUSH) == pytest.approx(tuple(ends(tasks.PUSH)), abs=1e-3)


def test_sliders_end_nearly_there():
    """The page's run ends before all has come to rest."""
    found = sliders.gripper_push(3.0, 1.0, tasks.PUSH)
    kept = [float(found[f"SPA_{k}"][-1] - found[f"goal_{k}"]) for k in (1, 2)]
    assert kept == pytest.approx(tasks.kept_of_push(tasks.PUSH), abs=0.5)


def test_push_that_the_second_finger_meets_an_angle_with():
    push = tasks.push_to_meet(tasks.MEETS)
    low, high, _ = slider("gripper_push", "disturbance")
    assert low < push < high
    assert equal_targets()[1] / DEG + ends(push)[1] == pytest.approx(tasks.MEETS, abs=1e-3)
