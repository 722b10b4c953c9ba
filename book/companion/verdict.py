"""Verdicts: what comes of a claim when it is recomputed, and on what basis; by rule, never by hand.

The value is recomputed with the rounding of its printed inputs carried through (`carried`); the
print stands for an interval too. They meet, or they do not: the rest is what may be concluded.

- A number is printed to half a unit of its last place, be it an input or what is judged; a count, a
  definition or a setting is exact.
- A range is two numbers, its ends. Below, within, above and at least make a number a bound.
- About, around, approximately and almost do not change to how many places a number is printed, but
  say that it may be off by more, and not by how much: what misses it, or misses what follows from
  it, stays open, unless the claim says why no reading of the word reaches so far (``regardless``).
- A print lies in a band of unprinted inputs if a case gives it, or if two neighbouring cases have
  it between them and the number is continuous from one to the other (`Band.continuous`).
"""

from collections import Counter
from collections.abc import Callable, Collection
from dataclasses import dataclass
from enum import StrEnum
from importlib import import_module
from itertools import pairwise
from math import isfinite
from typing import Any, TypeVar

from book.companion import relations, twin_reach
from book.companion.claims import (
    Assumption,
    Basis,
    Claim,
    approximate,
    assumptions,
    claim_of,
    read_claims,
    resolved,
    sources,
)
from book.companion.judged import judged
from book.companion.printed import Printed, Spread, carried
from softgrip.errors import DataFileError
from softgrip.reads import remembered

CLOSE = 0.05
"""Largest relative difference of a model that is still called close."""


class Outcome(StrEnum):
    """What came of a claim."""

    REPRODUCED = "reproduced"
    """It comes out, within the rounding of its inputs."""
    CLOSE = "close"
    """A model comes within 5 %; never of a bound, a count or arithmetic."""
    CONTRADICTS = "contradicts"
    """What is printed excludes it, whatever the unprinted inputs are."""
    OPEN = "open"
    """Inputs that decide are not printed, nor how far a word like about reaches."""
    GIVEN = "given"
    """A setting, a part or a measurement: there is nothing to hold it against."""


def _finite(value: float) -> float | None:
    return value if isfinite(value) else None


@dataclass(frozen=True)
class Case:
    """What comes out for one case of a band."""

    inputs: str
    spread: Spread

    @property
    def ends(self) -> tuple[float, float, float]:
        """The value, and the least and largest that rounding allows; NaN if there is no number."""
        return self.spread.value, self.spread.low, self.spread.high

    @property
    def exists(self) -> bool:
        """Whether the inputs have a number at all."""
        return all(end == end for end in self.ends)


@dataclass(frozen=True)
class Entry:
    """A claim with what came of it."""

    claim: Claim
    outcome: Outcome
    spread: Spread | None = None
    """The recomputed value, with what rounding leaves open; None if nothing recomputes it."""
    band: tuple[Case, ...] = ()
    """What comes out over the declared range of unprinted inputs."""
    under_assumption: float | None = None
    """What comes out if an assumption takes the place of stated inputs."""
    function: str = ""
    """What recomputed it, with its module; empty if nothing did."""

    @property
    def basis(self) -> Basis:
        """On what it is judged."""
        return self.claim.basis

    @property
    def assumption(self) -> Assumption | None:
        """The assumption that it names."""
        name = self.claim.assumption
        return assumptions(self.claim.chapter)[name] if name else None

    @property
    def met_by(self) -> tuple[str, ...]:
        """Cases of the band that give the print, as they stand or at an end of their rounding.

        Between those ends the number may jump, as a settling time does.
        """
        return tuple(
            case.inputs
            for case in self.band
            if any(meets(self.claim, end, end) for end in case.ends)
        )

    @property
    def in_band(self) -> bool | None:
        """Whether the print lies in the band; None without one."""
        if self.claim.band is None or not any(case.exists for case in self.band):
            return None
        between = (
            sorted((*a.ends, *b.ends))
            for (a, b), joined in zip(pairwise(self.band), self.claim.band.joined, strict=True)
            if joined and a.exists and b.exists
        )
        return bool(self.met_by) or any(
            meets(self.claim, ends[0], ends[-1]) is not False for ends in between
        )

    def record(self) -> dict[str, Any]:
        """Return the entry as plain values, as ``ledger.json`` holds it."""
        claim, spread, assumed = self.claim, self.spread, self.assumption
        source = sources()[claim.author] if claim.author else None
        return {
            "id": claim.id,
            "chapter": claim.chapter,
            "where": claim.where,
            "what": claim.what,
            "unit": claim.unit,
            "relation": claim.relation,
            "printed": claim.printed,
            "exact": claim.exact,
            "outcome": str(self.outcome),
            "basis": str(self.basis),
            "nature": claim.nature,
            "value": _finite(spread.value) if spread else None,
            "low": _finite(spread.low) if spread else None,
            "high": _finite(spread.high) if spread else None,
            "inputs": claim.arguments,
            "assumed": claim.assume,
            "assumption": assumed.text if assumed else "",
            "fitted_to": [*assumed.fitted_to] if assumed else [],
            "tries": assumed.tries if assumed else 0,
            "under_assumption": self.under_assumption,
            "band": claim.band.what if claim.band else "",
            "band_values": [[case.inputs, _finite(case.spread.value)] for case in self.band],
            "in_band": self.in_band,
            "stands_on": sorted(claim.stands_on),
            "author": f"{source.repository} {source.file} at {source.commit}" if source else "",
            "regardless": claim.regardless,
            "needs": claim.needs,
            "note": claim.note,
            "function": self.function,
            "twin": twin_reach.told(claim.id),
        }


