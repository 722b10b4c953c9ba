"""A build after which nothing changed is answered by digests; any change is a build."""

import subprocess
import sys

import pytest

from book.build import __main__ as build
from book.build import tracing


@pytest.fixture
def book(tmp_path, monkeypatch):
    """Lay a book of one file, whose build writes one page; return what was built so far."""
    html = tmp_path / "book" / "_build" / "html"
    source, built = tmp_path / "book" / "page.md", []
    source.parent.mkdir()
    source.write_text("first")
    for name, value in (("ROOT", tmp_path), ("BOOK", tmp_path / "book"), ("HTML", html),
                        ("STAMP", html.parent / "built.json"), ("MADE_OF", ("book",))):  # fmt: skip
        monkeypatch.setattr(build, name, value)

    def run(command, **_):
        html.mkdir(parents=True, exist_ok=True)
        (html / "index.html").write_text(source.read_text())
        built.append(command)
        return subprocess.CompletedProcess(command, int(source.read_text() == "wrong"))

    monkeypatch.setattr(build.subprocess, "run", run)
    monkeypatch.setattr(tracing, "surroundings", lambda: {"tensile tests": "True"})
    monkeypatch.delenv("SOFTGRIP_MATERIALS_DIR", raising=False)
    return source, html, built


def test_nothing_changed_is_said_and_not_built(book, capsys):
    assert (build.main(), build.main()) == (0, 0)
    assert len(book[2]) == 1
    assert capsys.readouterr().out.count("Nothing has changed") == 1


@pytest.mark.parametrize("change", ["text", "new file", "page gone", "page cut", "public data"])
def test_what_changed_is_built(book, change, tmp_path, monkeypatch):
    source, html, built = book
    build.main()
    if change == "text":
        source.write_text("second")
    elif change == "new file":
        source.with_name("other.md").write_text("")
    elif change == "page gone":
        (html / "index.html").unlink()
    elif change == "page cut":
        (html / "index.html").write_text("f")
    else:
        (tmp_path / "tests.csv").write_text("1")
        monkeypatch.setenv("SOFTGRIP_MATERIALS_DIR", str(tmp_path / "tests.csv"))
    assert build.main() == 0
    assert len(built) == 2


def test_a_build_that_fails_is_made_again(book):
    book[0].write_text("wrong")
    assert (build.main(), build.main()) == (1, 1)
    assert len(book[2]) == 2


def test_a_build_without_the_public_data_is_made_again(book, monkeypatch):
    monkeypatch.setattr(tracing, "surroundings", lambda: {"tensile tests": "False"})
    assert (build.main(), build.main()) == (0, 0)
    assert len(book[2]) == 2


def test_nothing_of_the_book_is_imported_before():
    code = "import sys, book.build.__main__; print([m for m in sys.modules if m in %r])"
    heavy = ("sphinx", "numpy", "matplotlib", "IPython", "softgrip")
    said = subprocess.run(
        [sys.executable, "-c", code % (heavy,)], capture_output=True, text=True, check=True
    )
    assert said.stdout.strip() == "[]"
