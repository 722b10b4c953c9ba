"""How the pressure models of Chapter 4 fare against the simulated rig: a check of its plausibility.

The text says that a model of constant capacity lies above the true response at high pressure, as
the finger grows. A syringe that starts at atmospheric pressure, closed and at one temperature,
cannot do that, however the finger grows and whatever leaks. With total volume V_0 at the start, the
capacity at the start is at least ``V_0 / P_atm``; a model tangent there is above the truth at gauge
pressure p only after the plunger has swept ``p V_0 / P_atm``, which from p = P_atm = 0.101 MPa on
is more than all the air that there was. `least_air_swept` says this in a number.
"""

import numpy as np
from scipy.optimize import least_squares

from softgrip.arrays import Floats
from softgrip.pump.gas import ATMOSPHERE
from softgrip.simulator.calibration import design_1
from softgrip.simulator.simulation import Simulation
from softgrip.units import REV, MPa

LOW, HIGH = 0.05 * MPa, 0.10 * MPa
"""Gauge pressures, Pa: the constant model is fitted below the first."""


def least_air_swept(gauge: float, excess: float, atmosphere: float = ATMOSPHERE) -> float:
    """Return the least share of the starting volume to be swept for a model to lie above the truth.

    Args:
        gauge: True pressure, Pa, at which the model, tangent at the start, is judged.
        excess: By what part of the truth it is to lie above.
        atmosphere: Pa.

    >>> round(least_air_swept(0.15e6, 0.3), 2)
    1.92
    """
    return gauge * (1 + excess) / atmosphere


def push() -> tuple[Floats, Floats]:
    """Return swept volume (m^3) and true gauge pressure (Pa) of the default push, no spread."""
    rig = Simulation(design_1(spread=False))
    _, truth = rig.open_loop(np.full(320, 1.65 * REV))
    swept = rig.parameters.pump.area * truth.plunger[:, 0]
    moving = np.diff(swept, prepend=0.0) > 0
    return swept[moving], truth.pressure[moving, 0]


def constant_capacity_error() -> float:
    """Return (model - truth) / truth at the push's end, constant capacity fitted up to `LOW`."""
    swept, pressure = push()
    low = pressure <= LOW
    capacity = float(swept[low] @ swept[low] / (swept[low] @ pressure[low]))
    return float((swept[-1] / capacity - pressure[-1]) / pressure[-1])


def modified_capacity_error() -> float:
    """Return the (model - truth) / truth of largest size above `HIGH`, for growing capacity.

    ``p = ln(1 + c q / C) / c`` in the swept volume q; C and c are fitted to the whole push, and c
    may come out negative.
    """
    swept, pressure = push()
    q, p = swept / swept[-1], pressure / pressure[-1]

    def model(x: Floats) -> Floats:
        curve: Floats = np.log1p(x[1] * q) / np.log1p(x[1]) * x[0]
        return curve

    found = least_squares(lambda x: model(x) - p, [1.0, -0.5], bounds=([0.1, -0.999], [10, 10]))
    high = pressure > HIGH
    off = (model(found.x) - p)[high] / p[high]
    return float(off[np.argmax(np.abs(off))])
