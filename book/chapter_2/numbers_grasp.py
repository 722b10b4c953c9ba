"""Recomputation of the numbers that Chapter 2 prints of the grasp with the tactile sensor."""

from softgrip.ledger.verdict import simulated
from softgrip.rig.pad_grasp_study import FRICTION, desired_force, study, summary
from softgrip.tactile.force import table_2_2
from softgrip.tactile.friction import printed_grasps
from softgrip.tactile.lift import contact_force, lift_force

WEIGHED = {"egg": "egg", "tofu": "tofu", "carrot": "sliced carrot"}
"""The row of Table 2.2 for each object of Section 2.4."""


def pressed(name: str, friction: float) -> float:
    """Return the contact force, N, that the printed estimated lift force of an object needs."""
    return contact_force(float(printed_grasps()[name].lift), friction)


def lift_of_desired(name: str, friction: float) -> float:
    """Return the lift force, N, whose Eq. (2.8) gives the printed desired force of an object."""
    return lift_force(desired_force(name), friction)


def printed_lift(name: str) -> float:
    """Return the estimated lift force that Figure 2.13 prints of an object, N."""
    return float(printed_grasps()[name].lift)


def true_weight(name: str) -> float:
    """Return what Table 2.2 prints as the true weight of an object, N."""
    return table_2_2()[WEIGHED[name]].true


@simulated
def simulated_lift(name: str) -> float:
    """Return the estimated lift force, N, of the simulated grasps at rest, Eq. (2.9)."""
    measured = desired_force(name) - summary(study(name)).steady_error
    return lift_force(measured, FRICTION)
