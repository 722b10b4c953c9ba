"""Left inverses and Eq. (6.20), against the plant itself, numpy's pseudo-inverse, the print."""

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.gripper.inversion import filtered_inverse, mean_inverse, moore_penrose_inverse
from softgrip.gripper.plant import PRINTED, FingerDynamics, Gripper, state_space
from softgrip.gripper.shaping_filter import FAST, SLOW, filter_state_space, low_pass

FINGERS = st.builds(FingerDynamics, st.floats(1, 4), st.floats(1, 8), st.floats(1, 10))
GRIPPERS = st.lists(FINGERS, min_size=2, max_size=4).map(lambda f: Gripper(tuple(f)))


def inverses(gripper):
    return (
        mean_inverse(gripper),
        moore_penrose_inverse(gripper),
        moore_penrose_inverse(gripper, adjoint=True),
    )


@settings(max_examples=25)
@given(GRIPPERS, st.floats(0.1, 10), st.floats(-0.5, 3))
def test_each_is_a_left_inverse(gripper, frequency, decay):
    """Eq. (6.19) solved for U: of the column times U each gives U back."""
    s = decay + 1j * frequency
    column = np.ravel(state_space(gripper)(s))
    for inverse in inverses(gripper):
        assert inverse(s) @ column == pytest.approx(1, abs=1e-6)


def test_the_printed_one_is_the_mean_and_not_the_one_of_theorem_2():
    mean, theorem, _ = inverses(PRINTED)
    s = 2j
    printed = [(s**3 + a * s**2 + b * s) / 15.66 for a, b in ((2.66, 3.61), (2.45, 3.06))]
    # 2 * 7.831 = 15.662: the print has four digits.
    assert mean(s) == pytest.approx(np.array(printed), rel=2e-4)
    column = np.ravel(state_space(PRINTED)(s))
    assert theorem(s) == pytest.approx(column / (column @ column))
    assert np.abs(theorem(s) / mean(s) - 1).max() > 0.1


@pytest.mark.parametrize("frequency", [0.01, 1.0, 1.8, 20.0])
def test_the_adjoint_one_is_the_pseudo_inverse_on_the_imaginary_axis(frequency):
    s = 1j * frequency
    found = moore_penrose_inverse(PRINTED, adjoint=True)(s)
    assert found == pytest.approx(np.linalg.pinv(state_space(PRINTED)(s))[0], rel=1e-8)


def test_only_the_adjoint_one_is_unstable():
    mean, theorem, adjoint = inverses(PRINTED)
    assert (mean.stable, theorem.stable, adjoint.stable) == (True, True, False)
    assert mean.poles.size == 0
    # P^T P = 0 for two fingers of one gain: q_2 = +-j q_1, whose roots are known in closed form.
    for sign in (1j, -1j):
        expected = np.roots([1 - sign, 2.45 - sign * 2.66, 3.06 - sign * 3.61])
        for root in expected:
            assert np.abs(theorem.poles - root).min() < 1e-9
    mirrored = adjoint.poles
    assert np.sort(mirrored.real) == pytest.approx(np.sort(-mirrored.real))


def test_identical_fingers_have_one_inverse():
    alike = Gripper((PRINTED.fingers[0],) * 3)
    rows = [inverse(1.5j) for inverse in inverses(alike)]
    assert rows[0] == pytest.approx(rows[1])
    assert rows[0] == pytest.approx(rows[2])


@settings(max_examples=25)
@given(GRIPPERS, st.floats(0.1, 30), st.sampled_from([FAST, SLOW]))
def test_filtered_inverse_is_the_product(gripper, frequency, printed):
    """Eq. (6.20)."""
    low, s = filter_state_space(*printed), 0.3 + 1j * frequency
    for inverse in inverses(gripper):
        whole = filtered_inverse(inverse, low)
        assert np.ravel(whole(s)) == pytest.approx(inverse(s) * low(s).item(), rel=1e-6)


def test_filtered_mean_inverse_keeps_the_order_and_jumps_by_the_leading_coefficients():
    whole = filtered_inverse(mean_inverse(PRINTED), filter_state_space(*FAST))
    assert whole.nstates == 6
    direct = whole.D[0]
    assert direct == pytest.approx(1009 / (2 * 7.831), rel=1e-9)
    assert np.abs(whole(0)) == pytest.approx(0, abs=1e-8)


@pytest.mark.parametrize(
    "slow", [low_pass(4.0, order=2), control.ss(-1, 1, 1, 0), control.ss([], [], [], 1)]
)
def test_filters_that_fall_off_too_slowly_are_refused(slow):
    with pytest.raises(InvalidInputError, match="relative degree"):
        filtered_inverse(mean_inverse(PRINTED), slow)
