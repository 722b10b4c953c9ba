"""The page *Change an input*: sliders over inputs, and the claims that they move."""

import json
import os
from collections import Counter
from pathlib import Path

import pandas as pd

from book.companion.chips import MARKS, Html
from book.companion.claims import claim_by_id
from book.companion.inputs import Input, inputs, reached
from book.companion.ledger import expected
from book.companion.markdown import Markdown, markdown_table
from book.companion.verdict import Outcome
from book.companion.what_if import judged_again
from book.explore.claim_laws import page_claims
from book.explore.explorer import MODE_VARIABLE
from book.explore.page import control, own_scripts
from book.explore.sliders import Range
from softgrip.reads import remembered

NAME = "inputs"
"""Id of the figure; the page's name is that of its heading."""
LABEL = "Inputs as sliders, and the verdicts that they move"
SCRIPT = Path(__file__).with_name("what_if.js")
TENTH = 0.1
"""Of the stated value: by how much each input is changed, to compare what they move."""


def slider(one: Input) -> Range:
    """Return an input's slider."""
    return Range(one.low, one.high, one.stated, one.symbol, "" if one.unit == "1" else one.unit)


def data() -> str:
    """Return what the page's script takes, in JavaScript."""
    page = page_claims()
    counts = Counter(row["outcome"] for row in expected().values())
    told = page.data() | {
        "sliders": [slider(inputs()[symbol]).data(symbol) for symbol in page.symbols],
        "call": "what_if",
        "marks": {str(outcome): mark for outcome, mark in MARKS.items()},
        "counts": {str(outcome): counts[outcome] for outcome in Outcome},
    }
    # A closing tag in a text would end the script.
    text = json.dumps(told, ensure_ascii=False).replace("</", "<\\/")
    return f"Object.assign({text},{{laws:{page.javascript()}}})"


def _chapter(one: Input) -> int:
    return (claim_by_id(one.places[0]) if one.places else reached(one.symbol)[0]).chapter


def _controls() -> str:
    chapters: dict[int, list[str]] = {}
    for symbol in page_claims().symbols:
        one = inputs()[symbol]
        chapters.setdefault(_chapter(one), []).append(control(NAME, symbol, slider(one), one.name))
    return "".join(
        f'<fieldset><legend>Chapter {chapter}</legend><div class="controls">{"".join(own)}</div>'
        "</fieldset>"
        for chapter, own in sorted(chapters.items())
    )


def show_sliders() -> Html:
    """Show the sliders, and what they move."""
    head = "" if os.environ.get(MODE_VARIABLE) == "static" else own_scripts()
    return Html(
        f'{head}<figure class="what-if explorer" id="{NAME}" aria-label="{LABEL}">{_controls()}'
        '<div class="strip"><p class="told" role="status"></p><ul class="counts"></ul></div>'
        '<div class="more">'
        '<button type="button" class="reset">reset</button>'
        '<details><summary>as code</summary><code class="call"></code></details>'
        f'<a class="link" href="#{NAME}">link to this state</a></div>'
        '<div class="moved"></div><div class="rest"></div><div class="left"></div>'
        "<noscript>The sliders need JavaScript.</noscript></figure>"
        f"<script>{SCRIPT.read_text(encoding='utf-8')}"
        f"(window.softgripExplorers||={{}})[{json.dumps(NAME)}]=softgripWhatIf({data()});"
        "window.softgripExplore?.();</script>"
    )


def tenth(one: Input, way: int) -> float:
    """Return an input a tenth up or down, or as far as its range goes."""
    return min(max(one.stated * (1 + way * TENTH), one.low), one.high)


@remembered
def moved_by_a_tenth(symbol: str) -> int:
    """Count the verdicts of the page that move where an input is a tenth smaller, or larger."""
    one, here = inputs()[symbol], {law.claim.id for law in page_claims().laws}
    own = [claim for claim in reached(symbol) if claim.id in here]
    found = (judged_again({symbol: tenth(one, way)}, own) for way in (-1, 1))
    return len({change.after.claim.id for changes in found for change in changes if change.moved})


def _printed_in(one: Input) -> str:
    first = {claim.where: claim.id for claim in map(claim_by_id, reversed(one.places))}
    links = (f'<a href="ledger.html#claim-{id}">{where}</a>' for where, id in first.items())
    return ", ".join(reversed([*links]))


def show_reach() -> Markdown:
    """Show all inputs: where each is printed, how many claims hang on it, what a tenth moves."""
    here = {law.claim.id for law in page_claims().laws}
    rows = [
        {
            "": f"`{one.symbol}`",
            "input": one.name,
            "stated": f"{one.stated:g} {one.unit}".removesuffix(" 1"),
            "printed in": _printed_in(one) or "no place",
            "claims": len(reached(symbol)),
            "on this page": sum(claim.id in here for claim in reached(symbol)),
            "moved by a tenth": moved_by_a_tenth(symbol),
        }
        for symbol, one in inputs().items()
    ]
    return Markdown(markdown_table(pd.DataFrame(rows)))
