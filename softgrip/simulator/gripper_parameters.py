"""What the simulated gripper is made of, and its calibration to what Section 6.4 prints.

The text contradicts itself on which finger is which. Eq. (6.26) gives SPA 1 the larger stiffness,
so that it bends less (0.303 pi against 0.357 pi of one command), and Eq. (6.27) has 0.227 pi, which
is 40.86 deg, for it. But Section 6.4 calls SPA 1 the left finger, which bends more (50 deg against
39.5 deg in open loop, 48.24 deg against 40.86 deg desired). Here **left and right go by the
angles**: the left finger has the second row of Eq. (6.26), the softer one, and the right finger
the first row. Then the angles, the rows and "responds faster" (a softer finger of the same mass is
ahead at all times) agree, and the equivalent masses differ by a few percent only, as they should.
"""

import numpy as np
from scipy.integrate import quad
from scipy.special import erf

from softgrip.gripper.plant import PRINTED
from softgrip.gripper.uncertainty import DAMPING_BOUND, STIFFNESS_BOUND
from softgrip.simulator.calibration import DESIGN_1, FULL_ANGLE, FULL_PRESSURE, TORQUE_PER_PRESSURE
from softgrip.simulator.parameters import FingerParameters, PumpParameters, RigParameters, Spread
from softgrip.units import DEG, ML

SYRINGE = 150 * ML
AREA = float(np.interp(SYRINGE, (60 * ML, 200 * ML), (6.61e-4, 16.62e-4)))
"""m^2: on the line through the two syringes of Table 4.1 (assumed; that of 150 mL is not said)."""
OPEN_LOOP_ANGLES = (50 * DEG, 39.5 * DEG)
"""Left and right at one pressure, in open loop (Section 6.4)."""
LEFT, RIGHT = PRINTED.fingers[1], PRINTED.fingers[0]
"""What the step tests of the two identify (Section 6.4), by the reading above."""
COMMON_PRESSURE = FULL_PRESSURE * (45 * DEG / FULL_ANGLE) ** DESIGN_1.fractional_power
"""Pa: what bends Design 1 to pi/4 (assumed; no pressure is printed)."""
PUMP = PumpParameters(area=AREA, syringe_volume=SYRINGE)
INERTIA, DAMPING = (2.495e-3, 2.647e-3), (7.345e-3, 8.666e-3)
"""kg m^2 and N m s/rad, left and right: with these an open-loop step, without noise, identifies
`LEFT` and `RIGHT`. `gripper_calibration` finds them."""
TRAVEL = 6.94e-3
"""Of the plunger in that step, m: the mean of the two angles is then that of those printed."""
BOUND_RUNS = 7
"""Runs of which the printed bounds are the largest deviation (assumed)."""


def largest_of(count: int) -> float:
    """Return the mean of the largest size among `count` standard normal numbers.

    >>> round(largest_of(1) ** 2, 4) == round(2 / np.pi, 4)
    True
    """
    # The mean of a number >= 0 is the integral of the chance to exceed.
    return float(quad(lambda x: 1 - erf(x / 2**0.5) ** count, 0, 10)[0])


def finger_of(angle: float, inertia: float, damping: float) -> FingerParameters:
    """Return a finger of Dragon Skin 20 that rests at an angle [rad] at `COMMON_PRESSURE`.

    Torque, volume, memory and friction are those of Design 1.
    """
    n = DESIGN_1.fractional_power
    return FingerParameters(
        stiffness=TORQUE_PER_PRESSURE * COMMON_PRESSURE / angle**n,
        fractional_power=n,
        inertia=inertia,
        damping=damping,
        torque_per_pressure=TORQUE_PER_PRESSURE,
        rest_volume=DESIGN_1.rest_volume,
    )


def run_to_run() -> Spread:
    """Return the spread of which the printed bounds are the largest of `BOUND_RUNS` deviations.

    A finger at one pressure whose torque is ``K theta**n`` has a linear stiffness, torque by angle,
    that goes with ``K**(1 / n)``: so K varies n times as much as the printed K_n.
    """
    largest = largest_of(BOUND_RUNS)
    return Spread(
        stiffness=DESIGN_1.fractional_power * STIFFNESS_BOUND / largest,
        damping=DAMPING_BOUND / largest,
        leakage=0.3,
    )


def printed_gripper(*, spread: bool = True) -> RigParameters:
    """Return the two-finger gripper of Section 6.4, left finger first; `spread` as `design_1`."""
    between_runs = run_to_run() if spread else Spread()
    fingers = tuple(map(finger_of, OPEN_LOOP_ANGLES, INERTIA, DAMPING))
    return RigParameters(fingers, PUMP, spread=between_runs)
