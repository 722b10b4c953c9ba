"""Claims as a page judges them: the recomputation in JavaScript, and what the rule takes beside.

A recomputation that is arithmetic alone runs on symbols, and so it can be translated. What asks a
symbol for its number, branches on it, searches or simulates cannot: `what_if` computes it.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from html import unescape
from typing import Any

import casadi as ca

from book.companion.chips import printed_cell
from book.companion.claims import Basis, Claim, claim_by_id, printed, read_claims, resolved
from book.companion.inputs import inputs, reached, replaced
from book.companion.printed import CORNERS_UP_TO, Printed, with_rounded_defaults
from book.companion.verdict import CLOSE, may_be_close, recomputation, settled, unprinted
from book.explore.javascript import javascript
from book.explore.scan import column
from softgrip.errors import InvalidInputError
from softgrip.reads import remembered


@dataclass(frozen=True)
class Leaf:
    """A number that a recomputation takes, as stated.

    Attributes:
        value: Of an input, or of a printed number.
        half: By how much its rounding may move it up or down.
        source: Index of the input; -1 for none.
    """

    value: float
    half: float
    source: int = -1


@dataclass(frozen=True)
class ClaimLaw:
    """A claim's recomputation in JavaScript, ``(arguments, results) => void``.

    Attributes:
        claim: The claim.
        leaves: What it takes, in order.
        source: The function.
        moved_by: Indices of the inputs on which its result depends.
    """

    claim: Claim
    leaves: tuple[Leaf, ...]
    source: str
    moved_by: frozenset[int]


@contextmanager
def _numberless() -> Iterator[None]:
    """Let nobody take a symbol for a number: CasADi gives NaN for one, and says nothing."""

    def refuse(_symbol: ca.SX) -> float:
        raise TypeError("a symbol is no number")

    own = ca.SX.__float__
    ca.SX.__float__ = refuse  # type: ignore[method-assign]
    try:
        yield
    finally:
        ca.SX.__float__ = own  # type: ignore[method-assign]


def _symbols(item: Any, leaves: list[Leaf], symbols: list[ca.SX]) -> Any:
    """Return arguments with a symbol for every leaf among them, which it notes."""
    if isinstance(item, Printed) and item.half:
        item = Leaf(float(item), item.half)
    if isinstance(item, Leaf):
        leaves.append(item)
        symbols.append(ca.SX.sym(f"x{len(leaves)}"))
        return symbols[-1]
    if isinstance(item, Printed):
        return float(item)
    if isinstance(item, Mapping):
        return {name: _symbols(inner, leaves, symbols) for name, inner in item.items()}
    if isinstance(item, tuple):
        return tuple(_symbols(inner, leaves, symbols) for inner in item)
    return item


def claim_law(claim: Claim, symbols: Sequence[str]) -> ClaimLaw | None:
    """Translate a claim's recomputation; None if it cannot be.

    Args:
        claim: The claim.
        symbols: Of the inputs that may change.
    """
    named: dict[str, Leaf] = {}
    typed: dict[tuple[str, float], Leaf] = {}
    for k, one in enumerate(inputs()[symbol] for symbol in symbols):
        named |= {f"@{p}": Leaf(one.stated, printed(p).half, k) for p in one.places}
        typed |= {(name, one.stated): Leaf(one.stated, 0.0, k) for name in one.arguments}
    open_claim, function = replaced(claim, named, typed), recomputation(claim)
    arguments = resolved(open_claim.arguments)
    if claim.basis is Basis.ASSUMPTION:
        arguments |= resolved(open_claim.assume)
    leaves: list[Leaf] = []
    given: list[ca.SX] = []
    taken = _symbols(with_rounded_defaults(function, arguments), leaves, given)
    try:
        with _numberless():
            found = column(function(**taken))
    except (TypeError, ValueError, RuntimeError, InvalidInputError):
        return None
    every = ca.vertcat(*given)
    source = javascript(ca.Function("law", [every], [found]))
    used = ca.jacobian(found, every).sparsity().get_triplet()[1] if given else []
    return ClaimLaw(claim, tuple(leaves), source, frozenset(leaves[k].source for k in used) - {-1})


@dataclass(frozen=True)
class PageClaims:
    """What a page judges of the claims that inputs reach.

    Attributes:
        symbols: Of the inputs that move something there, in order.
        laws: Of the claims that it judges.
        left: The other claims that these inputs reach.
    """

    symbols: tuple[str, ...]
    laws: tuple[ClaimLaw, ...]
    left: tuple[Claim, ...]

    def data(self) -> dict[str, Any]:
        """Return what the page's script takes, but for the laws."""
        sources = [*dict.fromkeys(law.source for law in self.laws)]
        return {
            "corners": CORNERS_UP_TO,
            "close": CLOSE,
            "claims": [
                self._shown(law.claim)
                | self._rule(law.claim)
                | {
                    "law": sources.index(law.source),
                    "x": [leaf.value for leaf in law.leaves],
                    "half": [leaf.half for leaf in law.leaves],
                    "from": [leaf.source for leaf in law.leaves],
                }
                for law in self.laws
            ],
            "left": [self._shown(claim) for claim in self.left],
        }

    def javascript(self) -> str:
        """Return the laws, each once, as a list."""
        return f"[{','.join(dict.fromkeys(law.source for law in self.laws))}]"

    def _of(self, place: str) -> int:
        """Return the index of the input that a claim prints; -1 if it prints none."""
        found = (k for k, s in enumerate(self.symbols) if place in inputs()[s].places)
        return next(found, -1)

    def _rule(self, claim: Claim) -> dict[str, Any]:
        """Return what the rule of `book.companion.verdict` takes of a claim."""
        about = {id for id in claim.stands_on if claim_by_id(id).relation == "~"}
        undecided = unprinted(claim) or claim.relation == "~" or any(self._of(a) < 0 for a in about)
        number = Printed(claim.printed, exact=claim.exact)
        return {
            "number": float(number),
            "half_unit": number.half,
            "relation": claim.relation,
            "held": self._of(claim.print_of),
            "settled": settled(claim) or "",
            "mayBeClose": may_be_close(claim),
            "undecided": undecided and not claim.regardless,
            "about": [] if claim.regardless else sorted(map(self._of, about)),
        }

    def _shown(self, claim: Claim) -> dict[str, Any]:
        """Return what a page shows of a claim, and which inputs it hangs on or prints."""
        return {
            "id": claim.id,
            "chapter": claim.chapter,
            "where": claim.where,
            "what": claim.what,
            "printed": unescape(printed_cell(claim)),
            "by": [k for k, s in enumerate(self.symbols) if claim in reached(s)],
            "prints": self._of(claim.id),
        }


@remembered
def page_claims() -> PageClaims:
    """Return what a page judges."""
    hanging = {claim.id: claim for symbol in inputs() for claim in reached(symbol)}
    known = tuple(inputs())
    found = [law for claim in hanging.values() if (law := claim_law(claim, known))]
    moving = {k for law in found for k in law.moved_by}
    held = {law.claim.print_of for law in found}
    symbols = tuple(s for k, s in enumerate(known) if k in moving or held & {*inputs()[s].places})
    own = {claim.id for symbol in symbols for claim in reached(symbol)}
    laws = [(claim, claim_law(claim, symbols)) for claim in read_claims() if claim.id in own]
    return PageClaims(
        symbols,
        tuple(law for _, law in laws if law),
        tuple(claim for claim, law in laws if not law),
    )
