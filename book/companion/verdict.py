"""Verdicts: what comes of a claim when it is recomputed, by rule and never by hand."""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from enum import StrEnum
from importlib import import_module
from typing import Any, TypeVar

from book.companion.claims import Claim, claim_of, read_claims
from softgrip.errors import DataFileError

CLOSE = 0.05
"""Largest relative difference that is still called close."""


class Verdict(StrEnum):
    """What came of a claim."""

    REPRODUCED = "reproduced"
    """From stated inputs alone, the value rounds to the printed string."""
    CLOSE = "close"
    """From stated inputs, not to the last digit, but within 5 %."""
    ASSUMED = "assumed"
    """It comes out under a named assumption for an unstated or misprinted input."""
    DIFFERS = "differs"
    """The stated inputs give another number, or no named assumption brings it out."""
    MEASURED = "measured"
    """A physical measurement: there is nothing to recompute it from."""
    CITED = "cited"
    """Taken from other literature by the dissertation."""


@dataclass(frozen=True)
class Entry:
    """A claim with its recomputed value and verdict."""

    claim: Claim
    recomputed: float | None
    verdict: Verdict
    under_assumption: float | None = None
    simulated: bool = False
    """Whether the recomputed value is one of the simulated rig."""
    band: tuple[tuple[Any, float], ...] = ()
    """(input, value) over the declared range of an unstated input."""
    function: str = ""
    """What recomputed it, with its module; empty if nothing did."""

    def record(self) -> dict[str, Any]:
        """Return the entry as plain values, as ``ledger.json`` holds it."""
        claim = self.claim
        band = claim.band
        return {
            "id": claim.id,
            "chapter": claim.chapter,
            "where": claim.where,
            "what": claim.what,
            "unit": claim.unit,
            "relation": claim.relation,
            "printed": claim.printed,
            "recomputed": self.recomputed,
            "simulated": self.simulated,
            "verdict": str(self.verdict),
            "assumptions": claim.assumptions,
            "under_assumption": self.under_assumption,
            "band": {"what": band.what, "values": [list(pair) for pair in self.band]}
            if band
            else None,
            "note": claim.note,
            "function": self.function,
        }


def decimals(printed: str) -> int:
    """Count the decimals of a printed number.

    >>> decimals("2.365"), decimals("96"), decimals("6.61e-4")
    (3, 0, 6)
    """
    mantissa, _, exponent = printed.lower().partition("e")
    return len(mantissa.partition(".")[2]) - int(exponent or 0)


def comes_out(claim: Claim, value: float) -> bool:
    """Tell whether a value rounds to the printed string (or stands to it as printed)."""
    number = float(claim.printed)
    if claim.relation == "<":
        return value < number
    if claim.relation == ">":
        return value > number
    # Half a unit of the last place, and the error of writing it in binary.
    return abs(value - number) <= 0.5 * 10.0 ** -decimals(claim.printed) * (1 + 1e-9)


def _from_inputs(claim: Claim, stated: float | None, assumed: float | None) -> Verdict:
    if stated is not None:
        if comes_out(claim, stated):
            return Verdict.REPRODUCED
        if abs(stated - float(claim.printed)) <= CLOSE * abs(float(claim.printed)):
            return Verdict.CLOSE
    if assumed is not None and comes_out(claim, assumed):
        return Verdict.ASSUMED
    return Verdict.DIFFERS


Function = TypeVar("Function", bound=Callable[..., float])


def simulated(function: Function) -> Function:
    """Mark a recomputation as simulated: it never counts as coming from stated inputs."""
    function.simulated = True  # type: ignore[attr-defined]
    return function


def _function(claim: Claim) -> Callable[..., float]:
    module = import_module(f"book.chapter_{claim.chapter}.numbers")
    found: Callable[..., float] | None = getattr(module, claim.function, None)
    if found is None:
        raise DataFileError(
            claim.id, expected=f"a function of {module.__name__}", got=claim.function
        )
    if getattr(found, "simulated", False) and claim.basis == "inputs" and claim.stated:
        raise DataFileError(
            claim.id, expected="a measurement or an assumption, if it is simulated", got="inputs"
        )
    return found


def judge(claim: Claim) -> Entry:
    """Recompute a claim and give the verdict that follows.

    Raises:
        DataFileError: If the claim can be recomputed from inputs, but names no function that does,
            or one that does not exist, or tries an assumption without writing it out.
    """
    if not claim.function:
        if claim.basis == "inputs":
            raise DataFileError(claim.id, expected="a function that recomputes it", got="none")
        verdict = Verdict.CITED if claim.basis == "citation" else Verdict.MEASURED
        return Entry(claim, None, verdict)
    if bool(claim.assume) != bool(claim.assumptions):
        raise DataFileError(
            claim.id, expected="assume and assumptions together", got="one without the other"
        )
    function = _function(claim)
    stated = float(function(**claim.arguments)) if claim.stated else None
    assumed = float(function(**claim.arguments | claim.assume)) if claim.assume else None
    band: tuple[tuple[Any, float], ...] = ()
    if swept := claim.band:
        given = claim.arguments | claim.assume
        band = tuple((v, float(function(**given | {swept.argument: v}))) for v in swept.values)
    if claim.basis == "citation":
        verdict = Verdict.CITED
    elif claim.basis == "measurement":
        verdict = Verdict.MEASURED
    else:
        verdict = _from_inputs(claim, stated, assumed)
    recomputed = assumed if stated is None or verdict is Verdict.ASSUMED else stated
    return Entry(
        claim,
        recomputed,
        verdict,
        assumed,
        getattr(function, "simulated", False),
        band,
        f"{function.__module__}.{function.__name__}",
    )


def ledger(chapter: int | None = None, where: Collection[str] = ()) -> list[Entry]:
    """Judge the claims of a chapter, or of all; with ``where`` those of places, by name, alone."""
    claims = read_claims(chapter)
    return [judge(claim) for claim in claims if not where or claim.where in where]


def verdict_of(chapter: int, claim: str, key: object = "") -> Verdict:
    """Judge one claim, by id and key as for `claim_of`."""
    return judge(claim_of(chapter, claim, key)).verdict
