"""JupyterLab opens copies: what a reader does there stays, and the book's pages what they are."""

import json

import pytest

from book.build.lab import lay


@pytest.fixture
def laid(tmp_path):
    """Lay one notebook, whose links lead to the book; return source, copy and what lays."""
    source, folder = tmp_path / "_sources" / "page.ipynb", tmp_path / "lab"
    source.parent.mkdir()
    source.write_text(
        json.dumps({"cells": ['[a](../rig.html) <a href="../ledger.html">b</a> ../c']})
    )

    def again():
        return lay(source.parent, folder, "/static/")

    assert again() == []
    return source, folder / "page.ipynb", again


def test_links_lead_to_the_book_that_the_server_has(laid):
    source, copy, _ = laid
    cell = json.loads(copy.read_text())["cells"][0]
    assert cell == '[a](/static/rig.html) <a href="/static/ledger.html">b</a> ../c'
    assert "/static/" not in source.read_text()


def test_a_copy_that_was_left_alone_follows_the_book(laid):
    source, copy, again = laid
    source.write_text("{}")
    assert again() == []
    assert copy.read_text() == "{}"


def test_a_copy_that_was_changed_stays_and_is_named_when_the_book_has_another(laid):
    source, copy, again = laid
    copy.write_text("mine")
    assert again() == []
    source.write_text("{}")
    assert (again(), again()) == (["page.ipynb"], ["page.ipynb"])
    assert copy.read_text() == "mine"
    copy.unlink()
    assert again() == []
    assert copy.read_text() == "{}"
