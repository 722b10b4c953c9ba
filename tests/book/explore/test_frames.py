"""The explorer: what each slider position leads to, in a page and with a kernel."""

import base64
import html
import io
import json
import re
from itertools import product

import ipywidgets as widgets
import matplotlib.pyplot as plt
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure
from PIL import Image

from book.explore import Slider, explore
from book.explore.frames import PAGE, Budget, Frame, render
from book.explore.page import Explorer
from softgrip.errors import InvalidInputError

NAMES = ("a", "b", "c")


def draw(**parameters):
    figure = Figure(figsize=(0.5, 0.5))
    for i, value in enumerate(parameters.values()):
        figure.text(0.1, 0.1 + 0.3 * i, str(value), fontsize=8)
    return figure


def draw_pyplot(a):
    figure, axes = plt.subplots(figsize=(1, 1))
    axes.plot([0, a])
    return figure


def draw_up_to_two(a):
    figure = draw_pyplot(a)
    if a > 2:
        raise ValueError(f"a is <{a}>")
    return figure


@pytest.fixture(autouse=True)
def fresh_page(monkeypatch):
    monkeypatch.setattr(PAGE, "spent", 0)
    monkeypatch.delenv("SOFTGRIP_BOOK", raising=False)
    yield
    widgets.Widget.close_all()
    assert plt.get_fignums() == []


def controls(widget):
    return list(widget.children[0].children)


def is_static(shown):
    return isinstance(shown, Explorer)


def frame_at(shown, places):
    """Return the frame that the page's script shows: the last slider moves fastest."""
    index = 0
    for place, item in zip(places, shown.sliders.values(), strict=True):
        index = index * len(item.values) + place
    return shown.frames[index]


def page(shown):
    return shown._repr_html_()


def told(shown):
    """Return what the page's script is told."""
    return json.loads(re.search(r"Object\.assign\((.*),\{laws:", page(shown))[1])


def webp(picture):
    source = picture if isinstance(picture, str) else picture.value
    return base64.b64decode(re.search(r'base64,([^"]+)', source)[1])


def alt(node):
    return html.unescape(re.search(r'alt="([^"]*)"', node.value)[1])


# Which mode


@pytest.mark.parametrize(
    ("variable", "mode", "static"),
    [
        (None, None, False),
        ("", None, False),
        ("static", None, True),
        ("static", "live", False),
        (None, "static", True),
    ],
)
def test_mode_is_that_of_the_environment_unless_given(monkeypatch, variable, mode, static):
    if variable is not None:
        monkeypatch.setenv("SOFTGRIP_BOOK", variable)
    assert is_static(explore(draw, a=[1, 2], mode=mode)) is static


# Static


@settings(max_examples=12)
@given(st.lists(st.integers(2, 3), min_size=1, max_size=3), st.randoms(use_true_random=False))
def test_every_combination_of_places_leads_to_its_frame(counts, random):
    sliders = {}
    for i, (name, count) in enumerate(zip(NAMES, counts, strict=False)):
        values = [10 * i + j for j in range(count)]
        sliders[name] = Slider(values, name, default=random.choice(values))
    shown = explore(draw, mode="static", **sliders)
    for places in product(*map(range, counts)):
        values = {n: s.values[i] for (n, s), i in zip(sliders.items(), places, strict=True)}
        assert webp(frame_at(shown, places)) == render(draw, values).webp
    data = told(shown)
    assert data["frames"] == list(shown.frames)
    first = [s["values"][s["start"]] for s in data["sliders"]]
    assert first == [item.default for item in sliders.values()]


@pytest.mark.parametrize("counts", [(3,), (2, 3), (2, 3, 4)])
def test_each_place_has_a_frame_and_each_slider_a_control(counts):
    sliders = {n: list(range(k)) for n, k in zip(NAMES, counts, strict=False)}
    shown = explore(draw, mode="static", **sliders)
    assert len(shown.frames) == np.prod(counts)
    ends = re.findall(
        r'type="range" id="explore-draw-(\w)" name="\1" min="0" max="(\d)"', page(shown)
    )
    assert ends == [(n, str(k - 1)) for n, k in zip(NAMES, counts, strict=False)]


def test_a_static_explorer_without_a_default_starts_at_the_first_values():
    shown = explore(draw, mode="static", a=["x", "y"], b=[1, 2])
    assert [s["start"] for s in told(shown)["sliders"]] == [0, 0]
    assert webp(frame_at(shown, (0, 0))) == render(draw, {"a": "x", "b": 1}).webp


