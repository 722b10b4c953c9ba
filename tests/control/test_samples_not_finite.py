"""A sample that is no finite number is refused, and leaves no trace in what it was given to."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.control.differentiator import PolynomialDifferentiator, RobustDifferentiator
from softgrip.control.pid import PID, Gains
from softgrip.control.pressure_command import PressureAsSpeed, PressureByPlunger
from softgrip.control.rig_controller import Tracking
from softgrip.control.state_feedback import ObserverFeedback, StateFeedback
from softgrip.dynamics.second_order import SecondOrder
from softgrip.errors import InvalidInputError, NotFiniteError
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.shaping_filter import low_pass
from softgrip.tactile.force_control import ForceController

GAINS = Gains(2.0, 4.0, 0.1)
K = [2.0, 0.5, 0.1]
MATRICES = controller_matrices(PRINTED, mean_inverse(PRINTED), low_pass(3.0))


def pid():
    return PID(GAINS, limits=(-10, 10))


LAWS = {
    "pid": pid,
    "derivative on the measurement": lambda: PID(GAINS, derivative_on="measurement"),
    "differentiator": lambda: StateFeedback(K, 4.0, RobustDifferentiator(10.0)),
    "fit": lambda: StateFeedback(K, 4.0, PolynomialDifferentiator(5)),
    "observer": lambda: ObserverFeedback(K, SecondOrder(2.86, 0.7, 1.5e-4), 4.0),
    "pressure as speed": lambda: PressureAsSpeed(pid()),
    "plunger": lambda: PressureByPlunger(pid(), 1e3),
    "force": lambda: ForceController(Gains(2.0, 0.0, 0.1)),
}
OTHERS = {
    "robust": lambda: RobustDifferentiator(10.0),
    "polynomial": lambda: PolynomialDifferentiator(5),
    "internal model": lambda: InternalModelController(MATRICES, [0.9, 1.1]),
    "tracking": lambda: Tracking(pid(), [0.1, 0.2, 0.3, 0.4]),
}
FINGERS = {"internal model": lambda y: [y, 0.5 * y], "tracking": lambda y: [[y], [0.5 * y]]}

finite = st.floats(-10, 10)
bad = st.sampled_from([math.nan, math.inf, -math.inf, None, "0.1 rad"])
samples = st.lists(st.one_of(finite, bad), min_size=1, max_size=12)


def commands(update, given, refused):
    """Return what comes of the good samples; the bad ones must be refused."""
    found = []
    for y in given:
        if isinstance(y, float) and math.isfinite(y):
            found.append(np.asarray(update(y)).tolist())
        elif refused:
            with pytest.raises(NotFiniteError, match="nothing has changed"):
                update(y)
    return found


@pytest.mark.parametrize("name", LAWS)
@given(given=samples)
def test_law_goes_on_as_if_the_sample_had_not_come(name, given):
    with_bad, without = LAWS[name](), LAWS[name]()
    assert commands(lambda y: with_bad.update(1.0, y), given, True) == commands(
        lambda y: without.update(1.0, y), given, False
    )


@pytest.mark.parametrize("name", LAWS)
def test_reference_is_looked_at_before_the_measurement_is_taken_in(name):
    law, other = LAWS[name](), LAWS[name]()
    law.update(1.0, 0.1), other.update(1.0, 0.1)
    with pytest.raises(NotFiniteError, match="reference"):
        law.update(math.nan, 5.0)
    assert law.update(1.0, 0.2).tolist() == other.update(1.0, 0.2).tolist()


@pytest.mark.parametrize("name", OTHERS)
@given(given=st.lists(st.one_of(finite, st.just(math.nan), st.just(math.inf)), max_size=12))
def test_differentiators_and_controllers_of_a_rig_do_too(name, given):
    shaped = FINGERS.get(name, lambda y: y)
    with_bad, without = OTHERS[name](), OTHERS[name]()
    assert commands(lambda y: with_bad.update(shaped(y)), given, True) == commands(
        lambda y: without.update(shaped(y)), given, False
    )


def test_commands_after_a_dropout_are_numbers():
    law = PID(Gains(2, 4), limits=(-10, 10))
    law.update(1.0, 0.0), law.update(1.0, 0.1)
    with pytest.raises(NotFiniteError, match=r"measurement: expected finite numbers .*, got nan"):
        law.update(1.0, math.nan)
    # Three errors of 1, 0.9 and 0.8 are summed: 2 x 0.8 + 4 x 0.025 x 2.7.
    assert law.update(1.0, 0.2) == pytest.approx(1.87)


def test_one_bad_run_of_a_batch_is_refused_for_all():
    batch = PID(GAINS)
    batch.update(1.0, [0.0, 0.1])
    with pytest.raises(NotFiniteError, match=r"got \[0\.1, nan\]"):
        batch.update(1.0, [0.1, math.nan])


def test_error_is_one_of_ours_and_a_value_error():
    assert issubclass(NotFiniteError, InvalidInputError)
    assert issubclass(NotFiniteError, ValueError)
