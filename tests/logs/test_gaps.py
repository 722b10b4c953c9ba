"""Logs in which rows are missing: named, bridged where that is safe, refused elsewhere."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from book.chapter_2.forces import calibrated, hour_errors
from book.chapter_4.identified_model import identify_capacity, identify_finger
from book.companion.show import show
from book.live.acceptance import bands_table
from softgrip.board.driver import Board
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.logs.fingers import read_runs
from softgrip.logs.pushes import compare
from softgrip.logs.reader import read_log
from softgrip.logs.repeated_steps import read_step_test
from softgrip.logs.staircase import judge_staircase, mean_edge
from softgrip.logs.steps import judge_step, judge_step_log
from softgrip.provenance import data_folder
from softgrip.rig.__main__ import main
from softgrip.rig.acceptance import judge
from softgrip.rig.record import record
from softgrip.rig.replay import Replay
from softgrip.tactile.drift import DRIFT_WEIGHTS
from softgrip.units import GRAM_FORCE
from tests.logs.example_logs import push_log, staircase_log
from tests.rig.test_check import checked, lose

FOLDER = data_folder() / "simulated"
PUSH, STAIRCASE, STEP = push_log("push-a"), staircase_log(), FOLDER / "lqr-fast.csv"


def rewrite(path, kept, change):
    """Write a kept log whose rows, lists of cells, were changed."""
    lines = kept.read_text().splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("time")) + 1
    rows = change([line.split(",") for line in lines[first:]])
    path.write_text("\n".join([*lines[:first], *(",".join(row) for row in rows), ""]))
    return path


def without(path, kept, missing):
    """Write a kept log without some rows, counted from 0."""
    gone = set(missing)
    return rewrite(path, kept, lambda rows: [row for k, row in enumerate(rows) if k not in gone])


def retimed(path, kept, time):
    """Write a kept log with other times: a function of the times, s."""

    def change(rows):
        times = time(np.array([float(row[0]) for row in rows])).round(9)
        return [[repr(float(t)), *row[1:]] for t, row in zip(times, rows, strict=True)]

    return rewrite(path, kept, change)


@pytest.fixture(scope="module")
def whole():
    return identify_capacity(PUSH), compare(PUSH), judge_staircase(STAIRCASE)


@pytest.mark.parametrize("start", [10, 35, 60])
@pytest.mark.parametrize("count", [5, 20, 40])
def test_capacity_is_that_of_the_whole_push(path, whole, count, start):
    capacity, before, _ = whole
    without(path, PUSH, range(start, start + count))
    # Fewer rows of a curve that bends: the fit weighs others. The volume lost would be 9 % to 54 %.
    assert identify_capacity(path) == pytest.approx(capacity, rel=0.03)
    found = compare(path)
    assert found.capacity == pytest.approx(before.capacity, rel=0.03)
    assert found.growth == pytest.approx(before.growth, rel=0.05)
    # The filter follows the last rows, and has long forgotten the gap.
    assert found.estimated.capacity[-1] == pytest.approx(before.estimated.capacity[-1], rel=1e-3)
    assert found.estimated.time[-1] == pytest.approx(before.estimated.time[-1])


@pytest.mark.parametrize("count", [5, 10, 20, 40])
@pytest.mark.parametrize("name", ["push-b", "push-d"])
def test_capacity_of_a_fast_push_is_near_or_refused(path, name, count):
    # In 40 rows these rise from nothing to above 30 kPa. What is left alone gives up to 27 % more.
    kept = push_log(name)
    analyses = [identify_capacity, lambda log: compare(log).capacity]
    before, near = [analysis(kept) for analysis in analyses], 0
    for start in range(4, 60, 8):
        without(path, kept, range(start, start + count))
        for analysis, capacity in zip(analyses, before, strict=True):
            try:
                assert analysis(path) == pytest.approx(capacity, rel=0.04), start
                near += 1
            except DataFileError as error:
                assert f"{count} rows missing" in str(error)  # noqa: PT017
    assert near > 0


@pytest.mark.parametrize("count", [10, 20])
def test_filtered_pressure_rises_over_a_gap_as_without_one(path, count):
    before = compare(push_log("push-b"))
    found = compare(without(path, push_log("push-b"), range(54, 54 + count)))
    # Its elastance doubles in 20 rows; held at that before them, the model would end 3 % lower.
    assert found.filtered[-1] == pytest.approx(before.filtered[-1], rel=0.02)


@pytest.mark.parametrize("start", [20, 43, 100, 200, 330, 500, 573])  # 43, 330, 573: over changes
def test_staircase_is_that_of_the_whole_log(path, whole, start):
    before = whole[2]
    found = judge_staircase(without(path, STAIRCASE, range(start, start + 10)))
    # The mean over twelve changes crosses a half in noise, from 0.92 s to 1.13 s: one row less can
    # move it as far. The shift of an even clock would be infinite.
    assert found.time_to_half == pytest.approx(before.time_to_half, abs=0.22)
    assert found.lag == pytest.approx(before.lag, abs=0.08)
    assert found.edges == before.edges
    assert found.rms_error == pytest.approx(before.rms_error, rel=0.03)


@pytest.mark.parametrize("start", [10, 50, 100, 400, 750])
def test_step_is_that_of_the_whole_log(path, start):
    before = judge_step_log(STEP)
    found = judge_step_log(without(path, STEP, range(start, start + 5)))
    assert found.settled_5_percent == pytest.approx(before.settled_5_percent, abs=0.03)
    assert found.settled_5_deg == pytest.approx(before.settled_5_deg, abs=0.03)
    assert found.steady_state_error == pytest.approx(before.steady_state_error, abs=0.006)
    # Bridged rows have no noise of their own; 75 measured ones tell it to 8 %.
    assert found.noise == pytest.approx(before.noise, rel=0.08)


def test_rows_that_are_missing_are_named_with_their_place(path):
    assert read_log(PUSH).repairs == ()
    (words,) = read_log(without(path, PUSH, [*range(40, 45), 100])).repairs
    assert words == (
        "5 rows missing between 1 and 1.15 s (row 40); "
        "1 row missing between 2.5 and 2.55 s (row 95)"
    )
    (words,) = read_log(without(path, PUSH, range(1, 100, 4))).repairs
    assert words.endswith("19 more in 19 places")


def test_figures_name_what_is_missing(path):
    without(path, STAIRCASE, range(40, 45))
    words = "log.csv: 5 rows missing between 0.975 and 1.125 s (row 40)"
    elsewhere = show("Figure 4.7", logs=[path], numbered=False)
    assert words in elsewhere._repr_mimebundle_()["text/html"]
    assert words in show("Figure 4.7", logs=[path])._repr_mimebundle_()["text/html"]
    assert "missing" not in show("Figure 4.7")._repr_mimebundle_()["text/html"]


def test_acceptance_names_what_is_missing(path, capsys):
    without(path, FOLDER / "pid-full.csv", range(400, 405))
    assert main(["accept", str(path), "--experiment", "pid"]) == 1
    assert "note  5 rows missing between 9.975 and 10.125 s" in capsys.readouterr().out
    assert "5 rows missing" in bands_table({"pid": path})["experiment"][0]
    without(path, FOLDER / "pid-full.csv", range(400, 420))
    assert main(["accept", str(path), "--experiment", "pid"]) == 2
    assert "20 rows missing between 9.975 and 10.5 s" in capsys.readouterr().err


def test_check_names_what_is_missing(path, stub, capsys):
    without(path, FOLDER / "step-60-1.csv", range(40, 45))
    assert main(["check", "--port", f"replay:{path}"]) == 1
    assert "FAIL  log: 5 rows missing between 1 and 1.15 s" in capsys.readouterr().out
    lose(stub, 3)
    code, text = checked(stub)
    assert code == 1
    assert "FAIL  samples: 3 rows missing between" in text


def test_a_drivers_log_with_lost_telemetry_names_the_place(path, stub):
    with Board(stub) as rig:
        rig.home()
        lose(stub, 5)
        record(rig, np.full(400, 5.0), 2.0, path)
    log = read_log(path)
    (at,) = (time for time, words in log.events if "telemetry lost: 5" in words)
    (words,) = log.repairs
    assert words.startswith("5 rows missing between")
    assert f"and {at:.6g} s" in words


def test_replay_keeps_the_time_and_tells_of_the_gap(path, tmp_path):
    without(path, STEP, range(40, 45))
    log, again = read_log(path), tmp_path / "again.csv"
    with Replay(path) as replay:
        replay.home()
        record(replay, log["command"][1:], 3.0, again)
        assert replay.difference == 0
    made, rows = read_log(again), 116  # 3 s are 121 rows with the first, less the missing five
    assert made["time"].size == rows
    for name in ("time", "angle", "command"):
        np.testing.assert_array_equal(made[name], log[name][:rows])
    assert made.repairs == log.repairs
    ((time, words),) = made.events
    assert time == 1.125
    assert "5 rows missing between 0.975 and 1.125 s" in words


def test_uneven_clock_is_no_gap_and_its_times_count(path):
    rng = np.random.default_rng(5)
    retimed(path, PUSH, lambda t: t + rng.uniform(-0.006, 0.006, t.size))
    (words,) = read_log(path).repairs
    assert words.startswith("times are up to 0.00")
    # 6 ms of a push of some seconds, in each row another way.
    assert identify_capacity(path) == pytest.approx(identify_capacity(PUSH), rel=0.005)


def test_a_slow_clock_sweeps_more(path):
    # All times 1 % longer at one command: so is the volume. The start counts a period, not 1 %.
    retimed(path, PUSH, lambda t: 1.01 * t)
    for capacity in (identify_capacity, lambda log: compare(log).capacity):
        assert capacity(path) == pytest.approx(1.01 * capacity(PUSH), rel=1e-3)


@pytest.mark.parametrize("factor", [0.5, 0.95, 1.05, 2.0, 1000.0])
def test_rows_another_time_apart_than_the_header_says_are_refused(path, factor):
    retimed(path, PUSH, lambda t: factor * t)
    with pytest.raises(DataFileError, match=r"rows 0\.025 s apart.*median of"):
        read_log(path)


@pytest.mark.parametrize(
    "missing",
    [
        range(0, 272, 2),
        range(2, 272, 2),  # one interval that is whole confirms no header
        [1, *range(3, 272)],  # and a single one may not be
    ],
    ids=["all", "but one", "two rows left"],
)
def test_a_log_without_every_second_row_is_refused(path, missing):
    without(path, PUSH, missing)
    with pytest.raises(DataFileError, match=r"median of 0\.05 s"):
        read_log(path)


def test_a_busy_host_may_leave_out_most_rows(path):
    # Two of three, but not in step: some rows are a period apart, which confirms the header.
    kept = np.random.default_rng(2).choice(np.arange(1, 272), 90, replace=False)
    without(path, PUSH, set(range(1, 272)) - set(kept.tolist()))
    assert "rows missing" in read_log(path).repairs[0]
    assert identify_capacity(path) == pytest.approx(identify_capacity(PUSH), rel=0.05)


def test_a_clock_of_whole_milliseconds_is_even_enough(path):
    retimed(path, PUSH, lambda t: 1e-3 * np.floor(1e3 * 1.003 * t))
    assert read_log(path).repairs == ()
    assert identify_capacity(path) == pytest.approx(1.003 * identify_capacity(PUSH), rel=2e-3)


@pytest.mark.parametrize(
    "time",
    [
        lambda t: np.where(np.arange(t.size) == 50, t[49], t),  # another row of the same time
        lambda t: np.where(np.arange(t.size) == 50, t[40], t),
        lambda t: np.where(np.arange(t.size) >= 50, t - t[49], t),  # a board that began anew
    ],
)
def test_times_that_stand_or_run_back_are_refused(path, time):
    retimed(path, PUSH, time)
    with pytest.raises(DataFileError, match=r"line 65: expected a time above"):
        read_log(path)


@pytest.mark.parametrize("last", [1e9, 1.7e12, 1e19])
def test_a_clock_that_was_set_within_a_log_is_refused(path, last):
    late = retimed(path, STEP, lambda time: np.where(time == time[-1], last, time))
    with pytest.raises(DataFileError, match=r"line \d+: expected a time within .* rows on"):
        read_log(late)


def test_a_push_whose_command_changes_in_a_gap_is_refused(path):
    without(path, PUSH, range(40, 45))

    def slower(rows):
        return [[row[0], "5.0", *row[2:]] if k >= 40 else row for k, row in enumerate(rows)]

    rewrite(path, path, slower)
    for analysis in (identify_capacity, compare):
        with pytest.raises(DataFileError, match=r"one command.*5 rows missing between 1 and 1\.15"):
            analysis(path)


def test_a_jump_of_the_clock_is_no_push(path):
    retimed(path, PUSH, lambda t: np.where(t > 1, t + 3600, t))
    with pytest.raises(DataFileError, match="144000 rows missing between 1 and 3601"):
        identify_capacity(path)


def test_a_push_without_its_beginning_is_refused(path):
    without(path, PUSH, range(20))
    retimed(path, path, lambda t: t - 0.5)  # as if it had begun then
    for analysis in (identify_capacity, compare):
        with pytest.raises(DataFileError, match="from atmospheric pressure"):
            analysis(path)


STARTS = [
    (identify_capacity, "push-a"),
    (compare, "push-a"),
    (judge_step_log, "lqr-fast"),
    (lambda path: judge(path, "lqr"), "lqr-fast"),
    (lambda path: judge(path, "gripper"), "gripper-fast-1"),
    (lambda path: read_step_test([path]), "step-60-1"),
    (lambda path: identify_finger([path]), "step-60-1"),
    (lambda path: read_runs([path]), "gripper-open-1"),
]


@pytest.mark.parametrize("lost", [2, 3, 20])
@pytest.mark.parametrize(("analysis", "name"), STARTS)
def test_a_log_without_its_start_is_refused(path, analysis, name, lost):
    # A step is settled so much sooner, a push has swept more, a finger was not at rest.
    without(path, FOLDER / f"{name}.csv", range(lost))
    with pytest.raises(DataFileError, match=r"from the start of the run.*the first row is at"):
        analysis(path)


def test_a_step_without_its_first_row_settles_as_the_whole_one(path):
    before, found = judge_step_log(STEP), judge_step_log(without(path, STEP, [0]))
    assert found.settled_5_percent == pytest.approx(before.settled_5_percent, abs=1e-9)
    (bands, whole) = (judge(log, "lqr") for log in (path, STEP))
    assert bands[2].found == pytest.approx(whole[2].found, abs=1e-3)  # one value less in the mean


def test_a_log_without_its_start_says_so(path):
    without(path, STEP, range(10))
    words = "the first row is at 0.25 s, not at 0 or 0.025 s"
    assert read_log(path).repairs == (words,)
    assert words in show("Figure 4.7", logs=[path])._repr_mimebundle_()["text/html"]


def test_a_change_of_the_reference_needs_no_start(path):
    def at_two(rows):
        return [[*row[:6], "0.0" if float(row[0]) < 2 else "1.0", row[7]] for row in rows]

    whole = judge_step_log(rewrite(path, STEP, at_two))
    cut = judge_step_log(without(path, path, range(20)))
    assert cut.settled_5_deg == whole.settled_5_deg


@pytest.mark.parametrize(
    ("read", "names"),
    [
        (read_step_test, ("step-60-1", "step-60-2")),
        (identify_finger, ("step-60-1", "step-60-2")),
        (read_runs, ("gripper-open-1", "gripper-open-2")),
    ],
)
def test_means_of_runs_need_all_rows(tmp_path, read, names):
    paths = [without(tmp_path / name, FOLDER / f"{name}.csv", [30, 31]) for name in names]
    with pytest.raises(DataFileError, match="all rows, for a mean of runs, got 2 rows missing"):
        read(paths)


def test_long_gaps_of_steps_and_staircases_are_refused(path):
    without(path, STEP, range(40, 46))
    with pytest.raises(DataFileError, match=r"6 rows missing between 0\.975 and 1\.15 s"):
        judge_step_log(path)
    with pytest.raises(DataFileError, match="all rows"):
        judge_step_log(without(path, STEP, [40]), window=0.0)
    with pytest.raises(DataFileError, match="11 rows missing"):
        judge_staircase(without(path, STAIRCASE, range(40, 51)))


def test_arrays_with_gaps_are_refused():
    time = np.delete(np.arange(400) * 0.025, range(100, 105))
    with pytest.raises(InvalidInputError, match=r"even samples.*5 rows missing"):
        judge_step(time, np.ones(time.size), 1.0)
    with pytest.raises(InvalidInputError, match=r"even samples.*5 rows missing"):
        mean_edge(time, np.floor(time), time)


def test_an_hour_without_one_of_its_weights_is_refused():
    force = np.array([*DRIFT_WEIGHTS, 10.0, 25.0, *DRIFT_WEIGHTS]) * GRAM_FORCE
    reference = calibrated()
    voltage = np.array([*reference, 1.5, 2.0, *reference])
    time = np.arange(force.size) * 16.0
    assert len(hour_errors(time, voltage, force)) == 2
    with pytest.raises(InvalidInputError, match="both ends"):
        hour_errors(time[1:], voltage[1:], force[1:])


runs = st.lists(st.tuples(st.integers(0, 271), st.integers(1, 45)), max_size=4)
single = st.sets(st.integers(0, 271), max_size=200)


@settings(max_examples=150, deadline=None)
@given(gaps=runs, rows=single)
def test_a_push_with_any_rows_missing_is_near_or_refused(gaps, rows, whole, tmp_path_factory):
    path = tmp_path_factory.mktemp("log") / "log.csv"
    without(path, PUSH, {k for start, n in gaps for k in range(start, start + n)} | rows)
    try:
        found = identify_capacity(path)
    except DataFileError:
        return
    # What may go unseen is a beginning of 1.5 kPa and the noise, below 20 kPa.
    assert found == pytest.approx(whole[0], rel=0.15)


@settings(max_examples=60, deadline=None)
@given(
    gaps=st.lists(st.tuples(st.integers(0, 623), st.integers(1, 12)), max_size=6),
    rows=st.sets(st.integers(0, 623), max_size=40),
)
@example(gaps=[(622, 2)], rows={573})  # the end of the log cut the last hold, and so all
def test_a_staircase_with_any_rows_missing_is_near_or_refused(gaps, rows, whole, tmp_path_factory):
    path = tmp_path_factory.mktemp("log") / "log.csv"
    without(path, STAIRCASE, {k for start, n in gaps for k in range(start, start + n)} | rows)
    try:
        found = judge_staircase(path)
    except DataFileError:
        return
    assert found.time_to_half == pytest.approx(whole[2].time_to_half, abs=0.25)
    assert found.lag == pytest.approx(whole[2].lag, abs=0.15)
