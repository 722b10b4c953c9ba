"""Errata: planted slips are found, innocent numbers have none, and each that is shown holds."""

import re
from dataclasses import replace
from importlib import import_module
from math import pi, sqrt

import pytest
from bs4 import BeautifulSoup

from book.companion import errata as module
from book.companion import slips
from book.companion.chips import SHOWN, errata_table, show_errata
from book.companion.claims import Basis, Claim, printed, read_claims, resolved
from book.companion.errata import KEPT, Erratum, contradicting, digest, errata, searched
from book.companion.printed import Printed, carried
from book.companion.slips import ASSUMPTION, PRINT, RESULT, Change, Found, search
from book.companion.verdict import judge, meets
from softgrip.provenance import data_rows

PART, WHOLE = 17.364, 6.1427


def quotient(part, whole):
    return part / whole


def found(printed, function=quotient, unit="1", relation="=", assumed=None, **arguments):
    raw = arguments or {"part": str(PART), "whole": str(WHOLE)}
    claim = Claim(
        id="planted", chapter=5, where="here", what="a number", unit=unit, printed=printed,
        basis=Basis.PRINT, relation=relation, arguments=raw, assumption="so",
    )  # fmt: skip
    inputs = resolved(raw)
    spread = carried(function, inputs)
    assert meets(claim, spread.low, spread.high) is False
    return search(claim, function, inputs, spread, assumed and carried(function, assumed))


@pytest.mark.parametrize(
    ("number", "change"),
    [
        (-PART / WHOLE, (RESULT, "with the other sign")),
        (PART / WHOLE * 10, (RESULT, "times 10")),
        (PART / WHOLE / 1000, (RESULT, "divided by 1000")),
        (PART / WHOLE * 2, (RESULT, "doubled")),
        (PART / WHOLE / (2 * pi), (RESULT, "divided by 2 pi")),
        (PART / WHOLE * 180 / pi, (RESULT, "times 180 / pi")),
        (PART / WHOLE * 9.80665e-3, (RESULT, "times 0.00980665 (gf to N)")),
        ((PART / WHOLE) ** 2, (RESULT, "squared")),
        (sqrt(PART / WHOLE), (RESULT, "as its square root")),
        (PART / WHOLE**2, ("whole", "squared")),
        (PART / sqrt(WHOLE), ("whole", "as its square root")),
        (sqrt(PART) / WHOLE, ("part", "as its square root")),
        (13.764 / WHOLE, ("part", "as 13.764, two digits swapped")),
        (17.634 / WHOLE, ("part", "as 17.634, two digits swapped")),
        (PART / 6.1927, ("whole", "as 6.1927, one digit changed")),
        (WHOLE / PART, ("part", "exchanged with whole")),
    ],
)
def test_a_planted_slip_is_found(number, change):
    assert Change(*change) in found(f"{number:.5g}").recovering


@pytest.mark.parametrize(
    ("text", "does"),
    [
        ("2.8628", "as 2.8268, two digits swapped"),
        ("2.8768", "as 2.8268, one digit changed"),
        ("8.2268", "as 2.8268, two digits swapped"),
    ],
)
def test_a_slip_in_the_print_itself_is_found(text, does):
    assert Change(PRINT, does) in found(text).recovering


def test_a_cut_number_a_percentage_of_the_other_and_an_assumption_are_found():
    assert Change(RESULT, "cut, not rounded") in found("2.82").recovering
    share = found("14.894", lambda error: error, unit="%", error="17.501").recovering
    assert Change(RESULT, "in percent of the other number") in share
    assumed = found("5.2001", assumed={"part": 5.2001, "whole": 1.0}).recovering
    assert assumed == (Change(ASSUMPTION, "so"),)


@pytest.fixture(scope="module")
def rows():
    """Return two claims that print different numbers of one column."""
    powers = [c for c in read_claims(5) if c.where == "Table 5.1" and c.unit == "1"]
    return powers[0], next(claim for claim in powers if claim.printed != powers[0].printed)


def test_a_number_read_from_another_row_is_found(rows):
    first, other = rows
    recovering = found(other.printed, lambda value: value, value=f"@{first.id}").recovering
    assert Change(first.id, f"read as {other.id}") in recovering


