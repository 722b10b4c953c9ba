"""The list of hard sentences sees what it should, and the pages have none beyond a length."""

import pytest

from book.build.sentences import all_sentences, sentences

LONGEST = 45
"""Words. Guides to plain English ask for 25 at most; a list of named things may go beyond."""


def read(text):
    return [one.text for one in sentences("page", text)]


def test_a_full_stop_in_a_formula_a_role_or_a_short_form_ends_no_sentence():
    text = "By Eq. (3.10), $a. B$ is {claim}`2. X`, e.g. `c. D`. [A link](x.md). Is it? It is."
    parts = ["By Eq. (3.10), $a. B$ is {claim}`2. X`, e.g. `c. D`.", "[A link](x.md).", "Is it?"]
    assert read(text) == [*parts, "It is."]


def test_code_equations_options_and_headings_are_no_prose():
    text = "---\na: b\n---\n# Head\n\n:::{note}\n:class: x\nSaid.\n:::\n\n```\nb. C.\n```\n\n"
    assert read(text + "$$\nx. Y\n$$ (e)\n") == ["Said."]


@pytest.mark.parametrize(
    "text",
    [
        "What does tell of the capacity is the pressure.",
        "Of the eight foods ten more go unrecognised.",
        "Beside each number stands the verdict that it has.",
        "Only where the finger rests does the projection hold.",
        "Neither of the two controllers settles within the band.",
    ],
)
def test_an_inverted_opening_is_seen(text):
    (one,) = sentences("page", text)
    assert one.inverted
    assert one.weight > one.words


@pytest.mark.parametrize(
    "text",
    [
        "What does the pressure tell of the capacity?",
        "The pressure tells of the capacity, which stands in the model.",
        "In a log of another program, a row with an empty cell is left out.",
        "What is here",
    ],
)
def test_a_plain_one_a_question_and_a_lead_are_not(text):
    (one,) = sentences("page", text)
    assert not one.inverted


def test_a_formula_or_a_role_is_one_word():
    (one,) = sentences("page", "It is $a + b + c$, or {glue:text}`a` to {claim}`b`.")
    assert one.words == 7


def test_no_sentence_of_a_page_is_longer_than_any_reader_holds():
    assert [f"{one.page}: {one.text}" for one in all_sentences() if one.words > LONGEST] == []
