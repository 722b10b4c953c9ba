"""Another input moves what hangs on it, by the laws that can be told by hand, and nothing else."""

from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from book.companion import inputs as module
from book.companion.claims import claim_by_id, read_claims, references
from book.companion.inputs import inputs, reached, with_inputs
from book.companion.ledger import expected
from book.companion.verdict import Outcome
from book.companion.what_if import what_if
from softgrip.errors import DataFileError, InvalidInputError, UnknownNameError

ROUNDING = 1e-12
"""Of a few sums and powers in another order."""


def entries(**values):
    return {change.after.claim.id: change.after for change in what_if(**values).changes}


def ratio(id, **values):
    """Return by which factor the number of a claim changes."""
    (change,) = [c for c in what_if(**values).changes if c.after.claim.id == id]
    return change.after.spread.value / change.before.spread.value


# What an input is.


def test_an_input_is_what_is_printed_and_where_that_is_repeated():
    assert inputs()["E"].places == (
        "table-5.1-e-dragon-skin-20",
        "3.4-modulus",
        "table-3.3-modulus-design-1-e1-",
        "table-3.3-modulus-design-2-e1-",
        "6.3-young-modulus",
    )
    # 94 mm is repeated as 0.94 m, and that is no repeat.
    assert inputs()["L"].places == ("3.4-length",)


def test_every_place_prints_the_stated_number():
    for one in inputs().values():
        assert {float(claim_by_id(place).printed) for place in one.places} <= {one.stated}


def test_every_reference_to_an_input_is_followed():
    for symbol, one in inputs().items():
        asked = {
            claim.id
            for claim in read_claims()
            if {*one.places} & (references([claim.arguments, claim.assume]) | {claim.print_of})
        }
        assert asked - {*one.places} <= {claim.id for claim in reached(symbol)}, symbol


def test_an_argument_of_the_name_with_another_number_is_another_input():
    by_script, assumed = ({claim.id for claim in reached(s)} for s in ("n", "n_assumed"))
    assert "3.2-power-of-pressure" in by_script
    assert by_script & assumed == {"table-3.3-estimated-design-1-e1-"}  # n, and n in its place
    sums = claim_by_id("3.4-sum-variance-1")
    assert with_inputs(sums, {"n": 2.2}) == sums
    assert with_inputs(sums, {"n_assumed": 2.2}).assume == {"power": 2.2}


def test_another_rubber_is_not_moved():
    soft = claim_by_id("table-3.3-estimated-design-3-e2-")
    own, other = with_inputs(soft, {"E": 0.4}).arguments["modulus"]
    assert (own, other) == ("@table-3.3-modulus-design-3-e2-", 0.4)


def test_a_default_that_holds_an_input_becomes_an_argument():
    claim = claim_by_id("table-3.2-kept-1")
    assert "power" not in claim.arguments
    assert with_inputs(claim, {"n": 1.5}).arguments["power"] == 1.5


def test_a_place_in_a_list_holds_one_of_its_numbers():
    claim = claim_by_id("4.3-settling-full-model")
    assert with_inputs(claim, {"ki": 2.0}).arguments["gains"] == [3.6, 2.0, 0.25]


def test_every_input_reaches_something():
    assert [symbol for symbol in inputs() if not reached(symbol)] == []


def test_an_input_that_starts_outside_its_range_is_refused(monkeypatch):
    row = {"symbol": "x", "name": "", "unit": "1", "claim": "", "arguments": "x"}
    row |= {"stated": "3", "low": "1", "high": "2"}
    monkeypatch.setattr(module, "data_rows", lambda name: [row])
    with pytest.raises(DataFileError, match="3"):
        module.inputs.__wrapped__()


# What comes of another one, by hand.


def test_the_power_of_the_pressure_is_one_more_than_the_reciprocal_of_n():
    entry = entries(n=2.0)["3.2-power-of-pressure"]
    assert (entry.spread.value, entry.outcome) == (1.5, Outcome.OPEN)


@pytest.mark.parametrize("id", ["table-3.3-estimated-design-1-e1-", "3.5-extended-frequency"])
def test_the_frequency_of_the_finger_by_its_powers(id):
    """Eq. (3.16) with n = 1: omega is proportional to E, w and (a + b)**3, by L**2, to the 1/2."""
    assert ratio(id, L=100.0) == pytest.approx(94 / 100, rel=ROUNDING)
    assert ratio(id, E=0.5) == pytest.approx((0.5 / 0.34) ** 0.5, rel=ROUNDING)
    assert ratio(id, w=25.0) == pytest.approx((25 / 30) ** 0.5, rel=ROUNDING)
    assert ratio(id, b=5.0) == pytest.approx(
        ((25 if "table" in id else 29) / (24 if "table" in id else 28)) ** 1.5, rel=ROUNDING
    )


def test_several_inputs_at_once():
    found = ratio("table-3.3-estimated-design-1-e1-", L=100.0, E=0.5)
    assert found == pytest.approx(94 / 100 * (0.5 / 0.34) ** 0.5, rel=ROUNDING)


