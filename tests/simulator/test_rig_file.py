"""A rig in a file: the same rig again, and damage that is refused."""

import pytest

from softgrip.errors import DataFileError
from softgrip.provenance import Provenance
from softgrip.simulator.rig_file import FittedRig, Line, lines_of, read_rig, write_rig
from tests.simulator.rigs import design_1, printed_gripper


def fitted(rig):
    value = rig.finger.stiffness
    known = [Line("finger.stiffness", value, 0.9 * value, 1.2 * value, "told")]
    logs = ("step.csv 0123456789ab", "push.csv ba9876543210")
    return FittedRig(rig, 0.1, Provenance.LOGGED, logs, lines_of(rig, known))


@pytest.fixture
def written(path):
    return write_rig(fitted(design_1()), path, source="a test")


@pytest.mark.parametrize("rig", [design_1(), printed_gripper()], ids=["finger", "gripper"])
def test_round_trip(rig, path):
    assert read_rig(write_rig(fitted(rig), path, source="a test")) == fitted(rig)


DAMAGES = {
    "other columns": ("parameter [unit],value", "name,value", r"line 6: expected the columns"),
    "no such parameter": ("finger.inertia [", "finger.length [", r"line 9: .*finger\.length"),
    "no unit": ("pump.lead [m]", "pump.lead", r"line \d+: expected pump\.lead in m, got ''"),
    "another unit": ("pump.lead [m]", "pump.lead [mm]", r"pump\.lead in m, got 'mm'"),
    "no number": (",2.5,", ",two,", "line 8: .*a finite number in column 'value', got 'two'"),
    "infinite": (",2.5,", ",inf,", "line 8: .*column 'value', got 'inf'"),
    "out of range": (",2.5,", ",0.5,", "fractional_power: expected >= 1, got 0.5"),
    "runs alike in nothing": ("spread.leakage [1],", "spread.leakage [1],9", "a spread of at most"),
    "no status": (",told", ",said", "line 7: expected a status of .*got 'said'"),
    "short": ("pump.area [m^2],0.000661,,,given", "pump.area [m^2],0.000661", "expected 5 cells"),
    "missing": ("pump.area [m^2],0.000661,,,given\n", "", "a row for pump.area, got none"),
    "twice": ("pump.lead [m],0.008,,,given\n", "pump.lead [m],0.008,,,given\n" * 2, "each .*once"),
    "bits in halves": ("sensors.bits [1],10", "sensors.bits [1],10.5", "sensors.bits"),
    "another schema": ("softgrip-rig 1", "softgrip-rig 9", "schema: softgrip-rig 1"),
    "no schema": ("schema: softgrip-rig 1", "schema: ", "schema: softgrip-rig 1'.*got ''"),
    "no period": ("period: 0.1", "period: soon", "column 'period', got 'soon'"),
}  # fmt: skip


@pytest.mark.parametrize(("before", "after", "words"), DAMAGES.values(), ids=DAMAGES)
def test_damage_is_refused(before, after, words, written):
    text = written.read_text()
    assert before in text
    written.write_text(text.replace(before, after, 1))
    with pytest.raises(DataFileError, match=words) as error:
        read_rig(written)
    assert str(error.value).startswith(str(written))


def test_an_interval_that_does_not_hold_its_value(written):
    text = written.read_text().splitlines()
    row = next(k for k, line in enumerate(text) if line.startswith("finger.stiffness"))
    cells = text[row].split(",")
    for low, high in ((cells[3], cells[2]), ("", cells[3]), ("nan", cells[3])):
        text[row] = ",".join([*cells[:2], low, high, cells[4]])
        written.write_text("\n".join([*text, ""]))
        with pytest.raises(DataFileError, match=f"line {row + 1}: .*low"):
            read_rig(written)


def test_a_file_that_is_none(tmp_path):
    with pytest.raises(DataFileError, match="a file, got none"):
        read_rig(tmp_path / "no-rig.csv")
