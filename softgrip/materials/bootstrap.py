"""Intervals of what is fitted to a measured curve, by drawing its rows again in runs."""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.special import ndtr, stdtrit

from softgrip.arrays import Floats, check_positive
from softgrip.checks import check_not_negative, record, takes_numbers
from softgrip.errors import InvalidInputError


@takes_numbers
def block_bootstrap(
    strain: Floats,
    stress: Floats,
    estimate: Callable[[Floats, Floats], Sequence[float]],
    *,
    confidence: float = 0.95,
    resamples: int = 200,
    seed: int = 0,
    offset: float = 0.0,
) -> tuple[tuple[float, float], ...]:
    """Return the percentile interval of each estimate when a curve's rows are drawn again, in runs.

    A law is not the curve, so its residuals are neither independent nor of mean zero: whole rows
    are drawn, in runs of about the square root of their number. The interval speaks of this one
    specimen and this way of fitting; it knows nothing of other specimens or other ways.

    Few runs vary less when they are drawn again than other ones would: the percentiles are further
    out than asked, as Student's t is than the normal distribution (Hesterberg, The American
    Statistician 69:4, 2015, the expanded percentile interval).

    Args:
        strain, stress: Of the curve, shape (N,).
        estimate: Returns k numbers of such a curve, whose rows need not rise.
        confidence: Share of the estimates within an interval, between 0 and 1.
        resamples: How often the rows are drawn.
        seed: Of the drawing.
        offset: Standard error of a stress that was taken off the whole curve, Pa: it is drawn, too.

    Returns:
        Low and high end of each of the k estimates.

    Raises:
        InvalidInputError: If `confidence` is not between 0 and 1.
    """
    strain, stress = record(at_least=2, strain=strain, stress=stress)
    check_positive(resamples=resamples)
    check_not_negative(seed=seed, offset=offset)
    if not 0 < confidence < 1:
        raise InvalidInputError("confidence", expected="a number in (0, 1)", got=confidence)
    length = max(2, round(strain.size**0.5))
    runs = -(-strain.size // length)
    random = np.random.default_rng(seed)
    found = []
    for _ in range(resamples):
        # Runs go on from the end to the start: else both ends would be drawn too seldom.
        starts = random.integers(0, strain.size, runs)
        rows = (starts[:, None] + np.arange(length)).ravel() % strain.size
        found.append(estimate(strain[rows], stress[rows] + offset * random.standard_normal()))
    far = stdtrit(runs - 1, (1 + confidence) / 2) * (runs / (runs - 1)) ** 0.5
    low, high = np.quantile(found, [ndtr(-far), ndtr(far)], axis=0)
    return tuple(zip(low.tolist(), high.tolist(), strict=True))
