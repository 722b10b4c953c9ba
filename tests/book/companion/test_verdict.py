"""Verdicts follow by rule from printed string, stated inputs and named assumptions."""

from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from book.companion import verdict as module
from book.companion.claims import Claim
from book.companion.verdict import Verdict, comes_out, decimals, judge
from softgrip.errors import DataFileError

FIND = module._function


def claim(printed="2.37", basis="inputs", **fields):
    fields = {"function": "value", "arguments": {"x": 2.37}} | fields
    return Claim("c", 5, "here", "a number", "1", printed, basis, **fields)


@pytest.fixture(autouse=True)
def value(monkeypatch):
    monkeypatch.setattr(module, "_function", lambda claim: lambda x: x)


@pytest.mark.parametrize(
    ("x", "expected"),
    [
        (2.37, Verdict.REPRODUCED),
        (2.3749, Verdict.REPRODUCED),
        (2.3751, Verdict.CLOSE),
        (2.48, Verdict.CLOSE),
        (2.49, Verdict.DIFFERS),
        (-2.37, Verdict.DIFFERS),
    ],
)
def test_stated_inputs(x, expected):
    assert judge(claim(arguments={"x": x})).verdict is expected


def test_assumption_is_tried_when_the_stated_inputs_fail():
    entry = judge(claim(arguments={"x": 9.0}, assume={"x": 2.371}, assumptions="x is 2.371"))
    assert (entry.verdict, entry.recomputed) == (Verdict.ASSUMED, 2.371)


def test_assumption_that_does_not_bring_the_number_out_leaves_differs():
    entry = judge(claim(arguments={"x": 9.0}, assume={"x": 2.40}, assumptions="x is 2.4"))
    assert (entry.verdict, entry.recomputed) == (Verdict.DIFFERS, 9.0)


def test_unstated_input_never_counts_as_reproduced():
    entry = judge(claim(stated=False, assume={"x": 2.37}, assumptions="x is 2.37"))
    assert entry.verdict is Verdict.ASSUMED


@pytest.mark.parametrize(
    ("basis", "expected"), [("citation", Verdict.CITED), ("measurement", Verdict.MEASURED)]
)
def test_citations_and_measurements_keep_their_value_beside_the_print(basis, expected):
    entry = judge(claim(basis=basis))
    assert (entry.verdict, entry.recomputed) == (expected, 2.37)
    assert judge(claim(basis=basis, function="")).recomputed is None


@pytest.mark.parametrize(
    ("relation", "x", "expected"),
    [
        ("<", 9.99, Verdict.REPRODUCED),
        ("<", 10.2, Verdict.CLOSE),
        ("<", 12.3, Verdict.DIFFERS),
        (">", 10.1, Verdict.REPRODUCED),
        (">", 9.0, Verdict.DIFFERS),
    ],
)
def test_bounds(relation, x, expected):
    got = judge(claim(printed="10", relation=relation, arguments={"x": x}))
    assert got.verdict is expected


def test_simulated_value_never_counts_as_coming_from_stated_inputs(monkeypatch):
    monkeypatch.setattr(module, "_function", FIND)
    chapter = SimpleNamespace(__name__="chapter", value=module.simulated(lambda x: x))
    monkeypatch.setattr(module, "import_module", lambda name: chapter)
    assert judge(claim(basis="measurement")).simulated
    with pytest.raises(DataFileError, match="a measurement or an assumption, if it is simulated"):
        judge(claim())


def test_claim_that_could_be_recomputed_but_names_no_function_is_an_error():
    with pytest.raises(DataFileError, match="a function that recomputes it"):
        judge(claim(function=""))


def test_assumption_must_be_written_out():
    with pytest.raises(DataFileError, match="assume and assumptions together"):
        judge(claim(assume={"x": 1.0}))


@given(st.decimals(min_value=-1000, max_value=1000, places=3))
def test_a_printed_number_comes_out_of_itself(number):
    assert comes_out(claim(printed=str(number)), float(number))
    assert decimals(str(number)) == 3


@given(st.floats(-1e4, 1e4), st.integers(0, 6))
def test_a_value_comes_out_of_its_own_rounding(x, places):
    assert comes_out(claim(printed=f"{x:.{places}f}"), x)


def test_ledger_of_a_place_judges_its_claims_and_no_others(monkeypatch):
    asked = []
    monkeypatch.setattr(module, "judge", asked.append)
    module.ledger(5, ["Table 5.2"])
    assert {claim.where for claim in asked} == {"Table 5.2"}
    assert len(asked) == sum(claim.where == "Table 5.2" for claim in module.read_claims(5))


def test_one_claim_is_judged_by_its_id_and_key(monkeypatch):
    monkeypatch.setattr(module, "_function", FIND)
    assert module.verdict_of(5, "table-5.2-true-{key}", "Dragon Skin 20") is Verdict.DIFFERS
    assert module.verdict_of(5, "table-5.2-true-{key}", "Dragon Skin FX Pro") is Verdict.REPRODUCED
