"""What should agree, and whether it does: ratios known in closed form."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.dynamics import consistency
from softgrip.dynamics.consistency import tip_loaded_angle

powers = st.floats(1.0, 3.0)


@given(n=powers)
def test_no_ratio_but_that_of_the_pressed_finger_depends_on_the_power(n):
    ratios = {one.name: one.ratio for one in consistency.agreements(n)}
    assert ratios.pop("pressed") == pytest.approx(((n + 1) / n) ** n, rel=1e-6)
    twice = {"moment", "spring", "force", "moment-3", "moment-integral", "spring-3"}
    for name, ratio in ratios.items():
        assert ratio == pytest.approx(2.0 if name in twice else 1.0, rel=1e-6), name


@given(n=powers, force=st.floats(0.1, 10), length=st.floats(0.01, 1))
def test_tip_loaded_beam_in_closed_form(n, force, length):
    # The integral of (F (L - s))**(1/n) over the beam, by hand.
    closed = n / (n + 1) * force ** (1 / n) * length ** (1 + 1 / n)
    assert tip_loaded_angle(force, 1.0, n, length) == pytest.approx(closed, rel=1e-6)


@given(n=powers)
def test_section_in_closed_form(n):
    closed = 2 * 0.012 ** (n + 2) / (n + 2) * 0.03
    assert consistency.section_integral(n, 0.03, 0.024) == pytest.approx(closed, rel=1e-6)


@given(n=powers)
def test_one_moment_all_along_bends_farther_than_the_tip_force_with_it_at_the_root(n):
    assert consistency.pressed_angle(1.0, 1.0, n, 1.0) > tip_loaded_angle(1.0, 1.0, n, 1.0)


def test_found_by_name():
    assert not consistency.agreement("moment").holds
    assert consistency.agreement("chapter-3").holds
