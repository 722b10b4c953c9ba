"""Outcomes and values are those that were accepted, and the README's counts are theirs."""

import sys
from dataclasses import replace
from inspect import unwrap
from math import nan
from types import CodeType, FunctionType

import pytest

from book.companion.claims import approximate, claim_of, resolved
from book.companion.ledger import BEGIN, END, changes, counts_table, expected, frozen, write_csv
from book.companion.printed import Spread, _rounded
from book.companion.verdict import Case, judge, ledger


@pytest.fixture(scope="module")
def entries():
    return ledger()


def test_no_outcome_and_no_value_changed(entries):
    wanted = expected()
    assert {entry.claim.id for entry in entries} == set(wanted)
    changed = {e.claim.id: found for e in entries if (found := changes(e, wanted[e.claim.id]))}
    assert changed == {}, "if they should change: make accept, and look at the diff"


def test_a_value_that_moves_without_its_outcome_is_seen(entries):
    entry = next(e for e in entries if e.spread)
    accepted = expected()[entry.claim.id]
    assert changes(entry, accepted | {"value": str(entry.spread.value * (1 + 1e-4))})
    assert not changes(entry, accepted | {"value": str(entry.spread.value * (1 + 1e-8))})


@pytest.mark.parametrize(
    ("accepted", "seen"),
    [
        ("1 2 nan", False),
        ("1 2.00000002 nan", False),
        ("1 2.0002 nan", True),
        ("1 nan nan", True),
        ("1 2", True),
        ("", True),
    ],
)
def test_a_band_that_moves_is_seen_whatever_the_value_does(accepted, seen):
    entry = judge(claim_of(4, "4.4-same-response"))
    band = tuple(Case("", Spread(value, value, value)) for value in (1.0, 2.0, nan))
    now = replace(entry, band=band)
    found = changes(now, frozen(now) | {"band_values": accepted})
    assert set(found) == ({"band_values"} if seen else set())


def test_readme_has_the_counts(entries, root):
    text = (root / "README.md").read_text(encoding="utf-8")
    written = text.partition(BEGIN)[2].partition(END)[0].strip()
    assert written == counts_table(entries), "make ledger writes them"


def test_table_has_a_row_for_each_claim_and_the_published_columns(entries, tmp_path):
    write_csv(tmp_path / "ledger.csv", entries)
    head, *rows = (tmp_path / "ledger.csv").read_text(encoding="utf-8").splitlines()
    assert len(rows) >= len(entries)
    assert {
        "id", "chapter", "where", "what", "unit", "printed", "exact", "outcome", "basis", "value",
        "low", "high", "inputs", "assumed", "assumption", "fitted_to", "under_assumption", "band",
        "note", "function",
    } <= set(head.split(","))  # fmt: skip


def test_what_is_open_shows_a_band_or_what_it_was_fitted_to(entries):
    for entry in (e for e in entries if e.outcome == "open"):
        undecided = entry.spread.low != entry.spread.high
        fitted = entry.claim.basis == "assumption" and entry.claim.id in entry.assumption.fitted_to
        about = approximate(entry.claim)
        assert entry.band or undecided or fitted or about or entry.basis == "rig", entry.claim.id


WITHOUT_WIDTH = {
    "number_of": "a count",
    "surpassing": "a count",
    "share_of_a_count": "the nearest share of a whole number",
    "largest": "an exact number that no rounded one passes",
    "fastest": "one of the values to choose from, all of them exact but the area",
    "height_limit": "an exact limit that no rounded height passes",
    "lower_limit": "an exact limit that no rounded size passes",
    "upper_limit": "an exact limit that no rounded size passes",
}
"""Functions of rounded inputs whose value rounding need not move."""


def test_rounding_of_printed_inputs_gives_a_value_its_width(entries):
    judged = [e for e in entries if e.basis in ("print", "model", "author")]
    for entry in (e for e in judged if e.spread.low == e.spread.high):
        function = entry.function.rpartition(".")[2]
        exact = not [*_rounded(resolved(entry.claim.arguments))]
        aside = entry.claim.id == "6.4-filter-2-per-s-num-3"  # the far pole is not in it
        assert exact or function in WITHOUT_WIDTH or aside, entry.claim.id


PRINTS = {
    *("section", "table_3_1", "table_3_2", "table_3_3", "table_5_1", "table_5_2"),
    *("printed", "printed_text", "claim_of", "PRINTED", "FILTERS", "FAST", "SLOW", "run_printed"),
}
"""What reads a printed number, or holds it."""
COUNTED = {"prototypes"}
"""Functions that count what is printed, whatever it was rounded from."""


def _globals_of(function) -> set[str]:
    """Return the names of its module that a function uses, itself or by a helper in there."""
    module, codes, names = (
        vars(sys.modules[function.__module__]),
        [unwrap(function).__code__],
        set(),
    )
    while codes:
        code = codes.pop()
        new = {name for name in code.co_names if name in module} - names
        names |= new
        codes += [const for const in code.co_consts if isinstance(const, CodeType)]
        helpers = (unwrap(module[name]) for name in new if callable(module[name]))
        codes += [
            helper.__code__
            for helper in helpers
            if isinstance(helper, FunctionType) and helper.__module__ == function.__module__
        ]
    return names


def test_printed_numbers_come_to_a_recomputation_as_arguments(entries):
    """What a function reads itself has no rounding that could be carried through."""
    used = {e.function for e in entries if e.spread and e.basis != "rig"}
    for module, name in (full.rsplit(".", 1) for full in sorted(used)):
        read = _globals_of(getattr(sys.modules[module], name)) & PRINTS
        assert not read or name in COUNTED, (module, name, read)


def test_a_settling_time_that_jumps_over_the_print_does_not_lie_about_it(entries):
    entry = next(e for e in entries if e.claim.id == "6.4-simulated-settling")
    values = [case.spread.value for case in entry.band]
    assert min(values) < 0.55 < 0.65 < max(values)
    assert entry.in_band is False


def test_no_assumption_and_no_simulation_contradicts_the_print(entries):
    found = [e for e in entries if e.outcome == "contradicts"]
    assert not [e.claim.id for e in found if e.basis in ("assumption", "rig")]


def test_what_an_assumption_was_fitted_to_is_a_claim(entries):
    known = {entry.claim.id for entry in entries}
    for entry in entries:
        if entry.assumption:
            assert set(entry.assumption.fitted_to) <= known, entry.assumption.name


def test_what_is_given_says_what_would_be_needed_and_few_stand_alone(entries):
    given = [entry.claim for entry in entries if entry.outcome == "given"]
    assert [claim.id for claim in given if not claim.needs] == []
    held_against = set().union(*(entry.claim.stands_on for entry in entries))
    assert len({claim.id for claim in given} - held_against) <= 90
