"""The description of ``data/`` is whole and true: each file, each column, the type of each cell."""

import csv
import json
import shutil
import tomllib

import frictionless
import pytest

from book.build.data_package import NAME, WORDS, description, kind, text
from softgrip.errors import DataFileError
from softgrip.provenance import data_folder

FOLDER = data_folder()
PACKAGE = json.loads((FOLDER / NAME).read_text(encoding="utf-8"))
TABLES = {one["path"]: one for one in PACKAGE["resources"] if "schema" in one}
CHECKS = {"integer": int, "number": float, "string": str}
"""What reads a cell of a type, as the specification defines it; other types are not used."""


def test_it_is_as_the_command_writes_it():
    assert (FOLDER / NAME).read_text(encoding="utf-8") == text(FOLDER), (
        "python -m book.build.data_package"
    )


def test_it_has_what_the_specification_asks_for():
    names = [one["name"] for one in PACKAGE["resources"]]
    assert len(set(names)) == len(names)
    for one in (PACKAGE, *PACKAGE["resources"]):
        assert one["name"].strip("abcdefghijklmnopqrstuvwxyz0123456789._-") == ""
        assert one["title"]
    assert all(one["name"] and one["path"] for one in PACKAGE["licenses"])
    sources = [
        *PACKAGE["sources"],
        *(s for r in PACKAGE["resources"] for s in r.get("sources", ())),
    ]
    assert all(one["title"] for one in sources)


def test_frictionless_agrees():
    report = frictionless.validate(str(FOLDER / NAME))
    assert report.valid, report.flatten(["type", "note"])[:10]


def test_each_file_is_described_once():
    files = {f.relative_to(FOLDER).as_posix() for f in FOLDER.rglob("*") if f.is_file()}
    assert sorted(one["path"] for one in PACKAGE["resources"]) == sorted(files - {NAME})


@pytest.mark.parametrize("name", TABLES)
def test_columns_and_types_are_those_of_the_file(name):
    # Read by the file's own dialect, not by what wrote the description.
    lines = (FOLDER / name).read_text(encoding="utf-8").splitlines()
    dialect = TABLES[name]["dialect"]
    head = dialect["headerRows"][0] - 1
    assert all(line.startswith(dialect["commentChar"]) for line in lines[:head])
    names, *rows = csv.reader(lines[head:])
    fields = TABLES[name]["schema"]["fields"]
    assert [field["name"] for field in fields] == names
    for field, *column in zip(fields, *rows, strict=True):
        assert field["description"], field
        for cell in filter(None, column):
            CHECKS[field["type"]](cell)


def test_each_quantity_has_a_unit():
    bare = {
        (name, field["name"])
        for name, table in TABLES.items()
        for field in table["schema"]["fields"]
        if field["type"] == "number" and "unit" not in field
    }
    # Shares, weights, numbers of errors and gains whose unit hangs on the design.
    shares = {
        "calibration": {"met", "distance", "share", "left", "really", "errors"},
        "control": {"p", "q1", "q2", "q3", "R", "k1", "k2", "k3", "kp", "ki", "kd"},
        "gripper": {"spread", "outside", "worst_sync"},
        "rig": {"width"}, "tactile": {"cut"},
    }  # fmt: skip
    for name, column in bare:
        folder = name.partition("/")[0]
        assert column in shares.get(folder, set()), (name, column)


@pytest.fixture
def small(tmp_path):
    """Lay a folder of one table, and the words for it."""
    (tmp_path / "a.csv").write_text(
        "# provenance: printed\n# source: x\nlength [m],word\n1,one\n2.5,\n"
    )
    columns = {"length": "of it", "word": "for it"}
    return tmp_path, {"table": [{"files": "*.csv", "title": "A", "columns": columns}]}


def test_units_and_types_are_read(small):
    fields = description(*small)["resources"][0]["schema"]["fields"]
    assert fields == [
        {"name": "length [m]", "type": "number", "description": "of it", "unit": "m"},
        {"name": "word", "type": "string", "description": "for it"},
    ]


@pytest.mark.parametrize("change", ["new file", "new column", "twice"])
def test_what_is_not_described_once_is_an_error(small, change):
    folder, words = small
    if change == "new file":
        (folder / "notes.txt").write_text("")
    elif change == "new column":
        shutil.copy(folder / "a.csv", folder / "b.csv")
        (folder / "b.csv").write_text((folder / "a.csv").read_text().replace("word", "other"))
    else:
        words["table"] *= 2
    with pytest.raises(DataFileError):
        description(folder, words)


def test_no_words_are_left_over():
    words = tomllib.loads(WORDS.read_text(encoding="utf-8"))
    known = {
        field["description"] for table in TABLES.values() for field in table["schema"]["fields"]
    }
    for table in words["table"]:
        for told in table.get("columns", {}).values():
            assert (told if isinstance(told, str) else told[1]) in known, told


@pytest.mark.parametrize(
    ("cells", "expected"),
    [
        (["1", "2.0"], "number"),
        (["1e3"], "number"),
        (["-4", "7"], "integer"),
        (["2", "x"], "string"),
    ],
)
def test_kind(cells, expected):
    assert kind(cells) == expected
