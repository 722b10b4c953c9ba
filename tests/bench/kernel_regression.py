"""A million predictions of the Nadaraya-Watson regressor, against sums over all points."""

import warnings

import numpy as np
from statsmodels.nonparametric.kernel_regression import KernelReg

from softgrip.tactile.kernel_average import BLOCK
from softgrip.tactile.nadaraya_watson import NadarayaWatson
from tests.bench.entry import Entry, entry, interleaved, spread

QUERIES = 1_000_000
SIZES = {69: 8.0, 10_000: 250.0}
"""Training points, and how many times faster than the broadcast is wanted."""

BANDWIDTH = 0.02
ALLOWED = 1e-9
"""Largest relative difference of the predictions."""

PLAIN = {69: 100_000, 10_000: 2000}
"""Queries that the broadcast answers: its time grows with their number."""


def data(points: int) -> tuple[np.ndarray, np.ndarray]:
    """Return voltages and forces, forces above zero so that a relative difference has sense."""
    rng = np.random.default_rng(0)
    x = rng.random(points)
    return x, 1 + 0.7 * x**2 + 0.01 * rng.normal(size=points)


def broadcast(queries: np.ndarray, x: np.ndarray, y: np.ndarray, bandwidth: float) -> np.ndarray:
    """Return Eq. (2.6) by a matrix of all pairs, as many rows at a time as fit the cache."""
    step = max(1, BLOCK // len(x))
    found = []
    for start in range(0, len(queries), step):
        apart = queries[start : start + step, None] - x
        weights = np.exp(-(apart**2) / (2 * bandwidth**2))
        found.append(weights @ y / weights.sum(axis=1))
    return np.concatenate(found)


def statsmodels_average(
    queries: np.ndarray, x: np.ndarray, y: np.ndarray, bandwidth: float
) -> np.ndarray:
    """Return the same by statsmodels."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FutureWarning)  # of its random numbers, not used here
        model = KernelReg(y, x, "c", reg_type="lc", bw=[bandwidth])
        return np.asarray(model.fit(queries)[0])


def entries(
    *, queries: int = QUERIES, other: int = 200, repetitions: int = 3, plain: int | None = None
) -> list[Entry]:
    """Return the seconds of all predictions, fit included, against the broadcast's."""
    new = np.random.default_rng(1).random(queries)
    found = []
    for points, wanted in SIZES.items():
        x, y = data(points)
        few = new[: plain or PLAIN[points]]

        def ours(x: np.ndarray = x, y: np.ndarray = y) -> np.ndarray:
            return NadarayaWatson(BANDWIDTH).fit(x[:, None], y).predict(new[:, None])

        def theirs(x: np.ndarray = x, y: np.ndarray = y, few: np.ndarray = few) -> np.ndarray:
            return broadcast(few, x, y, BANDWIDTH)

        def named(x: np.ndarray = x, y: np.ndarray = y) -> np.ndarray:
            return statsmodels_average(new[:other], x, y, BANDWIDTH)

        said = ours()
        apart = max(
            float(np.max(abs(said[: len(few)] / theirs() - 1))),
            float(np.max(abs(said[:other] / named() - 1))),
        )
        times = interleaved(ours, theirs, named, repetitions=repetitions)
        scaled = times * np.array([1, queries / len(few), queries / other])
        mine, plain_time, named_time = np.median(scaled, axis=0).tolist()
        found.append(
            entry(
                f"kernel regression, {points:,} points", mine, "s", plain_time,
                f">= {wanted:g} times", plain_time / mine >= wanted and apart < ALLOWED,
                f"{queries:,} queries, fit included ({spread(times[:, 0])}); baseline: blocks of"
                f" a NumPy broadcast, {len(few):,} queries, scaled up. statsmodels, {other:,}"
                f" queries, scaled up: {named_time:.3g} s, {named_time / mine:.3g} times."
                f" Largest relative difference {apart:.1g}.",
            )
        )  # fmt: skip
    return found
