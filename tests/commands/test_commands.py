"""The command ``softgrip``: its own examples run, errors are one line, JSON is in SI."""

import json
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from softgrip.actuator.stl import read_stl
from softgrip.commands.__main__ import COMMANDS, main, module
from softgrip.logs.reader import kept_log
from softgrip.rig import fit as rig_fit

E, N = 0.12e6, 1.6
GAUGE, AREA = 30e-3, 12e-6


def example(name):
    """Return the commands of a command's example, without its name and line breaks."""
    _, _, text = str(module(name).__doc__).partition("Example::\n\n")
    lines = text.replace("\\\n", " ").strip().splitlines()
    return [shlex.split(line)[1:] for line in lines]


EXAMPLES = [pytest.param(words, id=" ".join(words)) for name in COMMANDS for words in example(name)]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder of what the examples name."""
    for name, log in {
        "run.csv": "pid-full", "run-1.csv": "pid-full", "lqr.csv": "lqr-printed",
        "step.csv": "step-60-1", "push.csv": "push-a",
    }.items():  # fmt: skip
        shutil.copy(kept_log(log), tmp_path / name)
    strain = np.linspace(0, 3, 40)
    columns = 1e3 * GAUGE * strain, AREA * E * strain**N
    rows = "".join(f"{x:.6f},{y:.6f}\n" for x, y in zip(*columns, strict=True))
    (tmp_path / "rubber.csv").write_text("Extension [mm],Force [N]\n" + rows)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def found(pattern):
    """Return the files that a shell would put in place of a pattern."""
    return sorted(map(str, Path().glob(pattern)))


def run(*words):
    """Return the exit code of a command, also where its arguments are refused."""
    try:
        return main(list(words))
    except SystemExit as error:
        return error.code


def test_all_commands_have_an_example():
    assert all(str(module(name).__doc__).startswith(about) for name, about in COMMANDS.items())
    assert all(example(name) for name in COMMANDS)
    assert all(words[0] == name for name in COMMANDS for words in example(name))


@pytest.mark.parametrize("words", EXAMPLES)
def test_example_of_the_help_runs(words, folder, capsys, monkeypatch):
    if words[:2] == ["fit", "rig"]:  # takes minutes, and has tests of its own
        monkeypatch.setattr(rig_fit, "fit_rig", lambda logs, **others: list(map(str, logs)))
        monkeypatch.setattr(rig_fit, "fitted", lambda found: found)
        monkeypatch.setattr(rig_fit, "write_rig", lambda rig, path, source: path)
        monkeypatch.setattr(rig_fit, "report", lambda found: " ".join(found))
    if words[0] == "record":  # neither over a log, nor with a motor
        (folder / words[words.index("-o") + 1]).unlink()
        words = ["simulated" if word.startswith("/dev/") else word for word in words]
    words = [name for word in words for name in (found(word) if "*" in word else [word])]
    code = main(words)
    shown = capsys.readouterr()
    assert code == (0 if words[0] != "accept" else code)
    assert code in (0, 1)
    assert shown.out.strip()
    assert "Traceback" not in shown.err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["check", "none.csv"], "none.csv"),
        (["check", "rubber.csv"], "a column 'time'"),
        (["accept", "push.csv", "--experiment", "lqr"], "reference"),
        (["accept", "lqr.csv", "--experiment", "other"], "'lqr', 'pid'"),
        (["fit", "material", "run.csv"], "strain"),
        (["fit", "material", "rubber.csv"], "gauge_length="),
        (["fit", "material", "rubber.csv", "--column", "force"], "WHAT=HEADING"),
        (["fit", "material", "rubber.csv", "--column", "mood=x"], "valid are: strain"),
        (["fit", "material", "rubber.csv", "--gauge-length", "30 N", "--area", "1 mm^2"], "'N'"),
        (["fit", "rig", "rubber.csv", "-o", "mine.csv"], "rubber.csv"),
        (["fit", "other"], "material"),
        (["design", "--pressure", "80 mm"], "'mm'"),
        (["design", "--length", "110"], "probably mm"),
        (["design", "--material", "Dragon"], "valid are: "),
        (["design", "--rubber", "2 mm"], "'mm'"),
        (["design", "--rubber", "2 g"], "rubber of 0.002 kg at most; proved"),
        (["design", "--buckling", "-1"], "buckling"),
        (["design", "--chambers", "20", "--stl", "mould"], "room for 20"),
        (["design", "--chambers", "0", "--stl", "mould"], "at least 1"),
        (["design", "--length", "250 mm", "--stl", "mould"], "bed of 200 mm"),
        (["design", "--stl", "run.csv"], "run.csv"),
        (["record", "nowhere", "-o", "new.csv", "--travel", "5 mm"], "nowhere"),
        (["record", "simulated", "-o", "run.csv", "--travel", "5 mm"], "a new file"),
        (["record", "simulated:x", "-o", "new.csv", "--travel", "5 mm"], "valid are: simulated"),
        (["figures", "Figure 99.1"], "valid are: "),
        (["figures", "--log", "run.csv"], "names"),
        (["other"], "check"),
        ([], "COMMAND"),
    ],
)
def test_what_cannot_be_done_is_said_in_one_line(words, told, folder, capsys):
    assert run(*words) == 2
    said = capsys.readouterr().err
    assert told in said
    assert "Traceback" not in said
    assert "usage" in said or said.count("\n") == 1


def test_design_writes_a_mould_in_mm_and_says_so(folder, capsys):
    assert run("design", "--rubber", "28 g", "--chambers", "5", "--length", "80 mm",
               "--stl", "new/mould", "--json") == 0  # fmt: skip
    found = json.loads(capsys.readouterr().out)
    files = [Path(name) for name in found["stl"]]
    assert files == [Path("new/mould") / f"{part}.stl" for part in ("upper", "lower", "core")]
    upper, lower, core = map(read_stl, files)
    side = found["section"]
    np.testing.assert_allclose(lower.size, [86, 1e3 * side["width"] + 6,
                                            1e3 * side["bottom"] + 3], rtol=1e-6)  # fmt: skip
    # What the trays hold, less what the core takes of it, is the rubber that is said.
    outside = sum(np.prod(part.size) - part.volume for part in (upper, lower))
    plugs = core.volume - np.prod(core.size[:2]) * 3
    assert (outside - plugs) * 1e-9 * 1080 == pytest.approx(found["mass"], rel=1e-6)
    assert found["mass"] == pytest.approx(0.028, rel=1e-5)
    assert run("design", "--rubber", "28 g", "--stl", "other") == 0
    said = capsys.readouterr().out
    assert "written, in mm: other/core.stl" in said
    assert "g of rubber of 1080 kg/m^3" in said


def test_band_that_fails_is_1_and_json_says_which(folder, capsys):
    """A log that is judged as another experiment's fails."""
    assert run("accept", "lqr.csv", "--experiment", "pid", "--json") == 1
    bands = json.loads(capsys.readouterr().out)["bands"]
    assert any(band["passed"] for band in bands)
    assert not all(band["passed"] for band in bands)


def test_json_of_a_fit_is_in_si(folder, capsys):
    sizes = ["--gauge-length", "30 mm", "--area", "12 mm^2"]
    assert run("fit", "material", "rubber.csv", *sizes, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["young_modulus"]["value"] == pytest.approx(E, rel=1e-3)
    assert found["fractional_power"]["value"] == pytest.approx(N, rel=1e-3)


def test_json_of_a_check_is_in_si(folder, capsys):
    assert run("check", "--json", "push.csv") == 0
    (found,) = json.loads(capsys.readouterr().out)
    pressure = next(one for one in found["columns"] if one["name"] == "pressure")
    assert pressure["unit"] == "Pa"
    assert 1e5 < pressure["high"] < 1e6
    assert found["period"] == pytest.approx(0.025)


def test_json_of_a_design_is_in_si(capsys):
    assert run("design", "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["certificate"]["proven"]
    assert all(1e-4 < size < 0.1 for size in found["design"]["section"].values())


def test_console_entry():
    entry = Path(sys.executable).with_name("softgrip")
    done = subprocess.run([entry, "check", "none.csv"], capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "none.csv" in done.stderr
