"""A simulated rig whose finger has another section, by the models of Chapter 3."""

from dataclasses import replace

import numpy as np

from softgrip.actuator.bending import modified_moment
from softgrip.actuator.frequency import rubber_mass
from softgrip.actuator.section import Section, chamber_area, check_section, torque
from softgrip.errors import InvalidInputError
from softgrip.simulator.parameters import RigParameters


def with_section(rig: RigParameters, section: Section, known: Section) -> RigParameters:
    """Return a rig of one finger with another section of the same rubber and length.

    Each parameter is that of the finger times what the models of Chapter 3 say of the change: the
    torque by Eq. (3.4), the stiffness by I_n of Eq. (3.8), the inertia by the rubber's mass, the
    air by the chamber's area; the damping ratio stays.

    Args:
        rig: With the finger that is known.
        section: The other one.
        known: That of the rig's finger.

    Raises:
        InvalidInputError: If the section is no chamber or its torque is not positive.
    """
    check_section(section)
    finger, n = rig.finger, rig.finger.fractional_power
    pushes = torque(section, 1.0) / torque(known, 1.0)
    if not np.all(pushes > 0):
        raise InvalidInputError("section", expected="one with b > t", got=section)
    stiffer = modified_moment(n, section.width, section.height) / modified_moment(
        n, known.width, known.height
    )
    heavier = rubber_mass(section, 1.0, 1.0) / rubber_mass(known, 1.0, 1.0)
    changed = replace(
        finger,
        torque_per_pressure=finger.torque_per_pressure * pushes,
        stiffness=finger.stiffness * stiffer,
        inertia=finger.inertia * heavier,
        damping=finger.damping * (stiffer * heavier) ** 0.5,
        rest_volume=finger.rest_volume * chamber_area(section) / chamber_area(known),
    )
    return replace(rig, fingers=(changed,))
