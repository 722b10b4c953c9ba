"""What the simulated rig is tuned to, and how far off the printed measurements it is.

``python -m softgrip.rig.calibration_table`` writes ``data/calibration/simulated_rig.csv``: each
measurement used, the parameter that it set, what the rig then gives; what is assumed; and what is
printed but was not used. A quantity that the rig was calibrated to is never one that it found.
"""

import csv
from dataclasses import astuple, dataclass, fields, replace
from pathlib import Path
from typing import Literal

import numpy as np

from softgrip.provenance import data_file, data_folder
from softgrip.rig.calibration import (
    FULL_ANGLE,
    FULL_PRESSURE,
    OPERATING_ANGLE,
    SPREAD_ANGLE,
    design_1,
    small_signal_poles,
)
from softgrip.rig.capacity_check import constant_capacity_error, modified_capacity_error
from softgrip.rig.laws import finger_volume, leak, settled_torque
from softgrip.rig.parameters import FingerParameters
from softgrip.units import DEG, ML, MPa

FILE = "calibration/simulated_rig.csv"
COMMAND = "python -m softgrip.rig.calibration_table"


@dataclass(frozen=True)
class Entry:
    """One line of the calibration.

    Attributes
    ----------
    use
        "calibrated": the printed value set the parameter; "assumed": nothing printed, we chose it;
        "checked": printed, but not used.
    place, quantity, printed, unit
        What is printed, and where; `printed` is a string, empty if assumed.
    parameter, value
        What it set, SI; empty and NaN if checked.
    rig
        What the rig gives, in `unit`.
    residual
        `rig` less the printed value, in `unit`; NaN where nothing is printed.
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


def _settled_angle(finger: FingerParameters, pressure: float, softer: float = 1.0) -> float:
    torque = finger.torque_per_pressure * pressure / (finger.stiffness * softer)
    return float(torque ** (1 / finger.fractional_power))


def _damping_ratio(finger: FingerParameters) -> float:
    pole = small_signal_poles(finger, OPERATING_ANGLE)[0]
    return float(-pole.real / abs(pole))


def entries() -> tuple[Entry, ...]:
    """Compute the calibration: what is printed, what it set, and what the rig gives."""
    rig = design_1()
    finger, gas, sensors, spread = rig.finger, rig.gas, rig.sensors, rig.spread
    pole = small_signal_poles(finger, OPERATING_ANGLE)[0]
    step = sensors.angle_range / (sensors.high_count - sensors.low_count)
    noise = float(np.hypot(sensors.angle_noise, step / 12**0.5))
    middle = settled_torque(SPREAD_ANGLE, finger) / finger.torque_per_pressure
    swing = [_settled_angle(finger, middle, np.exp(s * spread.stiffness)) for s in (-1, 1)]
    lively = replace(finger, damping=finger.damping * float(np.exp(spread.damping)))
    growth = finger_volume(FULL_ANGLE, FULL_PRESSURE, finger) / finger.rest_volume
    nan = float("nan")

    def printed(
        use: Literal["calibrated", "checked"],
        where: str,
        what: str,
        text: str,
        unit: str,
        parameter: str,
        value: float,
        given: float,
    ) -> Entry:
        return Entry(
            use, where, what, text, unit, parameter, value, given, round(given - float(text), 9)
        )

    def assumed(what: str, unit: str, parameter: str, value: float, given: float) -> Entry:
        return Entry("assumed", "", what, "", unit, parameter, value, given, nan)

    return (
        printed(
            "calibrated", "Figure 3.9", "torque at 0.25 MPa held straight", "0.359", "N m",
            "finger.torque_per_pressure", finger.torque_per_pressure,
            finger.torque_per_pressure * 0.25 * MPa,
        ),
        printed(
            "calibrated", "Figure 3.10", "settled angle at 0.15 MPa", "206", "deg",
            "finger.stiffness", finger.stiffness, _settled_angle(finger, FULL_PRESSURE) / DEG,
        ),
        printed(
            "calibrated", "Table 5.1", "fractional power of Dragon Skin 20", "2.500", "",
            "finger.fractional_power", finger.fractional_power, finger.fractional_power,
        ),
        printed(
            "calibrated", "Table 3.3", "natural frequency taken at 60 deg", "2.86", "rad/s",
            "finger.inertia", finger.inertia, float(abs(pole)),
        ),
        printed(
            "calibrated", "Section 3.4", "damping ratio taken at 60 deg", "0.7", "",
            "finger.damping", finger.damping, _damping_ratio(finger),
        ),
        printed(
            "calibrated", "Section 3.4", "spread of the damping ratio as one deviation", "0.1", "",
            "spread.damping", spread.damping, _damping_ratio(lively) - _damping_ratio(finger),
        ),
        printed(
            "calibrated", "Section 5.4", "run-to-run RMS (2 to 3) taken at 75 deg", "2.5", "deg",
            "spread.stiffness", spread.stiffness, (swing[0] - swing[1]) / 2 / DEG,
        ),
        printed(
            "calibrated", "Section 6.4", "RMS error of the flex sensor", "2", "deg",
            "sensors.angle_noise", sensors.angle_noise, noise / DEG,
        ),
        printed(
            "checked", "Section 4.4", "constant capacity over truth at high pressure", "30", "%",
            "", nan, 100 * constant_capacity_error(),
        ),
        printed(
            "checked", "Section 4.3", "modified model off truth above 0.10 MPa", "10", "%",
            "", nan, 100 * modified_capacity_error(),
        ),
        assumed("volume at 206 deg over that at rest", "", "finger.ballooning",
                finger.ballooning, growth),
        assumed("air in the finger at rest", "mL", "finger.rest_volume", finger.rest_volume,
                finger.rest_volume / ML),
        assumed("dead volume", "mL", "gas.dead_volume", gas.dead_volume, gas.dead_volume / ML),
        assumed("air lost at 0.15 MPa and 36 mL", "%/s", "gas.leakage", gas.leakage,
                100 * leak(FULL_PRESSURE, gas.leakage, gas.atmosphere)
                / ((FULL_PRESSURE + gas.atmosphere) * 36 * ML)),
        assumed("lag of the pressure sensor", "s", "sensors.pressure_lag", sensors.pressure_lag,
                sensors.pressure_lag),
        assumed("lag of the flex sensor", "s", "sensors.angle_lag", sensors.angle_lag,
                sensors.angle_lag),
        assumed("fast memory over settled torque", "", "finger.memory[0]", finger.memory[0],
                finger.memory[0]),
        assumed("slow memory over settled torque", "", "finger.memory[1]", finger.memory[1],
                finger.memory[1]),
        assumed("dry friction", "N m", "finger.friction", finger.friction, finger.friction),
    )  # fmt: skip


def write(path: Path | None = None) -> Path:
    """Write the calibration file and return its path."""
    target = data_folder() / FILE if path is None else path
    target.parent.mkdir(parents=True, exist_ok=True)
    with target.open("w", encoding="utf-8", newline="") as out:
        out.write(f"# provenance: simulated\n# source: {COMMAND}\n")
        out.write("# What the simulated rig is tuned to; residual = rig - printed, in `unit`.\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow(entry.name for entry in fields(Entry))
        for line in entries():
            table.writerow(f"{x:.6g}" if isinstance(x, float) else x for x in astuple(line))
    return target


def read() -> tuple[Entry, ...]:
    """Read the calibration file."""
    with data_file(FILE).path.open(encoding="utf-8", newline="") as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))[1:]
    return tuple(Entry(*row[:6], *map(float, row[6:])) for row in rows)  # type: ignore[arg-type]


if __name__ == "__main__":
    print(write())
