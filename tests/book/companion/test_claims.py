"""Claim files: cells are expanded, and mistakes in them are named."""

import pytest

from book.companion import claims as module
from book.companion.claims import claim_of, read_claims, resolved
from book.companion.printed import Printed
from softgrip.errors import DataFileError, InvalidInputError, UnknownNameError

HEAD = "# provenance: printed\n# source: test\n"


@pytest.fixture
def write(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "data_folder", lambda: tmp_path)
    monkeypatch.setattr("softgrip.provenance.data_folder", lambda: tmp_path)
    (tmp_path / "claims").mkdir()
    return lambda text: (tmp_path / "claims/chapter_5.toml").write_text(HEAD + text)


BASE = 'where = "Table 5.1"\nunit = "1"\nbasis = "data"\n'


def test_a_table_of_cells_becomes_one_claim_a_cell(write):
    write(
        f'[[claim]]\n{BASE}id = "n-{{key}}"\nwhat = "n of {{key}}"\n'
        'arguments = {material = "{key}"}\n'
        '[claim.printed]\n"Mold Star 20T" = "2.174"\n"Ecoflex 00-10" = "1.538"\n'
    )
    first, second = read_claims(5)
    assert (first.id, first.what, first.printed) == (
        "n-mold-star-20t",
        "n of Mold Star 20T",
        "2.174",
    )
    assert first.arguments == {"material": "Mold Star 20T"}
    assert first.chapter == 5  # the file's own
    assert second.id == "n-ecoflex-00-10"


def test_a_key_is_a_name_even_if_it_is_a_number(write):
    write(
        f'[[claim]]\n{BASE}id = "row-{{key}}"\nwhat = "{{key}}"\n'
        'arguments = {row = "{key}", rounded = "1.5", other = "@row-{key}"}\n'
        '[claim.printed]\n"1" = "2.174"\n'
    )
    (claim,) = read_claims(5)
    found = resolved(claim.arguments)
    assert found == {"row": "1", "rounded": 1.5, "other": 2.174}
    assert [type(value) for value in found.values()] == [str, Printed, Printed]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (f'[[claim]]\n{BASE}id = "a"\nwhat = ""\nprinted = "1"\nverdict = "close"', "verdict"),
        (f'[[claim]]\n{BASE}id = "a"\nwhat = ""\nprinted = "1"\n' * 2, "a twice"),
        (
            f'[[claim]]\n{BASE}id = "a"\nwhat = ""\nprinted = "1"'.replace("data", "guess"),
            "'guess'",
        ),
    ],
)
def test_mistakes_are_named(write, text, message):
    write(text)
    with pytest.raises(DataFileError, match=message):
        read_claims(5)


HELD = f'[[claim]]\n{BASE}id = "limit"\nwhat = ""\nprinted = "5"\nexact = true\n'


def test_a_claim_may_be_held_against_the_print_of_another(write):
    write(
        f'{HELD}[[claim]]\n{BASE}id = "kept"\nwhat = ""\nprinted = "@limit"\n'
        'arguments = {value = "@reached"}\n'
    )
    _, kept = read_claims(5)
    assert (kept.printed, kept.exact, kept.stands_on) == ("5", True, {"limit", "reached"})


def test_a_claim_that_needs_its_own_print_does_not_stand_on_itself(write):
    write(f'{HELD}arguments = {{stated = "@limit", reached = ["@other"]}}\n')
    assert read_claims(5)[0].stands_on == {"other"}


@pytest.mark.parametrize("lender", ["nowhere", "kept"])
def test_a_print_that_is_lent_is_some_claims_own(write, lender):
    write(f'{HELD}[[claim]]\n{BASE}id = "kept"\nwhat = ""\nprinted = "@{lender}"\n')
    with pytest.raises(DataFileError, match=f"a print of its own, got @{lender}"):
        read_claims(5)


def test_chapter_without_claims_is_named():
    with pytest.raises(InvalidInputError, match="chapter: expected one with claims"):
        read_claims(99)


def test_claim_is_found_by_its_id_and_the_key_of_its_cell():
    claim = claim_of(5, "table-5.1-n-{key}", "Mold Star 20T")
    assert (claim.id, claim.printed) == ("table-5.1-n-mold-star-20t", "2.174")
    with pytest.raises(UnknownNameError, match=r"table-3\.2-top-1"):
        claim_of(3, "table-3.2-top-{key}", 9)
