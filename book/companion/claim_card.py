"""What a card says of a claim, beside the printed number in a page's prose."""

import html
from textwrap import shorten

from book.companion.chips import basis_cell, chip, printed_cell, reason, recomputed_cell
from book.companion.verdict import Entry

LONGEST = 400
"""Characters of a reason; the ledger has it whole."""


def claim_card(entry: Entry) -> str:
    """Return, as HTML, what was printed and what came of it, on what basis, and why."""
    claim, why = entry.claim, reason(entry)
    facts = {
        "printed": printed_cell(claim),
        "recomputed": recomputed_cell(entry),
        "basis": basis_cell(entry),
    }
    rows = "".join(f"<dt>{name}</dt><dd>{told}</dd>" for name, told in facts.items() if told)
    return (
        f"<p>{chip(entry.outcome, entry.outcome)} {html.escape(claim.what)}"
        f" <small>{html.escape(claim.where)}</small></p><dl>{rows}</dl>"
        + (f"<p>{html.escape(shorten(why, LONGEST, placeholder=' …'))}</p>" if why else "")
    )