def test_too_many_frames_are_refused_before_any_is_drawn():
    def never(a, b):
        raise AssertionError

    with pytest.raises(InvalidInputError, match=r"at most 125 .*fewer steps.*got 132"):
        explore(never, mode="static", a=range(11), b=range(12))


def test_a_live_explorer_has_no_budget():
    assert not is_static(explore(draw, mode="live", a=range(11), b=range(12)))


def test_the_budget_counts_all_explorers_of_a_page(monkeypatch):
    explore(draw, mode="static", a=[1, 2])
    one = PAGE.spent
    assert one == sum(len(base64.b64encode(render(draw, {"a": a}).webp)) for a in (1, 2))
    explore(draw, mode="static", a=[1, 2])
    assert PAGE.spent == 2 * one
    monkeypatch.setattr(PAGE, "limit", 3 * one - 1)
    with pytest.raises(InvalidInputError, match=r"fewer steps or a smaller figure; these 2 frames"):
        explore(draw, mode="static", a=[1, 2])
    assert PAGE.spent == 2 * one


def test_the_budget_is_three_megabytes_and_says_what_came():
    frame = Frame(b"x" * 750_000, 1, 1)
    budget = Budget()
    budget.spend([frame, frame, frame])
    assert budget.spent == 3_000_000
    with pytest.raises(InvalidInputError, match=r"at most 3\.00 MB.* got '4\.00 MB'"):
        budget.spend([frame])


# Live


def test_a_live_slider_redraws_and_leaves_no_figure_open():
    widget = explore(draw_pyplot, mode="live", a=Slider([1, 2, 3], "A", default=2))
    (control,), picture = controls(widget), widget.children[-1]
    assert webp(picture) == render(draw_pyplot, {"a": 2}, small=False).webp
    control.index = 2
    assert webp(picture) == render(draw_pyplot, {"a": 3}, small=False).webp
    assert plt.get_fignums() == []


def test_a_live_error_is_shown_and_the_last_good_picture_stays():
    widget = explore(draw_up_to_two, mode="live", a=[1, 2, 3])
    (control,) = controls(widget)
    complaint, picture = widget.children[1:]
    control.index = 1
    good = picture.value
    control.index = 2
    assert 'role="alert"' in complaint.value
    assert "ValueError: a is &lt;3&gt;" in complaint.value
    assert picture.value == good
    control.index = 0
    assert complaint.value == ""
    assert webp(picture) == render(draw_up_to_two, {"a": 1}, small=False).webp


@pytest.mark.parametrize("mode", ["live", "static"])
def test_an_error_in_the_first_picture_is_raised_with_its_parameters(mode):
    with pytest.raises(ValueError, match="a is <3>") as caught:
        explore(draw_up_to_two, mode=mode, a=[3, 4])
    assert caught.value.__notes__ == ["while drawing with {'a': 3}"]


# What the reader is told


def test_labels_units_and_alt_text_of_a_live_one():
    pressure = Slider([0.0, 20.0, 40.0, 60.0], "Pressure <p>", "kPa", 20)
    widget = explore(draw, mode="live", alt='A "curve"', a=pressure, b=["linear", "Ludwick"])
    first, second = controls(widget)
    assert (first.description, second.description) == ("Pressure <p>", "b")
    assert (first.label, second.label) == ("20 kPa", "linear")
    assert alt(widget.children[-1]) == 'A "curve"; Pressure <p> 20 kPa; b linear; 20.0; linear'


def test_what_the_titles_of_a_frame_say_is_told_in_words_too():
    def draw(item):
        figure = Figure()
        figure.subplots().set_title(f"{item}:\nfelt as point")
        figure.text(0, 0, "by touch")
        return figure

    shown = explore(draw, mode="static", item=["egg", "coin"])
    assert told(shown)["told"] == ["egg: felt as point; by touch", "coin: felt as point; by touch"]
    widget = explore(draw, mode="live", item=["egg", "coin"])
    assert alt(widget.children[-1]) == "item egg; egg: felt as point; by touch"


