"""What logs tell of parameters together that they do not tell of each: ratios, products, totals."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from softgrip.arrays import Floats
from softgrip.simulator.fit_estimates import TOLD_WITHIN, Estimate, Inferred
from softgrip.simulator.fit_problem import DEVIATIONS

TOTALS = ("_volume", ".ballooning")
"""Ends of the names of parameters of which the sum may be told: the air of the fingers and of the
tube is one charge."""
BETTER = 2.0
"""How many times narrower than that of each part the interval of a combination must be."""


@dataclass(frozen=True)
class Combination:
    """A function of some parameters.

    Attributes:
        name: In words, such as ``finger.stiffness / finger.damping``.
        value: SI.
        slopes: Of its logarithm by those of the parameters, shape (parameters,).
    """

    name: str
    value: float
    slopes: Floats


def candidates(names: list[str], values: Floats) -> Iterator[Combination]:
    """Yield the ratios and products of two parameters each, and the totals.

    >>> *_, last = candidates(["a_volume", "b_volume"], np.array([1.0, 3.0]))
    >>> last.name, last.value, last.slopes.tolist()
    ('a_volume + b_volume', 4.0, [0.25, 0.75])
    """
    for i, j in combinations(range(len(names)), 2):
        for sign, word in ((-1.0, "/"), (1.0, "*")):
            slopes = np.zeros(len(names))
            slopes[i], slopes[j] = 1.0, sign
            value = float(values[i] * values[j] ** sign)
            yield Combination(f"{names[i]} {word} {names[j]}", value, slopes)
    for kind in TOTALS:
        part = np.array([name.endswith(kind) for name in names])
        if part.sum() > 1:
            words = " + ".join(name for name in names if name.endswith(kind))
            total = float(values[part].sum())
            yield Combination(words, total, np.where(part, values / total, 0.0))


def told_together(found: Inferred) -> tuple[Estimate, ...]:
    """Return, for each parameter that is not told, the combination with it that is told best.

    One that is not told much better than each of its parts is no news and is left out.
    """
    names = [one.name for one in found.problem.space]
    # Of the logarithms; of what may be nothing it is large enough to be no news.
    share = np.where(found.problem.logarithmic, 1.0, 1 / np.fmax(found.values, 1e-30))
    covariance = found.covariance * np.outer(share, share)
    alone = np.sqrt(np.diag(covariance))
    told: list[tuple[float, Combination]] = []
    for one in candidates(names, found.values):
        deviation = float(one.slopes @ covariance @ one.slopes) ** 0.5
        news = BETTER * deviation < alone[one.slopes != 0].min()
        if news and 2 * DEVIATIONS * deviation < np.log(TOLD_WITHIN):
            told.append((deviation, one))
    best: dict[str, Estimate] = {}
    for k, estimate in enumerate(found.estimates):
        own = [pair for pair in told if pair[1].slopes[k] and not estimate.told]
        if own:
            deviation, one = min(own, key=lambda pair: pair[0])
            spread = float(np.exp(DEVIATIONS * deviation))
            best[one.name] = Estimate(
                one.name, one.value, one.value / spread, one.value * spread, True
            )
    return tuple(best.values())
