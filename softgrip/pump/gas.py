"""The gas in pump and finger: the law of Eq. (4.3), and what it says of the capacity.

All pressures here are absolute. A closed charge of gas at one temperature keeps ``P V``. Let V be
the volume of *all* of it: in the syringe, the tube and the finger. The plunger takes Q from V, the
finger's wall gives way by dV_f/dP times the rise of the pressure::

    0 = d(P V)/dt = V dP/dt + P (dV_f/dP dP/dt - Q)
    dP/dt = Q / C    with    C = (V + P dV_f/dP) / P

which is Eq. (4.5), so the capacity has the unit m^3/Pa, and it is no constant: a rigid chamber has
C = V/P, which *falls* as the plunger goes in, because V falls and P rises. As P V = N is kept,
C = N/P^2 + dV_f/dP and::

    dC/dP = d2V_f/dP2 - 2 V/P^2

so a wall of constant compliance leaves it falling; only a finger that softens as it fills
(d2V_f/dP2 > 2 V/P^2) has the growing capacity of Eq. (4.7). A leak looks the same from outside.

The dissertation differentiates Eq. (4.4) with V fixed and gas flowing in. That gives the same form
with the finger's volume alone; the gas that stays in the syringe, compressed with the rest, is
then missed.
"""

from typing import Any

import numpy as np

from softgrip.arrays import Value, check_positive, is_symbol
from softgrip.checks import check_not_negative
from softgrip.errors import InvalidInputError

GAS_CONSTANT = 8.31446261815324
"""R of Eq. (4.3), J/(mol K)."""
ATMOSPHERE = 101325.0
"""Standard atmosphere, Pa."""


def gas_pressure(amount: Value, volume: Value, temperature: float = 293.15) -> Value:
    """Return the pressure of an ideal gas, Eq. (4.4): ``n R T / V``.

    Args:
        amount: n, mol, > 0, any shape.
        volume: V, m^3, > 0, shape that broadcasts with `amount`.
        temperature: T, K, > 0.

    Returns:
        float or ndarray: Absolute pressure, Pa.

    >>> round(gas_pressure(1.0, 0.0224139695, 273.15))
    101325
    """
    check_positive(amount=amount, volume=volume, temperature=temperature)
    result: Value = amount * (GAS_CONSTANT * temperature) / volume
    return result


def capacity(pressure: Value, gas_volume: Value, compliance: float = 0.0) -> Value:
    """Return the capacity C that the gas has at one state: ``(V + P dV_f/dP) / P``.

    Args:
        pressure: Absolute pressure P, Pa, > 0, any shape.
        gas_volume: Volume V of all the gas at that pressure, m^3, > 0.
        compliance: dV_f/dP of the finger at that pressure, m^3/Pa, >= 0; 0 for a rigid chamber.

    Returns:
        float or ndarray: C, m^3/Pa.

    >>> capacity(1e5, 1e-4)  # 100 mL of air at 1 bar
    1e-09
    """
    check_positive(pressure=pressure, gas_volume=gas_volume)
    check_not_negative(compliance=compliance)
    result: Value = gas_volume / pressure + compliance
    return result


def capacity_growth(
    pressure: Value, gas_volume: Value, compliance: float = 0.0, compliance_slope: float = 0.0
) -> Value:
    """Return how the capacity changes with the volume pushed, the constant c of the modified model.

    With dP/d(Qt) = 1/C, ``c = (d2V_f/dP2 - 2 V/P^2) / C``, of unit 1/Pa. So the bounds 0 and 1
    that the text sets on c have no meaning in SI; times the pressure, c is a pure number.

    Args:
        pressure, gas_volume, compliance: As for `capacity`.
        compliance_slope: d2V_f/dP2 of the finger, m^3/Pa^2; above zero if the finger softens as it
            fills.

    Returns:
        float or ndarray: c, 1/Pa.

    >>> round(capacity_growth(1e5, 1e-4), 12)  # a rigid chamber: -2/P
    -2e-05
    """
    bend = compliance_slope - 2 * gas_volume / pressure**2
    result: Value = bend / capacity(pressure, gas_volume, compliance)
    return result


def charge_pressure(charge: Any, volume: Value, compliance: float, rest_pressure: float) -> Value:
    """Return the pressure of a charge of gas in a vessel that gives way, unchecked.

    It solves ``P (V + K (P - P_0)) = n R T`` for P.

    Args:
        charge: n R T, J, > 0: constant for a closed gas at one temperature. Any shape.
        volume: V at P_0, m^3, > 0, shape that broadcasts with `charge`.
        compliance: K = dV_f/dP, m^3/Pa, >= 0; 0 for a rigid chamber.
        rest_pressure: P_0, absolute, Pa.

    Returns:
        float or ndarray: Absolute pressure, Pa.

    >>> charge_pressure(10.0, 1e-4, 0.0, ATMOSPHERE)
    100000.0
    """
    b = volume - compliance * rest_pressure
    # The root of K P^2 + b P = n R T in the form that a rigid chamber, K = 0, can use too.
    result: Value = 2 * charge / (b + (b * b + 4 * compliance * charge) ** 0.5)
    return result


def closed_volume_pressure(
    swept_volume: Value,
    gas_volume: float,
    *,
    compliance: float = 0.0,
    start_pressure: float = ATMOSPHERE,
) -> Value:
    """Return the exact pressure of a closed charge of gas at one temperature, Eq. (4.3).

    ``P (V_0 - s + K (P - P_0)) = P_0 V_0`` is solved for P, with a finger of constant compliance K.

    Args:
        swept_volume: Volume s that the plunger has swept, m^3, < `gas_volume`; below zero if
            pulled. Any shape.
        gas_volume: Volume V_0 of all the gas, syringe included, before the push, m^3, > 0.
        compliance: K = dV_f/dP, m^3/Pa, >= 0; 0 for a rigid chamber.
        start_pressure: P_0, absolute, Pa, > 0.

    Returns:
        float or ndarray: Absolute pressure, Pa, shape of `swept_volume`.

    Raises:
        InvalidInputError: If the swept volume leaves no gas, or a parameter is out of range.

    >>> closed_volume_pressure(50e-6, 100e-6, start_pressure=1e5)  # half the volume, twice P
    200000.0
    """
    check_positive(gas_volume=gas_volume, start_pressure=start_pressure)
    check_not_negative(compliance=compliance)
    # Not <=, so that NaN is caught as well.
    if not is_symbol(swept_volume) and not np.all(np.asarray(swept_volume) < gas_volume):
        raise InvalidInputError(
            "swept_volume",
            expected=f"numbers below the gas volume {gas_volume:g}",
            got=swept_volume,
        )
    volume: Value = gas_volume - swept_volume
    return charge_pressure(start_pressure * gas_volume, volume, compliance, start_pressure)