def meets(claim: Claim, low: float, high: float) -> bool | None:
    """Tell whether values between two stand to the print as printed; None if some do, some not."""
    number = Printed(claim.printed, exact=claim.exact)
    if claim.relation in ("=", "~"):
        # The error of writing a number in binary is no difference.
        slack = number.half + 1e-9 * max(abs(number), number.half)
        return low <= number + slack and high >= number - slack
    holds = [value < number if claim.relation == "<" else value > number for value in (low, high)]
    return holds[0] if holds[0] == holds[1] else None


def settled(claim: Claim) -> Outcome | None:
    """Return the outcome that a claim has whatever comes out of it; None if that decides."""
    if not claim.function or (claim.basis is Basis.RIG and claim.nature != "result"):
        return Outcome.GIVEN
    named = assumptions(claim.chapter).get(claim.assumption)
    fitted = claim.basis is Basis.ASSUMPTION and named is not None and claim.id in named.fitted_to
    return Outcome.OPEN if claim.basis is Basis.RIG or fitted else None


def may_be_close(claim: Claim) -> bool:
    """Tell whether a claim that its number misses may still be called close."""
    return claim.relation in ("=", "~") and not claim.exact and claim.basis is not Basis.PRINT


def unprinted(claim: Claim) -> bool:
    """Tell whether inputs that decide a claim are not printed."""
    return claim.basis in (Basis.AUTHOR, Basis.DATA, Basis.ASSUMPTION) or claim.band is not None


def _outcome(claim: Claim, spread: Spread) -> Outcome:
    if found := settled(claim):
        return found
    holds = meets(claim, spread.low, spread.high)
    if holds is None:
        return Outcome.OPEN
    if holds:
        return Outcome.REPRODUCED
    number = float(claim.printed)
    if may_be_close(claim) and abs(spread.value - number) <= CLOSE * abs(number):
        return Outcome.CLOSE
    undecided = (unprinted(claim) or approximate(claim)) and not claim.regardless
    return Outcome.OPEN if undecided else Outcome.CONTRADICTS


Function = TypeVar("Function", bound=Callable[..., float])


def simulated(function: Function) -> Function:
    """Mark a recomputation as simulated: what it gives stands on the rig alone."""
    function.simulated = True  # type: ignore[attr-defined]
    return function


def recomputation(claim: Claim) -> Callable[..., float]:
    """Return what recomputes a claim that names a function."""
    module = import_module(f"book.chapter_{claim.chapter}.numbers")
    found: Callable[..., float] | None = getattr(
        module, claim.function, getattr(relations, claim.function, None)
    )
    if found is None:
        raise DataFileError(
            claim.id,
            expected=f"a function of {module.__name__} or {relations.__name__}",
            got=claim.function,
        )
    return found


