"""Step responses of the finger: how much faster than a loop over `scipy.integrate.solve_ivp`."""

import numpy as np

from tests.bench.entry import Entry, entry, interleaved, spread, timed
from tests.bench.fingers import ALLOWED, Batch, batch, choose_step, plain, responses, run

WANTED = 100


def _error(found: np.ndarray, true: np.ndarray) -> float:
    return float(np.abs(found - true).max())


def _spaced(given: Batch, count: int) -> np.ndarray:
    return np.arange(count) * given.runs // count


def entries(
    *, runs: int = 1000, plain_runs: int = 60, checked: int = 100, repetitions: int = 11
) -> list[Entry]:
    """Return time and error, ours and SciPy's."""
    whole = batch(runs)
    picked = _spaced(whole, checked)
    few, some = whole.take(picked), whole.take(_spaced(whole, plain_runs))
    choice = choose_step(few)
    choosing = timed(lambda: choose_step(few))

    times = interleaved(
        lambda: run(whole, choice.step), lambda: plain(some), repetitions=repetitions
    )
    times[:, 1] *= runs / plain_runs
    ours, theirs = (float(seconds) for seconds in np.median(times, axis=0))
    turns = times[:, 1] / times[:, 0]

    true = plain(few, method="DOP853", rtol=1e-11, atol=1e-13)
    # The whole batch at once, so that the runs judged are runs of the calculation timed.
    error = _error(responses(whole, choice.step)[:, picked], true)
    plain_error = _error(plain(few), true)
    samples = whole.times.size
    return [
        entry(
            f"{runs:,} step responses, time", ours, "s", theirs,
            f"ratio >= {WANTED}", theirs / ours >= WANTED,
            f"5 s each, {samples:,} angles a run, float64, all in memory up to 64 MB and streamed"
            f" beyond; fourth-order Runge-Kutta, step {1e3 * choice.step:g} ms, cubic Hermite"
            f" output; largest error {error:.2g} rad, of the baseline {plain_error:.2g} rad."
            f" Baseline: a loop over solve_ivp, RK45, rtol 1e-6, atol 1e-8, t_eval each"
            f" millisecond, {plain_runs} runs timed and scaled to {runs:,}. Medians of"
            f" {repetitions} turns ({spread(times[:, 0])}); the ratio in single turns was"
            f" {turns.min():.0f} to {turns.max():.0f}. Choosing the step on {checked} runs took"
            f" {choosing:.2g} s, once, and is not counted.",
        ),
        entry(
            f"{runs:,} step responses, largest error", error, "rad", plain_error,
            f"< {ALLOWED:g}", error < ALLOWED,
            f"Against DOP853, rtol 1e-11, atol 1e-13, on {checked} of the runs at all {samples:,}"
            f" times. The step's own estimate: {choice.error:.2g} rad.",
        ),
    ]  # fmt: skip
