"""What the package holds of Chapter 6's print is what the claims say is printed."""

import numpy as np
import pytest

from book.chapter_6 import filters, numbers
from book.companion.claims import printed
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.printed_loop import FILTERS


def test_fingers_are_those_of_eq_6_26():
    for finger, name in zip(PRINTED.fingers, ("spa1", "spa2"), strict=True):
        assert finger.damping == printed(f"6.26-{name}-damping")
        assert finger.stiffness == printed(f"6.26-{name}-stiffness")
        assert finger.gain == printed("6.26-gain")


@pytest.mark.parametrize("target", FILTERS)
def test_filters_are_those_of_section_6_4(target):
    name = target.replace(".", "-").removesuffix("/s")
    top, low = FILTERS[target]
    of = {"num": top, "den": low}
    for part, coefficients in of.items():
        for power, value in enumerate(reversed(coefficients)):
            if (part, power) != ("den", 6):
                assert value == printed(f"6.4-filter-{name}-per-s-{part}-{power}")


@pytest.mark.parametrize(("target", "expected"), [("4.8/s", 5.0), ("2/s", 2.0)])
def test_peaks_of_a_designed_filter_are_equal_for_its_own_target_loop(target, expected):
    """The reading is checked on filters of which c is known: a design of ours, and the prints."""
    ours = filters.designed(target, expected, filters.author_plant())
    assert filters.crossover_of_peaks(*ours.coefficients) == pytest.approx(expected, rel=1e-3)
    assert filters.crossover_of_peaks(*FILTERS[target]) == pytest.approx(expected, rel=1e-3)


def test_deviations_are_of_the_nine_free_coefficients():
    ours = filters.designed("2/s", 2.0, filters.author_plant())
    off = filters.deviations("2/s", ours)
    assert len(off) == 9
    top, low = FILTERS["2/s"]
    held_by = {"numerator": top, "denominator": low[1:-1]}
    found = numbers.filter_coefficient("den-4", 1.812, 0.7, 2.0, held_by)
    assert off[5] == pytest.approx(100 * (found / 442.5 - 1))


def test_a_projection_is_the_foot_of_a_perpendicular():
    """By least squares on the velocity gains, of stiffnesses that are not printed."""
    stiffness = (4.0, 2.5)
    column = 1 / np.array(stiffness)
    (u,), *_ = np.linalg.lstsq(column[:, None], [0.25, 0.25])
    found = [numbers.projection(spa, stiffness, 0.25) for spa in ("spa1", "spa2")]
    assert found == pytest.approx(column * u)
