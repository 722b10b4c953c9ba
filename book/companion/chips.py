"""Verdicts as a page shows them: as small labels, as the ledger's table, as counts."""

import html
from collections import Counter
from dataclasses import dataclass
from math import inf

from book.companion.verdict import Entry, Verdict, comes_out, ledger

MARKS = {
    Verdict.REPRODUCED: "✓",
    Verdict.CLOSE: "≈",
    Verdict.ASSUMED: "◇",
    Verdict.DIFFERS: "✗",
    Verdict.MEASURED: "◉",
    Verdict.CITED: "❝",
}
"""A verdict is told by mark and word, never by colour alone."""


def chip(verdict: Verdict, text: str) -> str:
    """Return a verdict as a small coloured label."""
    return f'<span class="verdict {verdict}">{MARKS[verdict]} {html.escape(text)}</span>'


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.4g}"


def _input(value: object) -> str:
    return "the peak" if value == inf else str(value).replace("_", " ")


def _remarks(entry: Entry) -> str:
    claim = entry.claim
    parts = [claim.assumptions and f"Assumed: {claim.assumptions}", claim.note]
    if claim.band:
        values = [value for _, value in entry.band if value == value]
        at = ", ".join(_input(v) for v, value in entry.band if comes_out(claim, value))
        low, high = min(values), max(values)
        inside = "within the band" if low < float(claim.printed) < high else "outside the band"
        parts.append(
            f"{claim.band.what}: {_number(low)} to {_number(high)}; the print "
            + (f"comes out at {at}." if at else f"lies {inside}.")
        )
    text = " ".join(filter(None, parts))
    if not text:
        return ""
    return f"<details><summary>remarks</summary>{html.escape(text)}</details>"


def _row(entry: Entry) -> str:
    claim = entry.claim
    sign = "" if claim.relation == "=" else f"{claim.relation} "
    unit = "" if claim.unit == "1" else f" {claim.unit}"
    return (
        f'<tr id="claim-{claim.id}"><td>{html.escape(claim.what)}{_remarks(entry)}</td>'
        f"<td class='number'>{html.escape(sign + claim.printed + unit)}</td>"
        f"<td class='number'>{_number(entry.recomputed)}"
        f"{'<br><small>simulated</small>' if entry.simulated else ''}</td>"
        f"<td>{chip(entry.verdict, entry.verdict)}</td></tr>"
    )


def verdict_table(entries: list[Entry]) -> str:
    """Return entries as an HTML table, place by place: printed, recomputed, verdict, remarks."""
    head = "".join(
        f'<th scope="col">{name}</th>' for name in ("what", "printed", "recomputed", "verdict")
    )
    places: dict[str, list[Entry]] = {}
    for entry in entries:
        places.setdefault(entry.claim.where, []).append(entry)
    bodies = "".join(
        f'<tbody><tr><th colspan="4" scope="rowgroup">{html.escape(where)}</th></tr>'
        f"{''.join(map(_row, found))}</tbody>"
        for where, found in places.items()
    )
    return f'<table class="ledger"><thead><tr>{head}</tr></thead>{bodies}</table>'


def counts_table(entries: list[Entry]) -> str:
    """Return the counts by chapter and verdict as a Markdown table."""
    lines = [
        "| chapter | " + " | ".join(Verdict) + " | claims |",
        "|---" * (len(Verdict) + 2) + "|",
    ]
    for chapter in sorted({entry.claim.chapter for entry in entries}):
        count = Counter(e.verdict for e in entries if e.claim.chapter == chapter)
        cells = [str(count[verdict]) for verdict in Verdict]
        lines.append(f"| {chapter} | " + " | ".join(cells) + f" | {count.total()} |")
    return "\n".join(lines)


@dataclass(frozen=True)
class Html:
    """A piece of HTML that a notebook displays."""

    markup: str

    def _repr_html_(self) -> str:
        return self.markup


def show_verdicts(chapter: int | None = None, *, where: tuple[str, ...] = ()) -> Html:
    """Show the ledger of a chapter (or all), or of the places that are named."""
    entries = ledger(chapter, where)
    count = Counter(entry.verdict for entry in entries)
    chips = " ".join(chip(v, f"{count[v]} {v}") for v in Verdict if count[v])
    return Html(f'<p class="counts">{chips}</p>{verdict_table(entries)}')


@dataclass(frozen=True)
class Markdown:
    """A piece of Markdown that a notebook displays."""

    text: str

    def _repr_markdown_(self) -> str:
        return self.text


def show_counts() -> Markdown:
    """Show how the verdicts stand, by chapter."""
    return Markdown(counts_table(ledger()))
