"""``python -m book.companion.ledger``: judge every claim, write ``ledger.json``, print the counts.

``--accept`` also writes the verdicts that the tests expect from now on, and the counts in the
README; the change then shows in the diff.
"""

import argparse
import csv
import json
import re
from collections import Counter
from pathlib import Path

from book.companion.counts import counts_table
from book.companion.verdict import ledger
from softgrip.provenance import data_folder

EXPECTED = "claims/expected.csv"
BEGIN, END = "<!-- verdicts: written by make ledger -->", "<!-- end of verdicts -->"


def expected() -> dict[str, str]:
    """Read the verdicts that were accepted, by claim."""
    with (data_folder() / EXPECTED).open(encoding="utf-8") as stream:
        rows = csv.DictReader(line for line in stream if not line.startswith("#"))
        return {row["id"]: row["verdict"] for row in rows}


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
    asked.into.parent.mkdir(parents=True, exist_ok=True)
    asked.into.write_text(json.dumps([e.record() for e in entries], indent=1) + "\n")
    for verdict, count in Counter(entry.verdict for entry in entries).most_common():
        print(f"{count:5} {verdict}")
    print(f"{len(entries):5} claims, written to {asked.into}")
    if asked.accept:
        rows = "".join(f"{e.claim.id},{e.verdict}\n" for e in entries)
        head = "# provenance: printed\n# source: book.companion.ledger --accept\n"
        (data_folder() / EXPECTED).write_text(f"{head}id,verdict\n{rows}")
    if Path("README.md").is_file():
        write_counts(Path("README.md"), counts_table(entries))


if __name__ == "__main__":
    main()
