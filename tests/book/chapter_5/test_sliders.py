"""The laws of Chapter 5 are what they say, and what their sliders name."""

import numpy as np
import pytest

from book.chapter_5.sliders import (
    ludwick_law,
    ludwick_plot,
    new_material,
    new_material_plot,
    straight_spring,
    straight_spring_plot,
)
from book.explore import Range, Slider, explore
from softgrip.errors import InvalidInputError
from softgrip.materials.powerlaw import predict_power
from tests.book.explore.page_laws import title


def test_law_is_shown_without_a_warning_and_keeps_its_place():
    """Axes end where the material does; the room around them does not depend on it."""
    materials = ["Dragon Skin 20", "Ecoflex 00-10"]
    shown = explore(
        ludwick_law, ludwick_plot(), mode="static", alt="x",
        material=Slider(materials, "Material"), n=Range(1, 3, 2, "n"),
    )  # fmt: skip
    assert set(shown.laws) == set(materials)
    (panel,) = shown.plot.panels
    for material, n in zip(materials, (1.4, 2.6), strict=True):
        found = ludwick_law(material, n)
        ends = [found[end] for axis in (panel.x, panel.y) for end in axis if isinstance(end, str)]
        assert len(ends) == 2
        assert min(ends) > 0


def test_law_is_drawn_with_the_chosen_power():
    law = ludwick_law("Dragon Skin 20", 1.5)
    # At strain 4 the stress is E 4**1.5 = 8 E.
    close = np.abs(law["strain"] - 4).argmin()
    assert law["Ludwick"][close] == pytest.approx(0.34 * law["strain"][close] ** 1.5, rel=1e-12)


def test_title_says_the_prediction_and_where_it_extrapolates():
    power = predict_power(0.3e6, 15.0, 2.5e6).power
    told = title(new_material_plot(), new_material(0.3, 15.0, 2.5))
    assert told == f"n = {power.value:.2f}, 95 %: {power.low:.2f} to {power.high:.2f}"
    assert "extrapolated" in title(new_material_plot(), new_material(3.0, 15.0, 2.5))
    with pytest.raises(InvalidInputError, match="young_modulus"):
        new_material(-0.3, 15.0, 2.5)


def test_both_springs_hold_where_they_are_said_to():
    law = straight_spring(2.0, 60.0, 90.0)
    forces = [np.interp(angle, law["angle"], law[name])
              for name, angle in (("Ludwick", 90), ("linear", law["rest"]))]  # fmt: skip
    # Points stand two degrees apart: the chord of a parabola lies (1 / 90)^2 above it at most.
    assert forces == pytest.approx([1, 1], abs=1.3e-4)
    for name in ("Ludwick", "linear"):
        assert np.interp(60, law["angle"], law[name]) == pytest.approx(law["agree"])
    told = title(straight_spring_plot(), law)
    assert told == "the linear spring rests at 135.0 deg: +45.0 deg"
    assert "outside" in title(straight_spring_plot(), straight_spring(2.6, 20.0, 120.0))
