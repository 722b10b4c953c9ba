"""Computed numbers in the prose of the page *Change an input*."""

from collections import Counter

from book.companion.inputs import inputs, reached
from book.explore.change_an_input import TENTH, moved_by_a_tenth
from book.explore.claim_laws import page_claims


def _most(count: Counter[str]) -> str:
    """Return the symbols of the inputs with the largest count."""
    most = max(count.values())
    return " and ".join(symbol for symbol, found in count.items() if found == most)


def _moved() -> Counter[str]:
    return Counter({symbol: moved_by_a_tenth(symbol) for symbol in page_claims().symbols})


def _reach() -> Counter[str]:
    return Counter({symbol: len(reached(symbol)) for symbol in inputs()})


WORDS = {
    "inputs": lambda: str(len(inputs())),
    "sliders": lambda: str(len(page_claims().symbols)),
    "hanging": lambda: str(len({claim.id for s in inputs() for claim in reached(s)})),
    "computed": lambda: str(len(page_claims().laws)),
    "left": lambda: str(len(page_claims().left)),
    "tenth": lambda: f"{100 * TENTH:g}",
    "widest": lambda: _most(_reach()),
    "widest_reach": lambda: str(max(_reach().values())),
    "mover": lambda: _most(_moved()),
    "mover_moves": lambda: str(max(_moved().values())),
    "unmoved": lambda: str(sum(not moved for moved in _moved().values())),
}
