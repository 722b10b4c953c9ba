"""Whether a simulated rig gives a print: what the fit of the twin kept, by claim."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from softgrip.provenance import data_rows
from softgrip.reads import remembered

FILE = "calibration/outcomes.csv"
WORDS = {
    "together": "with the others",
    "alone": "alone",
    "out of reach": "out of reach",
}
"""What the ledger says for a word of the file."""


@dataclass(frozen=True)
class Reach:
    """What the twin gives of a printed number, in the unit of the print.

    Attributes:
        word: "together" if the rig that is fitted to all prints gives it, or half of its ensemble;
            "alone" if some rig does; "out of reach" if none was found.
        best: Of the best rig.
        low, high: 5 and 95 % of the ensemble.
        nearest: Of the rig that comes nearest.
    """

    word: str
    best: float
    low: float
    high: float
    nearest: float


@remembered
def reaches() -> Mapping[str, Reach]:
    """Return what was kept, by the id of the claim."""
    numbers = ("best", "low", "high", "nearest")
    return MappingProxyType(
        {
            row["id"]: Reach(row["word"], *(float(row[name]) for name in numbers))
            for row in data_rows(FILE)
        }
    )


def told(claim: str) -> str:
    """Return what the ledger says of a claim; nothing where the twin has no such experiment."""
    found = reaches().get(claim)
    if found is None:
        return ""
    return f"{WORDS[found.word]}: {found.best:.3g} ({found.low:.3g} to {found.high:.3g})"
