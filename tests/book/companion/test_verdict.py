"""What comes of a claim follows by rule from print, basis, rounding and named assumptions."""

from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from book.companion import verdict as module
from book.companion.claims import Assumption, Band, Basis, Claim
from book.companion.verdict import Outcome, judge, meets
from softgrip.errors import DataFileError

FIND = module._function
HALF = Assumption("half", "x is a half", fitted_to=("fitted",))


def claim(printed="2.37", basis="model", **fields):
    fields = {"id": "c", "function": "value", "arguments": {"x": 2.37}} | fields
    if basis == "assumption":
        fields = {"assumption": "half", "assume": fields["arguments"]} | fields
    if basis == "author":
        fields |= {"author": "design script"}
    place = {"chapter": 5, "where": "here", "what": "a number", "unit": "1"}
    return Claim(printed=printed, basis=Basis(basis), **place | fields)


@pytest.fixture(autouse=True)
def value(monkeypatch):
    monkeypatch.setattr(module, "_function", lambda claim: lambda x: x)
    monkeypatch.setattr(module, "assumptions", lambda chapter: {"half": HALF})


@pytest.mark.parametrize(
    ("basis", "x", "expected"),
    [
        ("model", 2.37, "reproduced"),
        ("model", 2.3749, "reproduced"),
        ("model", 2.3751, "close"),
        ("model", 2.48, "close"),
        ("model", 2.49, "contradicts"),
        ("model", -2.37, "contradicts"),
        ("print", 2.3749, "reproduced"),
        ("print", 2.3751, "contradicts"),  # arithmetic is never close
        ("author", 2.48, "close"),
        ("author", 2.49, "open"),
        ("data", 2.49, "open"),
        ("assumption", 2.3749, "reproduced"),
        ("assumption", 2.48, "close"),
        ("assumption", 9.0, "open"),
    ],
)
def test_what_follows_on_each_basis(basis, x, expected):
    assert judge(claim(basis=basis, arguments={"x": x})).outcome == expected


@pytest.mark.parametrize(
    ("x", "expected"), [("2.4", "reproduced"), ("2.40", "contradicts"), ("2.3", "contradicts")]
)
def test_rounding_of_a_printed_input_is_carried(x, expected):
    assert judge(claim(basis="print", arguments={"x": x})).outcome == expected


def test_what_an_assumption_was_fitted_to_it_cannot_judge():
    assert judge(claim(basis="assumption")).outcome is Outcome.REPRODUCED
    assert judge(claim(basis="assumption", id="fitted")).outcome is Outcome.OPEN


def test_assumption_beside_stated_inputs_judges_nothing():
    entry = judge(claim(arguments={"x": 9.0}, assume={"x": 2.371}, assumption="half"))
    assert (entry.outcome, entry.under_assumption) == (Outcome.CONTRADICTS, 2.371)


def test_with_an_unprinted_input_a_number_stays_open_unless_none_can_bring_it_out():
    swept = {"arguments": {"x": 9.0}, "band": Band("x", "x", (2.0, 3.0))}
    assert judge(claim(**swept)).outcome is Outcome.OPEN
    assert judge(claim(**swept)).in_band
    assert judge(claim(**swept, regardless="x is above 8")).outcome is Outcome.CONTRADICTS
    outside = {**swept, "band": Band("x", cases=({"x": 4.0}, {"x": 5.0}))}
    assert not judge(claim(**outside)).in_band


@pytest.mark.parametrize("nature", ["measurement", "citation", "setting", "part"])
def test_what_nothing_is_held_against_is_given(nature):
    assert judge(claim(basis="", nature=nature, function="")).outcome is Outcome.GIVEN
    assert judge(claim(basis="print", nature=nature)).outcome is Outcome.REPRODUCED


@pytest.mark.parametrize(
    ("relation", "x", "expected"),
    [
        ("<", 9.99, "reproduced"),
        ("<", 10.0, "contradicts"),
        ("<", 10.2, "contradicts"),  # a broken bound is never close
        ("<", "10", "open"),
        (">", 10.1, "reproduced"),
        (">", 9.0, "contradicts"),
    ],
)
def test_bounds(relation, x, expected):
    got = judge(claim(printed="10", relation=relation, arguments={"x": x}))
    assert got.outcome == expected


def test_a_count_is_never_close():
    assert judge(claim(printed="40", exact=True, arguments={"x": 41})).outcome == "contradicts"
    assert judge(claim(printed="40", arguments={"x": 41})).outcome == "close"


def test_simulated_value_stands_on_the_rig_and_never_reproduces(monkeypatch):
    monkeypatch.setattr(module, "_function", FIND)
    chapter = SimpleNamespace(__name__="chapter", value=module.simulated(lambda x: x))
    monkeypatch.setattr(module, "import_module", lambda name: chapter)
    assert judge(claim(basis="rig")).outcome is Outcome.OPEN
    assert judge(claim(basis="rig", nature="measurement")).outcome is Outcome.GIVEN
    for basis in ("model", "print", "data"):
        with pytest.raises(DataFileError, match="the basis 'rig' exactly if it is simulated"):
            judge(claim(basis=basis))


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"function": ""}, "a function that recomputes it"),
        ({"basis": ""}, "a basis"),
        ({"assume": {"x": 1.0}}, "assume and an assumption's name together"),
        ({"assume": {"x": 2.37}, "assumption": "half"}, "assumed not among the stated inputs"),
        ({"author": "design script"}, "a source on the basis 'author'"),
        ({"basis": "assumption", "regardless": "so"}, "nothing 'regardless' on an assumption"),
    ],
)
def test_claim_that_is_not_what_it_says_is_refused(fields, message):
    with pytest.raises(DataFileError, match=message):
        judge(claim(**fields))


@given(st.floats(-1e4, 1e4), st.integers(0, 6))
def test_a_value_comes_out_of_its_own_rounding(x, places):
    assert meets(claim(printed=f"{x:.{places}f}"), x, x)


def test_ledger_of_a_place_judges_its_claims_and_no_others(monkeypatch):
    asked = []
    monkeypatch.setattr(module, "judge", asked.append)
    module.ledger(5, ["Table 5.2"])
    assert {claim.where for claim in asked} == {"Table 5.2"}
    assert len(asked) == sum(claim.where == "Table 5.2" for claim in module.read_claims(5))


def test_one_claim_is_judged_by_its_id_and_key(monkeypatch):
    monkeypatch.setattr(module, "_function", FIND)
    assert module.outcome_of(5, "table-5.2-true-{key}", "Dragon Skin 20") is Outcome.CONTRADICTS
    assert module.outcome_of(5, "table-5.2-true-{key}", "Dragon Skin FX Pro") is Outcome.REPRODUCED
