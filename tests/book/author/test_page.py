"""The page: that it runs with the readings and without, and says which."""

import jupytext
import pytest
from IPython.core.interactiveshell import InteractiveShell

from book.author.prose import WORDS
from softgrip.errors import DataUnavailableError
from softgrip.tactile import published_readings


def run(root):
    """Run the cells of the page as a notebook does."""
    shell = InteractiveShell()
    for cell in jupytext.read(root / "book" / "author.md").cells:
        if cell.cell_type == "code":
            shell.run_cell(cell.source, store_history=False).raise_error()


def refuse():
    raise DataUnavailableError("no readings")


def test_without_the_readings_it_says_so_and_keeps_its_numbers(root, monkeypatch):
    monkeypatch.setattr(published_readings, "available", lambda: False)
    monkeypatch.setattr(published_readings, "load", refuse)
    run(root)
    assert "could not be had" in published_readings.statement()
    assert WORDS["line_by_reading"]() == "0.0953"


@pytest.mark.usefixtures("published_readings")
def test_with_the_readings_it_says_that_they_were_checked(root):
    run(root)
    assert "readings were read and checked" in WORDS["statement"]()
