"""How the verdicts stand, counted."""

from collections import Counter

from book.companion.verdict import Entry, Verdict


def counts_table(entries: list[Entry]) -> str:
    """Return the counts by chapter and verdict as a Markdown table."""
    chapters = sorted({entry.claim.chapter for entry in entries})
    lines = [
        "| chapter | " + " | ".join(Verdict) + " | claims |",
        "|---" * (len(Verdict) + 2) + "|",
    ]
    for chapter in chapters:
        count = Counter(e.verdict for e in entries if e.claim.chapter == chapter)
        cells = [str(count[verdict]) for verdict in Verdict]
        lines.append(f"| {chapter} | " + " | ".join(cells) + f" | {count.total()} |")
    return "\n".join(lines)
