"""The pump that a point of the front needs: syringe, screw and motor, or why there is none."""

from softgrip.actuator.bending import elongation
from softgrip.actuator.front import Point
from softgrip.actuator.section import Section
from softgrip.pump.finger import Finger
from softgrip.pump.sizing import Sizing, sizings
from softgrip.units import ML

RISE = 1.5
"""From rest to the pressure, s: ours."""
DEAD = 2 * ML
"""Of tube and fittings, m^3: ours."""


def asked_of_pump(point: Point, fingers: int = 1) -> Finger:
    """Return what so many fingers of a point ask of a pump.

    The air of a finger grows as it does in length, by Eq. (3.9): the models widen no chamber.
    """
    found = point.answer
    section = Section(found.top, found.bottom, found.width, found.wall)
    E = point.question.problem().problem.young_modulus
    longer = float(elongation(section, point.question.pressure, E))
    rest = fingers * found.air
    return Finger(point.question.pressure, rest, rest * longer, DEAD, RISE)


def pump_for(point: Point, fingers: int = 1) -> Sizing:
    """Return the best pump for a feasible point; its reasons say why it does not do, if none does.

    Of those that do it is the one with the largest margin; else the one with the fewest reasons.
    """
    found = sizings(asked_of_pump(point, fingers))
    if found[0].feasible:
        return found[0]
    return min(found, key=lambda one: len(one.reasons))


def pump_words(sizing: Sizing) -> str:
    """Return a pump in words, or why there is none."""
    if not sizing.feasible:
        return f"none: {'; '.join(sizing.reasons)}"
    parts = sizing.syringe.name, f"screw {sizing.screw.name}", sizing.motor.name
    return f"{', '.join(parts)} ({sizing.margin:.1f} times)"
