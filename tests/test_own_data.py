"""What people of the field bring, each for a kind of fault, with the right values known."""

import csv

import numpy as np
import pytest

from softgrip.actuator.certificate import certified_design
from softgrip.actuator.design import Bounds, DesignProblem
from softgrip.board.calibration import DividerCurve, fit_sensor
from softgrip.control.ziegler_nichols import reaction_curve, ziegler_nichols
from softgrip.dynamics.identify import identify
from softgrip.errors import DataFileError, FitWarning, InvalidInputError
from softgrip.logs.contacts import read_contacts
from softgrip.logs.reader import read_log
from softgrip.materials import ludwick, tensile
from softgrip.materials.fitting import Fitting, fit
from softgrip.materials.tester import read_export
from softgrip.pump.capacity import estimate
from softgrip.pump.elastance import ElastanceModel, NoiseLevels, Prior
from softgrip.rig.__main__ import main
from softgrip.rig.replay import Replay
from softgrip.tactile.contact_kind import nearest_neighbours
from softgrip.tactile.kind_evaluation import accuracy, cross_validated
from softgrip.tactile.own_pad import read_readings
from tests.conftest import CASES

pytestmark = pytest.mark.skipif(not CASES.is_dir(), reason="needs the inputs: SOFTGRIP_CASES_DIR")


def columns(name):
    with (CASES / name).open(newline="") as stream:
        return np.array([[float(cell) for cell in row] for row in [*csv.reader(stream)][1:]]).T


def test_noisy_reaction_curve():
    curve = reaction_curve(*columns("reaction-noisy.csv"))
    # Noise of 0.5 % makes the delay uncertain by 2 %.
    assert curve.delay == pytest.approx(0.5, rel=0.03)
    assert curve.delay_interval[0] < 0.5 < curve.delay_interval[1]
    assert curve.slope == pytest.approx(2 / 3, rel=0.01)
    assert ziegler_nichols(curve).kp == pytest.approx(3.6, rel=0.03)


def test_step_with_a_dead_time():
    found = identify(*columns("step-dead-time.csv"), hold="zero")
    for estimate_of, true in (
        (found.natural_frequency, 2.86),
        (found.damping_ratio, 0.70),
        (found.dead_time, 0.1),
    ):
        assert estimate_of.low < true < estimate_of.high
        assert estimate_of.value == pytest.approx(true, rel=0.05)


def test_flex_sensor_in_a_divider():
    counts, angle = columns("flex-divider.csv")
    curve = fit_sensor(counts, angle)
    assert isinstance(curve, DividerCurve)
    # Counts are given to 0.1, which is 0.06 deg at the flat end.
    assert np.abs(curve.value(counts) - angle).max() < 0.1
    with pytest.raises(InvalidInputError, match="off a line"):
        fit_sensor(counts, angle, curve="line")


@pytest.mark.parametrize("missing", [[], [30], [0, 1, 80, 163]])
def test_capacity_over_lost_rows(missing):
    time, pressure, flow = columns("capacity-rows-lost.csv")
    pressure[missing] = np.nan
    noise = NoiseLevels(pressure_step=40.0, elastance_step=1e5, sensor=150.0)
    model = ElastanceModel(0.025, noise, Prior(0.0, 200.0, 1e9, 3e8))
    found = estimate(pressure, flow, 0 * flow, model, time=time)
    assert found.capacity[-1] == pytest.approx(1.20e-9, rel=0.02)


def test_time_column_is_no_channel_and_noise_is_chance():
    file = CASES / "pad-time-column.csv"
    with pytest.raises(DataFileError, match="time: its name is that of a clock"):
        read_readings(file, label="kind")
    elements = ["e1", "e2", "e3", "e4"]
    found = read_readings(file, label="kind", channels=elements)
    right = accuracy(cross_validated(nearest_neighbours(), found.voltages, found.labels, seed=0))
    low, high = right.interval()
    assert low < 0.46 < high


