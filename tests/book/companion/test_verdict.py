"""What comes of a claim follows by rule from print, basis, rounding and named assumptions."""

from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from book.companion import verdict as module
from book.companion.claims import Assumption, Band, Basis, Claim
from book.companion.verdict import Outcome, judge, meets
from softgrip.errors import DataFileError

FIND = module.recomputation
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
    monkeypatch.setattr(module, "recomputation", lambda claim: lambda x: x)
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
    assert judge(claim(**swept, regardless="x is above 8")).outcome is Outcome.CONTRADICTS


def banded(*cases, why=None, **fields):
    return judge(
        claim(arguments={"x": 9.0}, band=Band("x", "x", cases, continuous=why or {}), **fields)
    )


def test_print_between_two_cases_is_in_the_band_only_if_the_number_does_not_jump_there():
    assert banded(2.0, 3.0).in_band is False
    assert banded(2.0, 3.0, why={"x": "a line"}).in_band is True
    assert banded(4.0, 5.0, why={"x": "a line"}).in_band is False
    assert judge(claim()).in_band is None


def test_case_gives_the_print_within_the_rounding_of_both():
    assert banded(2.0, 2.374).met_by == ("2.374",)
    assert banded(2.0, "2.4").met_by == ()  # 2.35, 2.4 and 2.45: between them it may jump
    assert banded("2.38", 9.0).met_by == ("2.38",)  # from 2.375, where the print ends
    assert banded("2.4", 9.0, why={"x": "a line"}).in_band is True


def test_cases_are_joined_by_what_is_continuous_alone(monkeypatch):
    monkeypatch.setattr(module, "recomputation", lambda claim: lambda x, way: x)
    steps = ({"x": 2.0, "way": "a"}, {"x": 2.3, "way": "a"}, {"x": 3.0, "way": "b"})
    band = Band("x", cases=steps, continuous={"x": "a line"})
    assert band.joined == (True, False)
    inputs = {"arguments": {"x": 9.0, "way": "a"}, "band": band}
    assert judge(claim(**inputs)).in_band is False
    assert judge(claim(printed="2.15", **inputs)).in_band is True


def test_case_without_a_number_joins_nothing():
    entry = banded(2.0, float("nan"), 3.0, why={"x": "a line"})
    assert (entry.in_band, entry.met_by) == (False, ())
    assert banded(float("nan")).in_band is None


@pytest.mark.parametrize(("x", "expected"), [(2.37, "reproduced"), (2.48, "close"), (9.0, "open")])
def test_what_is_printed_with_a_word_like_about_has_no_bounds(x, expected):
    assert judge(claim(relation="~", arguments={"x": x})).outcome == expected


def test_about_may_be_off_by_more_in_what_stands_on_it_too(monkeypatch):
    """3.4-plateau is printed as about 0.15 N m, 3.4-measured-torque as 0.359 N m."""
    about, plain = ({"x": f"@3.4-{name}"} for name in ("plateau", "measured-torque"))
    assert judge(claim(basis="print", arguments=about)).outcome is Outcome.OPEN
    assert judge(claim(basis="print", arguments=plain)).outcome is Outcome.CONTRADICTS
    reason = {"regardless": "2.37 is sixteen times as much"}
    assert judge(claim(basis="print", arguments=about, **reason)).outcome is Outcome.CONTRADICTS


def test_what_speaks_for_an_assumption_is_counted_by_outcome():
    ids = {"fitted": 2.37, "out": 2.37, "near": 2.4, "off": 9.0}
    entries = [judge(claim(basis="assumption", id=i, arguments={"x": x})) for i, x in ids.items()]
    beside = judge(claim(assume={"x": 2.37}, assumption="half", arguments={"x": 9.0}))
    assert module.yields([*entries, beside]) == [module.Yield(HALF, 1, 1, 1, 3)]


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
    monkeypatch.setattr(module, "recomputation", FIND)
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
    monkeypatch.setattr(module, "recomputation", FIND)
    assert module.outcome_of(5, "table-5.2-true-{key}", "Dragon Skin 20") is Outcome.CONTRADICTS
    assert module.outcome_of(5, "table-5.2-true-{key}", "Dragon Skin FX Pro") is Outcome.REPRODUCED
