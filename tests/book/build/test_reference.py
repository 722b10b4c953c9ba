"""The reference beside the book: a page for each package, and made again when the code changes."""

import pytest

from book.build import reference


def test_each_package_and_module_has_its_place(tmp_path, root):
    reference.write_pages(tmp_path)
    text = {file.stem: file.read_text() for file in tmp_path.glob("*.rst")}
    assert set(text) == {*reference.packages(), "index", "tests"}
    named = {
        ".".join(file.relative_to(root).with_suffix("").parts)
        for top in ("softgrip", "book")
        for file in (root / top).rglob("*.py")
        if not file.stem.startswith("__") and not reference.MADE & {*file.relative_to(root).parts}
    }
    listed = [
        line.split()[-1]
        for page in text.values()
        for line in page.splitlines()
        if "automodule" in line
    ]
    assert sorted(listed) == sorted(named | set(reference.packages()))


def test_a_page_that_says_the_same_keeps_its_time_and_one_of_no_package_goes(tmp_path):
    reference.write_pages(tmp_path)
    before = {file: file.stat().st_mtime_ns for file in tmp_path.iterdir()}
    (tmp_path / "softgrip.gone.rst").touch()
    reference.write_pages(tmp_path)
    assert {file: file.stat().st_mtime_ns for file in tmp_path.iterdir()} == before


def test_code_that_has_not_changed_is_not_read_again(tmp_path, monkeypatch):
    started = []
    monkeypatch.setattr(reference.subprocess, "Popen", lambda command, **_: started.append(command))
    (tmp_path / reference.FOLDER).mkdir()
    (tmp_path / reference.FOLDER / reference.STAMP).write_text(reference.sources())
    assert reference.Reference(tmp_path).wait() == tmp_path / "api" / "objects.inv"
    assert started == []
    monkeypatch.setattr(reference, "sources", lambda: "others")
    reference.Reference(tmp_path)
    assert len(started) == 1


def test_what_a_build_makes_is_no_source(tmp_path, monkeypatch):
    for name in reference.CODE:
        (tmp_path / name).mkdir()
    monkeypatch.setattr(reference, "ROOT", tmp_path)
    monkeypatch.setattr(reference, "STATIC", ())
    monkeypatch.setattr(reference, "TEMPLATE", tmp_path / "layout.html")
    before = reference.sources()
    made = tmp_path / "book" / "_build" / "ipython" / "config.py"
    made.parent.mkdir(parents=True)
    made.touch()
    assert reference.sources() == before
    (tmp_path / "book" / "page.py").touch()
    assert reference.sources() != before


def test_a_reference_that_fails_is_an_error_and_leaves_no_stamp(tmp_path, monkeypatch):
    class Failed:
        def wait(self):
            return 1

    monkeypatch.setattr(reference.subprocess, "Popen", lambda *_, **__: Failed())
    made = reference.Reference(tmp_path)
    with pytest.raises(reference.ExtensionError):
        made.wait()
    assert not made.stamp.exists()
