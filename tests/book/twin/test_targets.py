"""The targets are what the claims print, and each is measured by a recipe."""

import numpy as np
import pytest

from book.companion.claims import read_claims
from book.twin import targets as module
from book.twin.recipes import FAST, SLOW
from book.twin.space import space
from book.twin.targets import Target, targets
from softgrip.errors import DataFileError

CLAIMS = {claim.id: claim for claim in read_claims()}
SECOND_SIDE = {"3.4-linear-up-to", "7.1-linear-range", "5.4-rms-range-min", "5.4-rms-range-max"}
"""Said of a range, with one of its ends: "even during", "within", "range around"."""


def test_there_are_enough():
    assert len(targets()) >= 70


@pytest.mark.parametrize("target", targets(), ids=lambda target: target.id)
def test_number_is_that_of_its_claim(target):
    claim = CLAIMS[target.id]
    # The sign stands in words: what lies above what.
    assert abs(target.value) == abs(float(claim.printed))
    assert target.unit == claim.unit.removesuffix("1") or target.unit == claim.unit
    assert target.section == claim.where
    assert target.relation == claim.relation or target.id in SECOND_SIDE


def test_no_print_is_counted_twice():
    """A repeat is no target, and a repeat of one target alone."""
    repeats = [one for target in targets() for one in target.repeats]
    assert set(repeats) <= set(CLAIMS)
    assert not set(repeats) & {target.id for target in targets()}
    own = [one for one in repeats if repeats.count(one) > 1]
    assert not own, own


def test_all_numbers_that_the_ledger_holds_the_rig_against_are_targets():
    rig = {claim.id for claim in read_claims() if claim.basis == "rig"}
    assert not rig - {target.id for target in targets()}


def test_each_is_measured_and_hangs_on_what_the_space_has():
    for target in targets():
        assert target.experiment in {**FAST, **SLOW}, target
        assert set(target.hangs_on) <= set(space()), target
        assert all(name.startswith("choice.") for name in target.hangs_on)


def _target(**changed):
    row = {
        **dict.fromkeys(("section", "what", "unit", "reason", "experiment", "quantity"), ""),
        **{"id": "a", "relation": "=", "value": 2.0, "tolerance": 0.5},
        **{"hangs_on": (), "repeats": ()},
    }
    return Target(**{**row, **changed})


def test_a_bound_is_missed_on_one_side():
    measured = np.array([-3.0, 1.0, 3.0])
    assert _target().off(measured).tolist() == [-5, -1, 1]
    assert _target(relation="<").off(measured).tolist() == [1, 0, 1]  # its size
    assert _target(relation=">").off(measured).tolist() == [5, 1, 0]


@pytest.mark.parametrize("bad", [{"relation": "!"}, {"tolerance": "0"}, {"id": "2.3-best-k"}])
def test_a_bad_line_is_refused(monkeypatch, bad):
    first, *rest = module.data_rows(module.FILE)
    monkeypatch.setattr(module, "data_rows", lambda _: [first | bad, *rest])
    with pytest.raises(DataFileError, match="expected"):
        targets.__wrapped__()
