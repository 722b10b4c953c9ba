"""A rig fitted to logs: hidden parameters found, the file, the command, and what to do next."""

import json

import numpy as np
import pytest

from softgrip.control.pid import PERIOD
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.provenance import data_folder
from softgrip.rig.__main__ import main
from softgrip.rig.connect import connect
from softgrip.rig.fit import base_rig, fit_rig
from softgrip.rig.fit_coverage import KEPT, hidden_rig, reader_logs
from softgrip.rig.fit_report import report
from softgrip.rig.record import record
from softgrip.rig.simulated import SimulatedRig
from softgrip.simulator import fit_problem, inference
from softgrip.simulator.free_parameters import parameter_values
from softgrip.simulator.inference import OVER
from softgrip.simulator.next_experiment import candidates, expected
from softgrip.simulator.rig_file import read_rig
from softgrip.simulator.simulation import Simulation
from softgrip.simulator.trial import read_trial
from softgrip.units import ML
from tests.board.emulated import needs_emulator
from tests.logs.test_gaps import rewrite, without

FOLDER = data_folder() / "simulated"
STEP, PUSH = FOLDER / "step-60-1.csv", FOLDER / "push-a.csv"
FIRST = "start 1 of 1"
NUMBER = 1
"""Of the hidden rig; nothing hangs on which."""


@pytest.fixture(scope="module")
def logs(tmp_path_factory):
    return reader_logs(hidden_rig(NUMBER), tmp_path_factory.mktemp("logs"), seed=NUMBER)


@pytest.fixture(scope="module")
def found(logs):
    return fit_rig(logs)


def interrupted(*_args, **_options):
    raise KeyboardInterrupt


@pytest.fixture
def quick(monkeypatch):
    """Fits that begin at one place only."""
    monkeypatch.setattr(inference, "STARTS", 1)


def misses(found, truth):
    """Distances of the truth from an interval's middle, in half widths, of what is told."""
    values = parameter_values(truth)
    return {
        one.name: abs(2 * np.log(values[one.name] / one.low) / np.log(one.high / one.low) - 1)
        for one in found.estimates
        if one.told
    }


def test_hidden_parameters_are_found(found):
    missed = misses(found, hidden_rig(NUMBER))
    # Some of 90 % intervals miss; twice the half width is 3.3 standard deviations.
    assert max(missed.values()) < 2
    assert {"finger.stiffness", "finger.fractional_power", "finger.damping"} <= set(missed)
    for size in found.misfit:
        assert size == pytest.approx(1.0, abs=0.15)


def test_what_the_report_says(found):
    words = report(found)
    told, unknown = words.split("these logs cannot tell:")
    assert "finger.stiffness" in told
    assert "finger.memory_time[1]" in unknown
    assert "gas.dead_volume" in unknown
    assert "record(rig, commands, len(commands) * rig.period" in unknown
    assert "the model does not follow" not in words


def test_the_intervals_hold_the_truth_as_often_as_they_say():
    rows = KEPT.read()
    told, held = sum(row.told for row in rows), sum(row.told_held for row in rows)
    # Parameters of one fit err together; half of them as independent gives this bound.
    deviation = (0.9 * 0.1 / (told / 2)) ** 0.5
    assert held / told > 0.9 - 2 * deviation
    assert all(row.rigs == rows[0].rigs for row in rows)


