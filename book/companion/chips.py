"""Verdicts as a page shows them: as small labels, as the ledger's table, as counts."""

import html
import re
from collections import Counter
from dataclasses import dataclass
from functools import cache
from math import inf
from pathlib import Path

import pandas as pd

from book.companion.claims import Basis, Claim, read_claims, references
from book.companion.errata import Erratum, errata
from book.companion.ledger_address import NONE, address, in_book, row_address
from book.companion.ledger_form import filter_form
from book.companion.markdown import Markdown, in_static_book, markdown_table
from book.companion.slips import ASSUMPTION, PRINT, RESULT, Change
from book.companion.twin_reach import told
from book.companion.verdict import Entry, Outcome, ledger, yields

MARKS = {
    Outcome.REPRODUCED: "✓",
    Outcome.CLOSE: "≈",
    Outcome.CONTRADICTS: "✗",
    Outcome.OPEN: "◇",
    Outcome.GIVEN: "◉",
}
"""An outcome is told by mark and word, never by colour alone."""


def chip(outcome: Outcome, text: str, to: str = "") -> str:
    """Return an outcome as a small coloured label; with an address, as a link to it."""
    tag, link = ("a", f' href="{html.escape(to)}"') if to else ("span", "")
    words = f"{MARKS[outcome]} {html.escape(text)}"
    return f'<{tag} class="verdict {outcome}"{link}>{words}</{tag}>'


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.4g}"


def _range(low: float, high: float) -> str:
    if low != low:
        return "no number"
    first, last = _number(low), _number(high)
    return first if first == last else f"{first} to {last}"


def _input(value: str) -> str:
    return "the peak" if value == str(inf) else value.replace("_", " ")


def _assumed(entry: Entry) -> str:
    assumption, claim = entry.assumption, entry.claim
    if assumption is None:
        return ""
    words = f"Assumed: {assumption.text}"
    if assumption.fitted_to:
        words += f" Fitted to {len(assumption.fitted_to)} printed numbers"
        words += ", this one among them." if claim.id in assumption.fitted_to else "."
    if assumption.tries > 1:
        words += f" {assumption.tries} readings were tried."
    return words


def _banded(entry: Entry) -> str:
    claim = entry.claim
    values = [case.spread.value for case in entry.band if case.exists]
    if claim.band is None or not values:
        return ""
    at = ", ".join(map(_input, entry.met_by))
    inside = "lies between two of these" if entry.in_band else "comes out at none of these"
    return f"{claim.band.what}: {_range(min(values), max(values))}; the print " + (
        f"comes out at {at}." if at else f"{inside}."
    )


def reason(entry: Entry) -> str:
    """Return in words why an entry has its outcome: its band, what is assumed, notes."""
    claim, author = entry.claim, entry.record()["author"]
    parts = [
        claim.regardless,
        _banded(entry),
        _assumed(entry),
        author and f"The author's {claim.author}: {author}.",
        claim.needs and f"To check it: {claim.needs.rstrip('.')}.",
        claim.note,
    ]
    return " ".join(filter(None, parts))


def _remarks(entry: Entry) -> str:
    used = ", ".join(
        f'<a href="{row_address(name)}">{name}</a>' for name in sorted(entry.claim.stands_on)
    )
    text = html.escape(reason(entry))
    text += f" Stands on {used}." if used else ""
    return f"<details><summary>remarks</summary>{text.strip()}</details>" if text else ""


def printed_cell(claim: Claim) -> str:
    """Return what is printed, with its bound or its word, and its unit."""
    sign = {"=": "", "~": "about "}.get(claim.relation, f"{claim.relation} ")
    unit = "" if claim.unit == "1" else f" {claim.unit}"
    return html.escape(f"{sign}{claim.printed}{unit}")


def range_cell(entry: Entry) -> str:
    """Return what comes out, as one number where its ends read the same."""
    return _range(entry.spread.low, entry.spread.high) if entry.spread else ""


def recomputed_cell(entry: Entry) -> str:
    """Return what comes out, and beside it what does under the assumption."""
    assumed = entry.under_assumption
    beside = "" if assumed is None else f" <small>if assumed: {_number(assumed)}</small>"
    return f"{range_cell(entry)}{beside}"


def basis_cell(entry: Entry) -> str:
    """Return the basis, or of what has none its nature."""
    return entry.basis or (entry.claim.nature if entry.claim.nature != "result" else "")


def _permalink(claim: Claim) -> str:
    words = f'title="Link to this row" aria-label="Link to this row: {html.escape(claim.what)}"'
    return f'<a class="permalink" href="{row_address(claim.id)}" {words}>#</a>'


def _computed_by(entry: Entry) -> str:
    """Return the function that recomputes a number, linked to its place in the reference."""
    if not entry.function:
        return ""
    package, _, name = entry.function.rsplit(".", 2)
    page = in_book(f"api/{package}.html")
    return f'<a class="by" href="{page}#{entry.function}"><code>{name}</code></a> '


def _valued(value: float | None) -> str:
    """Return what a cell of a number is sorted by."""
    return "" if value is None or value != value else f' data-value="{value:.9g}"'


