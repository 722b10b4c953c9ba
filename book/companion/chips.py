"""Verdicts as a page shows them: as small labels, as the ledger's table, as counts."""

import html
from collections import Counter
from dataclasses import dataclass
from math import inf

import pandas as pd

from book.companion.claims import Basis, Claim, read_claims, references
from book.companion.errata import Erratum, errata
from book.companion.markdown import Markdown, markdown_table
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


def chip(outcome: Outcome, text: str) -> str:
    """Return an outcome as a small coloured label."""
    return f'<span class="verdict {outcome}">{MARKS[outcome]} {html.escape(text)}</span>'


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
    if entry.under_assumption is not None:
        words += f" It gives {_number(entry.under_assumption)}."
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


def _remarks(entry: Entry) -> str:
    claim, author = entry.claim, entry.record()["author"]
    used = ", ".join(
        f'<a href="ledger.html#claim-{name}">{name}</a>' for name in sorted(claim.stands_on)
    )
    parts = [
        claim.regardless,
        _banded(entry),
        _assumed(entry),
        author and f"The author's {claim.author}: {author}.",
        claim.needs and f"To check it: {claim.needs.rstrip('.')}.",
        claim.note,
    ]
    text = html.escape(" ".join(filter(None, parts)))
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


def _row(entry: Entry) -> str:
    claim = entry.claim
    basis = entry.basis or (claim.nature if claim.nature != "result" else "")
    return (
        f'<tr id="claim-{claim.id}"><td>{html.escape(claim.what)}{_remarks(entry)}</td>'
        f"<td class='number'>{printed_cell(claim)}</td>"
        f"<td class='number'>{range_cell(entry)}</td>"
        f"<td>{chip(entry.outcome, entry.outcome)}</td><td>{basis}</td>"
        f"<td>{told(claim.id)}</td></tr>"
    )


TWIN = '<a href="one-rig.html">within the twin\'s reach</a>'
"""Head of the column that says what one simulated rig makes of a print."""


def verdict_table(entries: list[Entry]) -> str:
    """Return entries as an HTML table, place by place: printed, recomputed, verdict."""
    names = ("what", "printed", "recomputed", "outcome", "basis", TWIN)
    head = "".join(f'<th scope="col">{name}</th>' for name in names)
    wide = len(names)
    places: dict[str, list[Entry]] = {}
    for entry in entries:
        places.setdefault(entry.claim.where, []).append(entry)
    bodies = "".join(
        f'<tbody><tr><th colspan="{wide}" scope="rowgroup">{html.escape(where)}</th></tr>'
        f"{''.join(map(_row, found))}</tbody>"
        for where, found in places.items()
    )
    return f'<table class="ledger"><thead><tr>{head}</tr></thead>{bodies}</table>'


def _linked(words: str, ids: set[str]) -> str:
    """Return words as HTML, those that are ids of claims as links to their rows in the ledger."""
    return " ".join(
        f'<a href="ledger.html#claim-{word}">{word}</a>' if word in ids else html.escape(word)
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
        f'<tr><td><a href="ledger.html#claim-{claim.id}">{html.escape(claim.what)}</a>'
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
    """Count outcomes by a property of the claims, for the values of it that are named."""
    rows = []
    for key, words in keys:
        count = Counter(e.outcome for e in entries if getattr(e.claim, name) == key)
        rows.append({name: words, **{str(o): count[o] for o in Outcome}, "claims": count.total()})
    return pd.DataFrame(rows)


def counts_table(entries: list[Entry]) -> str:
    """Return the counts by chapter and outcome as a Markdown table."""
    chapters = sorted({entry.claim.chapter for entry in entries})
    return markdown_table(_counted(entries, "chapter", [(n, str(n)) for n in chapters]))


def basis_table(entries: list[Entry]) -> str:
    """Return the counts by basis and outcome as a Markdown table."""
    return markdown_table(_counted(entries, "basis", [(basis, basis or "none") for basis in Basis]))


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


@dataclass(frozen=True)
class Html:
    """A piece of HTML that a notebook displays."""

    markup: str

    def _repr_html_(self) -> str:
        return self.markup


def show_verdicts(chapter: int | None = None, *, where: tuple[str, ...] = ()) -> Html:
    """Show the ledger of a chapter (or all), or of the places that are named."""
    entries = ledger(chapter, where)
    count = Counter(entry.outcome for entry in entries)
    chips = " ".join(chip(found, f"{count[found]} {found}") for found in Outcome if count[found])
    return Html(f'<p class="counts">{chips}</p>{verdict_table(entries)}')


def show_counts() -> Markdown:
    """Show how the verdicts stand, by chapter."""
    return Markdown(counts_table(ledger()))


def show_bases() -> Markdown:
    """Show on what the outcomes stand."""
    return Markdown(basis_table(ledger()))


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
