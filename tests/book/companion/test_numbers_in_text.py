"""Every number of the dissertation's text has a claim, or a reason why it has none."""

import re
import sys

import pytest

from book.companion.claims import Claim, read_claims
from tests.book import numbers_in_text as module
from tests.book.numbers_in_text import claimed, listed, numbers, prints, unclaimed, write

PAGE = r"""
 Abstract

A hand with three fingers.

Contents

	2.1	Introduction	52

 Chapter 2

A Title

2.1 Introduction

Since the 1960s [18], the three-finger hands [2, 3] of Figure 2.1 (a) and Section 3.3 and 3.4 bend
to 60 deg by Theorem 2 and (2.3), by 1) air or 2) oil, for the 5, 20, and 70 gw weights, $0.5 \ N$.
Dragon Skin 20 of Design 2(E1), $P_1 = -1.5\%$, $s^2 + 2.66s^2$, $2\pi/3 \ rad$, 0.227π,
4\times10^{-12}.

$$\frac{l}{2\pi} \begin{bmatrix} \frac{0.303\pi}{s^3} & 12 \end{bmatrix} x^{0.5}
(2.3)$$

44

2.2 Results

	b [mm]	t [mm]
Variance 1	4.0	1.5

Table 2.1: Four rows of twenty-two
"""


def claim(where="Section 2.1", printed="60", unit="deg", what="angle"):
    return Claim(
        id="c", chapter=2, where=where, what=what, unit=unit, printed=printed, nature="setting"
    )


@pytest.fixture(scope="module")
def found():
    return numbers(PAGE)


def one(found, printed):
    [number] = [number for number in found if number.printed == printed]
    return number


def test_numbers_are_found_and_what_is_none_is_left_out(found):
    assert [(number.section, number.printed) for number in found] == [
        ("abstract", "three"),
        *(("2.1", printed) for printed in ["three", "60", "5", "20", "70", "0.5", "-1.5", "2.66"]),
        *(("2.1", printed) for printed in ["2pi/3", "0.227pi", "4e-12", "0.303pi"]),
        *(("2.2", printed) for printed in ["4.0", "1.5", "four", "twenty-two"]),
    ]


def test_a_list_shares_the_unit_of_its_last_number(found):
    units = {number.printed: number.unit for number in found if number.section == "2.1"}
    assert [units[text] for text in ("5", "20", "70")] == ["gf"] * 3
    assert [units[text] for text in ("60", "0.5", "-1.5", "three")] == ["deg", "N", "%", ""]


def test_words_beside_a_number_are_few(found):
    assert max(len(number.excerpt) for number in found) <= 40


@pytest.mark.parametrize(
    ("fields", "printed", "expected"),
    [
        ({}, "60", True),
        ({"printed": "60.0"}, "60", True),
        ({"printed": "61"}, "60", False),
        ({"unit": "mm"}, "60", False),
        ({"unit": "1"}, "60", False),
        ({"unit": "1", "what": "angle (deg)"}, "60", True),
        ({"where": "Section 2.2"}, "60", False),
        ({"where": "Section 2.2 against Section 2.1"}, "60", True),
        ({"printed": "0.667", "unit": "pi rad"}, "2pi/3", True),
        ({"printed": "2.094", "unit": "rad"}, "2pi/3", True),
        ({"printed": "120"}, "2pi/3", True),
        ({"printed": "40.86"}, "0.227pi", False),  # another number of the text
        ({"where": "Eq. (2.3)", "printed": "0.303", "unit": "pi rad"}, "0.303pi", True),
        ({"where": "Table 2.1", "printed": "4.0", "unit": "mm"}, "4.0", True),
        ({"where": "Section 2.2", "printed": "4.0", "unit": "mm"}, "4.0", False),
        ({"where": "Table 2.1", "printed": "22", "unit": "1"}, "twenty-two", True),
        ({"where": "Table 2.1", "printed": "22", "unit": "mm"}, "twenty-two", False),
    ],
)
def test_a_claim_prints_what_has_its_place_unit_and_value(found, fields, printed, expected):
    assert prints(claim(**fields), one(found, printed)) is expected


def test_a_number_without_claim_is_counted(found):
    by = claimed(found, [claim()])
    assert not unclaimed(by, found)["2.1", "60"]
    twice = numbers(PAGE + "\nfour more")
    assert unclaimed(claimed(twice, [claim()]), twice)["2.2", "four"] == 2


def test_list_is_written_anew_with_the_reasons_it_has(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(module, "data_folder", lambda: tmp_path)
    monkeypatch.setattr("softgrip.provenance.data_folder", lambda: tmp_path)
    monkeypatch.setattr(module, "read_claims", lambda: [claim()])
    path = tmp_path / module.UNCLAIMED
    write({("2.1", "three"): 1, ("9.9", "8"): 1}, {("2.1", "three"): "so, it is"}, path)
    (tmp_path / "text").write_text(PAGE, encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["", str(tmp_path / "text"), "--update"])
    module.main()
    assert listed()["2.1", "three"] == (1, "so, it is")
    assert listed()["2.2", "four"] == (1, "")
    assert ("9.9", "8") not in listed()
    assert ("2.1", "60") not in listed()
    assert "15 without reason" in capsys.readouterr().out


@pytest.fixture(scope="module")
def text(root):
    """Return the dissertation's text, which no checkout holds."""
    path = root.parent / "shared" / "dissertation.txt"
    if not path.is_file():
        pytest.skip("needs the dissertation's text beside the checkout")
    return path.read_text(encoding="utf-8")


UPDATE = "python -m tests.book.numbers_in_text PATH --update, then write the reasons"


def test_each_number_of_the_text_has_a_claim_or_is_listed(text):
    found = numbers(text)
    missing = unclaimed(claimed(found, read_claims()), found)
    assert missing == {key: times for key, (times, _) in listed().items()}, UPDATE


def test_each_that_is_listed_has_a_reason():
    assert [key for key, (_, reason) in listed().items() if not reason] == [], UPDATE


def test_claims_that_reasons_name_exist():
    known = {found.id for found in read_claims()}
    for key, (_, reason) in listed().items():
        named = re.findall(r"\bclaims? ((?:table-)?\d[\w.-]*\w)", reason)
        assert set(named) <= known, key
