"""Every figure of the dissertation is drawn, or said to be absent, on the page of its chapter."""

import re

import pytest

from book.companion.absent import ABSENT, NUMBERS, absent
from book.companion.exhibit import BOOK, exhibits
from softgrip.errors import UnknownNameError

DRAWN = {item.number: item.page for item in exhibits() if item.kind == "figure"}


def test_every_figure_is_drawn_or_its_absence_is_said():
    whole = {name for name in ABSENT if "(" not in name}
    panels = {name.split(" ")[0] for name in ABSENT} - whole
    assert whole.isdisjoint(DRAWN)
    assert panels <= DRAWN.keys()
    printed = {number for number in DRAWN if number.split(".")[1].isdigit()}
    assert printed | whole == set(NUMBERS)


@pytest.mark.parametrize("number", NUMBERS)
def test_it_stands_on_its_page(number):
    page = DRAWN.get(number, f"chapter-{number[0]}")
    text = (BOOK / f"{page}.md").read_text("utf-8")
    lacking = [name for name in ABSENT if name.split(" ")[0] == number]
    shown = re.findall(rf'^(show|absent)\("Figure {re.escape(number)}"', text, re.MULTILINE)
    assert shown == ["show"] * (number in DRAWN) + ["absent"] * bool(lacking)


def test_its_reason_is_told(monkeypatch):
    told = absent("Figure 3.7")._repr_mimebundle_()["text/markdown"]
    assert told.startswith("*Figure 3.7 is not drawn:* it shows the two moulds")
    assert "{numref}" not in told
    monkeypatch.setenv("SOFTGRIP_BOOK", "static")
    assert ABSENT["3.7"] in absent("Figure 3.7")._repr_mimebundle_()["text/markdown"]
    with pytest.raises(UnknownNameError, match=r"Figure 3\.7"):
        absent("Figure 3.1")
