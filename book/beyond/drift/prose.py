"""Computed numbers in the prose of the page *Drift, without the four weights*."""

from collections.abc import Callable

from book.beyond.drift import author_order, tasks
from book.beyond.drift.figures import one_session
from book.beyond.drift.kept import enough, row
from book.beyond.drift.methods import SPREAD
from book.beyond.drift.sessions import ABOVE_ZERO, CYCLE, HELD, HOURS, MISSING, SINGLE, START
from book.beyond.drift.study import (
    BEST,
    DRAWN,
    FEWER,
    FITTED,
    KNOWN,
    MEMORY,
    SESSIONS,
    SPREADS,
    TEXT,
    TOUCH,
)
from book.companion.claims import printed
from softgrip.simulator.force_layer import ForceLayer
from softgrip.tactile.accuracy import CONFIDENCE
from softgrip.tactile.drift import DRIFT_WEIGHTS
from softgrip.tactile.drift_model import DriftSize
from softgrip.tactile.rest_moments import LENGTH
from softgrip.units import GRAM_FORCE

MOST_SESSIONS = 0.9
"""Share of the sessions that must reach the printed accuracy for a number of weights to do."""
NO_PAUSES, LINE_ALONE, FOUR_TRACKED = (
    "4 at the start, no pauses used", "0 weights, circuit unknown", "tracked, 4 at the start",
)  # fmt: skip
LINE_FOUR = "4 spread, circuit unknown"
SIZE = DriftSize()


def _error(method: str, layers: str = FITTED, setting: str = "wandering", end: str = "") -> str:
    return f"{getattr(row(method, layers, setting), f'error{end}') / GRAM_FORCE:.1f}"


def _spread(method: str, layers: str = FITTED, setting: str = "wandering") -> str:
    low, high = (_error(method, layers, setting, end) for end in ("_low", "_high"))
    return f"{low} to {high}"


def _accuracy(method: str, layers: str = FITTED, setting: str = "wandering") -> str:
    return f"{row(method, layers, setting).accuracy:.1f}"


def _reached(method: str, layers: str = FITTED, setting: str = "wandering") -> str:
    one = row(method, layers, setting)
    low, high = (f"{100 * end:.0f}" for end in (one.reached_low, one.reached_high))
    return f"{100 * one.reached:.0f} % ({low} to {high} %)"


def _enough(layers: str, setting: str = "wandering") -> str:
    found = enough(layers, setting, MOST_SESSIONS)
    return "none of those tried" if found is None else f"{found}"


def _rests() -> str:
    return f"{len(one_session()[0].rests)}"


def _gain_off() -> str:
    """Return by how much the gain of the shown session is off at its end, % of the conductance."""
    case, alone, weighed = one_session()
    true = float(case.session.record.gain[case.at][-1])
    off = (100 * abs(float(found.gain[-1]) - true) for found in (alone, weighed))
    return " and ".join(f"{one:.1f}" for one in off)


