"""Computed numbers in the prose of the page *One rig for all numbers*."""

from collections.abc import Callable, Collection

import numpy as np

from book.twin import linear_bound, outcomes, study
from book.twin.blocks import BLOCKS
from book.twin.fitted import best_rig, ensemble
from book.twin.misfit import LOOPS, chosen
from book.twin.pictures import percents
from book.twin.problem import MODEL_ERROR, error_of
from book.twin.smoother import RIGS, ROUNDS
from book.twin.space import space
from book.twin.targets import Target, targets
from softgrip.units import DEG


def _median(name: str) -> str:
    return f"{np.median(percents(name)):.1f}"


def _within(name: str, percent: float) -> str:
    return f"{np.sum(percents(name) <= percent)}"


def _met(name: str, of: Collection[Target]) -> int:
    """Return how many targets a rig meets within their errors."""
    off = [(abs(getattr(_outcome(t.id), name) - t.value) / t.tolerance, error_of(t)) for t in of]
    return sum(miss <= error for miss, error in off)


def _outcome(target: str) -> outcomes.Outcome:
    return next(one for one in outcomes.KEPT.read() if one.id == target)


def _degrees(angle: float) -> str:
    return f"{angle / DEG:.1f}"


def _asked(block: str) -> tuple[Target, ...]:
    return chosen(BLOCKS[block].experiments)


def _count(word: str) -> str:
    return f"{sum(one.word == word for one in outcomes.KEPT.read())}"


def _fitted() -> list[str]:
    """Return the parameters in which the rigs of the ensemble differ."""
    return [name for name, own in zip(space(), np.ptp(ensemble(), axis=0), strict=True) if own]


def _power(percent: float) -> str:
    return f"{np.percentile(ensemble()[:, [*space()].index('rubber.power')], percent):.2f}"


WORDS: dict[str, Callable[[], str]] = {
    "targets": lambda: f"{len(targets())}",
    "fitted": lambda: f"{len(_asked('rig')) + len(_asked('pad'))}",
    "pad_targets": lambda: f"{len(_asked('pad'))}",
    "linear_targets": lambda: f"{len(chosen(['linear range']))}",
    "linear_best": lambda: f"{_outcome('5.5-linear-range-design-1').best:.0f}",
    "linear_bound": lambda: f"{best_rig()[[*space()].index(linear_bound.NAME)]:.0f}",
    "pad_rigs": lambda: f"{BLOCKS['pad'].rigs}",
    "pad_rounds": lambda: f"{BLOCKS['pad'].rounds}",
    "single_before": lambda: f"{_outcome('2.3-single-training').before:.0f}",
    "single_best": lambda: f"{_outcome('2.3-single-training').best:.0f}",
    "tilt_before": lambda: _degrees(space()["pad.tilt"].value),
    "tilt_best": lambda: _degrees(best_rig()[[*space()].index("pad.tilt")]),
    "pad_met": lambda: f"{_met('best', _asked('pad'))}",
    "parameters": lambda: f"{len(_fitted())}",
    "choices": lambda: f"{sum(name.startswith('choice.') for name in _fitted())}",
    "model_error": lambda: f"{100 * MODEL_ERROR:.0f}",
    "median_before": lambda: _median("before"),
    "median_best": lambda: _median("best"),
    "near_before": lambda: _within("before", 10),
    "near_best": lambda: _within("best", 10),
    "compared": lambda: f"{percents('best').size}",
    "met_before": lambda: f"{_met('before', targets())}",
    "met_best": lambda: f"{_met('best', targets())}",
    "together": lambda: _count("together"),
    "alone": lambda: _count("alone"),
    "out": lambda: _count("out of reach"),
    "power_low": lambda: _power(5),
    "power_high": lambda: _power(95),
    "rigs": lambda: f"{RIGS}",
    "rounds": lambda: f"{ROUNDS}",
    "kept": lambda: f"{len(ensemble())}",
    "loops": lambda: f"{LOOPS}",
    "dropped": lambda: f"{len(study.TABLES['tension'].read())}",
}
