"""A linear model matched to Ludwick's spring, and what page and claims say of it."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from book.chapter_5.matched_model import (
    Setting,
    largest_share_at_rest,
    linear_errors,
    resting_angle,
    settings,
)
from book.chapter_5.step_models import ANGLES, FINGERS
from book.chapter_5.step_protocols import kept_errors
from book.companion.claims import claim_of, printed
from book.companion.prose import word

SHARED = settings(ANGLES, (0.6, 0.7, 0.8))


def note(design, angle):
    return claim_of(5, f"5.4-rms-{design.lower().replace(' ', '-')}--{angle}-deg--linear").note


def test_linear_model_rests_where_the_force_of_the_power_law_holds_it():
    stiffness, power = 0.7, 1.9
    force = stiffness * 90**power
    slope = stiffness * 60**power / 60
    rests = brentq(lambda angle: slope * angle - force, 0, 1000)
    assert resting_angle(60, 90, power) == pytest.approx(rests)


def test_share_at_rest_is_that_of_a_record_which_is_right_elsewhere():
    off = np.where(np.arange(1000) < 130, resting_angle(60, 90, 1.5) - 90, 0)
    error = np.sqrt(np.mean(off**2))
    assert largest_share_at_rest(error, 60, 90, 1.5) == pytest.approx(0.13)


@pytest.mark.parametrize("tangent", [False, True])
@pytest.mark.parametrize("power", [1.538, 2.365])
def test_errors_are_those_of_both_equations_in_degrees(tangent, power):
    """By an adaptive method, with angles and time as they are; omega = 1.7 rad/s."""
    shared, omega = Setting(90, 40, tangent, 0.7, 6.0), 1.7
    time = np.linspace(0, shared.span / omega, 801)

    def angles(stiffness, n):
        def law(_, state):
            angle, rate = state
            spring, holds = stiffness * abs(angle) ** n, stiffness * shared.set_point**n
            return rate, holds - np.copysign(
                spring, angle
            ) - 2 * shared.damping_ratio * omega * rate

        found = solve_ivp(law, time[[0, -1]], (0, 0), t_eval=time, rtol=1e-9, atol=1e-9)
        return found.y[0]

    # As stiff at 40 deg: the same force there, or the same slope.
    stiffness = omega**2 * shared.matched_at ** (1 - power) / (power if tangent else 1)
    expected = np.sqrt(np.mean((angles(stiffness, power) - angles(omega**2, 1)) ** 2))
    assert linear_errors(power, (shared,)) == pytest.approx(expected, rel=2e-3)


def test_a_linear_spring_leaves_no_error():
    assert linear_errors(1.0, SHARED) == pytest.approx(0, abs=1e-12)


def test_larger_power_has_the_larger_error_but_for_three_short_records():
    """The exceptions are short, and their springs are matched just beyond the set point."""
    (large, small), (large_true, small_true) = (
        [getattr(FINGERS[f"Design {k}"], n) for k in (1, 2)] for n in ("estimated", "true")
    )
    assert (linear_errors(large_true, SHARED) > linear_errors(small_true, SHARED)).all()
    ratio = linear_errors(large, SHARED) / linear_errors(small, SHARED)
    others = [one for one, r in zip(SHARED, ratio, strict=True) if r <= 1]
    assert {(x.set_point, x.matched_at, x.tangent, x.span) for x in others} == {(90, 100, False, 2)}
    assert ratio.min() > 0.96
    assert word(5, "grows_in") == f"{len(SHARED) - len(others)}"


def test_printed_errors_have_the_other_order_and_so_has_the_rig_driven_by_a_step():
    step = kept_errors()["driven by a step of force"]
    for angle in ANGLES:
        one, two = (printed(f"5.4-rms-design-{k}--{angle}-deg--linear") for k in (1, 2))
        assert two > one
        ours = [step[f"Design {k}", angle, "linear"] for k in (1, 2)]
        assert ours[1] > ours[0]
    assert FINGERS["Design 2"].estimated < FINGERS["Design 1"].estimated


def test_notes_say_where_it_rests_how_long_and_how_often():
    for design, finger in FINGERS.items():
        said = note(design, ANGLES[1])
        error = printed(claim_of(5, "5.4-rms-{key}", f"{design}, 90 deg, linear").id)
        for n in (finger.estimated, finger.true):
            assert f"{resting_angle(*ANGLES, n):.0f}" in said
        most = max(
            largest_share_at_rest(error, *ANGLES, n) for n in (finger.estimated, finger.true)
        )
        assert f" {100 * most:.1f} % of the record at most" in said
    assert f"in {word(5, 'grows_in')} of {word(5, 'settings')} settings" in said
