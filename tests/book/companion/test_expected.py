"""The verdicts are those that were accepted, and the README's counts are theirs."""

import pytest

from book.companion.chips import counts_table
from book.companion.ledger import BEGIN, END, expected
from book.companion.verdict import ledger


@pytest.fixture(scope="module")
def entries():
    return ledger()


def test_no_verdict_changed(entries):
    got = {entry.claim.id: str(entry.verdict) for entry in entries}
    wanted = expected()
    changed = {
        name: f"{wanted.get(name)} -> {got.get(name)}"
        for name in wanted | got
        if wanted.get(name) != got.get(name)
    }
    assert changed == {}, "if they should change: make accept, and look at the diff"


def test_readme_has_the_counts(entries, root):
    text = (root / "README.md").read_text(encoding="utf-8")
    written = text.partition(BEGIN)[2].partition(END)[0].strip()
    assert written == counts_table(entries), "make ledger writes them"


def test_every_record_has_the_published_fields(entries):
    needed = {
        "id", "chapter", "where", "what", "unit", "printed", "recomputed", "verdict",
        "assumptions", "note", "function",
    }  # fmt: skip
    assert all(needed <= set(entry.record()) for entry in entries)
