"""Outcomes and values are those that were accepted, and the README's counts are theirs."""

import pytest

from book.companion.chips import counts_table
from book.companion.ledger import BEGIN, END, changes, expected, write_csv
from book.companion.verdict import ledger


@pytest.fixture(scope="module")
def entries():
    return ledger()


def test_no_outcome_and_no_value_changed(entries):
    wanted = expected()
    assert {entry.claim.id for entry in entries} == set(wanted)
    changed = {e.claim.id: found for e in entries if (found := changes(e, wanted[e.claim.id]))}
    assert changed == {}, "if they should change: make accept, and look at the diff"


def test_a_value_that_moves_without_its_outcome_is_seen(entries):
    entry = next(e for e in entries if e.spread)
    accepted = expected()[entry.claim.id]
    assert changes(entry, accepted | {"value": str(entry.spread.value * (1 + 1e-4))})
    assert not changes(entry, accepted | {"value": str(entry.spread.value * (1 + 1e-8))})


def test_readme_has_the_counts(entries, root):
    text = (root / "README.md").read_text(encoding="utf-8")
    written = text.partition(BEGIN)[2].partition(END)[0].strip()
    assert written == counts_table(entries), "make ledger writes them"


def test_table_has_a_row_for_each_claim_and_the_published_columns(entries, tmp_path):
    write_csv(tmp_path / "ledger.csv", entries)
    head, *rows = (tmp_path / "ledger.csv").read_text(encoding="utf-8").splitlines()
    assert len(rows) >= len(entries)
    assert {
        "id", "chapter", "where", "what", "unit", "printed", "exact", "outcome", "basis", "value",
        "low", "high", "inputs", "assumed", "assumption", "fitted_to", "under_assumption", "band",
        "note", "function",
    } <= set(head.split(","))  # fmt: skip


def test_what_is_open_shows_a_band_or_what_it_was_fitted_to(entries):
    for entry in (e for e in entries if e.outcome == "open"):
        undecided = entry.spread.low != entry.spread.high
        fitted = entry.claim.basis == "assumption" and entry.claim.id in entry.assumption.fitted_to
        assert entry.band or undecided or fitted or entry.basis == "rig", entry.claim.id


def test_no_assumption_and_no_simulation_contradicts_the_print(entries):
    found = [e for e in entries if e.outcome == "contradicts"]
    assert not [e.claim.id for e in found if e.basis in ("assumption", "rig")]


def test_what_an_assumption_was_fitted_to_is_a_claim(entries):
    known = {entry.claim.id for entry in entries}
    for entry in entries:
        if entry.assumption:
            assert set(entry.assumption.fitted_to) <= known, entry.assumption.name


def test_what_is_given_says_what_would_be_needed_and_few_stand_alone(entries):
    given = [entry.claim for entry in entries if entry.outcome == "given"]
    assert [claim.id for claim in given if not claim.needs] == []
    held_against = set().union(*(entry.claim.stands_on for entry in entries))
    assert len({claim.id for claim in given} - held_against) <= 90
