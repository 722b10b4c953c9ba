"""Deviations of rows of parameters are those of the table of targets, in whatever parts."""

import numpy as np
import pytest

from book.twin import misfit as module
from book.twin.__main__ import met
from book.twin.laboratory import Laboratory
from book.twin.misfit import LOOPS, PENALTY, STEPS, chosen, deviations, laboratory, misfit
from book.twin.space import space, values
from softgrip.errors import InvalidInputError

SOME = ("statics", "damping", "pushes", "pid", "gripper loops", "weights")
TODAY = np.array([one.value for one in space().values()])
CHANCE = np.random.default_rng(5)
ROWS = np.transpose([one.at(CHANCE.random(6)) for one in space().values()])


def test_the_calibrated_rig_is_as_far_off_as_the_table_says():
    known = met(Laboratory(values(), loops=LOOPS, steps=STEPS), SOME)
    off = np.array([one.off / one.target.tolerance for one in known])
    told = np.clip(np.where(np.isnan(off), PENALTY, off), -PENALTY, PENALTY)
    assert misfit(TODAY[None], experiments=SOME)[0] == pytest.approx(told, rel=1e-9, abs=1e-9)
    assert [one.target for one in known] == list(chosen(SOME))


def test_parts_and_neighbours_change_nothing():
    whole = misfit(ROWS, experiments=SOME)
    assert np.isfinite(whole).all()
    parts = misfit(ROWS, experiments=SOME, rigs_at_a_time=4)
    # Sums over other numbers of rigs are rounded otherwise, and fits go on from there.
    assert parts == pytest.approx(whole, rel=1e-6, abs=1e-6)


def test_what_is_not_told_costs_the_penalty(monkeypatch):
    wanted = chosen(["statics"])[:4]
    untold = (np.nan, np.inf, -np.inf, 1e9)
    found = {(t.experiment, t.quantity): np.array([x]) for t, x in zip(wanted, untold, strict=True)}
    monkeypatch.setattr(module, "measured", lambda lab, experiments: found)
    assert all(one.relation in "=~" for one in wanted)  # no bounds
    own = deviations(laboratory(TODAY[None]), wanted)
    assert own.tolist() == [[PENALTY, PENALTY, -PENALTY, PENALTY]]


def test_rows_outside_the_space_are_refused():
    for k, one in enumerate(space().values()):
        for end in (one.low - 0.01 * abs(one.high), one.high + 0.01 * abs(one.high)):
            row = TODAY.copy()
            row[k] = end
            with pytest.raises(InvalidInputError, match=one.name):
                misfit(row[None])
    for rows in (TODAY, TODAY[None, :-1], np.empty((0, TODAY.size)), np.nan * TODAY[None]):
        with pytest.raises(InvalidInputError):
            misfit(rows)


def test_progress_is_shown(capsys):
    misfit(ROWS, experiments=["statics"], rigs_at_a_time=4, jobs=1, progress=True)
    assert capsys.readouterr().err.splitlines() == ["rigs 0 to 3 of 6", "rigs 4 to 5 of 6"]
