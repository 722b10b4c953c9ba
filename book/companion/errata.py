"""Errata: printed numbers that other prints exclude, and the smallest change that recovers each.

The list follows the ledger: it has each claim that was accepted as one that the print contradicts,
if it is judged so still, and the number is the dissertation's own. What single changes give (see
`book.companion.slips`) is kept in ``data/claims/errata.csv``, which ``make accept`` writes; what
has changed since is searched anew.
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from hashlib import sha256
from importlib import import_module

from book.companion.claims import read_claims, resolved
from book.companion.printed import carried
from book.companion.slips import Change, Found, search
from book.companion.verdict import Entry, Outcome, judge
from softgrip.kept import Kept
from softgrip.provenance import Provenance, data_rows

EXPECTED = "claims/expected.csv"
WEAK = 0.05
"""Share of other numbers that the same changes may recover before one of them says little."""


@dataclass(frozen=True)
class Erratum:
    """A number that does not come out, and what single changes make of it."""

    entry: Entry
    found: Found

    @property
    def change(self) -> Change | None:
        """Smallest change that recovers the print; None if none does."""
        return self.found.recovering[0] if self.found.recovering else None

    @property
    def weak(self) -> bool:
        """Whether the same changes recover many other numbers too."""
        return self.found.others > WEAK * self.found.other_numbers


@dataclass(frozen=True)
class Row:
    """What is kept of a search."""

    id: str
    digest: str
    tried: int
    recovering: str
    others: int
    other_numbers: int


def digest(entry: Entry) -> str:
    """Return 12 digits that change with what a search depends on."""
    claim, spread = entry.claim, entry.spread
    numbers = (spread.value, spread.low, spread.high) if spread else ()
    printed = (claim.printed, claim.unit, claim.relation, claim.exact)
    inputs = (claim.arguments, resolved(claim.arguments), claim.assume)
    text = repr((printed, inputs, [f"{number:.6g}" for number in numbers]))
    return sha256(text.encode()).hexdigest()[:12]


def contradicting() -> list[Entry]:
    """Judge the dissertation's own numbers that were accepted as contradicted, in their order."""
    accepted = {row["id"] for row in data_rows(EXPECTED) if row["outcome"] == "contradicts"}
    own = [claim for claim in read_claims() if claim.nature != "citation"]
    entries = [judge(claim) for claim in own if claim.id in accepted]
    return [entry for entry in entries if entry.outcome is Outcome.CONTRADICTS]


def searched(entry: Entry) -> Found:
    """Try single changes of what recomputes a number."""
    module, _, name = entry.function.rpartition(".")
    function, claim = getattr(import_module(module), name), entry.claim
    stated, assume = resolved(claim.arguments), resolved(claim.assume)
    assumed = carried(function, stated | assume) if assume else None
    return search(claim, function, stated, entry.spread or carried(function, stated), assumed)


def _rows() -> Iterator[Row]:
    for entry in contradicting():
        found = searched(entry)
        changes = json.dumps([[change.of, change.does] for change in found.recovering])
        yield Row(
            entry.claim.id, digest(entry), found.tried, changes, found.others, found.other_numbers
        )


KEPT = Kept(
    "claims/errata.csv",
    Row,
    _rows,
    source="make accept (book.companion.errata)",
    provenance=Provenance.PRINTED,
)


def _kept(row: Row) -> Found:
    changes = tuple(Change(*change) for change in json.loads(row.recovering))
    return Found(row.tried, changes, row.others, row.other_numbers)


def errata() -> list[Erratum]:
    """Return what is contradicted, each with the single changes that recover it."""
    kept = {(row.id, row.digest): _kept(row) for row in KEPT.read()}
    return [
        Erratum(entry, kept.get((entry.claim.id, digest(entry))) or searched(entry))
        for entry in contradicting()
    ]
