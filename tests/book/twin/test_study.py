"""What is kept of how far the fit can be trusted, and what the page says of it."""

from typing import get_args

import numpy as np
import pytest

from book.twin import pictures, study, tables
from book.twin.bounds import BOUNDS, MANY, Bound, excludes
from book.twin.interval import CLAIMED, coverage
from book.twin.misfit import chosen
from book.twin.prediction import CHAPTERS, chapter
from book.twin.problem import error_of, printed
from book.twin.prose import WORDS
from book.twin.recovery import Way
from tests.book.twin.lines import lines

KEPT = {name: table.read() for name, table in study.TABLES.items()}
WAYS = get_args(Way)
HIDDEN = {
    name: [one.id for one in chosen() if chapter(one) in chapters]
    for name, chapters in CHAPTERS.items()
}


def test_every_hidden_number_is_predicted_once():
    for name, ids in HIDDEN.items():
        assert [row.id for row in KEPT["predictions"] if row.predicted == name] == ids
    known = {one.id: one for one in chosen()}
    for row in KEPT["predictions"]:
        own = row.interval
        assert own.actual == pytest.approx(known[row.id].value, rel=1e-5), row.id
        assert own.low <= own.middle <= own.high
        assert row.share > 0


def test_every_known_rig_is_asked_for_every_hidden_number():
    want = [
        (truth, name, one)
        for truth in range(study.TRUTHS)
        for name in CHAPTERS
        for one in HIDDEN[name]
    ]
    assert [(row.truth, row.predicted, row.id) for row in KEPT["held"]] == want


def test_every_known_rig_is_sought_by_both_ways():
    ids = [one.id for one in chosen()]
    free = [one.name for one in printed().free]
    for truth in range(study.TRUTHS):
        for way in WAYS:
            own = [r for r in KEPT["recovery"] if (r.truth, r.way) == (truth, way)]
            assert [r.name for r in own if r.kind == "parameter"] == free
            assert [r.name for r in own if r.kind == "target"] == ids


def test_the_true_rig_is_the_same_for_both_ways():
    one, other = (
        [(r.truth, r.name, r.interval.actual) for r in KEPT["recovery"] if r.way == way]
        for way in WAYS
    )
    assert one == other


def test_random_rigs_stand_beside_every_bound_and_none_passes():
    assert [row.id for row in KEPT["bounds"]] == [*BOUNDS]
    for row in KEPT["bounds"]:
        bound = BOUNDS[row.id]()
        assert MANY / 4 < row.rigs <= MANY
        # Kept with six digits.
        off = row.nearest - bound.value if bound.side == "at most" else bound.value - row.nearest
        assert off <= 1e-5 * abs(bound.value), row.id


def test_a_print_is_excluded_beyond_its_error():
    target = chosen()[0]
    error = error_of(target) * target.tolerance
    for side, sign in (("at most", -1), ("at least", 1)):
        assert excludes(Bound(target.value + sign * 1.01 * error, side, ""), target)
        assert not excludes(Bound(target.value + sign * 0.99 * error, side, ""), target)


@pytest.mark.parametrize(
    "table", [tables.ways_table, tables.prediction_table, tables.bound_table, tables.tension_table]
)
def test_no_table_of_the_page_is_empty(table):
    made = table()
    assert len(made) > 1
    assert made.notna().all(axis=None)
    assert (made.drop(columns=["unit", "at an end", "against it"], errors="ignore") != "").all(
        axis=None
    )


def test_the_page_counts_what_is_kept():
    hold = sum(row.interval.holds for row in KEPT["predictions"])
    assert WORDS["hidden_hold"]() == f"{hold}"
    share = 100 * np.mean([row.interval.holds for row in KEPT["held"]])
    assert WORDS["known_held"]() == f"{share:.0f}"
    excluded = (tables.bound_table()["print excluded"] == "yes").sum()
    assert WORDS["excluded"]() == f"{excluded}"


def test_the_page_says_of_the_intervals_what_is_so():
    """Too narrow for parameters, the smoother's less so; wide enough for what known rigs hide."""
    parameters = [coverage([r.interval for r in tables.found(w, "parameter")]) for w in WAYS]
    assert CLAIMED > parameters[0] > parameters[1]
    assert coverage([row.interval for row in KEPT["held"]]) >= CLAIMED
    of_print = [row.interval for row in KEPT["predictions"] if row.predicted == "gripper"]
    assert coverage(of_print) < CLAIMED


def test_the_page_says_what_predicts_what():
    rows = {row.id: row for row in KEPT["predictions"]}
    for row in (f"table-3.2-measured-{k}" for k in (1, 2, 3, 4)):
        assert rows[row].interval.holds
        assert rows[row].share < tables.NARROWED
    assert rows["3.4-damping-ratio"].interval.holds
    for loop in ("settling-fast", "settling-slow", "measured-transient-difference"):
        own = rows[f"6.4-{loop}"].interval
        assert own.actual < own.low


def test_the_prediction_picture_has_a_line_for_each_print_that_is_not_zero():
    (axes,) = pictures.draw_predictions().axes
    rows = [row for row in KEPT["predictions"] if row.interval.actual]
    assert [text.get_text() for text in axes.get_yticklabels()] != [""] * len(rows)
    assert len(axes.get_yticks()) == len(rows)


def test_a_study_goes_on_only_in_its_own_state(tmp_path, monkeypatch):
    monkeypatch.setattr(study, "STAGES", tmp_path)
    one = lines([[1.0, 0.5]], [0.0])
    folder = study._done(one)
    assert folder == study._done(lines([[1.0, 0.5]], [0.0]))
    assert folder != study._done(lines([[1.0, 0.5]], [0.0], [2.0]))
    monkeypatch.setattr(study, "RIGS", 2 * study.RIGS)
    assert folder != study._done(one)