def test_labels_units_and_alt_text_of_a_static_one():
    pressure = Slider([0.0, 20.0, 40.0, 60.0], "Pressure <p>", "kPa", 20)
    shown = explore(draw, mode="static", alt='A "curve" </script>', a=pressure, b=["x", "y"])
    labels = re.findall(r'<label for="explore-draw-\w">(.*?)</label>', page(shown))
    assert labels == ["Pressure &lt;p&gt;", "b"]
    assert page(shown).count("</script>") == 1
    data = told(shown)
    assert data["alt"] == 'A "curve" </script>'
    assert [(s["label"], s["unit"]) for s in data["sliders"]] == [
        ("Pressure <p>", "kPa"),
        ("b", ""),
    ]
    assert data["sliders"][0]["values"][data["sliders"][0]["start"]] == 20


# Frames


def test_the_same_draw_gives_the_same_bytes_whatever_the_notebook_is_set_to():
    first = render(draw_pyplot, {"a": 2})
    with plt.rc_context({"savefig.bbox": "tight", "savefig.dpi": 40}):
        assert render(draw_pyplot, {"a": 2}) == first


@pytest.mark.parametrize("colour", ["#FFFFFF", "#000000", "#0072B2", "#E69F00", "#767676"])
def test_a_frame_has_the_colours_of_the_figure_to_within_what_an_eye_sees(colour):
    frame = render(lambda: Figure(figsize=(2, 1), facecolor=colour), {})
    picture = Image.open(io.BytesIO(frame.webp))
    assert picture.size == (frame.width, frame.height) == (240, 120)
    wanted = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)])
    off = np.abs(np.array(picture.getpixel((60, 60))) - wanted)
    assert off.max() <= (0 if colour == "#FFFFFF" else 4)


def test_figures_that_were_open_before_stay_open():
    mine = plt.figure()
    render(draw_pyplot, {"a": 1})
    assert plt.get_fignums() == [mine.number]
    plt.close(mine)


# What is refused


@pytest.mark.parametrize(
    ("values", "options", "message"),
    [
        ([], {}, "at least two values"),
        ([1], {}, "at least two values"),
        ([1, 2, 1], {}, "values that differ"),
        ([1, 1.0], {}, "values that differ"),
        ([1, None], {}, "finite numbers or strings, got None"),
        ([1, [2]], {}, r"finite numbers or strings, got \[2\]"),
        ([1, float("nan")], {}, "finite numbers or strings, got nan"),
        ("abc", {}, "a sequence of values, got 'abc'"),
        ([1, 2], {"default": 3}, r"a default among \[1, 2\], got 3"),
        (["a", "b"], {"default": 1}, "a default among"),
    ],
)
def test_a_slider_refuses(values, options, message):
    with pytest.raises(InvalidInputError, match=message):
        Slider(values, "A", **options)


def needs_two(a, b):
    return draw(a=a, b=b)


def positional_only(a, /):
    return draw(a=a)


@pytest.mark.parametrize(
    ("function", "names", "message"),
    [
        (draw, "", "one to 4 sliders"),
        (draw, "abcde", "one to 4 sliders"),
        (needs_two, "a", r"needs_two\(a, b\): missing a required argument: 'b'"),
        (needs_two, "abc", "unexpected keyword argument 'c'"),
        (positional_only, "a", "sliders that fit positional_only"),
    ],
)
@pytest.mark.parametrize("mode", ["live", "static"])
def test_an_explorer_refuses_sliders_that_do_not_fit(function, names, message, mode):
    with pytest.raises(InvalidInputError, match=message):
        explore(function, mode=mode, **{name: [1, 2] for name in names})


@pytest.mark.parametrize("mode", ["live", "static"])
def test_an_explorer_refuses_what_is_not_a_figure(mode):
    with pytest.raises(InvalidInputError, match="returns a Figure, got 1"):
        explore(lambda a: a, mode=mode, a=[1, 2])


def test_an_unknown_mode_is_refused():
    with pytest.raises(InvalidInputError, match="'live', 'static' or None, got 'fast'"):
        explore(draw, mode="fast", a=[1, 2])


# Sliders


def test_values_may_come_from_numpy_and_defaults_may_be_rounded():
    assert Slider(np.array([1, 2]), "A").values == (1, 2)
    assert Slider(np.linspace(0, np.pi, 5), "A", default=np.pi / 2).start == 2


def test_a_default_is_the_nearest_of_close_values():
    assert Slider(np.linspace(1e5, 1e5 + 1e-3, 11), "A", default=1e5 + 5e-4).start == 5