def _check(claim: Claim, function: Callable[..., float]) -> None:
    """Refuse a claim that says of itself what its fields do not bear out."""
    rules = {
        "a basis": claim.basis is not Basis.NONE,
        "the basis 'rig' exactly if it is simulated": (
            getattr(function, "simulated", False) == (claim.basis is Basis.RIG)
        ),
        "assume and an assumption's name together": bool(claim.assume) == bool(claim.assumption),
        "a named assumption on the basis 'assumption'": (
            claim.basis is not Basis.ASSUMPTION or bool(claim.assumption)
        ),
        "a source on the basis 'author' and nowhere else": (
            (claim.basis is Basis.AUTHOR) == bool(claim.author)
        ),
        "what is assumed not among the stated inputs, unless the basis is 'assumption'": (
            claim.basis is Basis.ASSUMPTION
            or claim.assume.items().isdisjoint(claim.arguments.items())
        ),
        "nothing 'regardless' on an assumption or the rig": (
            not claim.regardless or claim.basis not in (Basis.ASSUMPTION, Basis.RIG)
        ),
    }
    for rule, kept in rules.items():
        if not kept:
            raise DataFileError(claim.id, expected=rule, got=f"{claim}")


def judge(claim: Claim) -> Entry:
    """Recompute a claim and conclude what follows.

    Raises:
        DataFileError: If a result names no function, or one that does not exist, or the claim's
            basis is not what its other fields say.
    """
    kept: Entry | None = judged(claim.chapter, claim.id)
    if kept and kept.claim == claim:
        return kept
    if not claim.function:
        if claim.basis is not Basis.NONE or claim.nature == "result":
            raise DataFileError(claim.id, expected="a function that recomputes it", got="none")
        return Entry(claim, Outcome.GIVEN)
    _check(claim, recomputation(claim))
    return rejudged(claim)


def rejudged(claim: Claim) -> Entry:
    """Judge a claim, of which one was checked, whose inputs may have been changed since."""
    function = recomputation(claim)
    stated, assume = resolved(claim.arguments), resolved(claim.assume)
    inputs = stated | assume if claim.basis is Basis.ASSUMPTION else stated
    spread = carried(function, inputs)
    band = tuple(
        Case(", ".join(map(str, case.values())), carried(function, inputs | case))
        for case in (map(resolved, claim.band.inputs) if claim.band else ())
    )
    assumed = assume and claim.basis is not Basis.ASSUMPTION
    return Entry(
        claim,
        _outcome(claim, spread),
        spread,
        band,
        float(function(**stated | assume)) if assumed else None,
        f"{function.__module__}.{function.__name__}",
    )


def ledger(chapter: int | None = None, where: Collection[str] = ()) -> list[Entry]:
    """Judge the claims of a chapter, or of all; with ``where`` those of places, by name, alone."""
    claims = read_claims(chapter)
    return [judge(claim) for claim in claims if not where or claim.where in where]


def outcome_of(chapter: int, claim: str, key: object = "") -> Outcome:
    """Judge one claim, by id and key as for `claim_of`."""
    return judge(claim_of(chapter, claim, key)).outcome


@remembered
def recomputed(chapter: int, claim: str) -> Spread:
    """Return what comes of a claim that is recomputed, with what rounding leaves open."""
    spread = judge(claim_of(chapter, claim)).spread
    assert spread, f"nothing recomputes {claim}"
    return spread


@dataclass(frozen=True)
class Yield:
    """What comes of the claims that an assumption judges, and what it was fitted to."""

    assumption: Assumption
    fitted: int
    reproduced: int
    close: int
    of: int
    """Claims that it judges, those that it was fitted to left out: of which the two above are."""


def yields(entries: Collection[Entry]) -> list[Yield]:
    """Count, for each assumption that judges, what comes of numbers that it was not fitted to."""
    found: dict[str, list[Entry]] = {}
    for entry in entries:
        if entry.basis is Basis.ASSUMPTION:
            found.setdefault(entry.claim.assumption, []).append(entry)
    result = []
    for own in found.values():
        if (assumption := own[0].assumption) is not None:
            free = [e for e in own if e.claim.id not in assumption.fitted_to]
            count = Counter(entry.outcome for entry in free)
            met = count[Outcome.REPRODUCED], count[Outcome.CLOSE]
            result.append(Yield(assumption, len(assumption.fitted_to), *met, len(free)))
    return result
