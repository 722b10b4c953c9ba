"""The drawings of the pad, and that they say what the numbers say."""

import numpy as np
import pytest

from book.chapter_2 import figures_pad as shown
from book.chapter_2.sliders_pad import COLOURS, draw_pad, outline
from book.chapter_2.tables_pad import table_2_c, table_2_d
from book.companion.style import style
from softgrip.simulator.pad_objects import pad_object
from softgrip.simulator.pad_surface import Pose
from softgrip.units import DEG


@pytest.mark.parametrize("make", [shown.figure_2_13, shown.figure_2_c, shown.figure_2_d])
def test_figure_is_drawn(make):
    with style():
        drawn = make()
        drawn.draw_without_rendering()
    assert drawn.axes


def test_element_that_feels_nothing_is_white_and_more_is_darker():
    shades = COLOURS(np.linspace(0, 1, 11))[:, :3]
    assert shades[0].tolist() == [1, 1, 1]
    luminance = shades @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(luminance) < 0).all()


def test_outline_turns_with_the_object():
    item = pad_object("tofu")
    turned = outline(item, Pose((0.0, 0.0), 90 * DEG))
    assert np.ptp(turned, axis=0) == pytest.approx([40, 40])
    moved = outline(item, Pose((0.005, 0.0)))
    assert moved[:, 0].max() == pytest.approx(25)


def title(item, x, classifier=None):
    return draw_pad(item, x, 30, classifier).axes[0].get_title(loc="left")


@pytest.mark.parametrize(("item", "x"), [("egg", 0), ("small carrot", 8), ("blueberry", 40)])
def test_slider_draws_any_object_also_beside_the_pad(item, x):
    assert title(item, x) == f"{item}: {pad_object(item).kind} (true)"


def test_slider_asks_the_classifier_it_is_given():
    asked = []

    def classifier(responses):
        asked.append(responses.shape)
        return "surface"

    assert title("egg", 0, classifier) == "egg: felt as surface, is point"
    assert asked == [(8,)]
    assert "felt as nothing" in title("blueberry", 40, classifier)
    assert len(asked) == 1


def test_tables_count_all_contacts():
    rows = table_2_c()
    kinds = rows["contacts"].isin([f"training, {k}" for k in ("point", "line", "surface")])
    assert rows.loc[kinds, "number"].tolist() == [210, 210, 210]
    assert rows["number"].tolist()[-8:] == [10] * 8
    assert set(table_2_d()["use"]) == {"checked", "assumed"}
