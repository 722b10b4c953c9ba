"""Three further inputs of each kind of fault, with right values by construction, or refused."""

import re

import numpy as np
import pytest

from softgrip.actuator.certificate import certified_design
from softgrip.actuator.design import DesignProblem
from softgrip.board.calibration import DividerCurve, fit_sensor
from softgrip.control.differentiator import PolynomialDifferentiator, RobustDifferentiator
from softgrip.control.state_feedback import ObserverFeedback
from softgrip.control.ziegler_nichols import integrating_reaction_curve, reaction_curve
from softgrip.dynamics.identify import identify
from softgrip.dynamics.second_order import SecondOrder, response
from softgrip.errors import DataFileError, InvalidInputError, LeftOutWarning, NotFiniteError
from softgrip.logs.pump import pump_of
from softgrip.logs.reader import read_log
from softgrip.logs.steps import judge_step_log
from softgrip.materials import ludwick
from softgrip.materials.powerlaw import predict_power
from softgrip.materials.tester import read_export
from softgrip.pump.flow import Pump
from softgrip.rig.__main__ import main
from softgrip.tactile.contact_kind import nearest_neighbours
from softgrip.tactile.kind_evaluation import accuracy, cross_validated
from softgrip.tactile.own_pad import read_readings

T = np.arange(0, 6, 0.05)
ANGLE = 1 - np.exp(-2 * T) * (1 + 2 * T)
TARGET = np.ones_like(T)
STRAIN = np.linspace(0, 3, 61)
E, N = 0.12e6, 1.6
STRESS = E * STRAIN**N


@pytest.fixture
def write(tmp_path):
    def made(text, encoding="utf-8"):
        path = tmp_path / "mine.csv"
        path.write_bytes(text.encode(encoding))
        return path

    return made


def table(names, *columns, separator=",", decimal="."):
    rows = [
        separator.join(f"{x:.9g}".replace(".", decimal) for x in row)
        for row in zip(*columns, strict=True)
    ]
    return "\n".join([separator.join(names), *rows, ""])


STEP = ("time [s]", "angle [rad]", "reference [rad]")
GERMAN = table(STEP, T, ANGLE, TARGET, separator=";", decimal=",")


@pytest.mark.parametrize(
    ("column", "unit", "factor"),
    [("flow", "L/min", 1e-3 / 60), ("torque", "N mm", 1e-3), ("contact_x", "cm", 1e-2)],
)
def test_units_of_columns_beside_those_of_the_rig(write, column, unit, factor):
    log = read_log(write(table(["time [ms]", f"{column} [{unit}]"], 1e3 * T, ANGLE)))
    assert log["time"] == pytest.approx(T)
    assert log[column] == pytest.approx(factor * ANGLE)


@pytest.mark.parametrize("unit", ["kPa", "rad/s", "furlong"])
def test_angle_in_a_unit_that_is_none_of_one(write, unit):
    with pytest.raises(DataFileError, match=rf"angle as .*rad.*'{unit}'"):
        read_log(write(table(["time [s]", f"angle [{unit}]"], T, ANGLE)))


@pytest.mark.parametrize(
    "kept",
    [
        pytest.param(np.delete(np.arange(T.size), [3, 17, 30, 31, 70]), id="rows lost"),
        pytest.param(np.delete(np.arange(T.size), 1), id="the second row lost"),
        pytest.param(np.arange(T.size)[::2], id="every other row"),
    ],
)
def test_settling_time_goes_by_the_time_column(write, kept):
    # (1 + 2 t) exp(-2 t) = 0.05 at t = 2.372 s.
    found = judge_step_log(write(table(STEP, T[kept], ANGLE[kept], TARGET[kept])))
    # Averaging over 0.5 s makes what is left of exp(-2 t) larger by 4 %, which is 0.02 s.
    assert float(found.settled_5_percent) == pytest.approx(2.372, abs=0.05)


