"""Answers of the tasks of Chapter 2, each found in another way."""

import re

import numpy as np
import pytest

from book.chapter_2 import sliders, tasks
from book.chapter_2.logs import TRAINING, contacts
from book.companion.claims import printed
from book.companion.exhibit import BOOK
from book.companion.prose import word
from book.explore import Range, Slider
from softgrip.simulator.pad import ideal_responses
from softgrip.simulator.pad_objects import pad_object
from softgrip.simulator.pad_surface import Pose
from softgrip.tactile.contact_kind import bagged_neighbours
from softgrip.units import DEG, MM
from tests.book.explore.page_laws import page_laws

ROW, LOAD = "table-2.1-pyramid-analytics-0-1-n", "2.2-load-0-1-n"


def touch_sliders():
    """Return the sliders of the explorer that has a drawing, by name, as its cell gives them."""
    given = {}
    cell = re.search(
        r"^explore\(\n    draw\.draw_touch.*?^\)", (BOOK / "chapter-2.md").read_text("utf-8"),
        re.MULTILINE | re.DOTALL,
    )  # fmt: skip
    told = {"draw": sliders, "Slider": Slider, "Range": Range}
    exec(cell[0], told | {"explore": lambda *_, alt, **every: given.update(every)})
    return given


def test_top_of_task_1_lies_between_positions_of_the_slider_that_enclose_the_row():
    slider = page_laws()["element"].ranges["cut"]
    load, wanted = printed(LOAD), printed(ROW)
    tops = np.arange(slider.low, slider.high + slider.step / 2, slider.step)
    moved = np.array([float(sliders.element("pyramid", load, top)["moved"]) for top in tops])
    found = tasks.top_for(wanted * MM, load)
    assert np.interp(-wanted, -moved, tops) == pytest.approx(found, abs=slider.step / 5)
    below = np.flatnonzero(tops <= found)[-1]
    assert moved[below] > wanted > moved[below + 1]
    share = 100 * (moved[below] - moved[below + 1]) / wanted
    assert word(2, "step_share") == f"{share:.0f}"


def test_the_found_top_is_shortened_as_printed():
    """By slices, in the place of the closed form."""
    top = tasks.top_for(printed(ROW) * MM, printed(LOAD))
    y = np.linspace(0, 1, 100_001)
    area = (6 * MM * (1 - (1 - top) * y)) ** 2
    shortened = 3 * MM * np.trapezoid(printed(LOAD) / (0.125e6 * area), y)
    assert shortened == pytest.approx(printed(ROW) * MM, rel=1e-6)


@pytest.mark.parametrize("shape", ["pyramid", "hemisphere"])
def test_halving_the_top_does_in_the_explorer_what_the_answer_says(shape):
    cuts = page_laws()["element"].ranges["cut"]
    assert cuts.low <= tasks.WIDER_TOP / 2
    whole, half = (
        sliders.element(shape, 0.1, cut)["moved"] for cut in (tasks.WIDER_TOP, tasks.WIDER_TOP / 2)
    )
    assert tasks.by_halving(shape) == pytest.approx(half / whole, rel=1e-9)


def test_poses_are_those_of_the_sliders():
    given = touch_sliders()
    assert tuple(given["x"].values) == tasks.PLACES
    assert tuple(given["angle"].values) == tasks.ANGLES
    assert {"egg", "small carrot"} <= set(given["item"].values)


@pytest.mark.parametrize(("item", "kind"), [("egg", "line"), ("small carrot", "surface")])
def test_poses_that_are_told_wrong_are_all_those_of_scikit_learn(item, kind):
    felt = contacts(TRAINING)
    model = bagged_neighbours().fit(felt.responses, felt.kinds)
    every = [(place, angle) for place in tasks.PLACES for angle in tasks.ANGLES]
    responses = [ideal_responses(item, Pose((x * MM, 0.0), a * DEG), 0.15) for x, a in every]
    told = model.predict(np.array(responses))
    expected = [pose for pose, each in zip(every, told, strict=True) if each == kind]
    found = tasks.poses(item, kind)
    assert [(pose.place, pose.angle) for pose in found] == expected
    assert found
    assert pad_object(item).kind != kind


def test_the_egg_is_a_line_in_the_middle_at_every_angle_and_the_carrot_a_surface_there_alone():
    """As the words of the answer, and the question, have it."""
    assert {(p.place, p.angle) for p in tasks.poses("egg", "line")} == {
        (0.0, angle) for angle in tasks.ANGLES
    }
    assert {pose.place for pose in tasks.poses("small carrot", "surface")} == {0.0}
    # Two elements feel the egg there; so do they a line.
    assert {pose.elements for pose in tasks.poses("egg", "line")} == {2}


@pytest.mark.parametrize("name", ["egg", "tofu"])
def test_grips_of_task_3_hold_as_surely_as_asked(name):
    """By a million draws of the pad's error; of 0.99 their mean has a deviation of 0.0001."""
    weight, error = printed(f"2.4-weight-{name}"), printed("2.2-deviation")
    lift = tasks.sure_lift(weight, 0.99, 1.0, error)
    pressed = lift / 2 + error * np.random.default_rng(0).standard_normal(1_000_000)
    assert (2 * pressed >= weight).mean() == pytest.approx(0.99, abs=5e-4)


def test_the_printed_lift_is_enough_for_the_egg_and_not_for_the_tofu():
    assert printed("2.4-lift-egg") > float(word(2, "sure_egg"))
    assert printed("2.4-lift-tofu") < float(word(2, "sure_tofu"))
