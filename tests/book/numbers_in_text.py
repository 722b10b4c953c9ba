"""``python -m tests.book.numbers_in_text PATH``: every number of the dissertation's text.

By rule: all numerals, and the words two to twelve, from the abstract on ("once" and "twice" stand
for no result in it). Left out are citations, references (to figures, sections, theorems ...), page
numbers, years, names (Dragon Skin 20, Design 1), indices and exponents; the contents and lists
before Chapter 1, which repeat headings and captions; and all but the decimals of displayed
equations. Each number is shown with its section, a few words, and the claims that print it, or the
reason why none does.

A claim prints a number if it is said of that section, or of a table, figure or equation that
stands there (of a table's rows: of that table); if it has the number's unit, or none and the number
none (see `same_unit`); and if its string is that number or equal to it, such as ``24.0`` for
``24``. A multiple of pi may stand in rad, in units of pi or, if it is a fraction, in degrees.

Reasons stand in ``data/claims/unclaimed.csv``. ``--update`` writes that file anew from text and
claims, and keeps the reasons it has; a number that is new there has none until somebody writes it.
"""

import argparse
import csv
import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from io import StringIO
from math import isclose, pi
from pathlib import Path

from book.companion.claims import Claim, read_claims
from softgrip.kept import write_data
from softgrip.provenance import Provenance, data_folder, data_rows

UNCLAIMED = "claims/unclaimed.csv"
Key = tuple[str, str]
"""Section, and number as it is printed."""

