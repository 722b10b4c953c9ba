"""The book is built by the version of jupyter-book that it is written for, or not at all."""

import shutil
import subprocess
import sys

import pytest


@pytest.mark.skipif(shutil.which("make") is None, reason="needs make")
@pytest.mark.parametrize(("version", "built"), [("1.0.4.post1", True), ("2.1.7", False)])
def test_make_book_runs_no_other_version(version, built, root, tmp_path):
    """In an environment that has this version."""
    told = tmp_path / f"jupyter_book-{version}.dist-info" / "METADATA"
    told.parent.mkdir()
    told.write_text(f"Metadata-Version: 2.1\nName: jupyter-book\nVersion: {version}\n")
    programs = {"python": f'PYTHONPATH="{tmp_path}" exec "{sys.executable}" "$@"'}
    (tmp_path / "bin").mkdir()
    for name, does in programs.items():
        (tmp_path / "bin" / name).write_text(f"#!/bin/sh\n{does}\n")
        (tmp_path / "bin" / name).chmod(0o755)
    (tmp_path / "ready").touch()
    # The target on which that of the book waits: it fails before anything is built.
    done = subprocess.run(
        ["make", "book-version", f"VENV={tmp_path}"], cwd=root, capture_output=True, text=True
    )
    assert (done.returncode == 0) == built
    assert (f"needs jupyter-book 1.x, {tmp_path} has {version}" in done.stderr) == (not built)
