"""The best feedforward: against another solver, its dual, single-finger bounds, and by hand."""

from itertools import islice

import casadi
import numpy as np
import pytest
from scipy.linalg import expm

from softgrip.control.minimum_time import minimum_settling_time
from softgrip.errors import InvalidInputError
from softgrip.gripper.gripper_batch import GripperBatch, Trial, can_rest, draw_grippers
from softgrip.gripper.monte_carlo import simulate
from softgrip.gripper.optimal_feedforward import FeedforwardProgram
from softgrip.gripper.plant import PRINTED, FingerDynamics, Gripper, finger_state_space, state_space
from softgrip.gripper.reach import project

TARGET = tuple(project(PRINTED, [np.pi / 4] * 2).reached.tolist())


@pytest.fixture(scope="module")
def best():
    return FeedforwardProgram(PRINTED, TARGET, limit=5.0).settled_by(1.5)


def test_the_command_does_what_is_said_of_it(best):
    """By the simulation of `monte_carlo`, at ten times as many points."""
    # The band and what a finger may leave it by between two points of the program.
    trial = Trial(TARGET, limit=5.0, feedforward=tuple(best.command.tolist()), bands=(0.0202,))
    found = simulate(GripperBatch.of(PRINTED), None, trial, keep="trajectories")
    np.testing.assert_allclose(found.angles[0, :, 10::10], best.angles, atol=1e-12)
    assert found.peak_command[0] <= 5 + 1e-9
    assert found.settling[0].max() <= 1.5 + 1e-6
    # Between the points that the program looks at, the fingers are no farther apart than this.
    assert found.synchronization[0] == pytest.approx(best.worst_sync, rel=1e-3)
    assert found.synchronization[0] >= best.worst_sync * (1 - 1e-9)


def test_interior_points_of_ipopt_find_the_same_optimum(best):
    """The program written anew for CasADi: with states and SciPy's exponential, no pulses."""
    period, points, count = 0.1, 10, 30
    system = state_space(PRINTED)
    joined = np.zeros((6, 6))
    joined[:5, :5], joined[:5, 5:] = system.A, system.B
    step = expm(joined * period / points)
    opti = casadi.Opti()
    u, s, x = opti.variable(count), opti.variable(), opti.variable(5, count * points + 1)
    opti.minimize(s)
    opti.subject_to(x[:, 0] == 0)
    opti.subject_to(opti.bounded(-5, u, 5))
    C = system.C / np.array(TARGET)[:, None]
    for k in range(count * points):
        drive = u[k // points]
        opti.subject_to(x[:, k + 1] == step[:5, :5] @ x[:, k] + step[:5, 5] * drive)
        progress = C @ x[:, k + 1]
        opti.subject_to(opti.bounded(-s, progress[0] - progress[1], s))
        if k + 1 >= 150:
            opti.subject_to(opti.bounded(0.98, progress, 1.02))
    rest = PRINTED.velocity_gains[0] / TARGET[0] * x[0, -1]
    opti.subject_to(opti.bounded(0.98, rest, 1.02))
    opti.solver("ipopt", {"print_time": False}, {"print_level": 0, "sb": "yes", "tol": 1e-9})
    found = float(opti.solve().value(s))
    assert found == pytest.approx(best.worst_sync, abs=1e-6)


def test_the_dual_program_proves_the_optimum(best):
    assert abs(best.gap) < 1e-9
    assert best.worst_sync > 0.01


def test_a_wider_limit_and_a_later_time_are_never_worse():
    curves = {
        limit: [
            b.worst_sync
            for b in islice(FeedforwardProgram(PRINTED, TARGET, limit=limit).trade_off(), 4)
        ]
        for limit in (5.0, 20.0)
    }
    for curve in curves.values():
        assert (np.diff(curve) < 1e-9).all()
    same = [
        FeedforwardProgram(PRINTED, TARGET, limit=x).settled_by(1.5).worst_sync for x in (5, 20)
    ]
    assert same[1] <= same[0] + 1e-9


@pytest.mark.parametrize("limit", [1.0, 5.0])
def test_two_fingers_settle_no_earlier_than_either_alone(limit):
    first = next(FeedforwardProgram(PRINTED, TARGET, limit=limit).trade_off())
    alone = [
        minimum_settling_time(
            finger_state_space(finger), angle, limit, band=0.02 * angle, hold=1.0, period=0.1
        )
        for finger, angle in zip(PRINTED.fingers, TARGET, strict=True)
    ]
    assert first.settling >= max(alone) - 1e-9
    with pytest.raises(InvalidInputError, match="within reach"):
        FeedforwardProgram(PRINTED, TARGET, limit).settled_by(round(first.settling - 0.1, 9))


def test_equal_fingers_are_never_apart():
    alike = Gripper((PRINTED.mean,) * 3)
    program = FeedforwardProgram(alike, (0.7,) * 3, limit=5.0, points=2)
    assert program.settled_by(1.5).worst_sync == pytest.approx(0, abs=1e-9)
    alone = minimum_settling_time(
        finger_state_space(PRINTED.mean), 0.7, 5.0, band=0.014, hold=1.5, period=0.1
    )
    # And then they are as fast as one, but for one point between two samples.
    assert next(program.trade_off()).settling == pytest.approx(alone, abs=0.11)


def test_fingers_that_differ_by_a_gain_alone_are_never_apart():
    """Their shares of the target are then one and the same, whatever the command."""
    scaled = Gripper((FingerDynamics(2.6, 3.3, 7.0), FingerDynamics(2.6, 3.3, 9.0)))
    target = tuple((0.3 * scaled.velocity_gains).tolist())
    assert FeedforwardProgram(scaled, target, limit=5.0).settled_by(
        1.5
    ).worst_sync == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(
    "bad",
    [
        {"target": (0.7, 0.7)},
        {"target": (0.7,)},
        {"settling": 3.0},
        {"settling": 1.55},
        {"limit": 0.0},
        {"band": -0.1},
        {"limit": 0.01},
    ],
)
def test_impossible_requests_are_refused(bad):
    given = {"target": TARGET, "settling": 1.5, "limit": 5.0, **bad}
    time = given.pop("settling")
    with pytest.raises(InvalidInputError):
        FeedforwardProgram(PRINTED, **given).settled_by(time)


def test_share_of_pairs_that_can_rest_is_that_of_the_triangle():
    """By hand: the difference of two uniform deviations of K_n has a triangle's density."""
    drawn = draw_grippers(PRINTED, 20_000, seed=3)
    for band in (0.02, 0.05):
        # (1 + d1) / (1 + d2) within (1 + b) / (1 - b); to first order |d1 - d2| <= 2 b.
        share = 1 - (1 - min(2 * band / 0.118, 1)) ** 2
        assert can_rest(drawn, TARGET, band).mean() == pytest.approx(share, abs=0.015)


def test_none_settles_that_cannot_rest(best):
    drawn = draw_grippers(PRINTED, 500, seed=3)
    trial = Trial(TARGET, 10.0, limit=5.0, feedforward=(*best.command.tolist(), *[0.0] * 70))
    settled = np.isfinite(simulate(drawn, None, trial).settling).all(axis=2)
    for band, found in zip(trial.bands, settled, strict=True):
        assert found.any()
        assert not (found & ~can_rest(drawn, TARGET, band)).any()
