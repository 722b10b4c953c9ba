"""``python -m book.companion.ledger``: judge every claim, write ``ledger.json``, print the counts.

``--accept`` also writes the verdicts that the tests expect from now on, and the counts in the
README; the change then shows in the diff.
"""

import argparse
import json
import re
from collections import Counter
from pathlib import Path

from book.companion.chips import counts_table
from book.companion.verdict import ledger
from softgrip.kept import write_data
from softgrip.provenance import Provenance, data_folder, data_rows

EXPECTED = "claims/expected.csv"
BEGIN, END = "<!-- verdicts: written by make ledger -->", "<!-- end of verdicts -->"


def expected() -> dict[str, str]:
    """Read the verdicts that were accepted, by claim."""
    return {row["id"]: row["verdict"] for row in data_rows(EXPECTED)}


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
        write_data(
            data_folder() / EXPECTED,
            "id,verdict\n" + "".join(f"{e.claim.id},{e.verdict}\n" for e in entries),
            source="book.companion.ledger --accept",
            provenance=Provenance.PRINTED,
        )
    if Path("README.md").is_file():
        write_counts(Path("README.md"), counts_table(entries))


if __name__ == "__main__":
    main()
