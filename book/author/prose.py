"""Computed numbers in the prose of the page on what the author published elsewhere."""

from functools import cache

from book.author import forces, scripts, tables
from book.author.forces import LEVEL, LINE, PARABOLA, PUBLISHED, READING, SIMULATED
from softgrip.actuator.design import DesignProblem, Range
from softgrip.actuator.printed import table_3_2
from softgrip.control.step_metrics import StepMetrics
from softgrip.tactile import published_readings
from softgrip.tactile.accuracy import CONFIDENCE
from softgrip.units import MM

DESIGN, CHECK = scripts.inputs("design"), scripts.inputs("check")
GAINS, NETWORK = scripts.inputs("control"), scripts.inputs("network")


def _band(row: int) -> Range:
    found = table_3_2()[row - 1]
    return found.low, found.high


def _below(row: int) -> Range:
    """Return the band of a row's width that ends where the row's begins."""
    low, high = _band(row)
    return 2 * low - high, low


def _top(band: Range) -> float:
    return float(tables.his_optimum(band).design.section.top) / MM


@cache
def _regulator() -> StepMetrics:
    return scripts.lqr_metrics(scripts.control_model(), scripts.control_weights())


@cache
def _errors(sensor: str, left_out: str) -> dict[str, forces.RegressorError]:
    return forces.kept_errors(sensor, left_out)


def _error(name: str, left_out: str, digits: int, sensor: str = PUBLISHED) -> str:
    return f"{_errors(sensor, left_out)[name].error:.{digits}f}"


@cache
def _repeated() -> forces.Repeatability:
    return forces.REPEATABILITY.read()[0]


WORDS = {
    # The design and check scripts.
    "most_height": lambda: f"{DESIGN['bounds']['height'][1]:g}",
    "most_bottom": lambda: f"{DESIGN['bounds']['bottom'][1]:g}",
    "pressure": lambda: f"{DESIGN['pressure']:g}",
    "stated_power": lambda: f"{DesignProblem().fractional_power:g}",
    "top_1": lambda: f"{_top(_band(1)):.1f}",
    "top_2": lambda: f"{_top(_band(2)):.2f}",
    "top_3": lambda: f"{_top(_band(3)):.2f}",
    "top_3_below": lambda: f"{_top(_below(3)):.2f}",
    "top_4": lambda: f"{_top(_band(4)):.2f}",
    "band_3_low": lambda: f"{_band(3)[0]:g}",
    "power": lambda: f"{CHECK['fractional_power']:g}",
    "angle": lambda: f"{scripts.checked_angle():.0f}",
    "frequency": lambda: f"{scripts.checked_frequency():.2f}",
    "tolerance": lambda: f"{DESIGN['constraint_tolerance']:g}",
    # The control script.
    "settles": lambda: f"{float(_regulator().settling_time):.2f}",
    "rises": lambda: f"{float(_regulator().rise_time):.3f}",
    "ratio": lambda: f"{scripts.gain_ratio(GAINS['kp'], GAINS['ki'], GAINS['kd']):.1f}",
    "ratio_by_rule": lambda: f"{scripts.gain_ratio_by_rule():g}",
    "overshoot": lambda: f"{100 * float(scripts.pid_metrics().overshoot):.0f}",
    "plant_frequency": lambda: f"{GAINS['natural_frequency']:g}",
    "plant_damping": lambda: f"{GAINS['damping_ratio']:g}",
    "plant_gain": lambda: f"{GAINS['gain']:g}",
    "weight": lambda: f"{scripts.control_weights().p:g}",
    "rate_weight": lambda: f"{scripts.control_weights().q[1]:g}",
    # The force readings.
    "readings": lambda: f"{_repeated().readings}",
    "levels": lambda: f"{_repeated().levels}",
    "statement": published_readings.statement,
    "limit": lambda: f"{forces.LIMIT:g}",
    "spread": lambda: f"{_repeated().pooled:.3f}",
    "least_spread": lambda: f"{_repeated().least:.3f}",
    "largest_spread": lambda: f"{_repeated().largest:.3f}",
    "levels_above": lambda: f"{_repeated().above}",
    "neurons": lambda: f"{NETWORK['neurons']}",
    "confidence": lambda: f"{100 * CONFIDENCE:g}",
    "line": lambda: _error(LINE, LEVEL, 3),
    "line_low": lambda: f"{_errors(PUBLISHED, LEVEL)[LINE].low:.3f}",
    "line_high": lambda: f"{_errors(PUBLISHED, LEVEL)[LINE].high:.3f}",
    "line_by_reading": lambda: _error(LINE, READING, 4),
    "parabola_by_reading": lambda: _error(PARABOLA, READING, 4),
    "width_by_reading": lambda: _error("Nadaraya-Watson, best width", READING, 4),
    "k_by_reading": lambda: _error("k-nearest neighbours, best k", READING, 4),
    "if_curved": lambda: f"{forces.error_if_curved_as_simulated():.3f}",
    "simulated_line": lambda: _error(LINE, LEVEL, 3, SIMULATED),
    "simulated_regression": lambda: _error("Nadaraya-Watson", LEVEL, 3, SIMULATED),
}
