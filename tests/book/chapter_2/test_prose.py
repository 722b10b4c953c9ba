"""What captions of Chapter 2 say in words is what their figures draw."""

import numpy as np
import pytest
from scipy.stats import binomtest

from book.chapter_2.kinds import kept
from book.companion.drawn import drawn
from softgrip.tactile.friction import common_friction, printed_grasps


def test_bagging_is_a_draw_with_replacement_and_better_without():
    draws = kept("draws")
    for name, even in (("bagged", True), ("bagged_without_replacement", False)):
        gain = draws[name] - draws["single"]
        better, worse = int((gain > 0).sum()), int((gain < 0).sum())
        assert (binomtest(better, better + worse).pvalue > 0.05) == even
        assert even or better > worse


def test_testing_is_above_training_in_figure_2_7_with_a_wider_band_below_the_print():
    (_, training), (_, testing) = (drawn("Figure 2.7", x) for x in ("training", "testing"))
    assert (testing > training).all()
    assert training[-1] == training.min()
    # The bands are filled without a label: series 5 and 6.
    bands = [drawn("Figure 2.7", f"series {k}")[1] for k in (5, 6)]
    assert np.ptp(bands[1]) > np.ptp(bands[0])
    assert max(map(np.max, bands)) < drawn("Figure 2.7", "training, printed")[1].item()


def test_bars_of_figure_2_i_lie_as_its_words_say():
    common, given = common_friction(), printed_grasps()
    for name in ("tofu", "carrot"):
        assert given[name].least_friction.high < common.low
    egg = given["egg"].least_friction
    assert egg.low < common.low
    assert egg.high > common.high


@pytest.mark.parametrize("shape", ["hemisphere", "pyramid"])
def test_tops_of_figure_2_5_sink_by_a_third_of_the_height(shape):
    from book.chapter_2.figures_element import loaded_section

    at, moved = loaded_section(shape)
    height = at[1].max()
    assert moved[1].min() < -height / 3
    # What is called its lower half hardly moves beside the top.
    assert np.hypot(*moved)[at[1] < height / 2].max() < 0.2 * -moved[1].min()


def test_hemisphere_gives_way_more_than_the_pyramid_by_finite_elements_in_figure_2_b():
    (cuts, one), (same, other) = (
        drawn("Figure 2.B", f"{shape}, FEM") for shape in ("hemisphere", "pyramid")
    )
    assert cuts.tolist() == same.tolist()
    assert (one > other).all()
    assert one[0] / other[0] < one[-2] / other[-2]


def test_the_best_regressor_changes_with_what_is_left_out():
    from book.chapter_2.figures_force import FOUR
    from book.chapter_2.forces import RANDOM, WHOLE, kept_comparison

    errors = kept_comparison().loc[[*FOUR]]
    assert errors[RANDOM].idxmin() == "Nadaraya-Watson"
    assert errors[WHOLE].idxmin() == "neural network"
