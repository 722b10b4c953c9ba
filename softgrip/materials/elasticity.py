"""What one tensile test says of the elasticity of its material, with intervals."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from softgrip.arrays import Floats
from softgrip.checks import takes_numbers
from softgrip.materials import ludwick, yeoh
from softgrip.materials.bootstrap import block_bootstrap
from softgrip.materials.fitting import Fitting, curve
from softgrip.materials.tensile import TensileTest

WINDOW = 0.1
"""Strain up to which the slope at small strain is taken, if enough rows lie within it."""
WINDOW_ROWS = 6
"""Rows that it is taken from at least."""


@dataclass(frozen=True)
class Estimate:
    """A fitted number.

    Attributes:
        value: As fitted.
        low, high: Ends of its interval; see `block_bootstrap`.
    """

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Elasticity:
    """Laws fitted to the engineering curve of a test, up to its largest stress.

    Attributes:
        name: Of the test.
        young_modulus: E of Ludwick's law, Pa: its stress at strain 1, no slope.
        fractional_power: n of Ludwick's law.
        small_strain_modulus: Slope of the curve at small strain, Pa.
        window: Strain up to which that slope is taken.
        yeoh: The three coefficients of Yeoh's law, Pa.
        ludwick_rms, yeoh_rms: Misfit of the laws, root mean square, Pa.
        ludwick_holds: Whether Ludwick's law describes the curve; see `ludwick.LudwickFit`.
        largest_strain: Up to which they are fitted.
        rows: That they are fitted to.
        confidence: Of the intervals.
    """

    name: str
    young_modulus: Estimate
    fractional_power: Estimate
    small_strain_modulus: Estimate
    window: float
    yeoh: tuple[Estimate, Estimate, Estimate]
    ludwick_rms: float
    yeoh_rms: float
    ludwick_holds: bool
    largest_strain: float
    rows: int
    confidence: float


@takes_numbers
def elasticity(
    test: TensileTest,
    *,
    young_modulus: float | None = None,
    preload_error: float = 0.0,
    confidence: float = 0.95,
    resamples: int = 200,
    seed: int = 0,
) -> Elasticity:
    """Fit Ludwick's law, the slope at small strain and Yeoh's law to a test of any material.

    Args:
        test: One of `softgrip.materials.tester.read_export`, or of the database.
        young_modulus: E of Ludwick's law to hold, Pa; None to fit it with n.
        preload_error: Standard error of a stress that was taken off, Pa.
        confidence, resamples, seed: As of `block_bootstrap`.

    Raises:
        InvalidInputError: If the curve is too short for a law, or none fits it.
    """
    whole = curve(test, Fitting("engineering", longest_strain=inf))
    begin = small_strains(*whole)

    def estimates(
        of: tuple[Floats, Floats], law: Callable[[Floats, Floats], Sequence[float]]
    ) -> list[Estimate]:
        ends = block_bootstrap(
            *of,
            law,
            confidence=confidence,
            resamples=resamples,
            seed=seed,
            offset=preload_error,
        )
        return [Estimate(value, *end) for value, end in zip(law(*of), ends, strict=True)]

    def ludwick_law(strain: Floats, stress: Floats) -> tuple[float, float]:
        law = ludwick.fit(strain, stress, young_modulus=young_modulus)
        return law.young_modulus, law.fractional_power

    modulus, power = estimates(whole, ludwick_law)
    (small,) = estimates(begin, _slope)
    first, second, third = estimates(whole, lambda e, s: yeoh.fit(e, s).coefficients)
    law = ludwick.fit(*whole, young_modulus=young_modulus)
    return Elasticity(
        name=test.name,
        young_modulus=modulus,
        fractional_power=power,
        small_strain_modulus=small,
        window=float(begin[0][-1]),
        yeoh=(first, second, third),
        ludwick_rms=law.rms_stress,
        yeoh_rms=yeoh.fit(*whole).rms_stress,
        ludwick_holds=law.holds,
        largest_strain=float(whole[0][-1]),
        rows=whole[0].size,
        confidence=confidence,
    )


def small_strains(strain: Floats, stress: Floats) -> tuple[Floats, Floats]:
    """Return the rows up to `WINDOW`, or as many as `WINDOW_ROWS`, of a curve that rises."""
    rows = max(WINDOW_ROWS, int(np.searchsorted(strain, WINDOW, side="right")))
    return strain[:rows], stress[:rows]


def _slope(strain: Floats, stress: Floats) -> tuple[float]:
    about = strain - strain.mean()
    # Rows that are drawn again may all be one: they have no slope.
    return (float(about @ stress / max(float(about @ about), 1e-300)),)
