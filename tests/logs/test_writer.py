"""Writing and reading logs."""

import os
import re
import signal
import subprocess
import sys
from itertools import pairwise

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.queued_writer import RunLog, plain
from softgrip.logs.reader import read_log
from softgrip.logs.schema import COLUMNS, LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.provenance import Provenance
from softgrip.text_table import LARGEST
from softgrip.units import DEG

HEADER = LogHeader(
    Provenance.LOGGED, "a rig", "board", 0.025, board="MEGA 2560", seed="", notes={"who": "us: two"}
)
finite = st.floats(-LARGEST, LARGEST)


def row(k, **values):
    return {
        "time": 0.025 * k, "command": 0.1 * k, "pressure_counts": 100 + k, "angle_counts": 200,
        "pressure": 1e3 / 3, "angle": 0.1, **values,
    }  # fmt: skip


@pytest.fixture
def path(tmp_path):
    made = tmp_path / "log.csv"
    with LogWriter(made, HEADER) as log:
        for k in range(5):
            log.write(**row(k), event="half way" if k == 2 else "")
    return made


def edit(path, change):
    lines = path.read_text().splitlines(keepends=True)
    path.write_text("".join(change(lines)))
    return len(lines)


@given(cells=st.lists(st.tuples(finite, finite, finite), min_size=1, max_size=5))
def test_round_trip_is_exact(cells, tmp_path_factory):
    made = tmp_path_factory.mktemp("log") / "log.csv"
    with LogWriter(made, HEADER, more={"angle_2": "rad"}) as log:
        for k, (command, pressure, angle) in enumerate(cells):
            log.write(**row(k, command=command, pressure=pressure, angle=angle), angle_2=command)
    found = read_log(made)
    assert found.header == HEADER
    assert found.repairs == ()
    for name, index in (("command", 0), ("pressure", 1), ("angle", 2), ("angle_2", 0)):
        assert found[name].tolist() == [cell[index] for cell in cells]
    assert found["pressure_counts"].tolist() == [100 + k for k in range(len(cells))]


def test_events_come_back_with_their_time(path):
    assert read_log(path).events == ((0.05, "half way"),)


def test_first_lines_state_provenance_and_source(path):
    assert path.read_text().splitlines()[:2] == ["# provenance: logged", "# source: a rig"]


def test_a_log_is_never_written_over(path):
    with pytest.raises(InvalidInputError, match="does not exist"):
        LogWriter(path, HEADER)


def test_rows_leave_at_once_and_reach_the_disk_each_second(tmp_path, monkeypatch):
    now, synced = [0.0], []
    monkeypatch.setattr(os, "fsync", lambda number: synced.append(now[0]))
    with LogWriter(tmp_path / "log.csv", HEADER, clock=lambda: now[0]) as log:
        for k in range(100):
            now[0] = 0.04 * k
            log.write(**row(k))
            assert len((tmp_path / "log.csv").read_text().splitlines()) == 10 + 1 + k + 1
    waits = [b - a for a, b in pairwise(synced)]
    assert max(waits) <= 1.04


def test_killed_writer_leaves_all_rows_that_it_had_written(tmp_path):
    path = tmp_path / "log.csv"
    program = f"""
import itertools, pathlib, time
from softgrip.provenance import Provenance
from softgrip.text_table import LARGEST
from softgrip.logs.schema import LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.logs.queued_writer import RunLog, plain
log = LogWriter(pathlib.Path({str(path)!r}),
                LogHeader(Provenance.SIMULATED, "test", "simulated rig", 0.025))
for k in itertools.count():
    log.write(time=0.025 * k, command=1.0, pressure_counts=1, angle_counts=2, pressure=0.1,
              angle=0.2)
    print(k, flush=True)
    time.sleep(0.002)
"""
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, text=True
    ) as run:
        for line in run.stdout:
            if int(line) == 60:
                run.send_signal(signal.SIGKILL)
                break
    found = read_log(path)
    assert run.returncode == -signal.SIGKILL
    assert len(found["time"]) >= 61
    assert len(found.repairs) <= 1


@pytest.mark.parametrize("lost", range(1, 45, 4))
def test_cut_last_line_is_left_out_and_said(path, lost):
    whole = path.read_bytes()
    last = len(whole.splitlines()[-1]) + 1
    path.write_bytes(whole[:-lost])
    found = read_log(path)
    assert len(found["time"]) == (4 if lost <= last else 3)
    number = len(whole.splitlines()) - (lost > last)
    words = f"the cut last line, {number}, was left out"
    assert found.repairs == ((words,) if lost != last else ())


def test_other_unit_is_converted_and_said(path):
    edit(path, lambda lines: [line.replace("angle [rad]", "angle [deg]") for line in lines])
    found = read_log(path)
    assert found["angle"].tolist() == [0.1 * DEG] * 5
    assert "deg" in found.repairs[0]


def test_doubled_row_counts_once_and_is_said(path):
    edit(path, lambda lines: [*lines[:-2], lines[-2], lines[-2], lines[-1]])
    found = read_log(path)
    assert len(found["time"]) == 5
    assert "same as" in found.repairs[0]


