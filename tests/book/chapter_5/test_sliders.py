"""The widgets of Chapter 5 draw what they say, and what their sliders name."""

import pytest

from book.chapter_5.sliders import draw_law, draw_new_material
from book.companion.save import numbers
from book.explore.frames import render
from softgrip.errors import InvalidInputError
from softgrip.materials.powerlaw import predict_power


def test_frames_are_drawn_without_a_warning_and_keep_their_place():
    first = draw_law("Dragon Skin 20", 1.4).axes[0].get_position().bounds
    second = draw_law("Ecoflex 00-10", 2.6).axes[0].get_position().bounds
    assert first == second
    assert render(draw_law, {"material": "Dragon Skin 20", "n": 2.0}).width == 576


def test_law_is_drawn_with_the_chosen_power():
    frame = numbers(draw_law("Dragon Skin 20", 1.5))
    law = frame[frame["series"] == "Ludwick, n = 1.50"]
    # At strain 4 the stress is E 4**1.5 = 8 E.
    close = law.iloc[(law["x"] - 4).abs().argmin()]
    assert close["y"] == pytest.approx(0.34 * close["x"] ** 1.5, rel=1e-12)


def test_title_says_the_prediction_and_where_it_extrapolates():
    power = predict_power(0.3e6, 15.0, 2.5e6).power
    title = draw_new_material(0.3, 15.0, 2.5).axes[0].get_title(loc="left")
    assert title == f"n = {power.value:.2f}, 95 %: {power.low:.2f} to {power.high:.2f}"
    assert "extrapolated" in draw_new_material(3.0, 15.0, 2.5).axes[0].get_title(loc="left")
    with pytest.raises(InvalidInputError, match="young_modulus"):
        draw_new_material(-0.3, 15.0, 2.5)
