"""How a fractional power is read from a tensile test: what the dissertation leaves open.

"Curve fitting" names neither the stress (on the first or on the present area), nor how far the
curve is used, nor what is made least, nor whether E is held at its table value. Each combination
is a `Fitting`; what all of them give for the ten materials is kept in
``data/materials/ludwick_fits.csv``, so that it is there without the measurements.
"""

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from math import inf, nan
from types import MappingProxyType
from typing import Literal, get_args

import numpy as np

from softgrip.arrays import Floats
from softgrip.checks import takes_numbers
from softgrip.errors import FitWarning, InvalidInputError
from softgrip.kept import Kept
from softgrip.materials import ludwick, tensile
from softgrip.materials.bootstrap import block_bootstrap
from softgrip.materials.table import table_5_1
from softgrip.materials.tensile import SOFTEST, TensileTest, up_to_peak
from softgrip.provenance import Provenance
from softgrip.reads import remembered

Stress = Literal["true", "engineering"]
Modulus = Literal["held", "free"]
LONGEST_STRAINS = (2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, inf)


@dataclass(frozen=True)
class Fitting:
    """One way to fit Ludwick's law to a tensile test.

    Attributes:
        stress: "true" (force on the present area, of a solid that keeps its volume) or
            "engineering".
        loss: As for `softgrip.materials.ludwick.fit`.
        longest_strain: Engineering strain up to which the curve is used; never beyond its peak.
        modulus: E "held", for the ten materials at the value of Table 5.1, or "free".
    """

    stress: Stress = "true"
    loss: ludwick.Loss = "stress"
    longest_strain: float = 6.0
    modulus: Modulus = "held"


def curve(test: TensileTest, fitting: Fitting) -> tuple[Floats, Floats]:
    """Return the engineering strain and the stress [Pa] that a fitting uses, each of shape (N,)."""
    pulled = up_to_peak(test)
    used = (pulled.strain >= 0) & (pulled.strain <= fitting.longest_strain)
    strain, stress = pulled.strain[used], pulled.stress[used]
    return strain, stress * (1 + strain) if fitting.stress == "true" else stress


def held_modulus(test: TensileTest) -> tuple[float, str]:
    """Return the modulus that a fitting holds, Pa, and where it is from, in words.

    That of Table 5.1 for its materials, by name. For another, the test's own engineering stress at
    strain 1: the 100 % modulus of a data sheet, which the table's is.

    Raises:
        InvalidInputError: If the material is not in the table and the test does not reach strain 1.
    """
    if test.name in table_5_1():
        return table_5_1()[test.name].young_modulus, "Table 5.1"
    try:
        found = tensile.hundred_percent_modulus(test)
    except InvalidInputError:
        raise InvalidInputError(
            "young_modulus",
            expected=f"one in Pa, as {test.name!r} is not in Table 5.1, or a test past strain 1",
            got=f"none, strains {test.strain[0]:g} to {test.strain[-1]:g}",
        ) from None
    if found < SOFTEST:
        expected = f"{SOFTEST:g} Pa or more at strain 1, which is held as modulus"
        raise InvalidInputError("stress", expected=expected, got=found)
    return found, "the stress of the test at strain 1"


@takes_numbers
def fit(
    test: TensileTest, fitting: Fitting, *, young_modulus: float | None = None
) -> ludwick.LudwickFit:
    """Fit the law to a test in the way that is named.

    Args:
        test: Of any material.
        fitting: The way.
        young_modulus: E to hold, Pa; None for `held_modulus`, if the way holds it at all.

    Raises:
        InvalidInputError: As of `held_modulus` and `softgrip.materials.ludwick.fit`.

    Warns:
        FitWarning: If the law does not hold in that way, see `LudwickFit.holds`.
    """
    found = _fit(test, fitting, young_modulus)
    if not found.holds:
        held = "fitted" if fitting.modulus == "free" else f"held at {found.young_modulus:.4g} Pa"
        warnings.warn(
            f"{test.name}: Ludwick's law of the {fitting.stress} stress, with E {held}, misses the "
            f"curve by {found.missed:.1%} of its largest stress, beyond the noise; "
            f"n = {found.fractional_power:.3g} is that of another curve: try the other stress, a "
            "shorter strain, or E that is free",
            FitWarning,
            stacklevel=3,
        )
    return found


def _fit(test: TensileTest, fitting: Fitting, young_modulus: float | None) -> ludwick.LudwickFit:
    held = _held(test, fitting, young_modulus)
    return ludwick.fit(*curve(test, fitting), young_modulus=held, loss=fitting.loss)


