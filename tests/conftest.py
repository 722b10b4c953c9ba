"""What all tests share: where data and cases lie, the project's root, no deadlines."""

import os
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

pytest_plugins = ["tests.board.served"]
collect_ignore = ["bench/elastica_rod.py"]  # runs in an environment of its own

ROOT = Path(__file__).parent.parent
BESIDE = ROOT.parent / "shared"
CASES = Path(os.environ.get("SOFTGRIP_CASES_DIR", BESIDE / "cases" / "own-data"))
"""Inputs as people of the field bring them."""

LONG = (
    *("board/test_firmware_noise.py", "board/test_record_emulated.py", "rig/test_record_pad.py"),
    *("book/companion/test_expected.py", "book/explore/test_laws.py", "book/twin/test_study.py"),
    *("book/twin/test_cluster.py", "book/chapter_2/test_own_pad.py"),
    "book/live/test_emulated_figures.py",
)
"""Files that take longest, by the table at the end of a run, though they have few tests."""

for variable, name in (("SOFTGRIP_MATERIALS_DIR", "materials"), ("SOFTGRIP_AUTHOR_DIR", "author")):
    if variable not in os.environ and (BESIDE / name).is_dir():
        os.environ[variable] = str(BESIDE / name)

# An example is not judged by the clock: its first call may import or compile, and others may keep
# the machine busy.
settings.register_profile("no clock", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("no clock")


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with what takes longest, so that no processor waits for it in the end.

    The book first, then `LONG`, then the files with most tests: processes take whole files, in this
    order.
    """
    tests = Counter(item.path for item in items)
    book = {item.path for item in items if item.get_closest_marker("book")}
    long = {ROOT / "tests" / name for name in LONG}
    items.sort(key=lambda i: (i.path not in book, i.path not in long, -tests[i.path]))


@pytest.fixture(scope="session")
def root() -> Path:
    return ROOT


@pytest.fixture
def path(tmp_path) -> Path:
    """Where a test writes its log."""
    return tmp_path / "log.csv"


@pytest.fixture(scope="session")
def tensile_tests() -> None:
    """Skip where the public tensile tests can neither be read nor fetched."""
    from softgrip.materials import tensile

    if not tensile.available():
        pytest.skip("needs the public tensile tests: a network, or SOFTGRIP_MATERIALS_DIR")


@pytest.fixture(scope="session")
def published_readings() -> None:
    """Skip where the author's force readings can neither be read nor fetched."""
    from softgrip.tactile import published_readings

    if not published_readings.available():
        pytest.skip("needs the author's force readings: a network, or SOFTGRIP_AUTHOR_DIR")
