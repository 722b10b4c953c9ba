"""The built book, and a browser that has no network."""

import fcntl
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


def build(folder: Path, **environment: str) -> str:
    """Build a book as ``make book`` does; return what was printed."""
    command = [str(Path(sys.executable).with_name("jupyter-book")), "build", "-W", "-n"]
    result = subprocess.run(
        [*command, "--keep-going", str(folder)],
        capture_output=True,
        text=True,
        env=os.environ | environment,
    )
    assert result.returncode == 0, result.stdout[-6000:] + result.stderr[-6000:]
    return result.stdout


@pytest.fixture(scope="session")
def alone(
    tmp_path_factory: pytest.TempPathFactory, testrun_uid: str
) -> tuple[Path, dict[str, list[str]]]:
    """Make each exhibit alone; return their folder, and the files below ``data/`` of each title.

    The first worker that asks does it for all, as it takes minutes; the others wait.
    """
    folder = tmp_path_factory.getbasetemp().parent / f"alone-{testrun_uid}"
    folder.mkdir(exist_ok=True)
    said = folder / "said.json"
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # let go when its process ends, however it ends
        if not said.exists():
            command = [sys.executable, "-m", "tests.book.alone", str(folder)]
            # One thread each: there is an exhibit for each processor already.
            one = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
            result = subprocess.run(command, capture_output=True, text=True, env=one)
            assert result.returncode == 0, result.stderr[-6000:]
            said.write_text(result.stdout)
    return folder, json.loads(said.read_text())


@pytest.fixture(scope="session")
def read_alone(alone: tuple[Path, dict[str, list[str]]]) -> dict[str, list[str]]:
    """Return the files below ``data/`` that each exhibit reads when it is made alone, by title."""
    return alone[1]


@pytest.fixture(scope="session")
def html(root: Path) -> Path:
    """Return the folder of the built pages."""
    command = [sys.executable, "-m", "book.build"]
    result = subprocess.run(command, capture_output=True, text=True, cwd=root)
    assert result.returncode == 0, result.stdout[-6000:] + result.stderr[-6000:]
    return root / "book" / "_build" / "html"


@pytest.fixture
def local_scripts(root: Path, html: Path) -> None:
    """Skip where the build could not fetch the scripts, and said so: its pages need a network."""
    if not (root / "book" / "_vendor" / "packages.json").is_file():
        pytest.skip("needs the npm registry: the pages were built with public script addresses")


@pytest.fixture(scope="session")
def browser():
    if CHROMIUM is None:
        pytest.skip("needs Chromium (Debian: apt-get install chromium)")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield browser
        browser.close()
