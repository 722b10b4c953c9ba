"""What a log is said to serve is what the analyses take."""

import json

import pytest

from softgrip.errors import DataFileError
from softgrip.logs.__main__ import main
from softgrip.logs.check import USES, contents
from softgrip.logs.contacts import read_contacts
from softgrip.logs.fingers import read_runs
from softgrip.logs.pushes import compare
from softgrip.logs.repeated_steps import read_step_test
from softgrip.logs.staircase import judge_staircase
from softgrip.logs.steps import judge_step_log
from softgrip.provenance import data_file

CALLS = {
    "the response to a step": judge_step_log,
    "the response to a staircase": judge_staircase,
    "the capacity of pump and finger": compare,
    "the finger's dynamics": lambda path: read_step_test([path]),
    "the dynamics of two fingers": lambda path: read_runs([path]),
    "contacts of a pad": read_contacts,
}


@pytest.mark.parametrize(
    "name", ["push-a", "staircase", "lqr-fast", "gripper-open-1", "pad-objects"]
)
def test_what_a_log_lacks_the_analysis_refuses(name):
    path = data_file(f"simulated/{name}.csv").path
    services = contents(path).services
    assert {one.what for one in services} <= {use.what for use in USES}
    for one in services:
        if one.why_not and one.what in CALLS:
            with pytest.raises(DataFileError):
                CALLS[one.what](path)


@pytest.mark.parametrize(
    ("name", "what"),
    [
        ("lqr-fast", "the response to a step"),
        ("staircase", "the response to a staircase"),
        ("push-a", "the capacity of pump and finger"),
        ("step-60-1", "the finger's dynamics"),
        ("gripper-open-1", "the dynamics of two fingers"),
        ("pad-objects", "contacts of a pad"),
    ],
)
def test_what_a_log_serves_the_analysis_takes(name, what):
    path = data_file(f"simulated/{name}.csv").path
    assert f"\nserves  {what}" in str(contents(path))
    CALLS[what](path)


def test_the_command_tells_of_each_log_and_ends_with_two_if_one_is_none(tmp_path, capsys):
    path = tmp_path / "run.csv"
    path.write_text("time [s],pressure [bar],what\n0,0.1,5\n0.1,0.1,6\n0.2,0.1,6\n0.4,0.1,7\n")
    assert main(["check", str(path)]) == 0
    said = capsys.readouterr().out
    for words in (
        "4 rows from 0 to 0.4 s, 0.1 s apart",
        "note  'what' was left out: it has no known unit",
        "note  1 row missing between 0.2 and 0.4 s",
        "column  pressure: 10000 to 10000 Pa, never changes",
        "cannot serve  the response to a step (Figure 4.5, Table 3.C, Table 4.C):\n"
        "        it lacks the columns angle, reference",
        "area and lead of the pump in the header",
    ):
        assert words in said
    assert main(["check", str(path), str(tmp_path / "none.csv")]) == 2
    assert "none.csv: expected a file, got none" in capsys.readouterr().err
    assert main(["check", "--json", str(path)]) == 0
    (told,) = json.loads(capsys.readouterr().out)
    assert told["rows"] == 4
    assert told["columns"] == [{"name": "pressure", "low": 1e4, "high": 1e4, "unit": "Pa"}]


def test_a_step_that_ends_too_early_cannot_serve(tmp_path):
    path = tmp_path / "run.csv"
    rows = "".join(f"{0.05 * k:.2f},{min(k, 9)},9\n" for k in range(20))
    path.write_text("time [s],angle [deg],reference [deg]\n" + rows)
    words = (
        "the response to a step (Figure 4.5, Table 3.C, Table 4.C):\n        expected a step and"
    )
    assert f"cannot serve  {words}" in str(contents(path))
