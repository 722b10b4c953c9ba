"""The range of an element of the pad: from the least force that it feels to where it ends."""

from scipy.optimize import brentq

from softgrip.simulator.pad_parameters import PadParameters
from softgrip.tactile.element import compliance
from softgrip.tactile.element_sensitivity import CEILING, resistance

NOISES = 3.0
"""Change of a voltage that is taken as felt, in deviations of its noise."""


def ceiling_force(pad: PadParameters) -> float:
    """Return the force on an element at which its resistance reaches the printed ceiling, N."""
    soft, height = compliance(pad.element, pad.young_modulus), pad.element.height
    # Just below the ceiling: from there on the law is flat.
    almost = CEILING * (1 - 1e-9)
    return float(brentq(lambda force: resistance(soft * force, height) - almost, 0, 1))


def least_force(pad: PadParameters) -> float:
    """Return the force on an element that moves its voltage by three deviations of the noise, N.

    A step of the converter, where it is larger, counts as the deviation.
    """
    soft, height = compliance(pad.element, pad.young_modulus), pad.element.height
    step = max(pad.noise, pad.supply / pad.levels)
    ohms = NOISES * step * pad.gain_resistor / pad.reference
    rest = resistance(0.0, height)
    return float(brentq(lambda force: resistance(soft * force, height) - rest - ohms, 0, 1))
