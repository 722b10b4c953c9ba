"""The first loading of a tensile test, from where its specimen takes load.

What comes before is no strain of the specimen: clamps that give way, rest, a crosshead's position.
What comes after its first peak is another specimen's: unloaded once, or broken.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from softgrip.arrays import Floats
from softgrip.checks import record, takes_numbers
from softgrip.errors import InvalidInputError
from softgrip.materials.toe import FEWEST, LIKELIER, Toe, noise, toe

Zero = Literal["file", "first row"]
"""What a strain is counted from where a record does not begin at it."""

FALLS = 0.01
"""Share of the strain's range by which it must fall for an unloading: less is noise."""
NEAR = 0.01
"""Share of the strain's range within which a record begins at zero."""
REST = 2e-3
"""Share of it within which the first rows are at rest."""
LOOSE = 3
"""Rows that loose clamps are seen in, or more."""
BROKEN = 0.1
"""Share of the largest stress by which it must have fallen in the end for a break."""
PRELOAD = 3e-3
"""Share of the largest stress below which one at the beginning is none."""
STEEPEST = 3.5
"""Power above which no curve of a material is taken to begin: the largest printed is 2.5."""


@dataclass(frozen=True, eq=False)
class FirstLoading:
    """The first loading of a test.

    Attributes:
        strain, stress: Of the specimen, shape (N,); the strain rises from row to row.
        slack: Strain that was taken off, dimensionless.
        preload: Stress that was taken off, Pa.
        preload_error: Its standard error, Pa; 0 if none was.
        notes: What was taken off and left out, one sentence each.
    """

    strain: Floats
    stress: Floats
    slack: float
    preload: float
    preload_error: float
    notes: tuple[str, ...]


@takes_numbers
def first_loading(strain: Floats, stress: Floats, *, zero: Zero | None = None) -> FirstLoading:
    """Return the first loading of a record.

    Args:
        strain: Engineering strain, shape (N,).
        stress: Engineering stress, shape (N,), Pa; tension above zero.
        zero: What the strain is counted from, where the record does not begin at zero: the file's
            zero, or the first row. None to find it or ask for it.

    Raises:
        InvalidInputError: If strain or stress does not rise, or what the strain is counted from
            cannot be told.
    """
    strain, stress = record(at_least=2, strain=strain, stress=stress)
    for name, values in (("strain", strain), ("stress", stress)):
        rise, fall = values.max() - values[0], values[0] - values.min()
        if not rise > fall:
            raise InvalidInputError(
                name,
                expected="one that rises; compression_positive=True turns signs",
                got=f"{values[0]:.4g} at first, then {values.min():.4g} to {values.max():.4g}",
            )
    rows, notes = _rows(strain, stress)
    strain, stress = strain[rows], stress[rows]
    if strain.size < FEWEST:
        raise InvalidInputError(
            "strain", expected=f"{FEWEST} rows of a first loading", got=strain.size
        )
    origin, slack = _origin(strain, stress, zero)
    begun = strain >= origin
    if slack:
        notes.append(f"the clamps gave way up to a strain of {origin:.4g}: it is taken off")
    elif abs(origin) > REST * np.ptp(strain):
        notes.append(f"the strain is counted from {origin:.4g} on")
    preload, error = _preload(strain - origin, stress)
    if preload:
        notes.append(
            f"a preload of {preload:.4g} +- {error:.2g} Pa is taken off, as an offset of the load "
            "cell: had it stretched the specimen before the extension was set to zero, E and n "
            "would not be the material's"
        )
    strain, stress = strain[begun] - origin, stress[begun] - preload
    scatter = noise(stress) / float(stress.max())
    if scatter > PRELOAD:
        notes.append(
            f"the noise is {scatter:.1%} of the largest stress: in it may hide a preload, or "
            f"clamps that gave way up to a strain of {toe(strain, stress).hidden:.2g}"
        )
    rising = np.concatenate([[True], np.diff(np.maximum.accumulate(strain)) > 0])
    return FirstLoading(strain[rising], stress[rising], slack, preload, error, tuple(notes))


def _rows(strain: Floats, stress: Floats) -> tuple[slice, list[str]]:
    """Return the rows until the strain first falls, or the stress does for good."""
    least = FALLS * float(np.ptp(strain))
    risen = int(np.argmax(strain > np.minimum.accumulate(strain) + least))
    low = int(np.argmin(strain[: risen + 1]))
    start = low if strain[0] > strain[low] + least else 0
    fallen = risen + np.flatnonzero(
        strain[risen:] < np.maximum.accumulate(strain[start:])[risen - start :] - least
    )
    turn = int(fallen[0]) if fallen.size else strain.size
    end = start + int(np.argmax(strain[start:turn])) + 1
    notes = []
    if fallen.size:
        notes.append(f"only the first loading is used: {strain.size - end} rows after it are not")
    peak = start + int(np.argmax(stress[start:end])) + 1
    if stress[end - 1] < (1 - BROKEN) * stress[peak - 1]:
        notes.append(f"the specimen broke: {end - peak} rows after the largest stress are left out")
        end = peak
    return slice(start, end), notes


def _origin(strain: Floats, stress: Floats, zero: Zero | None) -> tuple[float, float]:
    """Return the strain that is the specimen's zero, and how much of it is slack."""
    begun = toe(strain, stress)
    base = _counted(begun, strain) if zero is None else (0.0 if zero == "file" else strain[0])
    # Clamps were loose if some rows show it, and no such rows are missing.
    whole = strain[0] <= base + NEAR * np.ptp(strain)
    seen = whole and begun.knee > max(base, begun.strain[LOOSE])
    if seen and begun.likelier(begun.misfit(begun.knee), begun.misfit(base)) > LIKELIER:
        return begun.knee, begun.knee - float(base)
    return float(base), 0.0


def _counted(begun: Toe, strain: Floats) -> float:
    """Return what a strain is counted from: the file's zero or the first row."""
    first, reach = float(strain[0]), float(np.ptp(strain))
    if not first:
        return 0.0
    # From a zero before the first row the stress rises from nothing: there is no level.
    file = begun.misfit(0.0, level=first < 0)
    row = begun.misfit(first)
    likelier = begun.likelier(row, file) if begun.explains(min(row, file)) else 0.0
    if likelier > LIKELIER or (first > 0 and begun.power(0.0, level=False) > STEEPEST):
        return first
    if likelier < -LIKELIER or abs(first) <= NEAR * reach:
        return 0.0
    raise InvalidInputError(
        "zero",
        expected="'file' or 'first row': what the strain of a record is counted from that does "
        "not begin at zero",
        got=f"{first:.4g} at the first row",
    )


def _preload(strain: Floats, stress: Floats) -> tuple[float, float]:
    """Return the stress at the origin and its standard error, Pa; 0 where it may be noise."""
    if strain[0] > NEAR * strain[-1]:
        return 0.0, 0.0
    at_rest = int(np.argmax(strain > REST * strain[-1]))
    begun = toe(strain, stress)
    if begun.adequate and at_rest:
        start, error = begun.level(0.0)
    elif at_rest:
        start, error = float(stress[:at_rest].mean()), noise(stress) / at_rest**0.5
    else:
        # The record begins later: what a line from the origin gives is no preload.
        slope = begun.scale * float(begun.stress[-1] - begun.stress[0])
        slope /= float(begun.strain[-1] - begun.strain[0])
        start, error = float(stress[0]) - slope * float(strain[0]), noise(stress)
    least = max(3 * error, PRELOAD * float(np.ptp(stress)))
    return (start, error) if abs(start) > least else (0.0, 0.0)