def test_prints_that_stand_in_each_others_place_are_found(rows):
    first, other = rows
    claim = replace(first, arguments={"value": other.printed})
    inputs = resolved(claim.arguments)
    spread = carried(lambda value: value, inputs)
    recovering = search(claim, lambda value: value, inputs, spread).recovering
    assert Change(PRINT, f"exchanged with {other.id}") in recovering


def test_an_innocent_number_has_none():
    assert found("7.3194").recovering == ()
    assert found("0.41377").recovering == ()


def test_each_change_that_is_tried_is_counted_once():
    # What is done to the only input shows in the result: its digits alone are further changes. To
    # cut five digits to five changes nothing.
    digits = 5 * 9 + 4
    tried = found("7.3194", lambda value: value, value="2.8268").tried
    assert tried == 2 * digits + len(slips.OPERATIONS)


def test_few_digits_are_a_weak_hint_and_many_are_not():
    entry = judge(next(claim for claim in read_claims(5) if claim.function))
    weak = found("3", lambda value: value, value=2.0)
    firm = found(f"{PART / WHOLE * 10:.5g}")
    assert Erratum(entry, weak).weak
    assert not Erratum(entry, firm).weak
    assert weak.others / weak.other_numbers > 0.3 > 0.05 > firm.others / firm.other_numbers


def test_what_has_no_value_is_no_change():
    def root(value):
        return sqrt(value)

    assert found("7.3194", root, value="2.8268").recovering == ()


@pytest.fixture(scope="module")
def listed():
    return errata()


def test_list_is_what_the_ledger_contradicts_of_the_dissertations_own(listed):
    own = {claim.id for claim in read_claims() if claim.nature != "citation"}
    accepted = {row["id"] for row in data_rows(module.EXPECTED) if row["outcome"] == "contradicts"}
    assert {erratum.entry.claim.id for erratum in listed} == accepted & own


def test_kept_searches_are_those_of_the_list(listed):
    assert [row.id for row in KEPT.read()] == [e.entry.claim.id for e in listed], "make accept"


def test_a_search_gives_the_same_again(listed):
    for erratum in sorted(listed, key=lambda erratum: erratum.found.tried)[:12:3]:
        assert searched(erratum.entry) == erratum.found


def test_what_has_changed_since_is_searched_anew(monkeypatch, listed):
    entry = listed[0].entry
    moved = replace(entry, claim=replace(entry.claim, printed="7.3194"))
    assert digest(moved) != digest(entry)
    monkeypatch.setattr(module, "contradicting", lambda: [moved])
    assert errata()[0].found == searched(moved)


FACTORS = {"doubled": 2, "halved": 0.5, "with the other sign": -1}


def applied(x: float, does: str) -> float:
    """Do to a number what a change says, by its words."""
    if does in FACTORS:
        return x * FACTORS[does]
    if does == "squared":
        return x * x
    if does == "as its square root":
        return sqrt(x)
    if does == "in percent of the other number":
        return 100 * x / (100 + x)
    verb, words = re.match(r"(times|divided by) ([\d. /pi]+)", does).groups()
    top, _, bottom = words.replace(" ", "").partition("/")
    factor = factor_of(top) / factor_of(bottom)
    return x * factor if verb == "times" else x / factor


def factor_of(words: str) -> float:
    return float(words.replace("pi", "") or 1) * (pi if "pi" in words else 1)


def rebuilt(raw, value, new, path=()):
    """Return arguments with each printed input, by its name, as a function makes it."""
    if isinstance(value, dict):
        return {k: rebuilt(raw[k], v, new, (*path, k)) for k, v in value.items()}
    if isinstance(value, tuple):
        return tuple(rebuilt(raw[k], v, new, (*path, k)) for k, v in enumerate(value))
    named = isinstance(raw, str) and raw.startswith("@")
    return new(raw[1:] if named else ".".join(map(str, path)), value)


