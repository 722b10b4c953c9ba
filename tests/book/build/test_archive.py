"""An archive holds what is committed and no measurement of others, checks, and packs the same."""

import json
import os
import shutil
import subprocess
import sys
import tarfile

import pytest

import softgrip
from book.build import archive
from softgrip.errors import SoftgripError

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="needs git")
ANYONE = ("-c", "user.name=a", "-c", "user.email=a@b")


def git(root, *command):
    subprocess.run(["git", *ANYONE, *command], cwd=root, check=True, capture_output=True)


@pytest.fixture
def checkout(tmp_path):
    """Lay a small checkout: two tracked files, one of them a program, and one that is not."""
    root = tmp_path / "root"
    (root / "data").mkdir(parents=True)
    (root / "data" / "a.csv").write_text("a\n")
    (root / "run").write_text("#!/bin/sh\n")
    (root / "run").chmod(0o755)
    (root / "environment.lock").write_text("")
    git(root, "init", "-q")
    git(root, "add", ".")
    git(root, "commit", "-qm", "first")
    (root / "measured.csv").write_text("not ours\n")
    return root


@pytest.fixture
def tree(checkout, tmp_path):
    """Lay its archive's tree, with what a build leaves there."""
    tree = tmp_path / "dist" / "softgrip-0"
    archive.lay_sources(checkout, tree)
    for name in ("book/_build/traces/page.json", "book/_vendor/a.js", "html/index.html",
                 "html/_sources/page.md", "book/__pycache__/x.pyc"):  # fmt: skip
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        (tree / name).write_text("x")
    return tree


def test_only_what_is_tracked_is_laid_and_what_is_no_more_goes(checkout, tree):
    assert not (tree / "measured.csv").exists()
    assert os.access(tree / "run", os.X_OK)
    git(checkout, "rm", "-q", "data/a.csv")
    archive.lay_sources(checkout, tree)
    assert not (tree / "data" / "a.csv").exists()
    assert (tree / "run").exists()


def test_what_a_build_leaves_is_not_packed(tree):
    assert archive.files(tree) == [
        *("book/_vendor/a.js", "data/a.csv", "environment.lock"),
        *("html/_sources/page.md", "html/index.html", "run"),
    ]


def test_it_says_whether_it_differs_from_the_commit(checkout):
    git(checkout, "add", "measured.csv")
    git(checkout, "commit", "-qm", "second")
    assert archive.edition(checkout).changed == ()
    (checkout / "run").write_text("changed")
    told = archive.edition(checkout)
    assert told.changed == ("run",)
    assert len(told.commit) == 40
    assert str(told).endswith(f", commit {told.commit[:8]} with changes")


def test_sources_without_their_history_have_a_version(tmp_path):
    assert str(archive.edition(tmp_path)) == f"Version {softgrip.__version__}"


def test_packed_twice_it_is_the_same_and_its_sums_hold(checkout, tree, tmp_path):
    archive.describe(tree, archive.edition(checkout))
    first, second = tmp_path / "1.tar.gz", tmp_path / "other name.tar.gz"
    archive.pack(tree, first)
    for file in tree.rglob("*"):
        os.utime(file, (1e9, 1e9))
    archive.pack(tree, second)
    assert first.read_bytes() == second.read_bytes()
    with tarfile.open(first) as tar:
        if hasattr(tarfile, "data_filter"):
            tar.extraction_filter = tarfile.data_filter
        tar.extractall(tmp_path / "out")
    out = tmp_path / "out" / "softgrip-0"
    sums = (out / archive.SUMS).read_text().splitlines()
    assert [line.split("  ")[1] for line in sums] == sorted({*archive.files(out)} - {archive.SUMS})
    if shutil.which("sha256sum"):
        check = ["sha256sum", "--quiet", "-c", archive.SUMS]
        assert subprocess.run(check, cwd=out, check=False).returncode == 0
        (out / "data" / "a.csv").write_text("b\n")
        assert subprocess.run(check, cwd=out, check=False, capture_output=True).returncode == 1
    assert os.access(out / "run", os.X_OK)
    assert json.loads((out / archive.MANIFEST).read_text())["version"]


@pytest.mark.parametrize("read", ["tensile tests", "force readings", ""])
def test_a_book_with_the_measurements_of_others_is_refused(tree, read, monkeypatch):
    around = dict.fromkeys(("tensile tests", "force readings"), "False")
    context = tree / "book" / "_build" / "traces" / "page.context.json"
    context.write_text(json.dumps(around | ({read: "True"} if read else {})))
    for name in ("html/index.html", "ledger.json", "ledger.csv"):
        (tree / "book" / "_build" / name).parent.mkdir(exist_ok=True)
        (tree / "book" / "_build" / name).write_text("built")
    monkeypatch.setattr(archive.subprocess, "run", lambda *_, **__: None)
    if read:
        with pytest.raises(SoftgripError, match="measurements of others"):
            archive.build(tree)
    else:
        archive.build(tree)
        assert (tree / "html" / "index.html").read_text() == "built"


def test_nothing_but_the_tree_is_found_when_it_is_built(tmp_path, monkeypatch):
    for variable in archive.VARIABLES:
        monkeypatch.setenv(variable, str(tmp_path))
    program = (
        "from softgrip.materials import tensile\n"
        "from softgrip.tactile import published_readings\n"
        "assert not tensile.available() and not published_readings.available()\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True, env=archive.alone(tmp_path))


def test_packages_that_do_not_fit_this_python_say_for_which_they_are(root, tmp_path):
    (tmp_path / "wheels").mkdir()
    (tmp_path / "wheels" / archive.MADE_FOR).write_text("Python 3.99.1, Linux x86_64\n")
    shutil.copy(root / "environment.lock", tmp_path)
    command = [root / ".ci" / "environment", "made", sys.executable, "book"]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert ran.returncode == 1
    assert "wheels/ are for Python 3.99.1, Linux x86_64: make book PYTHON=" in ran.stderr
