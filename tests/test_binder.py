"""What Binder's repo2docker reads names a Python that we support and commands that are there."""

import importlib.util
import json
import os
import re
import shutil
import subprocess
import tomllib

import pytest

pytestmark = pytest.mark.skipif(shutil.which("sh") is None, reason="needs a shell")


@pytest.fixture
def run(root, tmp_path):
    """Return what runs a script in a checkout, with a new home and a Python that notes its call."""
    checkout, programs = tmp_path / "checkout", tmp_path / "bin"
    programs.mkdir()
    shutil.copytree(root / ".binder", checkout / ".binder")
    shutil.copy(root / "environment.lock", checkout)
    (tmp_path / "home").mkdir()
    python = programs / "python"
    python.write_text(f'#!/bin/sh\necho "$SOFTGRIP_BOOK_ADDRESS|$*" >>"{tmp_path}/called"\n')
    python.chmod(0o755)

    def script(name, *arguments, **variables):
        home = {"HOME": str(tmp_path / "home"), "PATH": f"{programs}:{os.environ['PATH']}"}
        done = subprocess.run(
            [checkout / ".binder" / name, *arguments], cwd=checkout, env=home | variables,
            check=True, capture_output=True, text=True,
        )  # fmt: skip
        calls = (tmp_path / "called").read_text().splitlines()
        return done.stdout, [call.partition("|")[::2] for call in calls]

    return script


def test_its_python_is_one_that_we_support(root):
    project = tomllib.loads((root / "pyproject.toml").read_text())["project"]
    supported = [line.rpartition(" ")[2] for line in project["classifiers"] if ":: 3." in line]
    found = re.fullmatch(r"python-(3\.\d+)\n", (root / ".binder" / "runtime.txt").read_text())
    assert found[1] in supported


def test_the_image_is_made_from_the_lock_and_has_the_book(run, root, tmp_path):
    _, calls = run("postBuild")
    words = [call.split() for _, call in calls]
    assert "--require-hashes" in words[0]
    locked = (tmp_path / "home" / "book.lock").read_text()
    assert "jupyterlab==" in locked
    assert "pytest==" not in locked
    assert words[1][-2:] == ["-e", "."]
    for call in words:
        assert call[0] == "-m"
        assert call[1] == "pip" or importlib.util.find_spec(call[1])
    told = json.loads((tmp_path / "home" / ".jupyter" / "jupyter_server_config.json").read_text())
    assert told["ServerApp"]["extra_static_paths"] == [
        str(tmp_path / "checkout" / "book" / "_build" / "html")
    ]


@pytest.mark.parametrize("prefix", ["", "/user/somebody/"])
def test_links_lead_to_the_server_that_starts(run, prefix):
    said, calls = run("start", "echo", "served", JUPYTERHUB_SERVICE_PREFIX=prefix)
    assert said == "served\n"
    assert calls == [(f"{prefix or '/'}static/", "-m book.build.lab")]
