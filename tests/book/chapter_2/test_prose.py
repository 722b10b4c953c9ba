"""What captions of Chapter 2 say in words is what their figures draw."""

import numpy as np
import pytest
from scipy.stats import binomtest

from book.chapter_2.figures_kind import figure_2_11, printed_gain
from book.chapter_2.forces import weight_points
from book.chapter_2.grasps import friction
from book.chapter_2.kinds import kept, split_shares
from book.companion.drawn import drawn
from book.companion.save import numbers
from softgrip.tactile.friction import common_friction, contact_force, printed_grasps


@pytest.mark.parametrize("name", ["bagged", "bagged_without_replacement"])
def test_bagging_takes_away_more_often_than_it_adds_on_the_foods(name):
    gain = kept("draws")[name] - kept("draws")["single"]
    better, worse = int((gain > 0).sum()), int((gain < 0).sum())
    assert binomtest(better, better + worse, alternative="less").pvalue < 0.01
    # "What that pad does not give": one seed in twenty would be chance enough.
    assert (gain >= printed_gain()).mean() < 0.05


def test_testing_is_above_training_in_figure_2_7_with_a_wider_band_below_the_print():
    (_, training), (_, testing) = (drawn("Figure 2.7", x) for x in ("training", "testing"))
    assert (testing > training).all()
    assert training[-1] == training.min() < training[0] < training.max()
    # The bands are filled without a label: series 5 and 6.
    bands = [drawn("Figure 2.7", f"series {k}")[1] for k in (5, 6)]
    assert np.ptp(bands[1]) > np.ptp(bands[0])
    for name, curve in (("training", training), ("testing", testing)):
        assert curve.max() < drawn("Figure 2.7", f"{name}, printed")[1].item() - 1


def test_three_neighbours_come_within_half_a_per_cent_of_the_best():
    """As the note to the claim of the best k says."""
    training = drawn("Figure 2.7", "training")[1]
    assert training[2] > training.max() - 0.5


def test_a_gaussian_kernel_tells_kinds_as_neighbours_do_and_all_others_far_worse():
    """As the caption of Table 2.E and the note to its claim say."""
    for part in ("cross_validated", "tested"):
        shares = {
            name: float(split_shares(name, part).mean())
            for name in set(kept("classifiers")["classifier"])
        }
        neighbours = shares.pop("k-nearest neighbours")
        assert shares.pop("support vectors, Gaussian kernel") == pytest.approx(neighbours, abs=0.02)
        assert shares.pop("bagged neighbours") == pytest.approx(neighbours, abs=0.02)
        assert max(shares.values()) < neighbours - 0.1


def test_all_surfaces_are_told_as_such_in_figure_2_11():
    cells = numbers(figure_2_11())["series"]
    assert cells.str.startswith("surface told as surface: 20").sum() == 2


def test_nearest_reading_is_one_of_the_same_weight():
    """As the caption of Figure 2.H says."""
    voltage, force = weight_points()
    apart = np.abs(voltage[:, None] - voltage) + np.where(np.eye(voltage.size), np.inf, 0)
    assert (force[apart.argmin(axis=1)] == force).mean() > 0.9


def test_bandwidth_may_be_narrow_while_repeats_remain_in_figure_2_h():
    point, weight = (
        drawn("Figure 2.H", f"best, a {what} at a time")[1].item() for what in ("point", "weight")
    )
    assert point < weight / 3


def test_the_egg_needs_nearly_all_of_its_desired_force_and_the_others_less_of_theirs():
    """The grey lines of Figure 2.14."""
    needed = {
        name: contact_force(float(given.weight), friction()) / float(given.contact)
        for name, given in printed_grasps().items()
    }
    assert needed["egg"] == pytest.approx(1, abs=0.1)
    assert max(needed["tofu"], needed["carrot"]) < needed["egg"]


def test_marks_of_figure_2_j_lie_above_the_curve_of_linear_contacts():
    for name in ("egg", "tofu", "carrot"):
        gain, missing = drawn("Figure 2.J", name, "(b)")
        assert missing.item() > 1 / (1 + gain.item())


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


def test_only_the_cross_validation_may_differ_by_more_than_chance_and_bagging_is_worse_there():
    """As the words below Table 2.F say."""
    from book.chapter_2.figures_kind import printed_accuracies, printed_right
    from softgrip.tactile.accuracy import overlaps

    for place, (_, total, single, bagged) in enumerate(printed_accuracies()):
        least = min(test.p_value for test in overlaps(*printed_right(place), total))
        assert (least < 0.05) == (place == 0)
        assert (float(bagged) < float(single)) == (place < 2)


def test_only_the_sausage_has_a_mean_that_chance_hardly_explains():
    from softgrip.tactile.force import table_2_2

    assert [name for name, row in table_2_2().items() if row.bias_p < 0.05] == ["sliced sausage"]


def test_with_the_largest_gains_egg_and_carrot_swing_and_the_tofu_does_not():
    from book.chapter_2.grasps import study, summary

    swung = {
        name: summary(study(name, 4.0)).ripple / summary(study(name)).ripple
        for name in ("egg", "tofu", "carrot")
    }
    assert min(swung["egg"], swung["carrot"]) > 10
    assert swung["tofu"] < 2


def test_the_more_elements_feel_a_line_the_better_its_angle_is_told():
    from book.chapter_2.figures_pad import table_2_c

    rows = table_2_c().set_index("contacts")["angle: median (deg)"]
    found = [float(rows[f"training, line felt by {n}"]) for n in ("two", "three", "four and more")]
    assert found[0] > found[1] > found[2]


def test_with_one_area_of_the_base_the_pyramid_leads_by_the_equation():
    from book.chapter_2.figures_element import table_2_b

    for _, row in table_2_b().iterrows():
        assert float(row["pyramid, equal area"]) > float(row["hemisphere, equal area"])


def test_of_a_weight_that_was_left_out_a_curve_that_rises_tells_more_than_a_wider_kernel():
    from book.chapter_2.forces import WHOLE, WIDE, kept_comparison

    errors = kept_comparison()[WHOLE]
    assert errors["isotonic regression"] < errors[WIDE] < errors["Nadaraya-Watson"]


def test_the_explorer_of_the_bandwidth_shows_what_its_question_asks():
    """Steps at its narrowest, none at the best one; at its widest the heaviest are too light."""
    from book.chapter_2.forces import weight_bandwidth
    from book.chapter_2.sliders import bandwidth
    from tests.book.explore.page_laws import page_laws

    slider = page_laws()["bandwidth"].ranges["sigma"]
    assert slider.low < weight_bandwidth() < slider.high
    within = bandwidth(0.1)["voltage"]
    within = (within > 0) & (within < 3.5)
    steps = {}
    for sigma in (slider.low, weight_bandwidth()):
        rise = np.diff(bandwidth(sigma)["force"][within])
        # Where the curve is flat: less than a tenth of its mean slope.
        steps[sigma] = (rise < 0.1 * rise.mean()).mean()
    assert steps[slider.low] > 0.5
    assert steps[weight_bandwidth()] < 0.1
    voltage, force = weight_points()
    wide = bandwidth(slider.high)
    told = np.interp(voltage[force == force.max()], wide["voltage"], wide["force"])
    assert (told < 65).all()
