"""Figures and tables: complete, deterministic, and with their numbers beside them."""

import tomllib

import pandas as pd
import pytest
from matplotlib.figure import Figure

from book.companion.exhibit import BOOK, chapters, exhibit, exhibits
from book.companion.save import make, numbers, save
from book.companion.show import show
from book.companion.style import style
from softgrip.errors import UnknownNameError
from softgrip.provenance import data_folder

ALL = exhibits()


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """Save every exhibit; return the folder, and what was made by title."""
    folder = tmp_path_factory.mktemp("first")
    return folder, {item.title: save(item, folder) for item in ALL}


@pytest.fixture(scope="module")
def again(saved):
    """Make every exhibit once more, when all the others have been made."""
    return {item.title: make(item) for item in ALL}


@pytest.mark.book
@pytest.mark.parametrize("item", ALL, ids=lambda item: item.title)
def test_files_are_the_same_to_the_bit(item, saved, alone):
    """Made after others in one process, and alone in another."""
    first, second = (sorted(folder.glob(f"{item.name}.*")) for folder in (saved[0], alone[0]))
    assert [f.name for f in first] == [f.name for f in second] != []
    assert [f.read_bytes() for f in first] == [f.read_bytes() for f in second]


@pytest.mark.parametrize("item", ALL, ids=lambda item: item.title)
def test_csv_holds_finite_numbers(item, saved):
    path = saved[0] / f"{item.name}.csv"
    assert path.exists() != item.drawing
    if item.drawing:
        assert not any(axes.axison for axes in saved[1][item.title].shown.axes)
        return
    frame = pd.read_csv(path)
    assert len(frame) >= 2
    if item.kind == "figure":
        assert frame[["x", "y"]].notna().all(axis=None)


@pytest.mark.parametrize("item", ALL, ids=lambda item: item.title)
def test_what_stands_beside_it_is_there(item, saved):
    made = saved[1][item.title].shown
    assert isinstance(made, Figure if item.kind == "figure" else pd.DataFrame)
    assert item.caption.strip().endswith(".")
    assert "{{" not in item.caption + item.alt
    assert item.kind == "table" or len(item.alt) > 40


@pytest.mark.parametrize("chapter", chapters())
def test_words_are_of_the_exhibits_there_are(chapter):
    told = tomllib.loads((BOOK / f"chapter_{chapter}/captions.toml").read_text("utf-8"))
    assert set(told) == {item.title for item in ALL if item.number.startswith(chapter)}
    for title, found in told.items():
        assert set(found) == ({"caption", "alt"} if title.startswith("Figure") else {"caption"})


@pytest.mark.book
def test_nothing_is_read_before_an_exhibit_is_made(read_alone):
    assert read_alone["an import"] == []


@pytest.mark.book
@pytest.mark.parametrize("item", ALL, ids=lambda item: item.title)
def test_strip_names_what_it_reads_alone_though_others_have_read_it_before(
    item, saved, again, read_alone
):
    for made in (saved[1][item.title], again[item.title]):
        names = [file.path.relative_to(data_folder().resolve()).as_posix() for file in made.data]
        assert names == read_alone[item.title]


def test_axes_of_every_figure_are_named(saved):
    for item in ALL:
        if item.kind == "figure" and not item.drawing:
            frame = pd.read_csv(saved[0] / f"{item.name}.csv")
            assert frame[["x_is", "y_is"]].notna().all(axis=None), item.title


def test_numbers_are_those_drawn():
    with style():
        figure = Figure()
        axes = figure.subplots()
        axes.plot([0, 1], [2, 3], label="a line")
        axes.scatter([4], [5], label="points")
        axes.bar([6], [7], label="bars")
        axes.axhline(9.0)
        axes.set(title="panel", xlabel="x (m)", ylabel="y (N)")
        figure.draw_without_rendering()
    frame = numbers(figure)
    rows = {tuple(row) for row in frame[["series", "x", "y"]].itertuples(index=False)}
    assert {("a line", 0, 2), ("a line", 1, 3), ("points", 4, 5), ("bars", 6, 7)} <= rows
    assert set(frame["x_is"]) == {"x (m)"}


def test_names_of_numbers_stand_in_one_line():
    with style():
        figure = Figure()
        axes = figure.subplots()
        axes.plot([0, 1], [2, 3], label="two\nlines")
        axes.set_title("(a)\npanel", loc="left")
    frame = numbers(figure)
    assert (set(frame["panel"]), set(frame["series"])) == ({"(a) panel"}, {"two lines"})


@pytest.mark.parametrize(
    ("title", "words"),
    [
        ("Table 6.A", "computed here from <b>printed</b> inputs"),
        ("Table 3.4", "shown: <b>printed</b>"),
        ("Table 2.G", "shown: <b>simulated</b>"),
    ],
)
def test_a_strip_does_not_call_printed_what_was_computed_here(title, words):
    assert words in show(title)._repr_mimebundle_()["text/html"]


def test_unknown_exhibit_lists_those_that_are():
    with pytest.raises(UnknownNameError, match=r"Figure 5\.1"):
        exhibit("Figure 5.99")