def test_the_command_writes_a_rig_that_can_be_driven(logs, quick, monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(inference, "MOST_ROUNDS", 1)  # what it finds does not matter here
    path = tmp_path / "my-rig.csv"
    assert main(["fit", *map(str, logs), "-o", str(path)]) == 0
    assert "these logs cannot tell:" in capsys.readouterr().out
    own = read_rig(path)
    assert [name.split()[0] for name in own.logs] == ["step.csv", "push.csv"]
    assert not path.with_name("my-rig.csv.part").exists()
    with connect(f"simulated:{path}", seed=2) as rig:
        assert (rig.fingers, rig.period) == (1, PERIOD)
        assert rig.rig.parameters == own.rig
        assert rig.header().calibration == "my-rig.csv"
        rig.home()
        made = record(rig, np.full(40, 5.0), 1.0, tmp_path / "run.csv")
    assert made.samples == 41
    assert main(["check", "--port", f"simulated:{path}"]) == 0


def test_an_interrupted_fit_goes_on(logs, quick, found, tmp_path):
    part = tmp_path / "my-rig.csv.part"

    def interrupt(words):
        if words == "fit, round 2":
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fit_rig(logs, part=part, progress=interrupt)
    assert set(json.loads(part.read_text())["stages"]) == {FIRST, FIRST + OVER, "fit"}
    told = []
    again = fit_rig(logs, part=part, progress=told.append)
    assert {words.split(", round")[0] for words in told} == {"fit", "fit with the real noise"}
    assert not part.exists()
    # Nearer than what a least-squares search calls the same, in standard deviations.
    assert again.point == pytest.approx(found.point, abs=0.1)


def test_what_is_left_of_another_fit_is_no_beginning(logs, quick, tmp_path):
    part = tmp_path / "my-rig.csv.part"
    for text in ('{"key": "another", "stages": {"fit": [0.0]}}', "{", "[]"):
        part.write_text(text)

        def interrupt(words):
            assert words == f"{FIRST}, round 1"
            raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            fit_rig(logs, part=part, progress=interrupt)


def test_a_further_log_tells_what_is_expected(found, quick, logs, tmp_path):
    """Shut at the finger: the compression that is advised is recorded, and fitted with the rest."""
    clamped = next(one for one in candidates(found) if one.clamped)
    foreseen = next(one for one in expected(found) if one.candidate == clamped)
    truth = hidden_rig(NUMBER)
    shut = fit_problem._clamped(truth)
    path = tmp_path / "clamped.csv"
    with SimulatedRig(Simulation(shut, seed=NUMBER, first=2, period=PERIOD)) as rig:
        rig.home()
        commands = clamped.commands(PERIOD)
        record(rig, commands, len(commands) * PERIOD, path)
    again = fit_rig(logs, clamped=[path])
    assert set(foreseen.told) <= {one.name for one in again.estimates if one.told}
    assert max(misses(again, truth).values()) < 2
    before = np.sqrt(np.diag(found.covariance))
    names = [one.name for one in found.problem.space]
    k = names.index("gas.dead_volume")
    assert np.sqrt(again.covariance[k, k]) < before[k] / 3


def test_no_candidate_goes_deeper_than_the_logs(found):
    deepest = max(one.deepest for one in found.problem.trials)
    pump = found.rig.pump
    for one in candidates(found):
        travel = np.cumsum(one.commands(PERIOD)) * PERIOD * pump.advance
        assert travel.max() <= deepest * (1 + 1e-9), one.name
        assert np.abs(one.speeds).max() <= pump.speed_limit


def test_pressure_alone_and_a_gap(quick, tmp_path):
    """A dead flex sensor, and ten rows that got lost: what can be told is told."""
    path = tmp_path / "push.csv"
    rewrite(path, PUSH, lambda rows: [[*row[:3], "300", *row[4:]] for row in rows])
    without(tmp_path / "gap.csv", path, range(50, 60))
    found = fit_rig([tmp_path / "gap.csv"])
    assert np.isnan(found.misfit[0][1])
    told, unknown = report(found).split("these logs cannot tell:")
    assert "column 'angle' was left out: it never changes" in told
    assert "finger.rest_volume" in told
    assert "sensors.angle_lag" in unknown
    assert found.rig.sensors.angle_noise == base_rig(read_trial(PUSH), None).sensors.angle_noise


def test_logs_of_two_rigs():
    with pytest.raises(DataFileError, match=r"gripper-open-1\.csv: expected a log of the same rig"):
        fit_rig([STEP, FOLDER / "gripper-open-1.csv"])
    with pytest.raises(InvalidInputError, match="logs: expected one or more"):
        fit_rig([])


def test_a_syringe_that_nobody_knows(path):
    path.write_text(STEP.read_text().replace("area: 0.000661", "area: 0.0007"))
    with pytest.raises(InvalidInputError, match=r"its volume, for an area of 0\.0007"):
        base_rig(read_trial(path), None)
    rig = base_rig(read_trial(path), 50 * ML)
    assert (rig.pump.area, rig.pump.syringe_volume) == (0.0007, 50 * ML)
    assert base_rig(read_trial(FOLDER / "gripper-open-1.csv"), None).pump.syringe_volume == 150 * ML


def test_the_command_says_what_is_wrong(tmp_path, monkeypatch, capsys):
    step, rig = str(STEP), str(tmp_path / "rig.csv")
    assert main(["fit", step, "--weight", step, "heavy", "-o", rig]) == 2
    assert "--weight: expected LOG and a torque, N m, got 'heavy'" in capsys.readouterr().err
    assert main(["fit", step, "--syringe", "-1", "-o", rig]) == 2
    assert "syringe_volume: expected a finite number > 0" in capsys.readouterr().err
    monkeypatch.setattr("softgrip.rig.fit.infer", interrupted)
    assert main(["fit", step, "-o", rig]) == 130
    assert f"it goes on from {rig}.part" in capsys.readouterr().err
    path = tmp_path / "no.csv"
    assert main(["fit", str(path), "-o", str(tmp_path / "rig.csv")]) == 2
    assert str(path) in capsys.readouterr().err
    assert main(["check", "--port", f"simulated:{path}"]) == 2
    assert "a file, got none" in capsys.readouterr().err


@needs_emulator
def test_the_emulated_board(quick, path):
    """Its plunger begins 2 mm from home: homed, it has too little air, which the fit finds."""
    with connect("emulated", seed=1) as rig:
        rig.home()
        record(rig, np.repeat([8.0, 0.0], [80, 80]), 4.0, path)
        truth = rig.session.link.plant.parameters
    found = fit_rig([path])
    assert max(misses(found, truth).values()) < 2
    _, start, zeros = found.problem.split(found.point, 0)
    # One cannot tell a start from a zero of the sensor by a row or two at rest, but their sum.
    assert start < 0
    assert start + zeros[0] == pytest.approx(-1900, abs=500)
