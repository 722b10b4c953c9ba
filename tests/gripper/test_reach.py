"""Eq. (6.24) and (6.25) against numpy's least squares and the printed numbers."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError, SoftgripError
from softgrip.gripper import reach
from softgrip.gripper.plant import PRINTED, FingerDynamics, Gripper, state_space
from softgrip.gripper.printed_loop import equal_targets, run_printed
from softgrip.gripper.reach import outside_share, project, reachable

FINGERS = st.builds(FingerDynamics, st.floats(1, 4), st.floats(1, 8), st.floats(1, 10))
GRIPPERS = st.lists(FINGERS, min_size=2, max_size=5).map(lambda f: Gripper(tuple(f)))


@settings(max_examples=30)
@given(GRIPPERS, st.floats(0.1, 20), st.randoms(use_true_random=False))
def test_projection_is_least_squares(gripper, frequency, random):
    """Eq. (6.24) and (6.25); and at any frequency the distance from the image, Eq. (6.2)."""
    target = np.array([random.uniform(0.1, 1) for _ in gripper.fingers])
    found = project(gripper, target)
    column = gripper.velocity_gains[:, None]
    expected = column @ np.linalg.lstsq(column, target, rcond=None)[0]
    assert found.reached == pytest.approx(expected)
    assert found.reached + found.residual == pytest.approx(target)
    assert found.reached @ found.residual == pytest.approx(0, abs=1e-12)
    column = state_space(gripper)(1j * frequency)
    best = np.linalg.lstsq(column, target.astype(complex), rcond=None)[0]
    left = np.linalg.norm(target - column @ best) / np.linalg.norm(target)
    assert outside_share(gripper, target, frequency) == pytest.approx(left, abs=1e-6)


@settings(max_examples=30, deadline=None)
@given(GRIPPERS, st.floats(0.1, 20))
def test_direction_is_the_column_without_the_pump(gripper, frequency):
    """Eq. (6.1) by the realization with the pump, times s: the fingers alone, Eq. (6.12)."""
    s = 1j * frequency
    column = s * np.ravel(state_space(gripper)(s))
    assert reach.direction(gripper, frequency) == pytest.approx(column / np.linalg.norm(column))


@pytest.mark.parametrize("frequency", [0.5, 2.0, 10.0])
@pytest.mark.parametrize(("poles", "solvable"), [((2.0, 3.0), True), ((2.2, 3.0), False)])
def test_a_target_is_reached_where_it_adds_nothing_to_the_rank(frequency, poles, solvable):
    """Eq. (6.3) by singular values, for fingers of one pole pair and for others."""
    gripper = Gripper((FingerDynamics(2.0, 3.0, 5.0), FingerDynamics(*poles, 8.0)))
    target = np.array([5.0, 8.0])
    column = state_space(gripper)(1j * frequency)
    both = np.column_stack([column / np.linalg.norm(column), target / np.linalg.norm(target)])
    assert (np.linalg.matrix_rank(both, tol=1e-6) == 1) == solvable
    assert (outside_share(gripper, target, frequency) < 1e-6) == solvable


@settings(max_examples=30, deadline=None)
@given(GRIPPERS, st.floats(0.1, 2.0))
def test_what_is_reachable_keeps_the_rank_at_one(gripper, angle):
    """Eq. (6.7) at rest, by singular values; equal angles of unequal fingers do not keep it."""
    wanted = np.full(len(gripper.fingers), angle)
    column = gripper.velocity_gains / np.linalg.norm(gripper.velocity_gains)
    reached = reachable(gripper, wanted, tolerance=1.0)
    assert np.linalg.matrix_rank(np.column_stack([column, reached]), tol=1e-9) == 1
    alike = np.ptp(column) < 1e-6
    assert alike or np.linalg.matrix_rank(np.column_stack([column, wanted]), tol=1e-9) == 2


@pytest.mark.parametrize(
    ("angle", "printed"), [(np.pi / 3, (0.303, 0.357)), (np.pi / 4, (0.227, 0.268))]
)
def test_printed_loops_end_at_the_printed_left_sides(angle, printed):
    """Eq. (6.26) (with the text's 0.357 for its 0.35) and Eq. (6.27), by a run of the loop."""
    run = run_printed(angle=angle, duration=12.0)
    assert run.angles[:, -1] == pytest.approx(equal_targets(angle), rel=1e-3)
    assert equal_targets(angle) / np.pi == pytest.approx(np.array(printed), abs=1.6e-3)


@pytest.mark.parametrize(
    ("share", "printed", "residual"),
    [(0.333, (0.303, 0.357), (0.030, -0.024)), (0.25, (0.227, 0.268), (0.023, -0.018))],
)
def test_printed_projections_within_two_units_of_their_last_digit(share, printed, residual):
    found = project(PRINTED, np.full(2, share * np.pi))
    assert found.reached / np.pi == pytest.approx(np.array(printed), abs=1.1e-3)
    assert found.residual / np.pi == pytest.approx(np.array(residual), abs=1.1e-3)
    # They come out to the digit if q is cut, not rounded, to three digits.
    q = np.floor(1000 * reach.direction(PRINTED).real) / 1000
    assert np.round(share * q.sum() * q, 3) == pytest.approx(np.array(printed))


def test_printed_degrees_are_the_printed_fractions_with_the_fingers_swapped():
    """48.24 deg is printed for the left finger, which is SPA 1: its row has 0.227 pi."""
    assert np.array([0.268, 0.227]) * 180 == pytest.approx([48.24, 40.86])
    assert project(PRINTED, [np.pi / 4] * 2).reached.argmax() == 1


def test_a_step_along_the_direction_at_rest_is_outside_the_image_on_its_way():
    at_rest = reach.direction(PRINTED).real
    assert outside_share(PRINTED, at_rest, 0.0) == pytest.approx(0, abs=1e-12)
    # Equal gains: far above the poles both fingers do the same.
    assert outside_share(PRINTED, [1, 1], 1e5) == pytest.approx(0, abs=1e-4)
    ends = outside_share(PRINTED, at_rest, 1e5), outside_share(PRINTED, [1, 1], 0)
    assert ends[0] == pytest.approx(ends[1], abs=1e-4)


def test_fingers_of_one_pole_pair_can_reach_their_direction_at_all_frequencies():
    alike = Gripper((FingerDynamics(2.0, 3.0, 5.0), FingerDynamics(2.0, 3.0, 8.0)))
    share = outside_share(alike, [5.0, 8.0], np.geomspace(0.01, 100, 9))
    assert share == pytest.approx(0, abs=1e-7)


def test_opposite_targets_are_refused_with_how_far_and_the_nearest():
    with pytest.raises(reach.UnreachableTargetError, match="outside") as refused:
        reachable(PRINTED, [-np.pi / 4, np.pi / 4])
    assert isinstance(refused.value, SoftgripError | ValueError)
    assert refused.value.share == pytest.approx(project(PRINTED, [-1, 1]).share)
    assert refused.value.nearest == pytest.approx(project(PRINTED, [-np.pi / 4, np.pi / 4]).reached)


def test_negative_angles_are_unreachable_though_on_the_line():
    with pytest.raises(reach.UnreachableTargetError) as refused:
        reachable(PRINTED, -reach.direction(PRINTED).real)
    assert refused.value.nearest == pytest.approx([0, 0])


def test_tolerance_decides():
    assert reachable(PRINTED, [1, 1]) == pytest.approx(project(PRINTED, [1, 1]).reached)
    with pytest.raises(reach.UnreachableTargetError, match=r"0\.0822 outside"):
        reachable(PRINTED, [1, 1], tolerance=0.05)


@pytest.mark.parametrize("target", [[1.0], [1.0, np.nan], [0.0, 0.0]])
def test_impossible_targets_are_refused(target):
    with pytest.raises(InvalidInputError, match="target"):
        project(PRINTED, target)
