"""A rig judged against the printed numbers."""

import numpy as np
import pytest

from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.fingers import column
from softgrip.logs.schema import LogHeader
from softgrip.logs.writer import LogWriter
from softgrip.provenance import Provenance, data_folder
from softgrip.rig.__main__ import main
from softgrip.rig.acceptance import SETTLING, judge, report
from softgrip.units import DEG

FOLDER = data_folder() / "simulated"


def write(path, *, settling=2.38, noise=2.0, error=0.0, fingers=1, period=0.025, counts=500):
    """Write a step to 60 deg whose first-order rise enters 5 % at a time, of angles in deg."""
    rng, target = np.random.default_rng(3), 60.0
    units = {}
    for finger in range(fingers):
        units[column("reference", finger)] = "rad"
        if finger:
            units |= {column("angle_counts", finger): "count", column("angle", finger): "rad"}
    header = LogHeader(Provenance.SIMULATED, "a test", "simulated rig", period)
    with LogWriter(path, header, more=units) as log:
        for k in range(round(20 / period)):
            row = {"time": k * period, "command": 0.0, "pressure": 1e4, "pressure_counts": 117}
            for finger in range(fingers):
                angle = (target - error) * (1 - np.exp(-np.log(20) * k * period / settling))
                row[column("angle", finger)] = (angle + noise * rng.standard_normal()) * DEG
                row[column("angle_counts", finger)] = counts
                row[column("reference", finger)] = target * DEG
            log.write(**row)
    return path


def failed(bands):
    return [band.quantity.partition(": ")[2] or band.quantity for band in bands if not band.passed]


@pytest.mark.parametrize(
    ("experiment", "fingers", "period"), [("lqr", 1, 0.025), ("pid", 1, 0.025), ("gripper", 2, 0.1)]
)
def test_a_step_like_the_printed_one_passes(path, experiment, fingers, period):
    settling = SETTLING[experiment][0]
    write(path, settling=settling, fingers=fingers, period=period, noise=0.5)
    bands = judge(path, experiment)
    assert failed(bands) == []
    assert len(bands) == 2 + 3 * fingers


def test_the_noise_that_was_put_in_is_found(path):
    noise = {band.quantity: band.found for band in judge(write(path), "pid")}
    # 80 samples at the end: a root mean square of them is good to 8 %.
    assert noise["finger 1: noise of the flex sensor"] == pytest.approx(2.0, rel=0.25)


@pytest.mark.parametrize(
    ("changes", "wrong"),
    [
        ({"settling": 4.0, "noise": 0.5}, "settled within 5 % of its own end"),
        ({"settling": 1.2, "noise": 0.5}, "settled within 5 % of its own end"),
        ({"error": 5.0, "noise": 0.5}, "steady-state error"),
        ({"noise": 0.0}, "noise of the flex sensor"),
        ({"noise": 0.5, "counts": 1023}, "samples at an end of the converter"),
    ],
)
def test_each_fault_fails_its_own_band(path, changes, wrong):
    assert failed(judge(write(path, **changes), "pid")) == [wrong]


def test_too_much_noise_fails(path):
    assert "noise of the flex sensor" in failed(judge(write(path, noise=4.0), "pid"))


def test_the_simulated_rig_is_told_from_the_printed_one():
    # It was tuned to other numbers than these; that its PID rests later is a finding (Chapter 4).
    bands = judge(FOLDER / "pid-full.csv", "pid")
    assert failed(bands) == ["settled within 5 % of its own end"]


def test_the_report_counts(path):
    text = report(judge(write(path, settling=9.0), "pid"))
    assert text.endswith("4 of 5 bands passed")
    assert "FAIL  finger 1: settled" in text


def test_what_cannot_be_judged_is_refused():
    with pytest.raises(DataFileError, match="constant reference"):
        judge(FOLDER / "gripper-open-1.csv", "gripper")
    with pytest.raises(DataFileError, match="constant reference"):
        judge(FOLDER / "staircase.csv", "pid")
    with pytest.raises(InvalidInputError, match="experiment"):
        judge(FOLDER / "pid-full.csv", "guess")


def test_the_command_says_it_by_its_exit_code(path, tmp_path, capsys):
    assert main(["accept", str(write(path, noise=0.5)), "--experiment", "pid"]) == 0
    assert "5 of 5 bands passed" in capsys.readouterr().out
    assert main(["accept", str(FOLDER / "pid-actuator.csv"), "--experiment", "pid"]) == 1
    assert main(["accept", str(tmp_path / "none.csv"), "--experiment", "pid"]) == 2
