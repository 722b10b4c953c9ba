"""JupyterLab leaves the sources alone: a page that is opened there and saved stays what it was."""

import shutil

import pytest

from book.build.lab_form import pages, saved


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.stem)
def test_a_page_that_is_opened_run_and_saved_is_unchanged(page, tmp_path):
    for file in (page, page.with_name("jupytext.toml")):
        shutil.copy(file, tmp_path)
    saved(tmp_path / page.name)
    words = "not in the form in which Lab saves it: python -m book.build.lab_form"
    assert (tmp_path / page.name).read_text() == page.read_text(), words
