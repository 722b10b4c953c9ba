"""Break an equation, and what hangs on it in the ledger turns: the ledger tests the package.

Each case rewrites one expression in the source of one function, and puts the code of the broken
function in the place of the sound one. Some are chosen by what an equation says, some by chance.
"""

import inspect
import textwrap
from collections.abc import Callable

import pytest

from book.companion.claims import read_claims
from book.companion.ledger import changes, expected
from book.companion.verdict import judge
from softgrip.actuator import bending, frequency
from softgrip.actuator import section as cross_section
from softgrip.control import lqr
from softgrip.dynamics import consistency, linear, ludwick
from softgrip.gripper import fixed_order_shaping, inversion, plant, reach
from softgrip.materials import fitting, least_squares, powerlaw
from softgrip.materials import ludwick as tension
from softgrip.pump import flow, gas
from softgrip.tactile import element, hertz
from softgrip.tactile import friction as lifting
from tests.book.mutants import forget, mutant

CASES: list[tuple[str, Callable, str, str, str]] = [
    # Chapter 2.
    ("Eq. (2.1): a taper that does not divide",
     element.compliance, "block / k", "block * k", "table-2.1-pyramid-analytics-0-1-n"),
    ("Eq. (2.2): the whole of the force in place of three quarters",
     hertz.hertz_approach, "0.75 *", "1.0 *", "table-2.1-hemisphere-hertzian-0-1-n"),
    ("Eq. (2.8): one finger only",
     lifting.contact_force, "(2 * friction)", "friction", "2.4-desired-force-egg"),
    # Chapter 3.
    ("Eq. (3.3): the bottom does not pull",
     cross_section.wall_area, "w * (b + t)", "w * t", "3.4-half-newton-metre"),
    ("Eq. (3.4): the wall pushes",
     cross_section.torque, "(b - t)", "(b + t)", "3.4-half-newton-metre"),
    ("Eq. (3.8): as Eq. (5.14) has it",
     bending.modified_moment, "0.5 ** (1 + n)", "0.5**n", "table-3.3-estimated-design-1-e1-"),
    ("Eq. (3.10): no elongation",
     bending.elongation, "1 + pressure", "1 + 0 * pressure", "3.4-sum-opt--parameters"),
    ("Eq. (3.14): a constant moment in place of the force at the tip",
     frequency.spring_constant, "((n + 1) / n) ** n * ", "", "table-3.3-estimated-design-1-e1-"),
    ("Eq. (3.23): the frequency not squared",
     frequency.stiffness_product_for, "frequency**2", "frequency", "table-3.2-top-1"),
    ("Eq. (3.30): a reference that enters by another gain",
     lqr.closed_loop, "gain[0, 0]", "gain[0, 1]", "3.5-lqr-error"),
    # Chapter 4.
    ("Eq. (4.1): the lead in the denominator",
     flow.slider_speed, "lead / (2 * pi)", "1 / (2 * pi * lead)", "4.2-optimal-lead"),
    ("Eq. (4.2): the area left out",
     flow.flow, "* pump.area", "* 1", "4.2-optimal-area"),
    ("capacity of the gas law: growing where it falls",
     gas.capacity_growth, "compliance_slope - 2", "compliance_slope + 2", "4.3-growth-above-zero"),
    # Chapter 5.
    ("Eq. (5.2): a straight line in place of the power",
     tension.fit_power, "x**p", "(p * x)", "table-5.1-n-mold-star-16-fast"),
    ("true stress: on the first area, not the present one",
     fitting.curve, "stress * (1 + strain)", "stress * 1", "table-5.1-n-dragon-skin-10-medium"),
    ("Eq. (5.4): damped normal equations",
     least_squares.normal_equations,
     "np.linalg.solve(A.T @ A", "np.linalg.solve(A.T @ A + np.eye(p)",
     "table-5.2-estimated-dragon-skin-20"),
    ("Eq. (5.7): properties without their powers",
     powerlaw._powers, "** exponents", "** 1", "table-5.2-estimated-dragon-skin-fx-pro"),
    ("Eq. (5.8): the factors in the wrong order",
     powerlaw.FractionalPowerRegressor.predict,
     "self.coef_ + ", "self.coef_[::-1] + ", "table-5.2-estimated-dragon-skin-20"),
    ("Eq. (5.10): another factor",
     linear.spring_constant, "2 * young_modulus", "4 * young_modulus", "5.3-degrades-spring"),
    ("Eq. (5.11): another factor",
     linear.moment_of_inertia, "/ 12", "/ 6", "5.3-degrades-moment"),
    ("Eq. (5.13): the power left out",
     ludwick.spring_constant, "((n + 1) / n) ** n", "1", "5.3-degrades-force"),
    ("Eq. (5.14): the exponent of Eq. (3.8)",
     ludwick.modified_moment, "0.5**n", "0.5 ** (1 + n)", "5.3-against-moment-3"),
    ("a cantilever whose moment does not fall along it",
     consistency.tip_loaded_angle, "(length - s)", "length", "5.3-factor-of-a-tip-force"),
    # Chapter 6.
    ("Eq. (6.25): a direction without the fingers' stiffness",
     reach.direction, "+ stiffness)", "+ 1)", "6.4-proj-60-spa1"),
    ("P-dagger: a sum of the elements' inverses in place of their mean",
     inversion.mean_inverse, "(count * f.gain)", "f.gain", "6.4-inverse-denominator"),
    ("Eq. (6.15): a spring that pushes away",
     plant.state_space, "-finger.stiffness", "finger.stiffness", "6.4-simulated-noise-error"),
    ("mixed sensitivity: a weight of the sensitivity without its half",
     fixed_order_shaping.weights, "asymptote * s + 1", "s + 1", "6.4-target-loop-2-s"),
    ("Eq. (2.9): one finger only",
     lifting.lift_force, "2 * friction", "friction", "2.4-chosen-lift-above-weight-tofu"),
]  # fmt: skip