@pytest.mark.parametrize(
    ("time", "line"),
    [
        (np.where(T > 3, T - 3, T), 63),
        (np.where(np.arange(T.size) == 40, T[39], T), 42),
        (np.where(np.arange(T.size) == 40, 0.5, T), 42),
    ],
    ids=["reset", "standing", "one row backward"],
)
def test_time_that_does_not_run_on_is_refused_with_its_line(write, time, line):
    with pytest.raises(DataFileError, match=f"line {line}: expected a time above"):
        read_log(write(table(STEP, time, ANGLE, TARGET)))


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(table(STEP, T[:1], ANGLE[:1], TARGET[:1]), id="one row"),
        pytest.param(",".join(STEP) + "\n", id="no row"),
        pytest.param(table(STEP, 10 * T[:9], ANGLE[:9], TARGET[:9]), id="slow"),
        pytest.param("", id="empty"),
    ],
)
def test_log_too_short_or_slow_is_not_a_failed_band(write, text, capsys):
    assert main(["accept", str(write(text)), "--experiment", "pid"]) == 2
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        (table(STEP, T, ANGLE, TARGET, separator="\t", decimal=","), "utf-16"),
        (GERMAN + "\nOperator;Müller\n", "latin-1"),
        (re.sub(r"[^,\n]+", r'"\g<0>"', table(STEP, T, ANGLE, TARGET)), "utf-8-sig"),
    ],
    ids=["tabs in UTF-16", "a block after it in latin-1", "all in quotes with a mark"],
)  # fmt: skip
def test_log_of_other_programs_is_the_same(write, text, encoding):
    log = read_log(write(text, encoding))
    assert log["time"] == pytest.approx(T)
    assert log["angle"] == pytest.approx(ANGLE)
    assert log["reference"] == pytest.approx(TARGET)


INCH, POUND = 0.0254, 4.4482216


@pytest.mark.parametrize(
    ("names", "columns", "sizes"),
    [
        (("Extension [in]", "Load [lbf]"), (STRAIN, STRESS * 12e-6 / POUND),
         {"gauge_length": "1 in", "area": "12 mm^2"}),
        (("Strain [%]", "Stress [psi]"), (100 * STRAIN, STRESS / 6894.757293), {}),
        (("Crosshead [mm]", "Force [gf]"), (30 * (STRAIN + 0.05), STRESS * 12e-6 / 9.80665e-3),
         {"gauge_length": 0.03, "area": 12e-6, "zero": "first row"}),
    ],
    ids=["inches and pounds", "per cent and psi", "a position that does not begin at zero"],
)  # fmt: skip
def test_tensile_test_of_another_tester(write, names, columns, sizes):
    test = read_export(write(table(names, *columns)), **sizes).test
    found = ludwick.fit(test.strain, test.stress)
    assert (found.young_modulus, found.fractional_power) == pytest.approx((E, N), rel=2e-3)


def test_tensile_test_in_cycles_is_its_first_loading(write):
    first = np.concatenate([STRAIN, STRAIN[-2::-1], STRAIN[1:]])
    stress = E * first**N * np.where(np.arange(first.size) < STRAIN.size, 1.0, 0.7)
    test = read_export(write(table(["Strain", "Stress [Pa]"], first, stress))).test
    assert test.strain[-1] == pytest.approx(3.0)
    assert ludwick.fit(test.strain, test.stress).young_modulus == pytest.approx(E, rel=1e-3)


def test_strain_in_per_cent_or_by_another_gauge_length_is_refused(write):
    with pytest.raises(InvalidInputError, match="not per cent"):
        ludwick.fit(100 * STRAIN, STRESS)
    file = write(table(["Extension [mm]", "Force [N]"], 30 * STRAIN, STRESS * 12e-6))
    with pytest.raises(DataFileError, match="is the gauge length right"):
        read_export(file, gauge_length="1 mm", area="12 mm^2")


