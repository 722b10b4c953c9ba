"""The page on a reader's own data, run cell by cell: what was put in comes out."""

import contextlib
import io
import re

import jupytext
import pytest


@pytest.fixture(scope="module")
def page(root):
    """The names that the page leaves, and what it prints."""
    names, said = {}, io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        for cell in jupytext.read(root / "book" / "your-own-data.md").cells:
            if cell.cell_type == "code":
                exec(cell.source, names)  # as a notebook would
    return names, said.getvalue()


def test_step_settles_after_three_of_its_time_constants(page):
    assert float(page[0]["found"].settled_5_percent) == pytest.approx(1.5, abs=0.1)


def test_step_that_was_made_up_is_called_simulated(page):
    assert "step.csv: simulated, another program" in page[1]


def test_lost_rows_are_told_with_their_place(page):
    assert "10 rows missing between 2.9 and 3.45 s" in page[1]


def test_kinds_are_told_from_whole_presses_that_were_left_out(page):
    names, said = page
    assert len(set(names["readings"].groups)) == 90
    assert 60 < float(re.search(r"(\d+)% of the rows right", said)[1]) < 100


def test_material_is_the_one_that_it_was_made_with(page):
    told = re.search(r"strain 1 +([\d.]+) \(.*\n +n +([\d.]+) \(", page[1])
    # Noise of 5 mN on up to 8 N moves both by less than a hundredth.
    assert [float(one) for one in told.groups()] == pytest.approx([120, 1.6], rel=1e-2)


def test_a_finger_of_eighty_metres_is_asked_about(page):
    assert "length: expected the length of a finger" in page[1]
    assert "probably mm" in page[1]
