"""What the simulated gripper gives beside the measurements printed in Chapter 6."""

import numpy as np

from softgrip.ledger.verdict import simulated
from softgrip.rig import gripper_comparison, gripper_results, gripper_speed
from softgrip.units import DEG, ML

SIDE = {"left": 0, "right": 1}
PARAMETER = {"damping": 0, "stiffness": 1}


@simulated
def deviation_of_runs(parameter: str) -> float:
    """Return the larger of the two fingers' largest deviations over seven logs, in percent."""
    found = gripper_results.bounds(gripper_results.identified("open"))
    return float(100 * found[:, PARAMETER[parameter]].max())


@simulated
def excited(kind: str, end: str) -> float:
    """Return an end of the band in which the command of some logs is excited, rad/s."""
    return gripper_results.band(kind)[("low", "high").index(end)]


@simulated
def spread_at_rest(speed: float) -> float:
    """Return the measured standard deviation at rest of the left finger, in deg.

    ``speed`` is one of `gripper_speed.SPEEDS`, rev/s.
    """
    found = {spread.speed: spread for spread in gripper_speed.read()}
    return float(found[speed].measured.std(ddof=1))


@simulated
def angle_at_rest(side: str, kind: str = "open") -> float:
    """Return the mean of the last second of seven logs of a kind, in deg."""
    return float(gripper_results.ends(kind)[SIDE[side]] / DEG)


@simulated
def reachable_angle(side: str) -> float:
    """Return what the simulated gripper's own model can reach of 45 deg, in deg."""
    return float(gripper_results.desired()[SIDE[side]] / DEG)


@simulated
def settled_on_rig(controller: str, criterion: str = "10 %") -> float:
    """Return the settling time of both fingers on the simulated gripper, median of 50 runs, s."""
    return float(np.median(gripper_comparison.judged(controller).settling[criterion]))


@simulated
def tracking_error_on_rig(controller: str) -> float:
    """Return how far a finger's true end lies from its target, median of 50 runs, in deg."""
    return float(np.median(gripper_comparison.judged(controller).error)) / DEG


@simulated
def transient_difference_on_rig(controller: str) -> float:
    """Return the largest difference of the shares of their ways, median of 50 runs, in deg."""
    return float(np.median(gripper_comparison.judged(controller).synchronization)) / DEG


@simulated
def identified(finger: str, parameter: str) -> float:
    """Return what the simulated gripper's steps identify, the mean of the runs, SI by mass."""
    runs = gripper_results.identified("open")[SIDE[finger]]
    return float(np.mean([getattr(one, parameter) for one in runs]))


@simulated
def volume_of_fingers(count: int, angle: float) -> float:
    """Return the volume that bends so many fingers by an angle [rad], in mL."""
    return gripper_results.volume_for(count, angle) / ML