def _row(entry: Entry) -> str:
    claim, value = entry.claim, entry.spread.value if entry.spread else None
    data = f'data-outcome="{entry.outcome}" data-basis="{entry.basis or NONE}"'
    return (
        f'<tr id="claim-{claim.id}" {data}>'
        f"<td>{html.escape(claim.what)} {_permalink(claim)} "
        f'<div class="more">{_computed_by(entry)}{_remarks(entry)}</div></td>'
        f'<td class="number"{_valued(float(claim.printed))}>{printed_cell(claim)}</td>'
        f'<td class="number"{_valued(value)}>{recomputed_cell(entry)}</td>'
        f"<td{_valued([*Outcome].index(entry.outcome))}>{chip(entry.outcome, entry.outcome)}</td>"
        f"<td>{basis_cell(entry)}</td><td>{told(claim.id)}</td></tr>"
    )


TWIN = "within the twin's reach"
"""Head of the column that says what one simulated rig makes of a print."""


def verdict_table(entries: list[Entry]) -> str:
    """Return entries of a chapter as an HTML table, place by place: printed, recomputed, verdict.

    Tables, bodies and rows bear as data what a reader may filter them by.
    """
    heads = {name: name for name in ("what", "printed", "recomputed", "outcome", "basis")}
    heads["twin"] = f'<a href="{in_book("one-rig.html")}">{TWIN}</a>'
    head = "".join(f'<th scope="col" data-sort="{n}">{words}</th>' for n, words in heads.items())
    chapter = entries[0].claim.chapter
    places: dict[str, list[Entry]] = {}
    for entry in entries:
        places.setdefault(entry.claim.where, []).append(entry)
    bodies = "".join(
        f'<tbody data-place="{html.escape(where)}"><tr>'
        f'<th colspan="{len(heads)}" scope="rowgroup">{html.escape(where)}</th></tr>'
        f"{''.join(map(_row, found))}</tbody>"
        for where, found in places.items()
    )
    return (
        f'<table class="ledger numbers" data-chapter="{chapter}">'
        f"<thead><tr>{head}</tr></thead>{bodies}</table>"
    )


def _linked(words: str, ids: set[str]) -> str:
    """Return words as HTML, those that are ids of claims as links to their rows in the ledger."""
    return " ".join(
        f'<a href="{row_address(word)}">{word}</a>' if word in ids else html.escape(word)
        for word in words.split(" ")
    )


def _change(change: Change, erratum: Erratum, ids: set[str]) -> str:
    assumption = erratum.entry.assumption
    said = {
        RESULT: f"What follows, {change.does}.",
        PRINT: f"The print {change.does}.",
        ASSUMPTION: f"As assumed: {assumption.text if assumption else change.does}",
    }
    given = change.of if change.of in ids else f"The input {change.of}"
    return _linked(said.get(change.of, f"{given} {change.does} ."), ids).replace(" .", ".")


SHOWN = 3
"""Changes that are shown, if no more than these recover a number; of more, the smallest."""


def _tries(erratum: Erratum, ids: set[str]) -> str:
    found = erratum.found
    if not found.recovering:
        return f"No single change found: {found.tried} were tried."
    few = len(found.recovering) <= SHOWN
    shown = found.recovering if few else found.recovering[:1]
    changes = " Or: ".join(_change(change, erratum, ids) for change in shown)
    words = f"{changes} <small>{len(found.recovering)} of {found.tried} changes bring it out"
    if found.other_numbers:
        words += f", and {found.others} of {found.other_numbers} other numbers"
    return words + f"{': a weak hint' if erratum.weak else ''}.</small>"


def _erratum(erratum: Erratum, ids: set[str]) -> str:
    claim = erratum.entry.claim
    used = _linked(" , ".join(sorted(references(claim.arguments) - {claim.id})), ids).replace(
        " ,", ","
    )
    value = range_cell(erratum.entry)
    return (
        f'<tr><td><a href="{row_address(claim.id)}">{html.escape(claim.what)}</a>'
        f" <small>{html.escape(claim.where)}</small></td>"
        f"<td class='number'>{printed_cell(claim)}</td>"
        f"<td>{value}{f' <small>from {used}</small>' if used else ''}</td>"
        f"<td>{_tries(erratum, ids)}</td></tr>"
    )


def errata_table(found: list[Erratum]) -> str:
    """Return errata as HTML, a table a chapter: printed, what follows, the smallest change."""
    ids = {claim.id for claim in read_claims()}
    names = ("what", "printed", "the rest of the print gives", "smallest change that recovers it")
    head = "".join(f'<th scope="col">{name}</th>' for name in names)
    chapters: dict[int, list[str]] = {}
    for erratum in found:
        chapters.setdefault(erratum.entry.claim.chapter, []).append(_erratum(erratum, ids))
    return "".join(
        f"<h2>Chapter {chapter}</h2>"
        f'<table class="ledger errata"><thead><tr>{head}</tr></thead>'
        f"<tbody>{''.join(rows)}</tbody></table>"
        for chapter, rows in sorted(chapters.items())
    )