@pytest.mark.parametrize(
    ("make", "step"),
    [
        (lambda: RobustDifferentiator(5.0), lambda one, y: one.update(y)),
        (lambda: PolynomialDifferentiator(5), lambda one, y: one.update(y)),
        (lambda: ObserverFeedback([2.0, 0.1, 0.0], SecondOrder(2.86, 0.7), 4.0),
         lambda one, y: one.update(1.0, y)),
    ],
    ids=["robust", "polynomial", "observer"],
)  # fmt: skip
@pytest.mark.parametrize("reading", [np.nan, np.inf, None, "no reading"])
def test_reading_that_is_none_leaves_the_state(make, step, reading):
    one, twin = make(), make()
    for y in (0.0, 0.1, 0.2):
        np.testing.assert_array_equal(step(one, y), step(twin, y))
        with pytest.raises(NotFiniteError):
            step(one, reading)


def volts(rows, seed=0):
    return np.random.default_rng(seed).uniform(0.2, 4, (rows, 2))


@pytest.mark.parametrize(
    ("name", "column"),
    [
        ("x", 0.5 + 0 * np.arange(40)),
        ("x", np.cumsum(volts(40)[:, 0])),
        ("timestamp", volts(40)[:, 1]),
    ],
    ids=["constant", "rising", "a clock by its name"],
)  # fmt: skip
def test_column_that_is_no_channel_is_refused_unless_named(write, name, column):
    e = volts(40)
    rows = [
        f"{a:.6f},{b:.6f},{c:.6f},{k}" for (a, b), c, k in zip(e, column, "pq" * 20, strict=True)
    ]
    file = write("\n".join([f"e1,e2,{name},kind", *rows, ""]))
    with pytest.raises(DataFileError, match=f"{name}: it"):
        read_readings(file, label="kind")
    assert read_readings(file, label="kind", channels=["e1", "e2"]).voltages == pytest.approx(
        e, abs=1e-6
    )


def test_presses_that_are_many_rows_are_chance_when_left_out_whole(write):
    """Kinds that nothing tells: rows of one press give them away, presses do not."""
    e = np.repeat(volts(40), 5, axis=0) + np.random.default_rng(1).normal(0, 1e-3, (200, 2))
    kinds = np.repeat(np.random.default_rng(2).permutation(["p", "q"] * 20), 5)
    rows = [
        f"{a:.6f},{b:.6f},{k},{n // 5}" for n, ((a, b), k) in enumerate(zip(e, kinds, strict=True))
    ]
    file = write("\n".join(["e1,e2,kind,press", *rows, ""]))
    found = read_readings(file, label="kind", group="press")
    shares = [
        accuracy(
            cross_validated(
                nearest_neighbours(), found.voltages, found.labels, seed=0, groups=groups
            )
        ).share
        for groups in (None, found.groups)
    ]
    assert shares[0] > 0.95
    # 40 presses: 0.5 +- 3 standard deviations of 0.08.
    assert 0.26 < shares[1] < 0.74


@pytest.mark.parametrize(
    "slip",
    [
        lambda: predict_power(0.34, 20, 3.79),
        lambda: Pump(area=320.0, lead=2.0),
        lambda: certified_design(DesignProblem(young_modulus=0.07)),
    ],
    ids=["MPa", "mm^2 and mm", "MPa of a design"],
)
def test_slip_of_a_unit_is_refused_with_the_unit_that_was_meant(slip):
    with pytest.raises(InvalidInputError, match="probably"):
        slip()


def rough(values, share, seed=0):
    """Return a record with the noise of a sensor, a share of its range."""
    return values + np.random.default_rng(seed).normal(0, share * np.ptp(values), values.size)


