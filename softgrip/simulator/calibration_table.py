"""What the simulated rig is tuned to, and how far off the printed measurements it is.

``python -m softgrip.simulator.calibration_table`` writes ``data/calibration/simulated_rig.csv``:
each measurement used, the parameter that it set, what the rig then gives; what is assumed; and what
is printed but was not used. A quantity that the rig was calibrated to is never one that it found.
Lines that name no other finger are those of Design 1.
"""

from dataclasses import replace

import numpy as np

from softgrip.kept import Kept
from softgrip.simulator.calibration import FULL_ANGLE, FULL_PRESSURE, design_1, design_2, design_3
from softgrip.simulator.calibration_entry import (
    Entry,
    assumed,
    calibrated,
    checked,
    damping_ratio,
    of_finger,
)
from softgrip.simulator.capacity_check import constant_capacity_error, modified_capacity_error
from softgrip.simulator.laws import finger_volume, leak
from softgrip.units import DEG, ML, MPa

FILE = "calibration/simulated_rig.csv"
NOTES = "What the simulated rig is tuned to; residual = rig - printed, in `unit`."


def entries() -> tuple[Entry, ...]:
    """Compute the calibration: what is printed, what it set, and what the rig gives."""
    rig = design_1()
    finger, gas, sensors, spread = rig.finger, rig.gas, rig.sensors, rig.spread
    step = sensors.angle_range / (sensors.high_count - sensors.low_count)
    noise = float(np.hypot(sensors.angle_noise, step / 12**0.5))
    lively = replace(finger, damping=finger.damping * float(np.exp(spread.damping)))
    growth = finger_volume(FULL_ANGLE, FULL_PRESSURE, finger) / finger.rest_volume
    lost = leak(FULL_PRESSURE, gas.leakage, gas.atmosphere)
    torque = finger.torque_per_pressure * 0.25 * MPa
    angle, power, frequency, damping, run_to_run = of_finger(rig, "206", "2.86", "2.500")
    return (
        calibrated("Figure 3.9", "torque at 0.25 MPa held straight", "0.359", "N m",
                   "finger.torque_per_pressure", finger.torque_per_pressure, torque),
        angle,
        replace(power, quantity="fractional power of Dragon Skin 20"),
        frequency,
        damping,
        calibrated("Section 3.4", "spread of the damping ratio as one deviation", "0.1", "",
                   "spread.damping", spread.damping, damping_ratio(lively) - damping.rig),
        run_to_run,
        calibrated("Section 6.4", "RMS error of the flex sensor", "2", "deg",
                   "sensors.angle_noise", sensors.angle_noise, noise / DEG),
        checked("Section 4.4", "constant capacity over truth at high pressure", "30", "%",
                100 * constant_capacity_error()),
        checked("Section 4.3", "modified model off truth above 0.10 MPa", "10", "%",
                100 * modified_capacity_error()),
        *of_finger(design_2(), "201", "2.78", "2.500", name="Design 2"),
        *of_finger(design_3(), "232", "1.72", "1.538", name="Design 3"),
        checked("Figure 3.9", "Design 3: torque at 0.25 MPa, where it has buckled", "0.15", "N m",
                design_3().finger.torque_per_pressure * 0.25 * MPa),
        assumed("Designs 2 and 3: torque at 0.25 MPa held straight", "N m",
                "design_3.finger.torque_per_pressure", finger.torque_per_pressure, torque),
        assumed("volume at 206 deg over that at rest", "", "finger.ballooning",
                finger.ballooning, growth),
        assumed("air in the finger at rest", "mL", "finger.rest_volume", finger.rest_volume),
        assumed("dead volume", "mL", "gas.dead_volume", gas.dead_volume),
        assumed("air lost at 0.15 MPa and 36 mL", "%/s", "gas.leakage", gas.leakage,
                100 * lost / ((FULL_PRESSURE + gas.atmosphere) * 36 * ML)),
        assumed("lag of the pressure sensor", "s", "sensors.pressure_lag", sensors.pressure_lag),
        assumed("lag of the flex sensor", "s", "sensors.angle_lag", sensors.angle_lag),
        assumed("fast memory over settled torque", "", "finger.memory[0]", finger.memory[0]),
        assumed("slow memory over settled torque", "", "finger.memory[1]", finger.memory[1]),
        assumed("dry friction", "N m", "finger.friction", finger.friction),
    )  # fmt: skip


KEPT = Kept(FILE, Entry, entries, "python -m softgrip.simulator.calibration_table", NOTES)

if __name__ == "__main__":
    KEPT.main()