WORDS = {
    **{"two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8, "nine": 9},
    **{"ten": 10, "eleven": 11, "twelve": 12, "twenty-two": 22},
}

READ_AS = [
    (r"(\d+) ?(?:\u00d7|\\times) ?10\^\{(-?\d+)\}", r"\1e\2"),
    (r"(\d) ?e ?- ?(\d)", r"\1e-\2"),
    (r"\bj(\d)", r"\1"),
]
"""Powers of ten in one form, and imaginary parts as the numbers they are."""

REFERRED = (
    r"[Ff]?igures?|Tables?|Sections?|[Cc]hapters?|[Ee]quations?|Theorems?|Remarks?|Assumptions?"
    r"|Definitions?|[Pp]arts?|[Cc]omponents?"
)
LEFT_OUT = {
    "running heads and page numbers": r"^(?:\d+|CHAPTER \d\..*)$",
    "citations": r"\[\d+(?:, \d+)*\]|section III-B",
    "references": (
        rf"(?:\b(?:{REFERRED})|\bure)\*? \d\.\d+(?:(?:,| and|,? and|[-\u2013]) ?\d\.\d+)*(?!/s)"
        rf"|\b(?:{REFERRED})\*? \d(?:(?:,|,? and) \d)*(?!\d|\.\d|/s)|(?<=\* and )\d(?= are|,)"
    ),
    "headings and captions": r"^(?:Chapter \d|\d\.\d (?=[A-Z])|(?:Figure|Table) \d\.\d+:)",
    "numbers of equations": r"\(\d\.\d+\)|\\tag\{\d\.\d+\}",
    "points of a list": r"(?:^|(?<=[ (]))\d\)(?=[ ,])",
    "years": r"\b(?:19|20)\d\ds?\b(?!\^)",
    "names": (
        r"(?:[Ss]kin|Star|Clear)(?: ?\[?™\]?|\^\{TM\}\$)?\s*\d+T?\b|\b00-\d0\b"
        r"|(?:Designs?|Variance|SPA|Parameter) ?\$?\d|\b\d ?\(E\d\)|\bE\d\b|\b3D\b"
        r"|(?:ATmega|MEGA) 2560|N(?:EMA|ema) 17|INA126|DM320T|ode45|\bR2\b"
    ),
    "indices and exponents": r"_\{?\d\}?|\^\{?[-+]?\d+(?:\.\d+)?\}?",
    "formulas": (
        r"\\frac\{\d\}\{\d|(?<=[a-z])(?<!\de) ?[-+] ?\d\b(?!\.)|\b\d ?[-+] ?(?=[a-z])|\\times 1\b"
    ),
}

NUMBER = re.compile(
    r"(?:(?<=[ $\[(])(?<!\d )-)?(?<![\w.])"
    rf"(?:(?P<word>(?i:{'|'.join(sorted(WORDS, key=len, reverse=True))}))(?!\w)"
    r"|(?P<factor>\d+(?:\.\d+)?)? ?(?:\\pi(?![a-z])|π)(?: ?/ ?(?P<part>\d+))?"
    r"|\d+(?:\.\d+)?(?:e-?\d+)?)"
)
SAME = ("mm", "m", "N", "MPa", "deg", "rad", "rad/s", "rev/s", "%", "s", "ms", "psi", "mL", "kHz")
UNITS = {unit: unit for unit in (*SAME, "kg", "g")} | {
    **{"Nm": "N m", "sec": "s", "gw": "gf", "hr": "h", "hours": "h", "bits": "bit", "deq": "deg"},
    **{"degree": "deg", "/s": "rad/s"},
}
"""As printed, and as claims name them."""
UNIT = re.compile(
    r"[\s\\*$-]*(" + "|".join(map(re.escape, sorted(UNITS, key=len, reverse=True))) + r")(?![\w/^])"
)
GOES_ON = re.compile(r"(?:[\s,$\\±\u00d7~\u2013-]|and|to|or|pm|times)*")
"""What stands between numbers that share the unit of the last."""
PLACE = re.compile(r"(Section|Table|Figure|Eq\.)s? |(\d\.\d+)|(Abstract)")


@dataclass(frozen=True)
class Number:
    """A number where it is printed."""

    section: str
    printed: str
    values: tuple[float, ...]
    """What it is, and for a multiple of pi also in units of pi and in degrees."""
    unit: str
    places: frozenset[str]
    """Where a claim may say that it stands, such as ``Table 3.2``."""
    excerpt: str

    @property
    def key(self) -> Key:
        """Return what a reason is given for."""
        return self.section, self.printed


def _blank(match: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", match[0])


def masked(text: str) -> str:
    """Blank out what the rule leaves out; every other character stays where it is."""
    for pattern in LEFT_OUT.values():
        text = re.sub(pattern, _blank, text, flags=re.MULTILINE)
    whole = r"(?<![\w.])(?:\d*\\pi(?![a-z])|\d+(?![\d.e]))"
    return re.sub(
        r"\$\$.*?\$\$", lambda shown: re.sub(whole, _blank, shown[0]), text, flags=re.DOTALL
    )


def _sections(lines: list[str]) -> list[str]:
    section, found = "front", []
    for line in lines:
        if line.strip() == "Abstract" and section == "front":
            section = "abstract"
        elif line == "Contents":
            section = "lists"
        elif heading := re.match(r"^Chapter (\d)$|^(\d\.\d) [A-Z]", line):
            section = heading[1] or heading[2]
        found.append(section)
    return found


def _tables(lines: list[str]) -> list[str]:
    """Return for each line the table whose row it is: that of the nearest caption."""
    captions = {
        n: m[1] for n, line in enumerate(lines) if (m := re.match(r"(Table \d\.\d+):", line))
    }
    return [
        captions[min(captions, key=lambda n: abs(n - row))] if "\t" in line and captions else ""
        for row, line in enumerate(lines)
    ]


def _standing(lines: list[str], sections: list[str]) -> dict[str, set[str]]:
    """Return what stands in each section: itself, and its tables, figures and equations."""
    found = {section: {f"Section {section}"} for section in sections} | {"abstract": {"Abstract"}}
    for section, line in zip(sections, lines, strict=True):
        if caption := re.match(r"((?:Table|Figure) \d\.\d+):", line):
            found[section].add(caption[1])
        for tag in re.finditer(r"\((\d\.\d+)\)(?:\$\$)?$|\\tag\{(\d\.\d+)\}", line):
            found[section].add(f"Eq. {tag[1] or tag[2]}")
    return found


def _values(match: re.Match[str]) -> tuple[float, ...]:
    if word := match["word"]:
        return (float(WORDS[word.lower()]),)
    if "\\" not in match[0] and "π" not in match[0]:
        return (abs(float(match[0])),)
    share = float(match["factor"] or 1) / float(match["part"] or 1)
    return (share * pi, share) if "." in match[0] else (share * pi, share, share * 180)


def _units(line: str, matches: list[re.Match[str]]) -> list[str]:
    """Return the unit of each number of a line: its own, or that of the number that follows it."""
    units = [""]
    after = len(line)
    for match in reversed(matches):
        own = UNIT.match(line, match.end())
        goes_on = GOES_ON.fullmatch(line, match.end(), after)
        units.append(UNITS[own[1]] if own else units[-1] if goes_on else "")
        after = match.start()
    return units[:0:-1]


def _excerpt(line: str, start: int, end: int) -> str:
    around = 40 - (end - start)
    first = max(0, start - around // 2)
    return " ".join(line[first : first + 40].split())


def numbers(text: str) -> list[Number]:
    """Return every number of the text, in its order."""
    for pattern, form in READ_AS:
        text = re.sub(pattern, form, text)
    lines = text.split("\n")
    sections, tables = _sections(lines), _tables(lines)
    standing = _standing(lines, sections)
    found = []
    for line, rest, section, table in zip(
        lines, masked(text).split("\n"), sections, tables, strict=True
    ):
        matches = [] if section in ("front", "lists") else [*NUMBER.finditer(rest)]
        for match, unit in zip(matches, _units(rest, matches), strict=True):
            printed = match[0].lower().replace("\\pi", "pi").replace("π", "pi").strip()
            found.append(
                Number(
                    section=section,
                    printed=printed,
                    values=_values(match),
                    unit=unit,
                    places=frozenset({table} if table else standing[section]),
                    excerpt=_excerpt(line, *match.span()),
                )
            )
    return found


def _places(claim: Claim) -> set[str]:
    """Return the sections, tables, figures and equations that a claim names as its place."""
    kind, found = "", set()
    for match in PLACE.finditer(claim.where):
        kind = match[1] or kind
        if not match[1]:
            found.add(match[3] or f"{kind} {match[2]}")
    return found


def same_unit(claim: Claim, number: Number) -> bool:
    """Tell whether a claim has the unit of a number.

    A unit that is not in `UNITS`, such as ``m^2``, is any; so is what a table's row, a decimal or
    zero leaves out. Any other whole number or word without a unit is a count.
    """
    unit = claim.unit.removeprefix("pi ")
    if len(number.values) > 1:
        return unit in ("rad", "deg")
    row = all(place.startswith("Table") for place in number.places)
    if row or unit not in {*UNITS.values(), "1"}:
        return True
    if not number.unit:
        return unit == "1" or "." in number.printed or number.values == (0.0,)
    named = f"({number.unit})" in claim.what or number.unit in claim.what.split()
    return unit == number.unit or (unit == "1" and named)


def prints(claim: Claim, number: Number) -> bool:
    """Tell whether a claim prints a number: the same place, unit and value."""
    if not number.places & _places(claim) or not same_unit(claim, number):
        return False
    value = abs(float(claim.printed))
    digits = 1e-9 if len(number.values) == 1 else 2e-3  # a fraction of pi is printed to three
    return any(isclose(value, other, rel_tol=digits) for other in number.values)


def claimed(found: Iterable[Number], claims: Collection[Claim]) -> dict[Number, list[str]]:
    """Return the ids of the claims that print each number."""
    return {number: [claim.id for claim in claims if prints(claim, number)] for number in found}


def unclaimed(by: Mapping[Number, list[str]], found: Iterable[Number]) -> Counter[Key]:
    """Count the numbers that no claim prints."""
    return Counter(number.key for number in found if not by[number])


def listed() -> dict[Key, tuple[int, str]]:
    """Read how often each number without a claim stands in its section, and the reason."""
    return {
        (row["section"], row["number"]): (int(row["times"]), row["reason"])
        for row in data_rows(UNCLAIMED)
    }


def write(found: Mapping[Key, int], reasons: Mapping[Key, str], path: Path) -> None:
    """Write the list, in the text's order; what has no reason is left for somebody to write."""
    text = StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(("section", "number", "times", "reason"))
    table.writerows((*key, times, reasons.get(key, "")) for key, times in found.items())
    write_data(
        path,
        text.getvalue(),
        source="the text of the dissertation, by tests.book.numbers_in_text --update; reasons ours",
        provenance=Provenance.PRINTED,
    )


def main() -> None:
    """Print every number, then what claims print that is not found where they say it stands."""
    parser = argparse.ArgumentParser(prog="python -m tests.book.numbers_in_text")
    parser.add_argument("text", type=Path)
    parser.add_argument("--update", action="store_true")
    asked = parser.parse_args()
    found, claims = numbers(asked.text.read_text(encoding="utf-8")), read_claims()
    by, path = claimed(found, claims), data_folder() / UNCLAIMED
    reasons = {key: reason for key, (_, reason) in listed().items()} if path.is_file() else {}
    for number in found:
        why = ", ".join(by[number]) or f"none: {reasons.get(number.key) or 'NO REASON YET'}"
        print(f"{number.section}\t{number.printed}\t{number.excerpt}\t{why}")
    seen = {name for names in by.values() for name in names}
    for claim in (claim for claim in claims if claim.id not in seen):
        print(f"not found: {claim.id} prints {claim.printed} {claim.unit} in {claim.where}")
    missing = unclaimed(by, found)
    if asked.update:
        write(missing, reasons, path)
    without = [key for key in missing if not reasons.get(key)]
    print(f"{len(found)} numbers; {missing.total()} without claim, {len(without)} without reason")


if __name__ == "__main__":
    main()
