"""What the simulated gripper is tuned to, and how far off the printed measurements it is.

``python -m softgrip.simulator.gripper_calibration_table`` writes ``data/calibration/gripper.csv``,
as `calibration_table` does for one finger; what is not named here is as there.
"""

import numpy as np

from softgrip.gripper.uncertainty import parameter_bounds
from softgrip.kept import Kept
from softgrip.simulator.calibration_entry import NAN, Entry, assumed, calibrated, checked
from softgrip.simulator.calibration_table import NOTES
from softgrip.simulator.chance import SEED
from softgrip.simulator.gripper_calibration import step_identifies
from softgrip.simulator.gripper_parameters import (
    AREA,
    BOUND_RUNS,
    COMMON_PRESSURE,
    DAMPING,
    INERTIA,
    SYRINGE,
    TRAVEL,
    largest_of,
    printed_gripper,
    run_to_run,
)
from softgrip.units import DEG, ML

FILE = "calibration/gripper.csv"


def entries() -> tuple[Entry, ...]:
    """Compute the calibration: what is printed, what it set, and what the gripper gives."""
    calm, spread = printed_gripper(spread=False), run_to_run()
    angles, found = step_identifies(calm, TRAVEL)
    largest, n = largest_of(BOUND_RUNS), calm.fingers[0].fractional_power
    _, several = step_identifies(printed_gripper(), TRAVEL, runs=BOUND_RUNS, seed=SEED)
    damping, stiffness = np.max([parameter_bounds(runs) for runs in several], axis=0).tolist()
    rows = []
    sides = (("left", "50", "3.06", "2.45"), ("right", "39.5", "3.61", "2.66"))
    for k, (side, angle, stiff, damped) in enumerate(sides):
        finger = calm.fingers[k]
        rows += [
            calibrated("Section 6.4", f"{side}: angle in open loop", angle, "deg",
                       f"fingers[{k}].stiffness", finger.stiffness, float(angles[k, 0]) / DEG),
            calibrated("Eq. (6.26)", f"{side}: identified stiffness by mass", stiff, "1/s^2",
                       f"fingers[{k}].inertia", INERTIA[k], found[k][0].stiffness),
            calibrated("Eq. (6.26)", f"{side}: identified damping by mass", damped, "1/s",
                       f"fingers[{k}].damping", DAMPING[k], found[k][0].damping),
        ]  # fmt: skip
    return (
        *rows,
        calibrated("Section 6.4", "seven runs: largest deviation of C_n itself", "14.3", "%",
                   "spread.damping", spread.damping, 100 * largest * spread.damping),
        calibrated("Section 6.4", "seven runs: largest deviation of K_n at one pressure", "5.9",
                   "%", "spread.stiffness", spread.stiffness,
                   100 * largest * spread.stiffness / n),
        checked("Section 6.4", "seven runs: the same of C_n, identified", "14.3", "%",
                100 * damping),
        checked("Section 6.4", "seven runs: the same of K_n, identified", "5.9", "%",
                100 * stiffness),
        calibrated("Section 6.3", "syringe", "150", "mL", "pump.syringe_volume", SYRINGE,
                   SYRINGE / ML),
        assumed("cross-section of the syringe", "m^2", "pump.area", AREA),
        assumed("pressure at which the angles in open loop are taken", "Pa", "", COMMON_PRESSURE),
        assumed("travel of the plunger in the open-loop step", "mm", "", TRAVEL),
        assumed("inertia of the right finger over that of the left", "", "", NAN,
                float(np.divide(*INERTIA[::-1]))),
    )  # fmt: skip


KEPT = Kept(FILE, Entry, entries, "python -m softgrip.simulator.gripper_calibration_table", NOTES)

if __name__ == "__main__":
    KEPT.main()
