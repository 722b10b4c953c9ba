"""What if an input were another: the claims that hang on it, judged again.

``what_if(n=2.2)`` changes what `book.companion.inputs` declares, and nothing else: what was
computed and then printed stays as it is printed. The bands of unprinted inputs, which decide no
outcome, are not swept again.
"""

from collections import Counter
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from html import escape
from typing import Any

import pandas as pd

from book.companion.chips import chip, printed_cell, range_cell
from book.companion.claims import Claim, claim_by_id
from book.companion.inputs import input_of, reached, with_inputs
from book.companion.markdown import markdown_table
from book.companion.verdict import Entry, Outcome, rejudged
from softgrip.reads import remembered


@dataclass(frozen=True)
class Change:
    """A claim that hangs on what was changed."""

    before: Entry
    after: Entry

    @property
    def moved(self) -> bool:
        """Whether its outcome is another."""
        return self.before.outcome is not self.after.outcome

    @property
    def shifted(self) -> bool:
        """Whether its outcome stands, but its number is another."""
        return not self.moved and self.before.spread != self.after.spread


@dataclass(frozen=True)
class WhatIf:
    """What comes of a change.

    Attributes:
        values: What was changed, by symbol, in the unit of the print.
        changes: All claims that hang on it, in the order of the ledger.
        before, after: Claims of the whole ledger by outcome.
    """

    values: Mapping[str, float]
    changes: tuple[Change, ...]
    before: Counter[Outcome]
    after: Counter[Outcome]

    @property
    def moved(self) -> tuple[Change, ...]:
        """Those whose outcome is another."""
        return tuple(change for change in self.changes if change.moved)

    @property
    def shifted(self) -> tuple[Change, ...]:
        """Those whose number alone is another."""
        return tuple(change for change in self.changes if change.shifted)

    def table(self) -> pd.DataFrame:
        """Return those that moved, then those that shifted, as they are shown."""
        return pd.DataFrame(
            {
                "claim": f'<a href="ledger.html#claim-{before.claim.id}">'
                f"{escape(before.claim.what)}</a> <small>{escape(before.claim.where)}</small>",
                "printed": printed_cell(before.claim),
                "before": range_cell(before),
                "now": range_cell(after),
                "verdict": chip(before.outcome, before.outcome)
                + (f" → {chip(after.outcome, after.outcome)}" if change.moved else ""),
            }
            for change in (*self.moved, *self.shifted)
            for before, after in [(change.before, change.after)]
        )

    def _repr_markdown_(self) -> str:
        changed = ", ".join(
            f"{name} = {value:g} {one.unit}".removesuffix(" 1") + f" (stated: {one.stated:g})"
            for name, value in self.values.items()
            for one in [input_of(name)]
        )
        counts = " ".join(
            chip(found, f"{' → '.join(map(str, dict.fromkeys(both)))} {found}")
            for found in Outcome
            for both in [(self.before[found], self.after[found])]
        )
        words = (
            f"{changed or 'nothing changed'}: of {len(self.changes)} claims that hang on it, "
            f"{len(self.moved)} have another verdict and {len(self.shifted)} another number.\n\n"
        )
        return f"{words}{counts}\n\n{markdown_table(self.table()) if self.changes else ''}"


def _unswept(claim: Claim) -> Claim:
    return replace(claim, band=claim.band and replace(claim.band, values=(), cases=()))


@remembered
def _stated(id: str) -> Entry:
    return rejudged(_unswept(claim_by_id(id)))


def judged_again(values: Mapping[str, float], claims: Collection[Claim]) -> tuple[Change, ...]:
    """Judge claims with other values of inputs, but for those that print one of these.

    Args:
        values: By symbol, in the unit of the print.
        claims: As stated.
    """
    places = {place for symbol in values for place in input_of(symbol).places}
    return tuple(
        Change(_stated(claim.id), rejudged(_unswept(with_inputs(claim, values))))
        for claim in claims
        if claim.id not in places
    )


def what_if(**changed: Any) -> WhatIf:
    """Judge all claims that hang on inputs again, with other values for these.

    A value is exact, as nobody has rounded it. One that is the stated value changes nothing: it is
    the print, with its rounding.

    Args:
        **changed: By symbol, as of `inputs`: a number in the unit of the print, also in words; or
            words such as ``"10 cm"``, or a quantity of `pint`.

    Raises:
        UnknownNameError: If there is no such input; the message lists those there are.
        InvalidInputError: If a value is no number, of another dimension, or out of range.

    >>> found = what_if(kp=4.0)
    >>> [(str(c.before.outcome), str(c.after.outcome)) for c in found.moved]
    []
    """
    # Not above: `python -m book.companion.ledger` would run what has been imported already.
    from book.companion.ledger import expected

    given = {symbol: input_of(symbol).value(value) for symbol, value in changed.items()}
    values = {s: value for s, value in given.items() if value != input_of(s).stated}
    hanging = {claim.id: claim for symbol in values for claim in reached(symbol)}
    outcomes = {id: Outcome(row["outcome"]) for id, row in expected().items()}
    changes = judged_again(values, [hanging[id] for id in outcomes if id in hanging])
    now = outcomes | {change.before.claim.id: change.after.outcome for change in changes}
    return WhatIf(values, changes, Counter(outcomes.values()), Counter(now.values()))
