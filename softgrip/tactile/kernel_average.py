"""Kernel averages, Eq. (2.6) and (2.7): any kernel as they stand, and a fast sum of Gaussians.

The fast one is for one feature. About a cell's centre c, with x = c + u and all lengths in
bandwidths, each Gaussian is

    exp(-(x - x_i)^2 / 2) = exp(-u^2 / 2 + u (m - c)) exp(-(c - x_i)^2 / 2) exp(u (x_i - m)).

The first factor is common to numerator and denominator and cancels. The last is a short Taylor
series in u where cells are narrow, so that two polynomials a cell stand for all points, as in the
fast Gauss transform (Greengard and Strain, 1991). The middle one is scaled by that of the nearest
point: all terms of the denominator are positive and one is about 1, so that it cannot underflow.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import exp, factorial, hypot, log, sqrt

import numpy as np
from scipy.spatial.distance import cdist

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError

BLOCK = 2**18
"""Numbers that an intermediate array may hold: 2 MB, so that it stays in the cache."""

Kernel = Callable[[Floats], Floats]


def gaussian(squares: Floats) -> Floats:
    """Return K of Eq. (2.7) from squared distances by sigma^2, each row scaled to a largest of 1.

    The factor cancels in Eq. (2.6), which is then never 0/0: far from all points it tends to the
    target of the nearest.
    """
    weights: Floats = np.exp(-0.5 * (squares - squares.min(axis=1, keepdims=True)))
    return weights


def epanechnikov(squares: Floats) -> Floats:
    """Return 1 - d^2 where d < 1, else 0; a row without any such point falls to its nearest."""
    weights = np.clip(1 - squares, 0, None)
    empty = ~weights.any(axis=1)
    weights[empty] = squares[empty] == squares[empty].min(axis=1, keepdims=True)
    return weights


KERNELS: dict[str, Kernel] = {"gaussian": gaussian, "epanechnikov": epanechnikov}
"""Weights by kernel, of squared distances by the squared bandwidth, shape (queries, points)."""


def blocks(count: int, width: int) -> Iterator[slice]:
    """Cut `count` rows of a width into slices of at most `BLOCK` numbers, or of one row."""
    step = max(1, BLOCK // max(1, width))
    return (slice(start, min(start + step, count)) for start in range(0, count, step))


def scaled_squares(queries: Floats, points: Floats, bandwidth: float) -> Floats:
    """Return squared distances by the squared bandwidth, shape (queries, points).

    Raises:
        InvalidInputError: If one is too large for a floating-point number.
    """
    # Squared last: a bandwidth of 1e-200 has no square.
    with np.errstate(over="ignore"):
        squares: Floats = (cdist(queries, points) / bandwidth) ** 2
    if not np.isfinite(squares.max()):
        raise InvalidInputError("X", expected="distances below 1e150 bandwidths", got="farther")
    return squares


def exact_average(
    queries: Floats, points: Floats, targets: Floats, bandwidth: float, kernel: str = "gaussian"
) -> Floats:
    """Return the averages of Eq. (2.6) as it stands, block by block.

    Args:
        queries, points: Shapes (queries, features) and (points, features).
        targets: Shape (points,).
        bandwidth: sigma, > 0, unit of the features.
        kernel: A key of `KERNELS`.
    """
    found = np.empty(len(queries))
    for rows in blocks(len(queries), len(points)):
        weights = KERNELS[kernel](scaled_squares(queries[rows], points, bandwidth))
        found[rows] = weights @ targets / weights.sum(axis=1)
    return found


TERMS, EXPONENT = 10, 0.25
"""Terms of the Taylor series, and the largest ``|u (x_i - m)|`` that it is used for."""

DROPPED = 1e-14
"""Largest part of the denominator that is left out: points far beyond the nearest one."""

MOST_CELLS = 2**15
"""Cells that there may be, 5 MB; a bandwidth that needs more takes the exact sums."""

MARGIN = 10.0
"""Bandwidths by which the cells reach beyond the points."""

_SERIES = exp(EXPONENT) * EXPONENT**TERMS / factorial(TERMS)

BOUND = (DROPPED + _SERIES) / (1 - _SERIES)
"""Largest error of `fast_average` before rounding, in ranges of the targets: 3.5e-13.