def test_last_row_with_nan_is_left_out_and_said(path):
    edit(path, lambda lines: [*lines[:-1], lines[-1].replace("0.4,", "nan,", 1)])
    found = read_log(path)
    assert len(found["time"]) == 4
    assert "not all of it is finite" in found.repairs[0]


def test_lines_of_another_system_are_read(path):
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    assert read_log(path).repairs == ()


@pytest.mark.parametrize(
    ("change", "words", "from_end"),
    [
        (lambda x: [s.replace("angle [rad]", "angel [rad]") for s in x], "no angle", 5),
        (lambda x: [s.replace("[Pa]", "[mm]") for s in x], "pressure as a pressure: Pa, hPa", 5),
        (lambda x: [s.replace(",event", ",note") for s in x], "'name [unit]', got 'note'", 5),
        (lambda x: [*x[:-6], *x[-5:]], "a number in line 11, before any name", None),
        (lambda x: x[:-5], "rows with as many cells and a number in each", None),
        (lambda x: [*x[:-2], x[-1], x[-2]], "a time above 0.1 s", 0),
        (
            lambda x: [*x[:-2], x[-2].replace("0.1,", "nan,", 1), x[-1]],
            "a finite number under angle",
            1,
        ),
        (lambda x: [*x[:-2], x[-2].replace("0.1,", "x,", 1), x[-1]], "number under angle", 1),
        (lambda x: [*x[:-2], "1,2\n", x[-1]], "7 cells", 1),
        (lambda x: [s.replace("softgrip-log 1", "softgrip-log 9") for s in x], "schema", None),
        (lambda x: [s for s in x if "period" not in s], "'period' in the header", None),
        (lambda x: [s.replace("logged", "found") for s in x], "valid header", None),
        (lambda x: x[:5], "no line with a number", None),
    ],
)
def test_damage_is_refused_with_file_and_line(path, change, words, from_end):
    count = edit(path, change)
    with pytest.raises(DataFileError) as error:
        read_log(path)
    assert words in str(error.value)
    assert str(path) in str(error.value)
    if from_end is not None:
        assert f"line {count - from_end}:" in str(error.value)


@pytest.mark.parametrize(
    "values",
    [
        {"angle": float("nan")},
        {"time": -1.0},
        {"event": "a,b"},
        {"event": "trial #3"},
        {"event": 'so "called"'},
        {"event": "two\nlines"},
        {"event": "a name \udcff of a file"},
        {"angle_counts": 1.5},
        {"new": 1.0},
    ],
)
def test_writer_refuses_what_the_reader_would(tmp_path, values):
    with LogWriter(tmp_path / "log.csv", HEADER) as log:
        log.write(**row(0))
        with pytest.raises(InvalidInputError):
            log.write(**{**row(1), **values})


@given(words=st.text(st.characters(codec=None)))
def test_words_that_nobody_chose_are_one_cell_for_every_reader(words, tmp_path_factory):
    made = tmp_path_factory.mktemp("log") / "log.csv"
    with LogWriter(made, HEADER) as log:
        log.write(**row(0), event=plain(f"it said {words}"))
        log.write(**row(1), event="end")
    seen = pd.read_csv(made, comment="#")
    assert seen["event"].tolist() == [plain(f"it said {words}"), "end"]
    assert seen["angle [rad]"].tolist() == [0.1, 0.1]
    assert [event for _, event in read_log(made).events] == seen["event"].tolist()
    # Nothing is lost that can be seen.
    assert all(word in seen["event"][0] for word in re.findall(r"\w+", words))


def test_a_log_goes_on_after_words_that_it_cannot_hold(tmp_path):
    path = tmp_path / "log.csv"
    with RunLog(path, HEADER) as log:
        for k in range(3):
            log.write(**row(k))
            log.note("trial #3 of 'a\udcff': no, \"not\"\nthis\0")
    assert log.failure == ""
    assert (
        pd.read_csv(path, comment="#")["event"].tolist()
        == ["trial [hash]3 of 'a\\udcff': no; 'not' this\\x00"] * 3
    )


def test_names_of_columns_hold_no_comment(tmp_path):
    with pytest.raises(InvalidInputError, match="plain names"):
        LogWriter(tmp_path / "log.csv", HEADER, more={"finger #2": "rad"})


def test_columns_that_are_not_there_are_named(path):
    with pytest.raises(DataFileError, match=r"log\.csv: expected a column 'force'.*angle_counts"):
        read_log(path)["force"]
    assert list(read_log(path).columns) == list(COLUMNS)


@pytest.mark.parametrize(
    "settings",
    [{"provenance": Provenance.PRINTED}, {"period": 0.0}, {"notes": {"a": "b\nc"}},
     {"notes": {"seed": "1"}}],
)  # fmt: skip
def test_bad_headers_are_refused(settings):
    with pytest.raises(InvalidInputError):
        LogHeader(**{**vars(HEADER), **settings})
