"""What a finger asks of its pump: a pressure, and the volume to push for it.

The volume follows from the exact gas law, not from a constant capacity: syringe, tube and finger
begin at atmospheric pressure, and at the end all of that charge is at the pressure asked for.
"""

from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Number, check_positive, is_symbol
from softgrip.checks import check_not_negative
from softgrip.errors import InvalidInputError
from softgrip.pump.gas import ATMOSPHERE


@dataclass(frozen=True)
class Finger:
    """What is to be driven.

    Attributes:
        gauge_pressure: Wanted, Pa above atmosphere, > 0.
        volume_at_rest, volume_at_pressure: Of the finger's chambers (all fingers on the pump), m^3,
            > 0; the second is not smaller.
        dead_volume: Of tube and fittings, m^3, >= 0.
        rise_time: From rest to the pressure, s, > 0.
    """

    gauge_pressure: Number
    volume_at_rest: Number
    volume_at_pressure: Number
    dead_volume: Number
    rise_time: float

    def __post_init__(self) -> None:
        check_positive(
            gauge_pressure=self.gauge_pressure,
            volume_at_rest=self.volume_at_rest,
            rise_time=self.rise_time,
        )
        check_not_negative(dead_volume=self.dead_volume)
        if is_symbol(self.volume_at_pressure):
            return
        if not np.all(self.volume_at_pressure >= self.volume_at_rest):
            raise InvalidInputError(
                "volume_at_pressure",
                expected=f"at least the volume at rest, {self.volume_at_rest}",
                got=self.volume_at_pressure,
            )


def swept_volume(finger: Finger, start_volume: Number, atmosphere: Number = ATMOSPHERE) -> Number:
    """Return the volume to push for the wanted pressure, by the exact isothermal gas law.

    ``P_0 (V_s + V_rest + V_dead) = P_1 (V_s - s + V_pressure + V_dead)`` is solved for s.

    Args:
        finger: The finger and its pressure.
        start_volume: V_s, gas in the syringe before the push, m^3, > 0.
        atmosphere: P_0, Pa, > 0.

    Returns:
        s, m^3. Above `start_volume` if the syringe does not hold enough.

    >>> finger = Finger(101325.0, 20e-6, 20e-6, 0.0, 1.0)  # double the pressure: half the volume
    >>> round(swept_volume(finger, 60e-6) * 1e6, 6)
    40.0
    """
    check_positive(start_volume=start_volume, atmosphere=atmosphere)
    ratio = atmosphere / (atmosphere + finger.gauge_pressure)
    before = start_volume + finger.volume_at_rest + finger.dead_volume
    swept: Number = start_volume + finger.volume_at_pressure + finger.dead_volume - ratio * before
    return swept


def least_start_volume(finger: Finger, atmosphere: float = ATMOSPHERE) -> float:
    """Return the gas that the syringe must hold at the least, m^3: all of it is then pushed out.

    ``P_1 (V_pressure + V_dead) / P_0 - V_rest - V_dead``. No smaller syringe will do; a larger one
    that starts with no more than this has the shortest way to push, since less gas is compressed.

    >>> round(least_start_volume(Finger(101325.0, 20e-6, 20e-6, 0.0, 1.0)) * 1e6, 6)
    20.0
    """
    check_positive(atmosphere=atmosphere)
    ratio = (atmosphere + finger.gauge_pressure) / atmosphere
    at_rest = finger.volume_at_rest + finger.dead_volume
    return float(ratio * (finger.volume_at_pressure + finger.dead_volume) - at_rest)