A term of the denominator is in error by at most the part s = e^k k^n / n! (k the exponent, n the
terms), hence the denominator too, and the numerator, with targets from the middle of their range,
by at most s / 2 ranges times the denominator.
"""


@dataclass(frozen=True)
class Cells:
    """Equal cells on the line: where they begin, half a width (unit of x), and their number.

    The squared distance of a point that counts exceeds that of the nearest one by less than
    twice `reach`, in bandwidths.
    """

    low: float
    half: float
    count: int
    reach: float


def plan(queries: Floats, points: Floats, bandwidth: float) -> Cells | None:
    """Choose cells for sorted points; None where the exact sums are less work.

    For a cell of half width h whose centre is at most d from a point, those that count lie within
    ``R = h + |(d + h, sqrt(2 reach))|`` of the centre, and d is at most half the widest gap. Their
    spread S is then at most 2 R, and that of all points; h = 2 `EXPONENT` / S keeps the exponent.
    No cell is wider than a quarter of a bandwidth: a centre far from its queries would cost digits.
    """
    reach = log(len(points) / DROPPED)
    gap = float(np.diff(points).max(initial=0.0)) / bandwidth
    widest = 0.125
    spread = 2 * (widest + hypot(gap / 2 + widest, sqrt(2 * reach)))
    spread = min(spread, float(np.ptp(points)) / bandwidth)
    low = max(float(queries.min()), float(points[0]) - MARGIN * bandwidth)
    high = min(float(queries.max()), float(points[-1]) + MARGIN * bandwidth)
    if not (0 < spread < float("inf") and high > low):
        return None
    half = min(2 * EXPONENT / spread, widest) * bandwidth
    cells = (high - low) / (2 * half)
    if not cells < min(MOST_CELLS, len(queries) / (2 * TERMS)):
        return None
    return Cells(low, half, int(cells) + 1, reach)


def moments(
    cells: Cells, points: Floats, targets: Floats, bandwidth: float
) -> tuple[Floats, Floats, Floats]:
    """Return the centres of cells, and the series of denominator and numerator about them.

    Points must be sorted. The series have shape (TERMS, cells); u is in bandwidths.
    """
    centre = cells.low + cells.half * np.arange(1.0, 2 * cells.count, 2)
    right = np.searchsorted(points, centre).clip(1, len(points) - 1)
    nearest = np.minimum(abs(centre - points[right - 1]), abs(points[right] - centre))
    counts = cells.half + np.hypot(nearest + cells.half, sqrt(2 * cells.reach) * bandwidth)
    first = np.searchsorted(points, centre - counts)
    last = np.searchsorted(points, centre + counts, side="right") - 1
    middle = (points[first] + points[last]) / 2
    width = np.arange((last - first).max() + 1)
    below, above = np.empty((2, TERMS, cells.count))
    for rows in blocks(cells.count, len(width)):
        index = first[rows, None] + width
        inside = index <= last[rows, None]
        index[~inside] = len(points) - 1
        x, d = points[index], nearest[rows, None] / bandwidth
        away = abs(x - centre[rows, None]) / bandwidth
        term = np.exp(-0.5 * (away - d) * (away + d)) * inside
        slope = (x - middle[rows, None]) / bandwidth
        slope[~inside] = 0  # not to raise it to a power: it may be far away
        aimed = targets[index]
        for power in range(TERMS):
            below[power, rows] = term.sum(axis=1)
            above[power, rows] = np.einsum("ij,ij->i", term, aimed)
            term *= slope / (power + 1)
    return centre, below, above


def fast_average(queries: Floats, points: Floats, targets: Floats, bandwidth: float) -> Floats:
    """Return `exact_average` with the Gaussian kernel for one feature, to `BOUND`.

    Arguments as of `exact_average`, but queries and points of shapes (queries,) and (points,).
    Where the exact sums are less work, and for queries farther than `MARGIN` bandwidths beyond
    all points, it takes those.

    >>> x = np.linspace(0, 1, 69)
    >>> new = np.linspace(0, 1, 100_001)
    >>> fast = fast_average(new, x, x**2, 0.02)
    >>> exact = exact_average(new[:, None], x[:, None], x**2, 0.02)
    >>> bool(abs(fast - exact).max() < BOUND + 1e-14)
    True
    """
    if len(queries) <= 2 * TERMS:
        return exact_average(queries[:, None], points[:, None], targets, bandwidth)
    order = np.argsort(points, kind="stable")
    x, y = points[order], targets[order]
    middle = float(y.min() / 2 + y.max() / 2)
    cells = plan(queries, x, bandwidth)
    if cells is None:
        return exact_average(queries[:, None], points[:, None], targets, bandwidth)
    centre, below, above = moments(cells, x, y - middle, bandwidth)
    found = np.empty(len(queries))
    for rows in blocks(len(queries), 16):
        q = queries[rows]
        place = np.clip((q - cells.low) / (2 * cells.half), 0, cells.count - 1).astype(np.intp)
        # Cut where the query is beyond the cells: its answer is replaced below.
        u = np.clip(q - centre.take(place), -cells.half, cells.half) / bandwidth
        N, D = above[-1].take(place), below[-1].take(place)
        for power in range(TERMS - 2, -1, -1):
            N *= u
            N += above[power].take(place)
            D *= u
            D += below[power].take(place)
        found[rows] = middle + N / D
    end = cells.low + 2 * cells.half * cells.count
    outside = np.flatnonzero((queries < cells.low) | (queries > end))
    found[outside] = exact_average(queries[outside, None], points[:, None], targets, bandwidth)
    return found
