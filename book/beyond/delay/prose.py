"""Computed numbers in the prose of the page *Delay, and fingers that stay together*."""

from collections.abc import Callable

import numpy as np

from book.beyond.delay import full_rig, policy, step_time, sweep, tasks
from book.beyond.delay.kept import cell, delays_of_logs
from book.beyond.delay.pictures import DELAY
from book.beyond.delay.rigs import rigs
from book.beyond.delay.tables import AT
from book.chapter_6.controllers import WANTED
from softgrip.control.loop import SPEED_LIMIT
from softgrip.gripper.delayed_batch import BAND
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.predictive import Weights
from softgrip.logs.delays import CONFIDENCE, Delay
from softgrip.units import DEG, REV

PRINTED, FAST, SMITH, MPC = "printed, 2/s", "printed, 4.8/s", "Smith, 2/s", "predictive"


def _span(one: Delay) -> str:
    return f"{1000 * one.value:.0f} ms ({1000 * one.low:.0f} to {1000 * one.high:.0f})"


def _value(method: str, measure: str, delay: int = AT, digits: int = 1, **which: object) -> str:
    return f"{cell(method, measure, delay, **which).value:.{digits}f}"  # type: ignore[arg-type]


def _gain(method: str, measure: str, delay: int = AT) -> str:
    one = cell(method, measure, delay)
    return f"{one.gain:.2f} ({one.gain_low:.2f} to {one.gain_high:.2f})"


def _loss(method: str, measure: str, delay: int = AT) -> str:
    one = cell(method, measure, delay)
    return f"{-one.gain:.2f} ({-one.gain_high:.2f} to {-one.gain_low:.2f})"


def _full(method: str) -> full_rig.FullCell:
    return next(one for one in full_rig.KEPT.read() if one.method == method and one.delay == AT)


def _step(method: str) -> step_time.StepTime:
    return next(one for one in step_time.KEPT.read() if one.method == method)


def _least_settled() -> float:
    """Return the least share of runs that settle with a delay that is taken wrongly."""
    return min(one.value for one in sweep.KEPT.read() if one.wrong and one.measure == "settled")


WORDS: dict[str, Callable[[], str]] = {
    "left_delay": lambda: _span(delays_of_logs().whole[0]),
    "right_delay": lambda: _span(delays_of_logs().whole[1]),
    "at": lambda: f"{AT}",
    "responses_at": lambda: f"{1000 * DELAY:.0f}",
    "rigs": lambda: f"{len(rigs()) - sweep.SPENT}",
    "spent": lambda: f"{sweep.SPENT}",
    "runs": lambda: f"{sweep.RUNS}",
    "seeds": lambda: f"{(len(rigs()) - sweep.SPENT) * sweep.RUNS:,}",
    "wanted": lambda: f"{WANTED / DEG:g}",
    "limit": lambda: f"{SPEED_LIMIT / REV:g}",
    "period": lambda: f"{1000 * PERIOD:g}",
    "band": lambda: f"{100 * BAND:g}",
    "own_share": lambda: f"{100 * sweep.APART:g}",
    "confidence": lambda: f"{100 * CONFIDENCE:g}",
    "wrong_settled": lambda: f"{np.floor(1000 * _least_settled()) / 10:g}",
    "wrong": lambda: f"{sweep.WRONG[1]}",
    "printed_apart_0": lambda: _value(PRINTED, "apart", 0),
    "printed_apart": lambda: _value(PRINTED, "apart"),
    "printed_settling": lambda: _value(PRINTED, "settling"),
    "fast_settles": lambda: f"{100 * cell(FAST, 'settled', AT).value:.0f}",
    "smith_apart": lambda: _value(SMITH, "apart"),
    "smith_gain": lambda: _gain(SMITH, "apart"),
    "smith_gain_50": lambda: _gain(SMITH, "apart", 50),
    "smith_later_100": lambda: _loss(SMITH, "settling", 100),
    "mpc_settling": lambda: _value(MPC, "settling"),
    "mpc_sooner": lambda: _gain(MPC, "settling"),
    "mpc_loss_0": lambda: _loss(MPC, "apart", 0),
    "mpc_travel": lambda: _value(MPC, "travel"),
    "smith_travel": lambda: _value(SMITH, "travel"),
    "best_apart": lambda: _value("best feedforward", "apart"),
    "filtered_settling": lambda: _value("filtered Smith", "settling"),
    "learned_error_5": lambda: f"{100 * cell('learned', 'error', AT, fingers=5).value:.0f}",
    "smith_error_5": lambda: f"{100 * cell(SMITH, 'error', AT, fingers=5).value:.0f}",
    "learned_rigs": lambda: f"{policy.TRAINING_RIGS}",
    "learned_tries": lambda: f"{policy.POPULATION * policy.GENERATIONS:,}",
    "full_printed": lambda: f"{_full(PRINTED).apart:.1f}",
    "full_smith": lambda: f"{_full(SMITH).apart:.1f}",
    "full_mpc_gain": lambda: (
        f"{_full(MPC).apart_gain:.2f} ({_full(MPC).apart_gain_low:.2f} to "
        f"{_full(MPC).apart_gain_high:.2f})"
    ),
    "full_mpc_settling": lambda: f"{_full(MPC).settling:.1f}",
    "full_printed_settling": lambda: f"{_full(PRINTED).settling:.1f}",
    "horizon": lambda: f"{Weights.horizon:g}",
    "step_middle": lambda: f"{_step(MPC).middle / 1000:.2g}",
    "step_high": lambda: f"{_step(MPC).high / 1000:.2g}",
    "task_delay": lambda: f"{tasks.DELAY:g}",
    "task_known": lambda: f"{tasks.apart(0.0):.1f}",
    "task_none": lambda: f"{tasks.apart(-100.0):.1f}",
    "task_no_delay": lambda: f"{tasks.apart(0.0, delay=0.0):.1f}",
    "task_faster": lambda: f"{tasks.FASTER:g}",
    "task_faster_apart": lambda: f"{tasks.apart(0.0, bandwidth=tasks.FASTER):.1f}",
    "task_less": lambda: f"{tasks.LESS:g}",
    "task_more": lambda: f"{tasks.MORE:g}",
    "task_over_known": lambda: f"{tasks.overshoot(0.0):.0f}",
    "task_over_less": lambda: f"{tasks.overshoot(tasks.LESS):.0f}",
    "task_over_more": lambda: f"{tasks.overshoot(tasks.MORE):.0f}",
    "task_over_none": lambda: f"{tasks.overshoot(-100.0):.0f}",
    "task_difference": lambda: f"{tasks.DIFFERENCE:g}",
    "task_rate": lambda: f"{tasks.RATE:g}",
    "task_behind": lambda: f"{tasks.behind(tasks.DIFFERENCE, tasks.RATE):.1f}",
    "task_together": lambda: f"{tasks.TOGETHER / DEG:g}",
    "task_largest": lambda: f"{tasks.largest_rate(tasks.TOGETHER / DEG):.0f}",
}