def _counted(entries: list[Entry], name: str, keys: list[tuple[object, str]]) -> pd.DataFrame:
    """Count outcomes by a property of the claims, for the values of it that are named, and all."""
    groups = {words: [e for e in entries if getattr(e.claim, name) == key] for key, words in keys}
    rows = []
    for words, own in {**groups, ALL: entries}.items():
        count = Counter(entry.outcome for entry in own)
        rows.append({name: words, **{str(o): count[o] for o in Outcome}, CLAIMS: count.total()})
    return pd.DataFrame(rows)


ALL, CLAIMS = "all", "claims"
"""Of a table of counts, the row and the column of sums."""


def _with_links(counts: pd.DataFrame) -> pd.DataFrame:
    """Link each count to the rows of the ledger that it counts."""
    name = counts.columns[0]

    def link(row: pd.Series, column: str) -> str:
        asked = {name: row[name], "outcome": column}
        fields = {field: value for field, value in asked.items() if value not in (ALL, CLAIMS)}
        to = html.escape(address(**fields))
        return f'<a href="{to}">{row[column]}</a>' if row[column] else "0"

    linked = counts.astype(object)
    for column in counts.columns[1:]:
        linked[column] = [link(row, column) for _, row in counts.iterrows()]
    return linked


def chapter_counts(entries: list[Entry]) -> pd.DataFrame:
    """Count outcomes by chapter."""
    chapters = sorted({entry.claim.chapter for entry in entries})
    return _counted(entries, "chapter", [(n, str(n)) for n in chapters])


def basis_counts(entries: list[Entry]) -> pd.DataFrame:
    """Count outcomes by basis."""
    return _counted(entries, "basis", [(basis, basis or NONE) for basis in Basis])


def counts_chips(entries: list[Entry], **fields: object) -> str:
    """Return the counts of outcomes as labels, each a link to its rows: those of some fields."""
    count = Counter(entry.outcome for entry in entries)
    chips = (
        chip(found, f"{count[found]} {found}", address(**fields, outcome=found))
        for found in Outcome
        if count[found]
    )
    return f'<p class="counts">{" ".join(chips)}</p>'


def assumptions_table(entries: list[Entry]) -> str:
    """Return the assumptions that judge, with what each was fitted to and what comes of others."""
    rows = [
        {
            "assumption": found.assumption.text.replace("|", "\\|"),
            "fitted to": found.fitted,
            "reproduces": found.reproduced,
            "comes close to": found.close,
            "of others": found.of,
            "readings tried": found.assumption.tries,
        }
        for found in yields(entries)
    ]
    return markdown_table(pd.DataFrame(rows))


STYLES = Path(__file__).parents[1] / "_static" / "softgrip.css"
LINKED = "a.verdict { color: #16181d !important; text-decoration: none; }"
"""A notebook has a colour of its own for links, which a label of its dark scheme would hide."""
STYLED = re.compile(r"^(?:\.verdict|table\.ledger)[^{}]*\{[^{}]*\}$", re.M)


@cache
def styles() -> str:
    """Return the rules of labels and ledger, for a notebook; a page has them from its head."""
    if in_static_book():
        return ""
    rules = STYLED.findall(STYLES.read_text(encoding="utf-8"))
    return f"<style>{' '.join([*rules, LINKED])}</style>"


@dataclass(frozen=True)
class Html:
    """A piece of HTML that a notebook displays."""

    markup: str

    def _repr_html_(self) -> str:
        return styles() + self.markup


def show_verdicts(chapter: int | None = None, *, where: tuple[str, ...] = ()) -> Html:
    """Show the ledger of a chapter (or all), or of the places that are named."""
    chapters: dict[int, list[Entry]] = {}
    for entry in ledger(chapter, where):
        chapters.setdefault(entry.claim.chapter, []).append(entry)
    return Html(
        "".join(
            f"{counts_chips(own, chapter=number)}{verdict_table(own)}"
            for number, own in chapters.items()
        )
    )


def show_filter() -> Html:
    """Show how all verdicts stand; in a page, with the form that filters them."""
    form = filter_form(read_claims()) if in_static_book() else ""
    return Html(f"{counts_chips(ledger())}{form}")


def show_counts() -> Markdown:
    """Show how the verdicts stand, by chapter."""
    counts = chapter_counts(ledger())
    return Markdown(markdown_table(_with_links(counts), numbers=counts))


def show_bases() -> Markdown:
    """Show on what the outcomes stand."""
    counts = basis_counts(ledger())
    return Markdown(markdown_table(_with_links(counts), numbers=counts))


def show_assumptions() -> Markdown:
    """Show the assumptions that judge, what they were fitted to, and what comes of others."""
    return Markdown(assumptions_table(ledger()))


def show_errata() -> Html:
    """Show the printed numbers that other prints exclude, and what would recover each."""
    found = errata()
    none = sum(not erratum.change for erratum in found)
    weak = sum(erratum.weak and bool(erratum.change) for erratum in found)
    counts = (
        f"{len(found)} numbers. A single change that would recover few others is found for "
        f"{len(found) - none - weak} of them, a weak hint for {weak}, and none for {none}."
    )
    return Html(f"<p>{counts}</p>{errata_table(found)}")
