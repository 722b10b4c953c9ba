"""One line of the calibration of the simulated rig, and the lines of a finger."""

from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np

from softgrip.simulator.calibration import (
    FULL_PRESSURE,
    OPERATING_ANGLE,
    SPREAD_ANGLE,
    small_signal_poles,
)
from softgrip.simulator.laws import settled_torque
from softgrip.simulator.parameters import FingerParameters, RigParameters
from softgrip.units import DEG, ML, MM

NAN = float("nan")


@dataclass(frozen=True)
class Entry:
    """One line of the calibration.

    Attributes:
        use: "calibrated": the printed value set the parameter; "assumed": nothing printed, we chose
            it; "checked": printed, but not used.
        place, quantity, printed, unit: What is printed, and where; `printed` is a string, empty if
            assumed.
        parameter, value: What it set, SI; empty and NaN if checked.
        rig: What the rig gives, in `unit`.
        residual: `rig` less the printed value, in `unit`; NaN where nothing is printed.
    """

    use: Literal["calibrated", "assumed", "checked"]
    place: str
    quantity: str
    printed: str
    unit: str
    parameter: str
    value: float
    rig: float
    residual: float


def settled_angle(finger: FingerParameters, pressure: float, softer: float = 1.0) -> float:
    """Return the angle, rad, at which a pressure (Pa) rests, its stiffness times `softer`."""
    torque = finger.torque_per_pressure * pressure / (finger.stiffness * softer)
    return float(torque ** (1 / finger.fractional_power))


def damping_ratio(finger: FingerParameters) -> float:
    """Return the damping ratio of small motions about `OPERATING_ANGLE`."""
    pole = small_signal_poles(finger, OPERATING_ANGLE)[0]
    return float(-pole.real / abs(pole))


def swing(rig: RigParameters) -> float:
    """Return how far one deviation of the stiffness moves the angle at `SPREAD_ANGLE`, rad."""
    finger = rig.finger
    middle = settled_torque(SPREAD_ANGLE, finger) / finger.torque_per_pressure
    soft, hard = (settled_angle(finger, middle, np.exp(s * rig.spread.stiffness)) for s in (-1, 1))
    return (soft - hard) / 2


def _in_unit(value: float, unit: str) -> float:
    """Return a value in SI in the unit of a line."""
    if unit == "%":
        return 100 * value
    return 1e3 * value if unit == "mV" else value / {"mm": MM, "mL": ML, "deg": DEG}.get(unit, 1)


def _printed(
    use: Literal["calibrated", "checked"], place: str, quantity: str, printed: str, unit: str,
    parameter: str, value: float, rig: float,
) -> Entry:  # fmt: skip
    residual = round(rig - float(printed), 9) + 0.0  # no minus zero
    return Entry(use, place, quantity, printed, unit, parameter, value, rig, residual)


calibrated = partial(_printed, "calibrated")
"""The line of a printed string that set a parameter; arguments as the attributes of `Entry`."""


def checked(place: str, quantity: str, printed: str, unit: str, rig: float) -> Entry:
    """Return the line of a printed string that set nothing; as `calibrated`."""
    return _printed("checked", place, quantity, printed, unit, "", NAN, rig)


def assumed(
    quantity: str, unit: str, parameter: str, value: float, rig: float | None = None
) -> Entry:
    """Return the line of an assumption; without `rig` the value itself is told, in the unit."""
    told = _in_unit(value, unit) if rig is None else rig
    return Entry("assumed", "", quantity, "", unit, parameter, value, told, NAN)


def of_finger(
    rig: RigParameters, angle: str, frequency: str, power: str, *, name: str = ""
) -> tuple[Entry, ...]:
    """Return the lines of a finger from its printed strings; `name` that of all but Design 1."""
    finger, spread = rig.finger, rig.spread
    pole = small_signal_poles(finger, OPERATING_ANGLE)[0]
    rows = (
        ("Figure 3.10", "settled angle at 0.15 MPa", angle, "deg", "finger.stiffness",
         finger.stiffness, settled_angle(finger, FULL_PRESSURE) / DEG),
        ("Table 5.1", "fractional power", power, "", "finger.fractional_power",
         finger.fractional_power, finger.fractional_power),
        ("Table 3.3", "natural frequency taken at 60 deg", frequency, "rad/s", "finger.inertia",
         finger.inertia, float(abs(pole))),
        ("Section 3.4", "damping ratio taken at 60 deg", "0.7", "", "finger.damping",
         finger.damping, damping_ratio(finger)),
        ("Section 5.4", "run-to-run RMS (2 to 3) taken at 75 deg", "2.5", "deg",
         "spread.stiffness", spread.stiffness, swing(rig) / DEG),
    )  # fmt: skip
    words, own = (f"{name}: ", f"{name.lower().replace(' ', '_')}.") if name else ("", "")
    return tuple(
        calibrated(where, words + what, text, unit, own + sets, value, given)
        for where, what, text, unit, sets, value, given in rows
    )