def test_the_same_finger_with_another_rubber_scales_the_other_way():
    id = "table-3.3-estimated-design-3-e2-"
    assert ratio(id, E=0.5) == pytest.approx((0.34 / 0.5) ** 0.5, rel=ROUNDING)


def test_a_changed_value_is_exact_and_its_rounding_gone():
    id = "table-3.3-length-design-1-e1-"
    (change,) = [c for c in what_if(L=100.0).changes if c.after.claim.id == id]
    printed, exact = change.before.spread, change.after.spread
    assert (printed.low, printed.high) == pytest.approx((0.0935, 0.0945), rel=ROUNDING)
    assert (exact.low, exact.value, exact.high) == (0.1, 0.1, 0.1)


def test_a_percentage_of_another_set_point():
    entry = entries(step_1=50.0)["5.4-percent-design-1--60-deg--linear"]
    assert entry.spread.value == pytest.approx(100 * 2.03 / 50, rel=ROUNDING)
    assert entry.outcome is Outcome.CONTRADICTS


def test_what_is_held_against_an_input_is_held_against_the_new_one():
    id = "3.4-model-overestimates"  # 290 deg, above the measured angle
    assert entries(theta=285.0)[id].outcome is Outcome.REPRODUCED
    assert entries(theta=300.0)[id].outcome is Outcome.CONTRADICTS


def test_a_value_that_is_given_is_no_longer_about_itself():
    id = "3.4-pole-range-least"  # from about 0.7
    assert entries(zeta=0.6)[id].outcome is Outcome.CONTRADICTS


def test_what_prints_an_input_is_not_held_against_it():
    assert not {*inputs()["E"].places} & entries(E=0.4).keys()
    assert "table-3.1-optimum-top" in entries(n=1.5)
    assert "table-3.1-optimum-top" not in entries(n=1.5, a=21.0)


# What is given back.


def test_counts_are_those_of_the_ledger_but_for_what_moved():
    found = what_if(F_pad=0.11)
    assert found.before == Counter(Outcome(row["outcome"]) for row in expected().values())
    gone, come = (
        Counter(getattr(change, side).outcome for change in found.moved)
        for side in ("before", "after")
    )
    assert found.after == found.before - gone + come
    assert len(found.moved) + len(found.shifted) <= len(found.changes)
    assert found.moved


def test_a_result_tells_itself():
    text = what_if(F_pad=0.11)._repr_markdown_()
    assert "F_pad = 0.11 N (stated: 0.1)" in text
    assert "ledger.html#claim-2.2-proportional-cylinder-fem" in text
    assert what_if()._repr_markdown_().startswith("nothing changed: of 0 claims")


def test_before_is_the_ledger():
    wanted = expected()
    for change in (*what_if(E=0.4).changes, *what_if(w=31).changes):
        row = wanted[change.before.claim.id]
        assert change.before.outcome == row["outcome"]
        assert change.before.spread.value == pytest.approx(float(row["value"]), rel=1e-8)


@given(st.dictionaries(st.sampled_from([*inputs()]), st.just(None), max_size=5))
def test_the_stated_values_change_nothing(chosen):
    found = what_if(**{symbol: inputs()[symbol].stated for symbol in chosen})
    assert (found.values, found.changes) == ({}, ())


FAST = ("E", "L", "w", "b", "t", "M", "T", "step_1", "T_s", "F_pad")


@settings(max_examples=20, deadline=None)
@given(st.sampled_from(FAST), st.floats(0.0, 1.0))
def test_every_claim_that_hangs_on_it_is_judged_and_no_other(symbol, part):
    one = inputs()[symbol]
    value = one.low + part * (one.high - one.low)
    found = what_if(**{symbol: value})
    if value != one.stated:
        assert [c.after.claim.id for c in found.changes] == [c.id for c in reached(symbol)]


# How a value is given.


@pytest.mark.parametrize("same", [94, 94.0, "94", "94 mm", "9.4 cm", "0.094 m"])
def test_a_value_may_be_in_any_unit_of_its_dimension(same):
    assert what_if(L=same).values == {}


def test_a_quantity_of_pint():
    from pint import UnitRegistry

    registry = UnitRegistry()
    assert what_if(L=registry.Quantity(10, "cm")).values == {"L": 100.0}
    assert what_if(P=registry.Quantity(300, "kPa")).values == {"P": 0.3}


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"L": 200}, "70 to 110 mm, got 200"),
        ({"L": "94 N"}, "a length"),
        ({"L": "long"}, "a length"),
        ({"L": float("nan")}, "finite"),
        ({"K1": "3.6 mm"}, "a number in 1/s"),
        ({"n": "2 mm"}, "a share"),
    ],
)
def test_what_is_no_such_value_is_refused(given, message):
    with pytest.raises(InvalidInputError, match=message):
        what_if(**given)


def test_an_unknown_input_is_told_those_there_are():
    with pytest.raises(UnknownNameError, match="E_pad"):
        what_if(young=0.3)