def test_reaction_curve_after_a_rest():
    time = np.arange(0, 40, 0.05)
    lag = 2.0 * (1 - np.exp(-np.maximum(time - 10.8, 0) / 4.0))
    found = reaction_curve(time, rough(0.3 + lag, 0.005), step=0.5, step_time=10.0)
    assert found.delay == pytest.approx(0.8, rel=0.05)
    assert found.slope == pytest.approx(2.0 / 4.0 / 0.5, rel=0.02)


def test_ramp_after_a_dead_time():
    time = np.arange(0, 10, 0.05)
    found = integrating_reaction_curve(time, rough(3 * np.maximum(time - 0.7, 0), 0.002), step=2.0)
    assert found.delay == pytest.approx(0.7, rel=0.05)
    assert found.slope == pytest.approx(1.5, rel=0.01)


def test_step_with_a_long_dead_time_at_uneven_times():
    time = np.cumsum(np.random.default_rng(3).uniform(0.02, 0.06, 200))
    finger = SecondOrder(4.0, 0.5)
    late = np.maximum(time - 0.4, time[0])
    every, at = np.unique(np.concatenate([time, late]), return_inverse=True)
    moved = response(finger, every, np.ones_like(every), initial_pressure=0.0, hold="zero")
    found = identify(
        time,
        np.ones_like(time),
        rough(moved[at[time.size :]], 0.005),
        initial_input=0.0,
        hold="zero",
    )
    assert found.natural_frequency.value == pytest.approx(4.0, rel=0.05)
    assert found.dead_time.value == pytest.approx(0.4, rel=0.05)


ANGLES = np.linspace(0, 90, 13)


@pytest.mark.parametrize("top", [1023, 4095])
def test_divider_with_the_sensor_at_ground_and_readings_at_the_rail(top):
    counts = top * (10e3 + 400 * ANGLES) / (20e3 + 400 * ANGLES)
    found = fit_sensor(np.append(counts, top), np.append(ANGLES, 120.0), top=top)
    assert isinstance(found, DividerCurve)
    assert found.value(counts) == pytest.approx(ANGLES, abs=1e-6)


def test_sensor_that_bends_both_ways_is_refused():
    with pytest.raises(InvalidInputError, match="fit a part of the range"):
        fit_sensor(100 + 9 * ANGLES, (ANGLES - 45.0) ** 2)


def plain(step, *, names=STEP, more=""):
    return table(names, T, step, TARGET) + more


def settled(path):
    found = judge_step_log(path)
    return float(found.settled_5_percent), float(found.steady_state_error)


TRUE = 2.3719
"""5 % of a critically damped step at 2 rad/s: (1 + 2 t) exp(-2 t) = 0.05."""


@pytest.mark.parametrize("low", [0.5, -0.8])
def test_a_step_of_a_bent_finger_is_judged_from_where_it_was(write, low):
    bent = low + (1 - low) * ANGLE
    at, error = settled(write(plain(bent)))
    assert at == pytest.approx(TRUE, abs=0.05)
    assert error == pytest.approx(0, abs=2e-3)


def test_a_short_record_is_judged_by_its_last_quarter(write):
    some = T < 3.5
    text = table(STEP, T[some], ANGLE[some], TARGET[some])
    assert settled(write(text))[0] == pytest.approx(TRUE, abs=0.05)


@pytest.mark.parametrize("below", ["ms,rad,rad", "s,deg,rad", "[s],[rad],[deg]"])
def test_two_units_of_one_column_are_refused(write, below):
    names, *rows = plain(ANGLE).split("\n")
    with pytest.raises(DataFileError, match="one unit of"):
        read_log(write("\n".join([names, below, *rows])))


def test_two_spellings_of_one_unit_are_one(write):
    names, *rows = plain(ANGLE).split("\n")
    found = read_log(write("\n".join([names, "sec,RAD,rad", *rows])))
    assert found["time"][-1] == pytest.approx(T[-1])