WORDS: dict[str, Callable[[], str]] = {
    "four": lambda: f"{len(DRIFT_WEIGHTS)}",
    "hours": lambda: f"{HOURS}",
    "start": lambda: f"{START:g}",
    "fitted": lambda: f"{SESSIONS[FITTED]}",
    "drawn": lambda: f"{SESSIONS[DRAWN]}",
    "fewer": lambda: f"{FEWER}",
    "most": lambda: f"{100 * MOST_SESSIONS:.0f}",
    "interval": lambda: f"{100 * CONFIDENCE:.0f}",
    "single": lambda: f"{DRIFT_WEIGHTS[SINGLE]:g}",
    "largest": lambda: f"{SPREAD[-1]}",
    # What is assumed.
    "gain_rate": lambda: f"{100 * SIZE.gain_rate:g}",
    "offset_rate": lambda: f"{1e3 * SIZE.offset_rate:g}",
    "chapter_gain": lambda: f"{100 * ForceLayer().gain_drift:g}",
    "chapter_offset": lambda: f"{1e3 * ForceLayer().offset_drift:g}",
    "wander": lambda: f"{100 * SIZE.gain_wander / (SIZE.gain_rate * HOURS**0.5):.0f}",
    "above": lambda: f"{ABOVE_ZERO:g}",
    "held": lambda: f"{HELD[0]} to {HELD[1]}",
    "cycle": lambda: f"{CYCLE}",
    "missing": lambda: f"{100 * MISSING:g}",
    "moment": lambda: f"{LENGTH:g}",
    "touch": lambda: f"{TOUCH / GRAM_FORCE:g}",
    # What comes out.
    "text_error": lambda: _error(TEXT),
    "text_spread": lambda: _spread(TEXT),
    "best_error": lambda: _error(BEST),
    "zero_error": lambda: _error(SPREADS[0]),
    "zero_spread": lambda: _spread(SPREADS[0]),
    "two_error": lambda: _error(SPREADS[2]),
    "two_spread": lambda: _spread(SPREADS[2]),
    "known_error": lambda: _error(KNOWN),
    "text_reached": lambda: _reached(TEXT),
    "zero_reached": lambda: _reached(SPREADS[0]),
    "two_reached": lambda: _reached(SPREADS[2]),
    "four_reached": lambda: _reached(FOUR_TRACKED),
    "four_spread_reached": lambda: _reached(SPREADS[4]),
    "enough_fitted": lambda: _enough(FITTED),
    "enough_steady": lambda: _enough(FITTED, "steady"),
    "enough_drawn": lambda: _enough(DRAWN),
    "enough_drawn_steady": lambda: _enough(DRAWN, "steady"),
    "two_reached_drawn": lambda: _reached(SPREADS[2], DRAWN),
    "most_reached_drawn": lambda: _reached(SPREADS[SPREAD[-1]], DRAWN),
    "known_reached_drawn": lambda: _reached(KNOWN, DRAWN),
    "line_alone": lambda: _error(LINE_ALONE),
    "line_four_reached": lambda: _reached(LINE_FOUR),
    "no_pauses": lambda: _error(NO_PAUSES),
    "memory_before": lambda: _error(SPREADS[4], DRAWN, "memory"),
    "memory_after": lambda: _error(MEMORY[0], DRAWN, "memory"),
    "believed_text": lambda: _error(TEXT, FITTED, "no wander is expected"),
    "believed_zero": lambda: _error(SPREADS[0], FITTED, "no wander is expected"),
    "never_text": lambda: _error(TEXT, FITTED, "never unloaded"),
    "never_zero": lambda: _error(SPREADS[0], FITTED, "never unloaded"),
    "touched_text": lambda: _error(TEXT, FITTED, "touched in pauses"),
    "touched_zero": lambda: _error(SPREADS[0], FITTED, "touched in pauses"),
    "touched_two": lambda: _error(SPREADS[2], FITTED, "touched in pauses"),
    "rests": _rests,
    "gain_off": _gain_off,
    # The author's readings.
    "author_readings": lambda: f"{author_order.KEPT.read()[0].readings}",
    "author_up": lambda: f"{author_order.KEPT.read()[0].up}",
    "author_down": lambda: f"{author_order.KEPT.read()[0].down}",
    "author_p": lambda: f"{author_order.KEPT.read()[0].p:.2f}",
    # Tasks.
    "task_used": lambda: f"{tasks.last_error('used', 0.5, 0.0):.1f}",
    "task_weighed": lambda: f"{tasks.last_error('used', 0.5, 1.0):.1f}",
    "task_unused": lambda: f"{tasks.last_error('not used', 0.5, 1.0):.1f}",
    "task_unused_four": lambda: f"{tasks.last_error('not used', 0.5, 4.0):.1f}",
    "task_offset": lambda: f"{tasks.last_error('used', 0.0, 0.0):.1f}",
    "task_gain": lambda: f"{tasks.last_error('used', 1.0, 0.0):.1f}",
    "task_worst": lambda: f"{tasks.worst_share():.2f}",
    "task_none": lambda: f"{tasks.accuracies()[0]:.1f}",
    "task_fewest": lambda: f"{tasks.fewest(printed('2.4-mean-accuracy'))}",
    "task_at": lambda: f"{tasks.accuracies()[tasks.fewest(printed('2.4-mean-accuracy')) or 0]:.1f}",
}