@pytest.mark.parametrize("name", ["bar", "mmHg", "rpm"])
def test_log_in_other_units_is_its_twin(name):
    found, twin = read_log(CASES / f"log-step-{name}.csv"), read_log(CASES / "log-step-rad.csv")
    assert any("was converted" in words for words in found.repairs)
    for column, values in found.columns.items():
        # The cells have five digits.
        assert values == pytest.approx(twin[column][: values.size], rel=5e-5)


@pytest.mark.parametrize("read", [read_log, Replay])
def test_period_in_ms_is_refused(read):
    with pytest.raises(DataFileError, match="rows 50 s apart, the period of the header"):
        read(CASES / "log-step-period-in-ms.csv")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("log-step-1hz", "expected rows 0.25 s apart or less"),
        ("log-pad-m", "expected a log of the gripper, got pad"),
        ("log-step-bar", "expected a step and more than 2 s after it"),
    ],
)
def test_log_that_cannot_be_judged_has_not_failed(name, words, capsys):
    assert main(["accept", str(CASES / f"{name}.csv"), "--experiment", "pid"]) == 2
    assert words in capsys.readouterr().err


def test_contacts_of_a_slow_log():
    found = read_contacts(CASES / "log-pad-m.csv")
    assert found.kinds.tolist() == ["point", "point", "surface"]
    assert found.places == pytest.approx(np.array([[0.011, 0.01], [-0.0055, 0], [0, -0.01]]))


def test_blanks_in_a_header_are_not_of_its_names():
    found = read_readings(CASES / "pad-header-spaces.csv", label="kind")
    assert found.channels == ("e1", "e2")
    assert found.labels.tolist() == ["point", "line", "point", "line"]


def test_empty_label_is_refused():
    with pytest.raises(DataFileError, match="line 4: expected a label"):
        read_readings(CASES / "pad-empty-label.csv", label="kind")


@pytest.mark.parametrize(
    ("name", "sizes", "young_modulus"),
    [
        ("bluehill-like", {"gauge_length": "30 mm", "area": "12 mm^2"}, 0.12e6),
        ("own-material", {}, 0.12e6),
        ("preload", {}, 0.10e6),
    ],
)
def test_tensile_tests_of_own_materials(name, sizes, young_modulus):
    test = read_export(CASES / f"tensile-{name}.csv", **sizes).test
    found = ludwick.fit(test.strain, test.stress)
    assert found.young_modulus == pytest.approx(young_modulus, rel=1e-3)
    assert found.fractional_power == pytest.approx(1.6, abs=1e-3)


def test_material_that_is_not_in_the_table_holds_its_own_modulus():
    test = tensile.parse(CASES / "tensile-own-material.csv")
    # Its law is one of the engineering stress: the true one is no power, which is said.
    with pytest.warns(FitWarning, match="misses the curve"):
        assert fit(test, Fitting()).young_modulus == pytest.approx(0.12e6, rel=1e-3)
    assert fit(test, Fitting("engineering")).fractional_power == pytest.approx(1.6, abs=1e-3)


@pytest.mark.parametrize("loss", ["stress", "log", "strain"])
def test_preload_that_was_not_taken_off_is_warned_of(loss):
    with pytest.warns(FitWarning, match="begins at 2e.04 Pa at strain 0"):
        ludwick.fit(*columns("tensile-preload.csv"), loss=loss)


def test_finger_of_110_m_is_refused_and_one_of_110_mm_taken():
    millimetres = {
        "top": (6, 12), "bottom": (1, 4), "width": (12, 20), "wall": (1.5, 3), "height": (8, 16)
    }  # fmt: skip
    with pytest.raises(InvalidInputError, match="probably mm"):
        certified_design(DesignProblem(pressure=20e3, length=110, bounds=Bounds(**millimetres)))
    words = {name: (f"{a} mm", f"{b} mm") for name, (a, b) in millimetres.items()}
    meant = DesignProblem(pressure="20 kPa", length="110 mm", bounds=Bounds(**words))
    assert (meant.pressure, meant.length) == pytest.approx((20e3, 0.11))
    assert meant.bounds.height == pytest.approx((8e-3, 16e-3))
