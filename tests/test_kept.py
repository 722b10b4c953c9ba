"""Kept tables: what is read is what was written, and the files of ``data/`` are in this form."""

import os
from dataclasses import dataclass, replace

import pytest

from book.author import forces
from book.chapter_3 import regulators
from book.chapter_4 import pid_gains
from book.chapter_5 import step_protocols, step_sweep
from book.chapter_6 import finger_count, speed
from softgrip.actuator import fem_results
from softgrip.errors import DataFileError
from softgrip.kept import Kept
from softgrip.logs import pushes
from softgrip.materials import facts, fitting
from softgrip.provenance import Provenance, data_file, describe
from softgrip.tactile import element_results

MODULES = (
    *(regulators, pid_gains, step_protocols, step_sweep, finger_count, speed, pushes, facts),
    fitting,
)
MADE_BY = {module.KEPT: module for module in MODULES}
MADE_BY |= {
    made: module for module in (fem_results, element_results) for made in module.KEPT.values()
}
MADE_BY |= dict.fromkeys((forces.ERRORS, forces.REPEATABILITY), forces)


@dataclass(frozen=True)
class Size:
    width: float
    count: int


@dataclass(frozen=True)
class Made:
    name: str
    size: Size
    off: float


ROWS = (Made("plain", Size(0.1 + 0.2, 3), 1 / 3), Made("of two, parts", Size(2.0, 0), float("inf")))
TABLE = Kept("no/such.csv", Made, lambda: ROWS, "python -m this", exact=("width",), number=".3g")


def test_text_is_as_by_hand(tmp_path):
    path = replace(TABLE, notes="one\ntwo").write(tmp_path / "deep" / "made.csv")
    assert path.read_text() == (
        "# provenance: simulated\n# source: python -m this\n# one\n# two\nname,width,count,off\n"
        'plain,0.30000000000000004,3,0.333\n"of two, parts",2.0,0,inf\n'
    )
    assert describe(path).provenance is Provenance.SIMULATED


def test_rows_are_read_as_they_were_written_but_for_the_digits(tmp_path):
    first, second = TABLE.read(TABLE.write(tmp_path / "made.csv"))
    assert first == replace(ROWS[0], off=0.333)
    assert second == ROWS[1]


def test_rows_are_told_as_they_are_made(tmp_path):
    seen = []

    def make():
        for row in ROWS:
            yield row
            seen.append("next")

    replace(TABLE, make=make).write(tmp_path / "made.csv", tell=seen.append)
    assert seen == [ROWS[0], "next", ROWS[1], "next"]


def test_what_breaks_off_leaves_the_file_as_it_was(tmp_path):
    def make():
        yield ROWS[0]
        raise KeyboardInterrupt

    path = TABLE.write(tmp_path / "made.csv")
    before = path.read_bytes()
    with pytest.raises(KeyboardInterrupt):
        replace(TABLE, make=make).write(path)
    assert path.read_bytes() == before


def test_a_file_that_says_the_same_is_left_alone(tmp_path):
    # A page that has just read it would count as made of something that was changed meanwhile.
    path = TABLE.write(tmp_path / "made.csv")
    os.utime(path, ns=(1, 1))
    assert TABLE.write(path).stat().st_mtime_ns == 1
    assert replace(TABLE, source="another").write(path).stat().st_mtime_ns > 1
    assert "another" in path.read_text()


def test_other_columns_are_refused(tmp_path):
    path = replace(TABLE, columns=("a", "b", "c", "d")).write(tmp_path / "made.csv")
    with pytest.raises(DataFileError, match="expected the columns"):
        TABLE.read(path)


@pytest.mark.parametrize("table", MADE_BY, ids=lambda table: table.file)
def test_kept_file_says_by_which_command_it_is_made(table):
    file, module = data_file(table.file), MADE_BY[table]
    materials, public = module in (facts, fitting), module in (facts, fitting, forces)
    command = f"python -m {'softgrip.materials' if materials else module.__name__}"
    assert file.provenance is (Provenance.PUBLIC if public else Provenance.SIMULATED)
    assert file.source == table.source
    assert file.source.endswith(f": {command}") if public else file.source == command


@pytest.mark.parametrize("table", MADE_BY, ids=lambda table: table.file)
def test_kept_file_written_from_its_own_rows_is_the_same_to_the_byte(table, tmp_path):
    path = replace(table, make=table.read).write(tmp_path / "again.csv")
    assert path.read_bytes() == data_file(table.file).path.read_bytes()