DRAWN = [
    ("softgrip.dynamics.second_order.step_response: z * w * s -> z * w / s",
     "3.4-step-below-least"),
    ("softgrip.tactile.hertz.hertz_approach: "
     "0.75 * (1 - poisson_ratio ** 2) -> 0.75 / (1 - poisson_ratio ** 2)",
     "table-2.1-hemisphere-hertzian-0-3-n"),
    ("softgrip.gripper.reach.direction: "
     "column / np.linalg.norm(column, axis=-1, keepdims=True) -> "
     "column * np.linalg.norm(column, axis=-1, keepdims=True)",
     "6.5-opposite-targets"),
    ("book.chapter_3.numbers.section_torque: "
     "pressure * MPa * chamber_area(found) -> pressure * MPa / chamber_area(found)",
     "3.4-half-newton-metre"),
    ("book.chapter_3.numbers.scale_load: torque / (length * MM) / G -> torque / (length * MM) * G",
     "3.4-load-of-the-scale"),
    ("softgrip.logs.staircase.lag: longest / period -> longest * period",
     "4.4-time-to-change"),
    ("softgrip.gripper.gripper_loop.run_gripper: "
     "A @ state + B @ np.concatenate([[commands[-1]], outer]) -> "
     "A @ state - B @ np.concatenate([[commands[-1]], outer])",
     "6.4-simulated-disturbance-error"),
    ("softgrip.materials.yeoh.stress: "
     "stretch ** 2 + 2 / stretch - 3 -> stretch ** 2 + 2 / stretch + 3",
     "2.2-young-modulus"),
    ("softgrip.pump.flow.slider_speed: "
     "lead / (2 * pi) * motor_speed -> lead / (2 * pi) / motor_speed",
     "4.2-optimal-motor-speed"),
    ("softgrip.gripper.inversion.mean_inverse: "
     "np.array([1.0, f.damping, f.stiffness, 0.0]) / (count * f.gain) -> "
     "np.array([1.0, f.damping, f.stiffness, 0.0]) * (count * f.gain)",
     "6.4-inverse-denominator"),
]  # fmt: skip
"""Nobody chose these: the first ten of ``python -m tests.book.mutants --count 120 --seed 2`` (2475
mutants in all) that a claim of less than 0.3 s, which needs no public tensile test, notices by a
value, not by an error, and whose text stands once in its function; with the quickest such claim."""


def broken(function: Callable, sound: str, wrong: str):
    """Return the code of a function with one expression rewritten."""
    # What is imported for types alone is not there to be evaluated.
    source = "from __future__ import annotations\n" + textwrap.dedent(inspect.getsource(function))
    assert source.count(sound) >= 1, f"{sound!r} is not in {function.__qualname__}"
    namespace: dict = {}
    exec(source.replace(sound, wrong), function.__globals__ | {"__name__": "broken"}, namespace)
    return inspect.unwrap(namespace[function.__name__]).__code__


@pytest.fixture
def put(monkeypatch):
    """Put a code in the place of a function's, with nothing remembered before and after."""

    def put(function, code):
        monkeypatch.setattr(inspect.unwrap(function), "__code__", code)
        forget()

    yield put
    monkeypatch.undo()
    forget()


def judged(claim):
    """Return what is not as it was accepted of a claim."""
    (claimed,) = [c for c in read_claims() if c.id == claim]
    return changes(judge(claimed), expected()[claim])


@pytest.mark.parametrize("case", CASES, ids=lambda case: case[0])
def test_broken_equation_turns_what_hangs_on_it(case, put, request):
    what, function, sound, wrong, claim = case
    if "table-5.1-n" in claim:
        request.getfixturevalue("tensile_tests")
    assert judged(claim) == {}
    put(function, broken(function, sound, wrong))
    assert judged(claim), what


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # such as a division by zero
@pytest.mark.parametrize(("change", "claim"), DRAWN, ids=lambda text: text.partition(":")[0])
def test_change_that_chance_drew_is_noticed(change, claim, put):
    one = mutant(change)
    assert judged(claim) == {}
    put(one.function, one.code())
    assert judged(claim), change
