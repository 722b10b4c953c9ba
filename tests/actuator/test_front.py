"""The kept front: rows come out again, none is dominated by mistake, and a sweep goes on."""

from dataclasses import replace

import numpy as np
import pytest

from softgrip.actuator import front as module
from softgrip.actuator.certificate import TOLERANCE
from softgrip.actuator.front import (
    FREQUENCIES,
    KEPT,
    OBJECTIVES,
    Answer,
    Point,
    Question,
    answer,
    questions,
    sweep,
    undominated,
)
from softgrip.actuator.limits import measures
from softgrip.actuator.section import Section
from softgrip.materials.table import table_5_1

ROWS = KEPT.read()


def test_there_are_enough_points_of_all_materials_and_all_are_proved():
    asked = questions()
    assert [row.question for row in ROWS] == asked
    assert len(asked) == len(set(asked)) >= 200
    assert {one.material for one in asked} == {*table_5_1()}
    assert all(row.answer.proven for row in ROWS)


@pytest.mark.parametrize("k", [2, 91, 200, 237])
def test_a_kept_row_comes_out_again(k):
    again, kept = answer(ROWS[k].question), ROWS[k].answer
    assert again.feasible == kept.feasible
    if kept.feasible:
        assert again.torque == pytest.approx(kept.torque, rel=2 * TOLERANCE)


def test_kept_sections_keep_their_limits_and_do_what_is_said():
    for row in ROWS:
        if not row.answer.feasible:
            assert np.isnan(row.answer.torque)
            continue
        question, found = row.question, row.answer
        section = Section(found.top, found.bottom, found.width, found.wall)
        values = measures(question.problem(), section)
        for name in ("torque", "angle", "mass", "envelope", "air"):
            assert values[name] == pytest.approx(getattr(found, name), rel=1e-5)
        room = 1 + 1e-5
        assert found.angle >= module.LEAST_ANGLE / room
        assert found.mass <= question.largest_mass * room
        assert found.envelope <= question.largest_envelope * room
        assert found.air <= question.largest_air * room
        assert found.frequency >= question.least_frequency / room
        assert found.buckling >= 1 / room
        assert found.torque <= found.bound <= found.torque * (1 + 2 * TOLERANCE)


def test_more_room_never_costs_torque():
    """Of two questions that differ in one limit the wider has at least as much."""
    known = {row.question: row.answer for row in ROWS}
    pairs = [(q, replace(q, largest_mass=0.030)) for q in known if q.largest_mass == 0.015]
    pairs += [
        (q, replace(q, least_frequency=min(FREQUENCIES)))
        for q in known
        if q.least_frequency == max(FREQUENCIES)
    ]
    assert len(pairs) > 90
    for narrow, wide in pairs:
        if known[narrow].feasible:
            assert known[wide].torque >= known[narrow].torque * (1 - 2 * TOLERANCE)


def test_undominated_by_hand():
    def point(torque, mass, pressure=1.0, feasible=1):
        values = dict.fromkeys(OBJECTIVES, 1.0) | {"torque": torque, "mass": mass}
        return Point(Question("x", 6, pressure), Answer(feasible, 1, **values))

    points = [
        point(1.0, 1.0), point(2.0, 1.0), point(2.0, 1.0), point(1.0, 0.5), point(1.0, 1.0, 2.0),
        point(9.0, 0.1, feasible=0),
    ]  # fmt: skip
    assert undominated(points).tolist() == [False, True, True, True, True, False]


def test_a_sweep_goes_on_where_it_stopped(tmp_path, monkeypatch):
    asked = [ROWS[0].question, ROWS[2].question, ROWS[4].question]
    journal = tmp_path / "front.jsonl"
    first = sweep(asked[:2], journal, jobs=1)
    worked = []
    plain = module.answer
    monkeypatch.setattr(module, "answer", lambda one: worked.append(one) or plain(one))
    found = sweep(asked, journal, jobs=1)
    assert worked == asked[2:]
    assert found[1] == first[1]
    assert found[1].answer.torque == pytest.approx(ROWS[2].answer.torque, rel=1e-5)
