"""Identification of Eq. (5.16) and (5.17)."""

import numpy as np
import pytest
from scipy.stats import binom

from softgrip.dynamics.identify import identify
from softgrip.dynamics.linear import linear_finger, second_order
from softgrip.dynamics.ludwick import LudwickFinger, pressure_response
from softgrip.dynamics.ludwick_fit import fit_finger
from softgrip.errors import InvalidInputError

TIME = np.arange(0, 6, 0.05)
PRESSURE = 7e3 * np.minimum(1, TIME / 0.3)
F = 1.5e-5
TRUE = LudwickFinger(0.04, 0.14, 0.1, 2.365)
CLEAN = pressure_response(TRUE, TIME, PRESSURE, force_per_pressure=F)
NOISE = 0.02


def fit(angle, **held):
    held = {"fractional_power": 2.365} | held
    return fit_finger(TIME, PRESSURE, angle, force_per_pressure=F, **held)


@pytest.mark.parametrize("held", [{}, {"stiffness": 0.1}, {"fractional_power": None}])
def test_known_parameters_come_back(held):
    found = fit(CLEAN, **held)
    for name in ("mass", "damping", "stiffness", "fractional_power"):
        assert getattr(found, name).value == pytest.approx(getattr(TRUE, name), rel=1e-5)
    assert found.fit_percent > 99.99


def test_intervals_hold_the_truth_about_as_often_as_they_say():
    rng = np.random.default_rng(3)
    runs, hits = 60, np.zeros(3)
    for _ in range(runs):
        found = fit(CLEAN + NOISE * rng.normal(size=TIME.size))
        for k, name in enumerate(("mass", "damping", "stiffness")):
            hits[k] += getattr(found, name).low < getattr(TRUE, name) < getattr(found, name).high
    # Of a true 95 % this falls outside once in a thousand, on the low side.
    assert (hits >= binom.ppf(0.001, runs, 0.95)).all(), hits
    # Intervals twice as wide would never miss: some of these 180 must.
    assert hits.sum() < 3 * runs


def test_interval_of_a_short_record_is_that_of_the_textbook():
    """Of logarithms. Student's t, 12 samples less 3 parameters: 2.262 in any table."""
    few = slice(0, None, 10)
    angle = CLEAN[few] + 1e-3 * np.random.default_rng(1).normal(size=12)
    found = fit_finger(
        TIME[few], PRESSURE[few], angle, force_per_pressure=F, fractional_power=2.365
    )
    for e in (found.mass, found.damping, found.stiffness):
        half = pytest.approx(2.262 * e.standard_error / e.value, rel=3e-4)
        assert (np.log(e.high / e.value), np.log(e.value / e.low)) == (half, half)


def test_linear_model_is_that_of_the_other_identification():
    # `identify` solves between the samples exactly, and fits an offset besides.
    finger = linear_finger(0.04, 0.11, 0.1)
    rng = np.random.default_rng(0)
    angle = pressure_response(finger, TIME, PRESSURE, force_per_pressure=F)
    angle += 0.005 * rng.normal(size=TIME.size)
    ours = fit_finger(TIME, PRESSURE, angle, force_per_pressure=F, fractional_power=1.0)
    other = identify(TIME, PRESSURE, angle, initial_input=0.0)
    system = second_order(ours.finger, F)
    assert system.natural_frequency == pytest.approx(other.natural_frequency.value, rel=0.01)
    assert system.damping_ratio == pytest.approx(other.damping_ratio.value, rel=0.01)
    assert system.gain == pytest.approx(other.gain.value, rel=0.01)
    assert ours.fit_percent == pytest.approx(other.fit_percent, abs=0.1)


def test_fit_is_the_share_of_the_deviation_that_it_explains():
    angle = CLEAN + NOISE * np.random.default_rng(1).normal(size=TIME.size)
    found = fit(angle)
    left = np.linalg.norm(found.fitted - angle)
    assert found.fit_percent == pytest.approx(
        100 * (1 - left / np.linalg.norm(angle - angle.mean())), rel=1e-9
    )
    np.testing.assert_allclose(found.response(TIME, PRESSURE), found.fitted, atol=1e-12)


def test_only_ratios_to_the_force_are_known():
    twice = fit_finger(TIME, PRESSURE, CLEAN, force_per_pressure=2 * F, fractional_power=2.365)
    assert twice.mass.value == pytest.approx(2 * TRUE.mass, rel=1e-5)
    assert twice.stiffness.value == pytest.approx(2 * TRUE.stiffness, rel=1e-5)


@pytest.mark.parametrize(
    "change",
    [
        {"angle": -CLEAN},
        {"angle": 0 * CLEAN + 1},
        {"angle": CLEAN - 5 * ((TIME > 5.35) & (TIME < 5.65))},  # below zero in the last tenth
        {"pressure": 0 * PRESSURE},
        {"time": 0 * TIME},
        {"time": TIME[:4], "pressure": PRESSURE[:4], "angle": CLEAN[:4]},
        {"force_per_pressure": 0.0},
    ],
)
def test_bad_records_are_refused(change):
    good = {"time": TIME, "pressure": PRESSURE, "angle": CLEAN, "force_per_pressure": F}
    words = "three finite arrays|above zero over the last tenth|force_per_pressure"
    with pytest.raises(InvalidInputError, match=words):
        fit_finger(**{**good, **change}, fractional_power=2.0)


def test_record_that_tells_nothing_of_the_motion_is_refused():
    # A spring so stiff that no mass and no damping matter: Eq. (5.10) as it is printed.
    with pytest.raises(InvalidInputError, match="determines the parameters"):
        fit(CLEAN, fractional_power=1.0, stiffness=2.66)
