"""What the sliders of the page on drift move: the error that is left, by its covariance alone."""

from typing import Any

import numpy as np

from book.beyond.drift.sessions import HOURS, START, bridge_of, drifting_voltage
from book.companion.style import BLUE, GREY, ORANGE
from book.explore.plot import Line, Panel, Plot
from softgrip.arrays import Floats, Number
from softgrip.simulator.fitted_rigs import fitted_layer
from softgrip.tactile.drift_filter import COUNT, LEFT
from softgrip.tactile.drift_model import DriftSize
from softgrip.units import GRAM_FORCE

FORCE, WEIGHT = 29 * GRAM_FORCE, 50 * GRAM_FORCE
"""N: where the error is told, that of the sausage of Table 2.2; and the known weight."""
WEIGHED = 0.005
"""V, by which the fitted layer's reading of a known weight scatters: the root mean square about the
mean of three in its calibration."""
SIZE = DriftSize()


def slopes(force: float) -> tuple[float, float]:
    """Return what the fitted layer's voltage does at a force: V per gain, and V/N."""
    layer, step = fitted_layer(), 1e-4
    nothing = np.zeros(3)
    low, here, high = drifting_voltage(
        np.array([force, force + step / 2, force + step]), nothing, nothing, layer
    ).tolist()
    return float(bridge_of(layer).per_gain(here, 0.0)), (high - low) / step


def session_hours() -> Floats:
    """Return the hours of a session at which the error is told."""
    return np.linspace(0.25, HOURS, 32)


def expected_error(pauses: str, times: Number, share: Number, weights: Number) -> dict[str, Any]:
    """Return the error of the force that steady drift leaves, gf, one deviation, over a session.

    What is known of the two rates is a covariance. A weight at the start and a moment without load
    at each time reduce it, as in a Kalman filter; what is left is the error.

    Args:
        pauses: "used" or "not used".
        times: How many times the assumed drift, > 0.
        share: Of it that is gain, 0 to 1; a half is assumed.
        weights: How many times the weight of 50 gf is weighed at the start, >= 0.
    """
    age = START + session_hours()
    at_rest, at_weight, at_force = slopes(0.0)[0], slopes(WEIGHT)[0], slopes(FORCE)
    gain = (2 * times * share * SIZE.gain_rate) ** 2
    offset = (2 * times * (1 - share) * SIZE.offset_rate) ** 2

    def seen(known: Any, slope: float, hours: Any, precision: Any) -> Any:
        """Return variances and covariance of the rates after a voltage was read."""
        a, b, c = known
        first, second = hours * (slope * a + c), hours * (slope * c + b)
        part = precision / (1 + precision * hours * (slope * first + second))
        return a - part * first**2, b - part * second**2, c - part * first * second

    known = seen((gain, offset, 0.0), at_weight, START, weights / WEIGHED**2)
    if pauses == "used":
        known = seen(known, at_rest, age, 1 / (LEFT * COUNT / 2) ** 2)
    slope, per_force = at_force
    a, b, c = known
    left = age * abs(slope**2 * a + 2 * slope * c + b) ** 0.5 / per_force / GRAM_FORCE
    spread = (slope**2 * gain + offset) ** 0.5 / per_force / GRAM_FORCE
    return {
        "time": session_hours(),
        "none": age * spread,
        "text": (age - START) * spread,
        "tracked": left,
        "last_none": (START + HOURS) * spread,
        "last_text": HOURS * spread,
        "last": left[-1],
    }


PLOT = Plot(
    [
        Panel(
            [
                Line("time", "none", "no correction", colour=GREY, dash="2 3"),
                Line("time", "text", "line at the start (Section 2.3)", colour=ORANGE, dash="6 3"),
                Line("time", "tracked", "tracked", colour=BLUE),
            ],
            x=(0, HOURS), y=(0, "last_none"),
            x_label="time in the session (h)", y_label="error at 29 gf (gf)",
        )
    ],
    title="at the end: {last:.2f} gf tracked, {last_text:.1f} gf by the text's line, "
    "{last_none:.1f} gf without a correction",
)  # fmt: skip
