"""The ledger's column says what the twin's fit kept, and nothing where it has no experiment."""

from book.companion.twin_reach import WORDS, reaches, told
from book.companion.verdict import ledger
from softgrip.provenance import data_rows

KEPT = {row["id"]: row for row in data_rows("calibration/outcomes.csv")}


def test_every_row_is_told_in_words_and_numbers():
    assert {*reaches()} == {*KEPT}
    for name, row in KEPT.items():
        words = told(name)
        assert words.startswith(WORDS[row["word"]])
        assert f"{float(row['best']):.3g} (" in words


def test_a_claim_that_is_no_measurement_has_none():
    assert told("no such claim") == ""


def test_every_target_is_a_claim_of_the_ledger_and_none_is_reproduced_by_it():
    entries = {entry.claim.id: entry for entry in ledger(3)}
    own = [entry for name, entry in entries.items() if name in KEPT]
    assert own
    assert all(entry.record()["twin"] == told(entry.claim.id) for entry in own)
    # What stands on the rig is given: no print is reproduced by a rig that was fitted to it.
    assert {str(e.outcome) for e in own if str(e.basis) == "rig"} <= {"given", "open"}
