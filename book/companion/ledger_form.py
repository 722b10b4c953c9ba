"""The form that filters the ledger in a page; `book/_static/ledger` has what it does there."""

import html
import re
from collections.abc import Iterable

from book.companion.claims import Basis, Claim
from book.companion.ledger_address import NONE
from book.companion.verdict import Outcome


def _natural(place: str) -> list[tuple[int, str]]:
    """Return what sorts places as one reads them: Section 2.2 before Section 2.10."""
    return [(int(digits or 0), word) for word, digits in re.findall(r"(\D+)|(\d+)", place)]


def _choice(name: str, options: Iterable[object]) -> str:
    choices = "".join(f"<option>{html.escape(str(option))}</option>" for option in options)
    return (
        f'<label class="{name}">{name} <select name="{name}"><option value="">all</option>'
        f"{choices}</select></label>"
    )


def filter_form(claims: Iterable[Claim]) -> str:
    """Return the form as HTML: its fields are those of `address`, and of rows as data."""
    claims = [*claims]
    places: list[str] = sorted({claim.where for claim in claims}, key=_natural)
    return (
        '<form class="ledger-filter" aria-label="Filter the ledger" autocomplete="off">'
        + _choice("chapter", sorted({claim.chapter for claim in claims}))
        + _choice("outcome", Outcome)
        + _choice("basis", [basis or NONE for basis in Basis])
        + _choice("place", places)
        + '<label class="text">text <input type="search" name="text"></label>'
        '<input type="hidden" name="sort">'
        '<button type="reset">show all</button><output name="shown"></output></form>'
    )
