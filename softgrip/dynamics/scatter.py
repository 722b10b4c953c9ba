"""How a record scatters from sample to sample, and whether a fitted curve leaves more than that."""

import numpy as np

from softgrip.arrays import Floats

BLOCKS = 30
"""Into which a record is cut to see whether a residual has a shape."""
SLACK, SIGMAS = 0.05, 8.0
"""Of the variance that a fit may leave above the scatter: a share, and what chance makes of N
samples, four standard deviations of ``2 / sqrt(N)``, that of the difference's variance."""


def scatter(time: Floats, output: Floats) -> float:
    """Return the standard deviation of what is independent from sample to sample.

    Each sample is held against the line between its neighbours, which leaves what is smooth out;
    sampled coarsely, a response is not smooth, and counts in part. A converter's step counts as the
    error that it makes, step / sqrt(12).

    Args:
        time: s, shape (N,), increasing, N >= 3.
        output: Shape (N,).

    Returns:
        float: Unit of the output.

    >>> t = np.arange(10000.0)
    >>> round(scatter(t, 0.1 * t + np.random.default_rng(0).normal(0, 2.0, t.size)), 1)
    2.0
    """
    share = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    off = output[1:-1] - (1 - share) * output[:-2] - share * output[2:]
    found = float(np.sqrt(np.mean(off**2 / (1 + share**2 + (1 - share) ** 2))))
    moves = np.abs(np.diff(output))
    return max(found, float(np.min(moves[moves > 0], initial=np.inf)) / 12**0.5)


def leaves_more(residual: Floats, noise: float, parameters: int) -> bool:
    """Tell whether a fit leaves more than the record's scatter.

    Args:
        residual: Of the fit, shape (N,).
        noise: As of `scatter`.
        parameters: That were fitted.
    """
    N = residual.size
    left = float(residual @ residual) / (N - parameters)
    return bool(left > noise**2 * (1 + SLACK + SIGMAS / N**0.5))


def dependence(residual: Floats, parameters: int) -> float:
    """Return by how much more a residual's means vary than those of independent samples, >= 1.

    By its root the standard errors of a fit are too small: where noise drifts, or the model is not
    quite the process, neighbouring samples are off alike.

    Args:
        residual: Of the fit, shape (N,).
        parameters: That were fitted.

    >>> white = np.random.default_rng(0).normal(size=3000)
    >>> dependence(white, 4) < 1.5 < dependence(np.repeat(white[:300], 10), 4)
    True
    """
    size = residual.size // BLOCKS
    if size < 2:
        return 1.0
    means = residual[: size * BLOCKS].reshape(BLOCKS, size).mean(axis=1)
    alone = float(np.mean(residual**2)) / size
    return max(float(means @ means) / (BLOCKS - parameters) / alone, 1.0) if alone > 0 else 1.0
