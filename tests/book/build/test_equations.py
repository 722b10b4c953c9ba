"""Each equation of the dissertation: one owner, a test, and links to both under it on its page."""

import ast
import re
from collections import Counter

import pytest

from book.build.equations import NUMBERS, owners, pairs
from book.build.tracing import ROOT

BY_OWNER = {place.full_name: place for place in owners()}


def test_the_pages_set_the_98_equations_once_each():
    set_on = Counter()
    for page in (ROOT / "book").glob("*.md"):
        labels = re.findall(r"^\$\$ \(eq-(\d)-(\d+)\)$", page.read_text(), re.M)
        set_on.update(f"{chapter}.{k}" for chapter, k in labels)
    assert len(NUMBERS) == 98
    assert set_on == Counter(NUMBERS)


def test_each_has_one_owner():
    owned = Counter(number for place in owners() for number in place.numbers)
    assert owned == Counter(NUMBERS)


@pytest.mark.parametrize("name", BY_OWNER)
def test_an_owner_writes_each_number_out(name):
    """A search for the number finds it: no range hides one."""
    words = BY_OWNER[name].words
    assert set(re.findall(r"\((\d\.\d+)\)", words)) == BY_OWNER[name].numbers
    assert not re.search(r"\d\)(-| to )\(\d", words)


@pytest.mark.parametrize("number", NUMBERS)
def test_each_is_named_by_a_test_whose_file_uses_the_owner(number):
    assert number in pairs()
    owner, test = pairs()[number]
    used = {
        name
        for node in ast.walk(ast.parse((ROOT / f"{test.path}.py").read_text()))
        for name in (getattr(node, "id", None), getattr(node, "attr", None))
    }
    # A method is called on what the file makes; a class may be made by another function.
    assert used & set(owner.name.split(".")), (owner, test)
