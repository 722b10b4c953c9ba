"""Answers of the tasks of the page on drift."""

import numpy as np

from book.beyond.drift.methods import SPREAD, Case
from book.beyond.drift.sessions import session
from book.beyond.drift.sliders import expected_error
from book.beyond.drift.study import errors
from softgrip.reads import remembered
from softgrip.simulator.fitted_rigs import fitted_layer
from softgrip.tactile.drift_model import DriftSize

SHARES = np.linspace(0, 1, 101)
SEED = 11
"""Of the session of the third task."""


def last_error(pauses: str, share: float, weights: float, times: float = 1.0) -> float:
    """Return the error at the end of a session, gf; arguments as of `expected_error`."""
    return float(expected_error(pauses, times, share, weights)["last"])


def worst_share() -> float:
    """Return the share of gain at which pauses alone leave the largest error."""
    return float(SHARES[np.argmax([last_error("used", share, 0.0) for share in SHARES.tolist()])])


@remembered
def accuracies() -> dict[int, float]:
    """Return the accuracy, %, of the session of the third task by its number of weights."""
    case = Case(session(fitted_layer(), DriftSize(), SEED), DriftSize())
    return {
        count: 100 * errors(case, case.tracked(case.spread(count))).accuracy for count in SPREAD
    }


def fewest(wanted: float) -> int | None:
    """Return the fewest weights with which that session has an accuracy, %; None for none."""
    return next((count for count, found in accuracies().items() if found >= wanted), None)
