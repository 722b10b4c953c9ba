"""The simulated rig with a finger of another section, and the frequency that its steps tell."""

from dataclasses import replace

from softgrip.actuator.bending import modified_moment
from softgrip.actuator.frequency import rubber_mass
from softgrip.actuator.printed import section as printed_section
from softgrip.actuator.printed import table_3_2
from softgrip.actuator.section import Section, chamber_area, check_section, torque
from softgrip.dynamics.identify import Identified, identify
from softgrip.errors import InvalidInputError
from softgrip.reads import remembered
from softgrip.simulator.calibration import OPERATING_ANGLE, design_1
from softgrip.simulator.chance import SEED
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.steps import simulate_step_test, travel_to

RUNS = 7


def rig_with(section: Section) -> RigParameters:
    """Return the rig of Design 1 with another section of the same rubber and length.

    Each parameter is that of Design 1 times what the models of Chapter 3 say of the change: the
    torque by Eq. (3.4), the stiffness by I_n of Eq. (3.8), the inertia by the rubber's mass, the
    air by the chamber's area; the damping ratio stays.

    Raises:
        InvalidInputError: If the section is no chamber or its torque is not positive.
    """
    check_section(section)
    known = printed_section("Opt. parameters")
    rig = design_1()
    finger, n = rig.finger, rig.finger.fractional_power
    pushes = torque(section, 1.0) / torque(known, 1.0)
    if not pushes > 0:
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


def identified_step(rig: RigParameters, *, angle: float = OPERATING_ANGLE) -> Identified:
    """Identify the mean of seven simulated steps, pressure to angle, as Section 3.4 does.

    Args:
        rig: Its parameters.
        angle: At which the median run ends, rad.
    """
    test = simulate_step_test(rig, travel_to(rig, angle), runs=RUNS, seed=SEED)
    return identify(test.time, test.pressure, test.angle, initial_input=0.0)


@remembered
def identified_row(row: int) -> Identified:
    """Identify simulated steps to 60 deg of the section of a row of Table 3.2, 1 to 4."""
    return identified_step(rig_with(table_3_2()[row - 1].section))