def read_anew(value: Printed, does: str) -> Printed:
    """Return a printed input as a change reads it."""
    if does.startswith("read as "):
        return printed(does.removeprefix("read as "))
    if does.startswith("as ") and "," in does:
        return Printed(does[3 : does.index(",")], exact=not value.half)
    low, middle, high = (applied(value + k * value.half, does) for k in (-1, 0, 1))
    number = Printed(repr(middle))
    number.half = abs(high - low) / 2
    return number


def inputs_after(claim, stated, change: Change):
    if not change.does.startswith("exchanged with "):
        anew = {change.of: lambda value: read_anew(value, change.does)}
    else:
        found = {}
        rebuilt(claim.arguments, stated, lambda name, value: found.setdefault(name, value))
        names = (change.of, change.does.removeprefix("exchanged with "))
        anew = {
            name: lambda _, other=other: found[other]
            for name, other in zip(names, reversed(names), strict=True)
        }
    return rebuilt(
        claim.arguments, stated, lambda name, value: anew[name](value) if name in anew else value
    )


def brings_out(entry, change: Change) -> bool:
    claim, spread = entry.claim, entry.spread
    module, _, name = entry.function.rpartition(".")
    function = getattr(import_module(module), name)
    stated = resolved(claim.arguments)
    if change.of == PRINT and change.does.startswith("exchanged with "):
        other = printed(change.does.removeprefix("exchanged with "))
        return spread.low <= other + other.half and spread.high >= other - other.half
    if change.of == PRINT:
        text = change.does[3 : change.does.index(",")]
        once = sum(a != b for a, b in zip(text, claim.printed, strict=True)) == 1
        assert once or sorted(text) == sorted(claim.printed)
        return meets(replace(claim, printed=text), spread.low, spread.high)
    if change.does == "cut, not rounded":
        least, largest = sorted(map(abs, (spread.low, spread.high)))
        number = Printed(claim.printed)
        return least < abs(number) + 2 * number.half and largest >= abs(number) - 1e-9
    if change.of == RESULT:
        ends = [applied(value, change.does) for value in (spread.low, spread.high)]
        return meets(claim, min(ends), max(ends))
    assumed = change.of == ASSUMPTION
    after = stated | resolved(claim.assume) if assumed else inputs_after(claim, stated, change)
    reached = carried(function, after)
    return meets(claim, reached.low, reached.high)


def test_each_change_that_is_shown_brings_the_print_out(listed):
    for erratum in listed:
        for change in erratum.found.recovering[:SHOWN]:
            assert brings_out(erratum.entry, change), (erratum.entry.claim.id, change)


def test_page_shows_each_with_links_into_the_ledger_and_says_how_many_were_tried(listed):
    page = BeautifulSoup(show_errata().markup, "html.parser")
    rows = page.select("tbody tr")
    assert len(rows) == len(listed)
    known = {f"ledger.html#claim-{claim.id}" for claim in read_claims()}
    assert {link["href"] for link in page.select("a")} <= known
    for row, erratum in zip(rows, listed, strict=True):
        assert row.a["href"] == f"ledger.html#claim-{erratum.entry.claim.id}"
        assert erratum.entry.claim.printed in row.select_one("td.number").text
        assert str(erratum.found.tried) in row.select("td")[-1].text


def test_none_few_and_many_changes_are_told_apart(listed):
    entry = listed[0].entry

    def said(count):
        changes = tuple(Change(RESULT, f"times {k}") for k in range(count))
        table = errata_table([Erratum(entry, Found(50, changes, 40, 100))])
        return BeautifulSoup(table, "html.parser").select("td")[-1].text

    assert said(0) == "No single change found: 50 were tried."
    assert said(SHOWN).count("Or: ") == SHOWN - 1
    assert "Or: " not in said(SHOWN + 1)
    assert f"{SHOWN + 1} of 50 changes bring it out, and 40 of 100 other numbers: a weak" in said(4)


def test_no_number_is_typed_in_the_page(root):
    text = (root / "book" / "errata.md").read_text(encoding="utf-8").split("---", 2)[2]
    assert not re.search(r"\d", text.replace("{code-cell} ipython3", ""))


def test_contradictions_are_judged_anew():
    assert all(entry.outcome == "contradicts" for entry in contradicting())
