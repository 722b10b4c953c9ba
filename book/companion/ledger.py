"""``python -m book.companion.ledger``: judge every claim, write ledger.json and ledger.csv.

``--accept`` also writes the outcomes and values that the tests expect from now on, the errata that
follow from them, and the counts in the README; the change then shows in the diff.
"""

import argparse
import csv
import json
import re
from collections import Counter
from collections.abc import Mapping
from math import isclose
from pathlib import Path

from book.companion.chips import chapter_counts
from book.companion.errata import KEPT
from book.companion.markdown import markdown_table
from book.companion.verdict import Entry, ledger
from softgrip.kept import write_data
from softgrip.provenance import Provenance, data_folder, data_rows

EXPECTED = "claims/expected.csv"
FROZEN = ("id", "outcome", "basis", "value", "low", "high", "under_assumption", "band_values")
"""Fields of a record that are frozen: the words, and the numbers that they hang on."""
BEGIN, END = "<!-- verdicts: written by make ledger -->", "<!-- end of verdicts -->"


def _text(value: object) -> str:
    if isinstance(value, list):
        return " ".join(map(_text, value))
    return f"{value:.9g}" if isinstance(value, float) else "" if value is None else str(value)


def frozen(entry: Entry) -> dict[str, str]:
    """Return what is frozen of an entry, as text, numbers to nine digits."""
    record = entry.record() | {"band_values": [case.spread.value for case in entry.band]}
    return {name: _text(record[name]) for name in FROZEN}


def changes(entry: Entry, accepted: Mapping[str, str]) -> dict[str, str]:
    """Return what is not as it was accepted: other words, numbers beyond the claim's tolerance."""

    def close(now: str, was: str) -> bool:
        return now == was or isclose(float(now), float(was), rel_tol=entry.claim.tolerance)

    def alike(now: str, was: str) -> bool:
        try:
            return all(close(*pair) for pair in zip(now.split(), was.split(), strict=True))
        except ValueError:
            return False

    now = frozen(entry)
    return {
        name: f"{was} -> {now[name]}"
        for name, was in accepted.items()
        if now[name] != was and not alike(now[name], was)
    }


def expected() -> dict[str, dict[str, str]]:
    """Read what was accepted, by claim: see `frozen`."""
    return {row["id"]: row for row in data_rows(EXPECTED)}


def write_csv(path: Path, entries: list[Entry]) -> None:
    """Write the records as a table; what is a list or a table is written as JSON."""
    records = [entry.record() for entry in entries]
    with path.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, list(records[0]))
        writer.writeheader()
        for record in records:
            writer.writerow(
                {n: json.dumps(v) if isinstance(v, list | dict) else v for n, v in record.items()}
            )


def write_records(path: Path, entries: list[Entry]) -> None:
    """Write the records as JSON, and beside it as a table."""
    path.parent.mkdir(parents=True, exist_ok=True)
    records = json.dumps([entry.record() for entry in entries], indent=1, allow_nan=False)
    path.write_text(records + "\n", encoding="utf-8")
    write_csv(path.with_suffix(".csv"), entries)


def counts_table(entries: list[Entry]) -> str:
    """Return the counts by chapter and outcome as a Markdown table."""
    return markdown_table(chapter_counts(entries))


def write_counts(readme: Path, table: str) -> None:
    """Put the counts between their marks in the README."""
    text = readme.read_text(encoding="utf-8")
    pattern = re.compile(f"({re.escape(BEGIN)}\n).*?({re.escape(END)})", re.DOTALL)
    readme.write_text(pattern.sub(rf"\g<1>{table}\n\g<2>", text), encoding="utf-8")


def main() -> None:
    """Judge, write and print."""
    parser = argparse.ArgumentParser(prog="python -m book.companion.ledger", description=__doc__)
    parser.add_argument("--into", type=Path, default=Path("book/_build/ledger.json"))
    parser.add_argument("--accept", action="store_true")
    asked = parser.parse_args()
    entries = ledger()
    write_records(asked.into, entries)
    for outcome, count in Counter(entry.outcome for entry in entries).most_common():
        print(f"{count:5} {outcome}")
    print(f"{len(entries):5} claims, written to {asked.into} and, as a table, .csv")
    if asked.accept:
        rows = [",".join(frozen(entry).values()) + "\n" for entry in entries]
        write_data(
            data_folder() / EXPECTED,
            ",".join(FROZEN) + "\n" + "".join(rows),
            source="book.companion.ledger --accept",
            provenance=Provenance.PRINTED,
        )
        KEPT.write()
    if Path("README.md").is_file():
        write_counts(Path("README.md"), counts_table(entries))


if __name__ == "__main__":
    main()
