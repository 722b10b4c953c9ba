"""The drawings of the pad, and that they say what the numbers say."""

import numpy as np
import pytest

from book.chapter_2 import figures_pad as shown
from book.chapter_2 import sliders
from book.chapter_2.logs import TRAINING, contacts
from book.companion.style import style
from softgrip.simulator.fitted_rigs import fitted_layer, fitted_pad
from softgrip.simulator.pad import ideal_responses
from softgrip.simulator.pad_objects import pad_object
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_kind import bagged_neighbours
from softgrip.units import DEG, MM


@pytest.mark.parametrize("make", [shown.figure_2_13, shown.figure_2_c, shown.figure_2_d])
def test_figure_is_drawn(make):
    with style():
        drawn = make()
        drawn.draw_without_rendering()
    assert drawn.axes


def test_element_that_feels_nothing_is_white_and_more_is_darker():
    shades = shown.COLOURS(np.linspace(0, 1, 11))[:, :3]
    assert shades[0].tolist() == [1, 1, 1]
    luminance = shades @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(luminance) < 0).all()


def test_outline_turns_with_the_object():
    item = pad_object("tofu")
    turned = shown.outline(item, Pose((0.0, 0.0), 90 * DEG))
    assert np.ptp(turned, axis=0) == pytest.approx([40, 40])
    moved = shown.outline(item, Pose((0.005, 0.0)))
    assert moved[:, 0].max() == pytest.approx(25)


def title(item, x):
    return sliders.draw_touch(item, x, 30).axes[0].get_title(loc="left")


@pytest.mark.parametrize(("item", "x"), [("egg", 0), ("small carrot", 8)])
def test_slider_says_what_the_classifier_says(item, x):
    responses = ideal_responses(item, Pose((x * MM, 0.0), 30 * DEG), shown.FORCE)
    felt = contacts(TRAINING)
    told = bagged_neighbours().fit(felt.responses, felt.kinds).predict(responses[None])[0]
    assert title(item, x) == f"{item}: felt as {told}, is {pad_object(item).kind}"


def test_slider_draws_an_object_beside_the_pad():
    assert title("blueberry", 40) == "blueberry: felt as nothing, is point"


def test_tables_count_all_contacts():
    rows = shown.table_2_c()
    kinds = rows["contacts"].isin([f"training, {k}" for k in ("point", "line", "surface")])
    assert rows.loc[kinds, "number"].tolist() == [210, 210, 210]
    assert rows["number"].tolist()[-8:] == [10] * 8


def test_table_2_d_has_the_pad_and_the_layer_that_are_simulated():
    rows = shown.table_2_d().set_index("parameter")
    pad, layer = fitted_pad(), fitted_layer()
    for name, value in (
        ("pad.cut [1]", pad.element.cut),
        ("pad.repeatability [1]", pad.repeatability),
        ("layer.memory_slow [1]", layer.memory[1]),
    ):
        assert float(rows.loc[shown.PARAMETERS[name], "value"]) == pytest.approx(value, rel=5e-3)
    assert set(rows["by the prints"]) == {"told", "not told", "given"}
    # What is given has no interval.
    assert ((rows["by the prints"] == "given") == (rows["90 % interval"] == "")).all()


def test_what_the_words_of_figure_2_13_say_of_each_grasp():
    egg, tofu, along, *turned = (grasp.responses for grasp in shown.GRASPS)
    assert egg[[3, 4]].min() > egg[1] > shown.FELT
    assert egg[[0, 2, 5, 6, 7]].max() < shown.FELT
    # Almost white: a response below a fifth.
    assert tofu.max() < 0.2
    assert set(np.flatnonzero(along > shown.FELT)) == {3, 4}
    for felt in (along, *turned):
        assert shown.FELT < felt.max() < 0.6
