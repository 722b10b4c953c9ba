"""Theorem 2: where its conditions hold, and which fails when."""

import numpy as np
import pytest

from softgrip.gripper.gripper_loop import run_gripper
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse, moore_penrose_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.reach import project
from softgrip.gripper.shaping_filter import FAST, SLOW, filter_state_space, low_pass
from softgrip.gripper.theorem_2 import check_theorem_2, final_angles

REACHED = project(PRINTED, [np.pi / 3] * 2).reached


@pytest.mark.parametrize("printed", [FAST, SLOW])
@pytest.mark.parametrize("make", [mean_inverse, moore_penrose_inverse])
def test_it_holds_for_the_printed_filters(printed, make):
    found = check_theorem_2(PRINTED, make(PRINTED), filter_state_space(*printed), REACHED)
    assert found.holds
    assert found.final_error < 1e-5


def test_a_target_outside_the_image_is_not_tracked():
    found = check_theorem_2(PRINTED, mean_inverse(PRINTED), low_pass(3.0), [np.pi / 3] * 2)
    assert (found.rational, found.bounded, found.stable_input) == (True, True, True)
    assert not found.tracks


def test_the_inverse_of_l2_has_no_stable_input():
    inverse = moore_penrose_inverse(PRINTED, adjoint=True)
    found = check_theorem_2(PRINTED, inverse, low_pass(3.0), REACHED)
    assert (found.rational, found.stable_input, found.holds) == (True, False, False)


def test_an_improper_product_fails_the_first_condition():
    found = check_theorem_2(PRINTED, mean_inverse(PRINTED), low_pass(3.0, order=2), REACHED)
    assert not found.rational


@pytest.mark.parametrize("make", [mean_inverse, moore_penrose_inverse])
def test_what_is_reached_outside_the_image_hangs_on_the_inverse(make):
    """The mean inverse does not project; the one of Theorem 2 does, at rest."""
    target = [np.pi / 3] * 2
    found = final_angles(PRINTED, make(PRINTED), low_pass(3.0), target)
    matrices = controller_matrices(PRINTED, make(PRINTED), low_pass(3.0))
    controller = InternalModelController(matrices, target)
    assert found == pytest.approx(run_gripper(PRINTED, controller, duration=12.0).angles[:, -1])
    is_projection = bool(np.allclose(found, REACHED, atol=1e-6))
    assert is_projection == (make is moore_penrose_inverse)
