"""The answers of Chapter 5's tasks, found again with the sliders that the tasks name."""

import numpy as np
import pytest

from book.chapter_5 import tasks
from book.chapter_5.numbers import BOUND
from book.chapter_5.step_models import ANGLES
from softgrip.materials.table import table_5_1
from tests.book.explore.page_laws import page_laws

PLACES = 1e-9
"""Of a slider's value: what is left between two ways to compute it."""


def slider(law, name):
    """Return all values that the keys of a slider reach."""
    found = page_laws()[law].ranges[name]
    return np.linspace(found.low, found.high, found.steps + 1)


def moved(law, name, values, **others):
    """Return what a law says for each value of one slider, the others where they start."""
    shown = page_laws()[law]
    given = {each: range_.start for each, range_ in shown.ranges.items()} | others
    return [shown.law(**given | {name: float(value)}) for value in values]


def test_the_slider_of_n_ends_the_law_where_the_test_ends_at_the_told_power():
    values = slider("ludwick_law", "n")
    found = moved("ludwick_law", "n", values, material=tasks.MATERIAL)
    # The picture is by 15 % higher than the largest true stress.
    off = [abs(each["Ludwick"][-1] - each["top"] / 1.15) for each in found]
    nearest = values[np.argmin(off)]
    assert nearest == pytest.approx(tasks.ending_power(), abs=0.005)  # half a step of the slider
    assert nearest not in (values[0], values[-1])


def test_no_power_moves_the_law_at_a_strain_of_one():
    for each in moved("ludwick_law", "n", [1.0, 2.0, 3.0], material=tasks.MATERIAL):
        at_one = np.interp(1.0, each["strain"], each["Ludwick"])
        # Sixty points of a curve that bends: its chord is a percent or two above it.
        assert at_one == pytest.approx(table_5_1()[tasks.MATERIAL].young_modulus / 1e6, rel=0.03)
        seen = np.interp(1.0, each["strain"], each["Yeoh"])
        # Yeoh's law, fitted to the whole curve, is not the curve.
        assert at_one / seen == pytest.approx(tasks.share_at_one(), abs=0.15)


def test_the_slider_of_the_modulus_lowers_the_power_by_what_is_told():
    values = slider("new_material", "E")
    assert (values[0], values[-1]) == tasks.MODULI
    start = page_laws()["new_material"].ranges
    assert (start["MV"].start, start["TS"].start) == (tasks.VISCOSITY, tasks.STRENGTH)
    found = [float(each["n"]) for each in moved("new_material", "E", values)]
    assert (found[0], found[-1]) == pytest.approx(tasks.powers_by_modulus(), abs=PLACES)
    assert np.all(np.diff(found) < 0)
    slope = (found[-1] - found[0]) / (values[-1] - values[0])
    assert slope == pytest.approx(tasks.modulus_factor(), abs=PLACES)


def test_modulus_factor_is_that_of_another_least_squares():
    rows = [(m.young_modulus / 1e6, m.mixed_viscosity / 50, m.tensile_strength / 10e6)
            for m in table_5_1().values()]  # fmt: skip
    A = np.array(rows) ** [1, 0.5, 0.5]
    n = [m.fractional_power for m in table_5_1().values()]
    assert np.linalg.lstsq(A, n, rcond=None)[0][0] == pytest.approx(tasks.modulus_factor())


def test_ranks_of_modulus_and_strength_go_together_as_told():
    materials = [*table_5_1().values()]
    # All values differ, so the ranks are a permutation: 1 - 6 sum d^2 / (m^3 - m).
    ranks = [
        np.argsort(np.argsort([getattr(m, name) for m in materials]))
        for name in ("young_modulus", "tensile_strength")
    ]
    m = len(materials)
    expected = 1 - 6 * np.sum((ranks[0] - ranks[1]) ** 2) / (m**3 - m)
    assert tasks.stiff_and_strong() == pytest.approx(expected)


@pytest.mark.parametrize("first", ANGLES)
def test_the_slider_of_the_angle_stays_within_the_bound_in_the_told_window(first):
    values = slider("straight_spring", "second")
    assert first in slider("straight_spring", "first")
    found = moved("straight_spring", "second", values, n=tasks.POWER, first=float(first))
    # Far below `first` the errors are small again: both springs rest near zero.
    inside = (np.abs([each["missed"] for each in found]) <= BOUND) & (values > 0.7 * first)
    low, high = tasks.window(first, BOUND)
    step = values[1] - values[0]
    assert values[inside].min() == pytest.approx(low, abs=step)
    assert values[inside].max() == pytest.approx(high, abs=step)


def test_windows_are_as_wide_wherever_the_springs_agree():
    """To first order the error is (n - 1) times the way; the second order is of the bound's size
    over the angle."""
    for power in (1.5, 2.0, 2.5):
        for first in ANGLES:
            width = tasks.window_width(first, 1e-4, power)
            assert width == pytest.approx(2e-4 / (power - 1), rel=1e-3)
            expected = 2 * BOUND / (power - 1)
            assert tasks.window_width(first, BOUND, power) == pytest.approx(expected, rel=0.02)
