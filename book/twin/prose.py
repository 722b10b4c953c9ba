"""Computed numbers in the prose of the page *One rig for all numbers*."""

from collections.abc import Callable, Collection

import numpy as np

from book.twin import linear_bound, outcomes, study, tables
from book.twin.blocks import BLOCKS
from book.twin.bounds import BOUNDS, MANY, excludes
from book.twin.fitted import best_rig, ensemble
from book.twin.interval import CLAIMED, Interval, coverage, widening
from book.twin.misfit import chosen
from book.twin.pictures import percents
from book.twin.prediction import Prediction
from book.twin.problem import MODEL_ERROR, error_of
from book.twin.recovery import TOLD, Way
from book.twin.smoother import RIGS, ROUNDS
from book.twin.space import space
from book.twin.targets import Target, targets
from book.twin.walk import PLACES
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


def _of_known(way: Way, kind: str, tell: Callable[[list[Interval]], float], digits: str) -> str:
    return format(tell([one.interval for one in tables.found(way, kind)]), digits)


def _predictions() -> tuple[Prediction, ...]:
    return study.TABLES["predictions"].read()


def _missed() -> set[str]:
    return {one.id for one in _predictions() if not one.interval.holds}


def _narrowed() -> list[Interval]:
    return [one.interval for one in _predictions() if one.share < tables.NARROWED]


def _hidden(table: str) -> list[Interval]:
    return [one.interval for one in study.TABLES[table].read()]


def _excluded() -> set[str]:
    known = {one.id: one for one in chosen()}
    return {name for name, make in BOUNDS.items() if excludes(make(), known[name])}


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
    "met_best": lambda: f"{_met('best', targets())}",
    "alone": lambda: _count("alone"),
    "out": lambda: _count("out of reach"),
    "power_low": lambda: _power(5),
    "power_high": lambda: _power(95),
    "rigs": lambda: f"{RIGS}",
    "rounds": lambda: f"{ROUNDS}",
    "kept": lambda: f"{len(ensemble())}",
    "claimed": lambda: f"{CLAIMED:g}",
    "truths": lambda: f"{study.TRUTHS}",
    "tried_rigs": lambda: f"{study.RIGS}",
    "tried_rounds": lambda: f"{study.ROUNDS}",
    "tried_generations": lambda: f"{study.GENERATIONS}",
    "told_share": lambda: f"{100 * TOLD:g}",
    "smoother_held": lambda: _of_known("smoother", "parameter", coverage, ".0f"),
    "smoother_wider": lambda: _of_known("smoother", "parameter", widening, ".2f"),
    "strategy_held": lambda: _of_known("strategy", "parameter", coverage, ".0f"),
    "strategy_wider": lambda: _of_known("strategy", "parameter", widening, ".2f"),
    "hidden": lambda: f"{len(_hidden('predictions'))}",
    "hidden_hold": lambda: f"{sum(one.holds for one in _hidden('predictions'))}",
    "hidden_held": lambda: f"{coverage(_hidden('predictions')):.0f}",
    "hidden_wider": lambda: f"{widening(_hidden('predictions')):.2f}",
    "known_hidden": lambda: f"{len(_hidden('held'))}",
    "known_held": lambda: f"{coverage(_hidden('held')):.0f}",
    "known_wider": lambda: f"{widening(_hidden('held')):.2f}",
    "narrowed": lambda: f"{len(_narrowed())}",
    "narrowed_hold": lambda: f"{sum(one.holds for one in _narrowed())}",
    "missed_excluded": lambda: f"{len(_excluded() & _missed())}",
    "bounds": lambda: f"{len(BOUNDS)}",
    "excluded": lambda: f"{len(_excluded())}",
    "bound_rigs": lambda: f"{MANY}",
    "places": lambda: f"{PLACES}",
}