@pytest.mark.parametrize("empty", ["", "NaN", "#N/A"])
def test_a_row_with_an_empty_cell_is_a_gap_and_said(write, empty):
    pressure = [f"{x:.3g}" for x in 10 * ANGLE]
    pressure[40] = empty
    rows = [f"{t:.9g},{a:.9g},1,{p}" for t, a, p in zip(T, ANGLE, pressure, strict=True)]
    path = write("\n".join(["time [s],angle [rad],reference [rad],pressure [kPa]", *rows, ""]))
    assert any("without pressure" in words for words in read_log(path).repairs)
    assert settled(path)[0] == pytest.approx(TRUE, abs=0.05)


def test_a_time_that_is_no_number_is_no_comment(write):
    rows = plain(ANGLE).split("\n")
    rows[30] = "#N/A" + rows[30][rows[30].index(",") :]
    with pytest.raises(DataFileError, match="line 31"):
        read_log(write("\n".join(rows)))


PADS = np.random.default_rng(3).uniform(0.2, 4, (60, 2)).round(3)
PRESSES = [f"{a},{b},{'point' if a > 2 else 'line'},{k}" for k, (a, b) in enumerate(PADS)]


def test_presses_that_were_appended_under_their_names_are_all_read(write):
    lines = ["e1,e2,kind,press", *PRESSES[:20], "e1,e2,kind,press", *PRESSES[20:], ""]
    with pytest.warns(LeftOutWarning, match="stand again in line 22"):
        found = read_readings(write("\n".join(lines)), label="kind", group="press")
    np.testing.assert_array_equal(found.voltages, PADS)


def test_presses_that_are_left_out_are_said(write):
    lines = ["e1,e2,kind,press", *PRESSES[:20], "# " + PRESSES[20], *PRESSES[21:], ""]
    with pytest.warns(LeftOutWarning, match="line 22, a comment"):
        assert (
            len(read_readings(write("\n".join(lines)), label="kind", group="press").voltages) == 59
        )


@pytest.mark.parametrize(
    ("name", "value"),
    [("code", lambda k: k % 3), ("force", lambda k: 0.7 + 0.01 * (k * 37 % 11)),
     ("level", lambda k: k % 5), ("day", lambda k: "2024-03-05")],
)  # fmt: skip
def test_a_column_that_is_no_element_must_be_named(write, name, value):
    lines = [f"e1,e2,kind,press,{name}", *(f"{row},{value(k)}" for k, row in enumerate(PRESSES))]
    path = write("\n".join([*lines, ""]))
    with pytest.raises(DataFileError, match=f"{name}.*channels="):
        read_readings(path, label="kind", group="press")
    found = read_readings(path, label="kind", group="press", channels=["e1", "e2"])
    np.testing.assert_array_equal(found.voltages, PADS)


@pytest.mark.parametrize("largest", [12.0, 300.0])
def test_a_strain_that_may_be_per_cent_is_asked_for(write, largest):
    share = largest / 3 * STRAIN
    with pytest.raises(DataFileError, match="%"):
        read_export(write(table(("Strain", "Stress [Pa]"), share, STRESS)))


@pytest.mark.parametrize(
    ("area", "lead"), [("3.2 cm^2", "2 mm"), ("320 mm^2", "0.2 cm"), ("0.00032 m^2", "0.002 m")]
)
def test_the_pump_of_a_log_has_any_unit(write, area, lead):
    path = write(table(("time [s]", "command [rad/s]", "pressure [kPa]"), T, T, T))
    path.with_suffix(".toml").write_text(f'[header]\narea = "{area}"\nlead = "{lead}"\n')
    found = pump_of(path, read_log(path))
    assert (found.area, found.lead) == pytest.approx((3.2e-4, 2e-3))


def test_a_pump_of_another_dimension_is_refused(write):
    path = write(table(("time [s]", "pressure [kPa]"), T, T))
    path.with_suffix(".toml").write_text('[header]\narea = "3.2 mm"\nlead = "2 mm"\n')
    with pytest.raises(DataFileError, match="area"):
        pump_of(path, read_log(path))