def _held(test: TensileTest, fitting: Fitting, given: float | None) -> float | None:
    if fitting.modulus == "free":
        return None
    return held_modulus(test)[0] if given is None else given


@takes_numbers
def bootstrap_interval(
    test: TensileTest,
    fitting: Fitting,
    *,
    young_modulus: float | None = None,
    confidence: float = 0.95,
    resamples: int = 200,
    seed: int = 0,
) -> tuple[float, float]:
    """Return the interval of n of `fit` by `block_bootstrap`, with its errors."""
    held = _held(test, fitting, young_modulus)

    def power(strain: Floats, stress: Floats) -> tuple[float]:
        again = ludwick.fit(strain, stress, young_modulus=held, loss=fitting.loss)
        return (again.fractional_power,)

    (interval,) = block_bootstrap(
        *curve(test, fitting), power, confidence=confidence, resamples=resamples, seed=seed
    )
    return interval


def grid() -> tuple[Fitting, ...]:
    """Return every combination of the choices."""
    return tuple(
        Fitting(*choice)
        for choice in product(
            get_args(Stress), get_args(ludwick.Loss), LONGEST_STRAINS, get_args(Modulus)
        )
    )


@dataclass(frozen=True)
class Fitted:
    """The power that a way of fitting gives for a material."""

    material: str
    fitting: Fitting
    fractional_power: float
    """NaN where the best one runs to a limit: that way does not describe that material."""


def measure() -> Iterator[Fitted]:
    """Fit every material in every way; needs the tensile tests, takes some seconds."""
    tests = [tensile.load(name) for name in table_5_1()]
    for fitting, test in product(grid(), tests):
        yield Fitted(test.name, fitting, _power(test, fitting))


def _power(test: TensileTest, fitting: Fitting) -> float:
    try:
        return _fit(test, fitting, None).fractional_power
    except InvalidInputError:
        return nan


KEPT = Kept(
    "materials/ludwick_fits.csv",
    Fitted,
    measure,
    "Soft Robotics Materials Database (doi 10.1089/soro.2019.0115), fitted by: "
    "python -m softgrip.materials",
    notes="The fractional power n of Ludwick's law for ten elastomers, in every way of fitting of\n"
    "softgrip.materials.fitting. No measurement is contained.",
    number=".5f",
    exact=("longest_strain",),
    provenance=Provenance.PUBLIC,
)


@remembered
def kept() -> MappingProxyType[tuple[str, Fitting], float]:
    """Read what `measure` gave: n by material and way of fitting."""
    return MappingProxyType(
        {(row.material, row.fitting): row.fractional_power for row in KEPT.read()}
    )


def fractional_power(name: str, fitting: Fitting) -> float:
    """Return n of a material: fitted now where its test can be had, else as it is kept.

    NaN as of `Fitted`.
    """
    if tensile.available():
        return _power(tensile.load(name), fitting)
    return kept()[name, fitting]


@dataclass(frozen=True)
class Score:
    """How well a way of fitting gives the printed column of n.

    The printed values are the reciprocals of two-decimal numbers, so m = 1/n is what was read
    off: a value comes out when its m rounds to the printed one.
    """

    fitting: Fitting
    come_out: int
    within_2_percent: int
    within_5_percent: int
    median_error: float
    """Of the relative errors of n."""


def comes_out(fitted: float, printed: float) -> bool:
    """Tell whether two powers have the same reciprocal to two decimals.

    >>> comes_out(2.1706, 2.174), comes_out(2.2312, 2.174)
    (True, False)
    """
    return f"{1 / fitted:.2f}" == f"{1 / printed:.2f}"


def score(fitting: Fitting) -> Score:
    """Hold a way of fitting against the ten printed values."""
    found = kept()
    pairs = [(found[name, fitting], m.fractional_power) for name, m in table_5_1().items()]
    # Where a way gives no n at all, it is as wrong as can be.
    errors = np.nan_to_num([abs(n / printed - 1) for n, printed in pairs], nan=inf)
    return Score(
        fitting,
        come_out=sum(comes_out(n, printed) for n, printed in pairs),
        within_2_percent=int(np.sum(errors <= 0.02)),
        within_5_percent=int(np.sum(errors <= 0.05)),
        median_error=float(np.median(errors)),
    )


def ranking() -> list[Score]:
    """Return all scores, the best first: by values that come out, then by the median error."""
    return sorted((score(f) for f in grid()), key=lambda s: (-s.come_out, s.median_error))
