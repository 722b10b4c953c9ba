"""The page: that it runs with the readings and without, and says which."""

import jupytext
import pytest
from IPython.core.interactiveshell import InteractiveShell

from book.companion.markdown import Markdown
from softgrip.errors import DataUnavailableError
from softgrip.tactile import published_readings


def shown(root):
    """Run the cells of the page as a notebook does; return the Markdown that they show."""
    cells = [
        cell.source
        for cell in jupytext.read(root / "book" / "author.md").cells
        if cell.cell_type == "code"
    ]
    shell = InteractiveShell()
    results = [shell.run_cell(source, store_history=False) for source in cells]
    for result in results:
        result.raise_error()
    return "\n".join(r.result.text for r in results if isinstance(r.result, Markdown))


def refuse():
    raise DataUnavailableError("no readings")


def test_without_the_readings_it_says_so_and_keeps_its_numbers(root, monkeypatch):
    monkeypatch.setattr(published_readings, "available", lambda: False)
    monkeypatch.setattr(published_readings, "load", refuse)
    text = shown(root)
    assert "could not be had" in text
    assert "0.0953" in text


@pytest.mark.usefixtures("published_readings")
def test_with_the_readings_it_says_that_they_were_checked(root):
    assert "readings were read and checked" in shown(root)
