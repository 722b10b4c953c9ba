"""The plant of Chapter 6: its realizations, their structure, and the printed numbers."""

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from softgrip.errors import InvalidInputError
from softgrip.gripper.plant import (
    PRINTED,
    FingerDynamics,
    Gripper,
    finger_state_space,
    stacked_state_space,
    state_space,
    structure,
)

FINGERS = st.builds(FingerDynamics, st.floats(0.5, 6), st.floats(0.5, 20), st.floats(0.5, 20))


@settings(max_examples=30)
@given(st.lists(FINGERS, min_size=2, max_size=5), st.floats(0.1, 30))
def test_both_realizations_have_the_elements_of_eq_6_16(fingers, frequency):
    gripper, s = Gripper(tuple(fingers)), 1j * frequency
    printed = [f.gain / (s**3 + f.damping * s**2 + f.stiffness * s) for f in fingers]
    for realization in (state_space, stacked_state_space):
        found = realization(gripper)(s)
        assert np.ravel(found) == pytest.approx(np.array(printed), rel=1e-8)


@settings(max_examples=30, deadline=None)
@given(st.lists(FINGERS, min_size=2, max_size=4), st.floats(0.1, 10), st.floats(-0.3, 3))
def test_transfer_function_is_that_of_the_matrices(fingers, frequency, decay):
    """Eq. (6.5): ``C (s I - A)^-1 B`` by elimination is the column of the elements."""
    system, s = state_space(Gripper(tuple(fingers))), decay + 1j * frequency
    solved = np.linalg.solve(s * np.eye(system.nstates) - system.A, system.B)
    printed = [f.gain / (s**3 + f.damping * s**2 + f.stiffness * s) for f in fingers]
    assert (system.C @ solved)[:, 0] == pytest.approx(np.array(printed), rel=1e-8)


def test_from_rest_the_matrices_move_each_finger_as_its_own_pump_would():
    """Eq. (6.4) under a sine, integrated, against three states a finger; Eq. (6.6), one input."""
    system, time = state_space(PRINTED), np.linspace(0, 4, 81)
    solved = solve_ivp(
        lambda t, x: system.A @ x + system.B[:, 0] * np.sin(2 * t),
        *((0, 4), np.zeros(5)),
        t_eval=time,
        rtol=1e-9,
        atol=1e-11,
    )
    for row, finger in zip(system.C @ solved.y, PRINTED.fingers, strict=True):

        def motion(t, y, f=finger):
            return [y[1], y[2], f.gain * np.sin(2 * t) - f.stiffness * y[1] - f.damping * y[2]]

        own = solve_ivp(motion, (0, 4), np.zeros(3), t_eval=time, rtol=1e-9, atol=1e-11)
        assert row == pytest.approx(own.y[0], abs=1e-7)


def test_two_states_a_finger_swing_on_their_own():
    """Eq. (6.10): without the pump's state, the matrix is one block a finger with its two poles."""
    A = state_space(PRINTED).A[1:, 1:]
    for k, (damping, stiffness) in enumerate(((2.66, 3.61), (2.45, 3.06))):
        block = slice(2 * k, 2 * k + 2)
        poles = np.linalg.eigvals(A[block, block])
        assert np.sort(poles) == pytest.approx(np.sort(np.roots([1, damping, stiffness])))
        A[block, block] = 0
    assert not A.any()


def test_unequal_fingers_are_minimal_with_the_pump_once():
    found = structure(state_space(PRINTED))
    assert (found.order, found.controllable, found.observable) == (5, 5, 5)
    assert found.minimal
    assert found.zeros.size == 0
    assert np.sort(found.poles.real)[:4] == pytest.approx([-1.33, -1.33, -1.225, -1.225])


def test_the_stacked_realization_of_eq_6_11_is_not_controllable():
    """It has the pump's integrator once a finger: the difference of the two is never driven."""
    found = structure(stacked_state_space(PRINTED))
    assert (found.order, found.controllable, found.minimal) == (6, 5, False)
    # By hand: the difference of the two integrators' states is a left eigenvector that B misses.
    system = stacked_state_space(PRINTED)
    left = np.array([3.61, 2.66, 1, -3.06, -2.45, -1])
    assert left @ system.A == pytest.approx(0, abs=1e-12)
    assert left @ system.B == pytest.approx(0, abs=1e-12)


def test_identical_fingers_are_not_controllable():
    alike = Gripper((PRINTED.fingers[0],) * 2)
    found = structure(state_space(alike))
    assert found.controllable == 3
    assert found.observable == 5


def test_the_printed_mean_is_near_the_factor_in_the_printed_filters():
    """(2.555, 3.335); both H(s) hold s^2 + 2.54 s + 3.28."""
    mean = PRINTED.mean
    assert (mean.damping, mean.stiffness) == pytest.approx((2.555, 3.335))


def test_physics_gives_the_element():
    found = FingerDynamics.from_physics(
        mass=0.5, damping=1.0, stiffness=2.0, torque_per_pressure=1e-5, pump_gain=3e3
    )
    assert (found.damping, found.stiffness, found.gain) == pytest.approx((2.0, 4.0, 0.06))
    # At rest the angle moves at gain / stiffness: c G / K by hand.
    assert found.velocity_gain == pytest.approx(1e-5 * 3e3 / 2.0)


def test_finger_behind_its_pump_moves_as_the_two_equations_say():
    """Eq. (6.9) driven by the pressure of Eq. (6.14) at 2 rad/s, integrated; Eq. (6.15) agrees."""
    mass, damping, stiffness, torque, pump = 0.5, 1.0, 2.0, 1e-5, 3e3
    time = np.linspace(0, 5, 51)

    def motion(_t, state):
        pressure, angle, rate = state
        return [2 * pump, rate, (torque * pressure - damping * rate - stiffness * angle) / mass]

    solved = solve_ivp(motion, (0, 5), np.zeros(3), t_eval=time, rtol=1e-10, atol=1e-12)
    finger = FingerDynamics.from_physics(
        mass=mass, damping=damping, stiffness=stiffness, torque_per_pressure=torque, pump_gain=pump
    )
    found = control.forced_response(finger_state_space(finger), time, np.full(51, 2.0)).outputs
    assert found == pytest.approx(solved.y[1], abs=1e-8)


def test_step_of_the_input_ends_in_the_velocity_gain():
    time = np.linspace(0, 20, 401)
    _, angle = control.step_response(finger_state_space(PRINTED.fingers[0]), time, squeeze=True)
    assert np.diff(angle)[-1] / np.diff(time)[-1] == pytest.approx(7.831 / 3.61, rel=1e-6)


@pytest.mark.parametrize("numbers", [(0, 1, 1), (1, -1, 1), (1, 1, float("nan"))])
def test_impossible_fingers_are_refused(numbers):
    with pytest.raises(InvalidInputError):
        FingerDynamics(*numbers)


def test_one_finger_is_no_gripper():
    with pytest.raises(InvalidInputError, match="two or more"):
        Gripper((PRINTED.fingers[0],))
