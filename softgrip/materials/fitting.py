"""How a fractional power is read from a tensile test: what the dissertation leaves open.

"Curve fitting" names neither the stress (on the first or on the present area), nor how far the
curve is used, nor what is made least, nor whether E is held at its table value. Each combination
is a `Fitting`; what all of them give for the ten materials is kept in
``data/materials/ludwick_fits.csv``, so that it is there without the measurements.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from math import inf, nan
from types import MappingProxyType
from typing import Literal, get_args

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.kept import Kept
from softgrip.materials import ludwick, tensile
from softgrip.materials.table import table_5_1
from softgrip.materials.tensile import TensileTest, up_to_peak
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
        modulus: E "held" at the value of Table 5.1, or "free".
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


def fit(test: TensileTest, fitting: Fitting) -> ludwick.LudwickFit:
    """Fit the law to a test of one of the ten materials in the way that is named."""
    held = table_5_1()[test.name].young_modulus if fitting.modulus == "held" else None
    return ludwick.fit(*curve(test, fitting), young_modulus=held, loss=fitting.loss)


def bootstrap_interval(
    test: TensileTest,
    fitting: Fitting,
    *,
    confidence: float = 0.95,
    resamples: int = 200,
    seed: int = 0,
) -> tuple[float, float]:
    """Return the percentile interval of n when the curve's rows are drawn again, in runs.

    The law is not the curve, so its residuals are neither independent nor of mean zero: whole rows
    are drawn, in runs of about the square root of their number. The interval speaks of this one
    specimen and this way of fitting; it knows nothing of other specimens or other ways.

    Raises:
        InvalidInputError: If `confidence` is not between 0 and 1.
    """
    if not 0 < confidence < 1:
        raise InvalidInputError("confidence", expected="a number in (0, 1)", got=confidence)
    strain, stress = curve(test, fitting)
    held = table_5_1()[test.name].young_modulus if fitting.modulus == "held" else None
    length = max(2, round(strain.size**0.5))
    runs = -(-strain.size // length)
    random = np.random.default_rng(seed)
    powers = []
    for _ in range(resamples):
        # Runs go on from the end to the start: else both ends would be drawn too seldom.
        starts = random.integers(0, strain.size, runs)
        rows = (starts[:, None] + np.arange(length)).ravel() % strain.size
        again = ludwick.fit(strain[rows], stress[rows], young_modulus=held, loss=fitting.loss)
        powers.append(again.fractional_power)
    low, high = np.quantile(powers, [(1 - confidence) / 2, (1 + confidence) / 2])
    return float(low), float(high)


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
        return fit(test, fitting).fractional_power
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
