"""How the pressure rises: constant capacity, Eq. (4.5) and (4.6), and growing, Eq. (4.7).

These laws hold for gauge and absolute pressure alike. They say that the rate grows with area, lead
and speed, and with nothing else but their product; so a smaller lead makes the response slower,
where Section 4.4 has it reduce the response time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from softgrip.arrays import Value, check_positive
from softgrip.errors import InvalidInputError
from softgrip.pump.flow import Pump

if TYPE_CHECKING:
    import control


def pressure_rate(flow: Value, capacity: Value) -> Value:
    """Return the rate of the pressure, Eq. (4.5): ``Q_i / C_i``.

    Args:
        flow: Q_i, m^3/s, any shape.
        capacity: C_i, m^3/Pa, > 0, shape that broadcasts with `flow`.

    Returns:
        float or ndarray: Pa/s.

    >>> round(pressure_rate(8e-6, 1e-9), 6)
    8000.0
    """
    check_positive(capacity=capacity)
    return flow / capacity


def pressure(time: Value, flow: float, capacity: float, start_pressure: float = 0.0) -> Value:
    """Return the pressure under a constant flow, the integral of `pressure_rate`.

    Args:
        time: Since the flow began, s, any shape.
        flow: Q_i, m^3/s.
        capacity: C_i, m^3/Pa, > 0.
        start_pressure: Pressure at time 0, Pa.

    Returns:
        float or ndarray: Pa, shape of `time`.

    >>> round(pressure(2.0, 8e-6, 1e-9), 6)
    16000.0
    """
    result: Value = start_pressure + pressure_rate(flow, capacity) * time
    return result


def modified_capacity(time: Value, flow: float, capacity: float, growth: float) -> Value:
    """Return the capacity that the modified model puts in place of C_i: ``C_i + c Q_i t``.

    Args:
        time: Since the flow began, s, any shape.
        flow: Q_i, m^3/s.
        capacity: C_i, m^3/Pa, > 0.
        growth: c, 1/Pa (see `gas.capacity_growth`); below zero for a capacity that falls.

    Returns:
        float or ndarray: m^3/Pa, shape of `time`.

    Raises:
        InvalidInputError: If the capacity is not above zero at some time.

    >>> round(modified_capacity(10.0, 1e-5, 1e-9, 5e-6) * 1e9, 9)
    1.5
    """
    check_positive(capacity=capacity)
    result: Value = capacity + growth * flow * time
    if not np.all(np.asarray(result) > 0):
        raise InvalidInputError(
            "growth", expected="C_i + c Q_i t > 0 at all times", got=f"least {np.min(result):g}"
        )
    return result


def modified_pressure_rate(time: Value, flow: float, capacity: float, growth: float) -> Value:
    """Return the rate of the modified model, Eq. (4.7): ``Q_i / (C_i + c Q_i t)``, Pa/s.

    Parameters and errors as for `modified_capacity`.

    >>> round(modified_pressure_rate(10.0, 1e-5, 1e-9, 1e-5), 6)  # half of that at time 0
    5000.0
    """
    result: Value = flow / modified_capacity(time, flow, capacity, growth)
    return result


def modified_pressure(
    time: Value, flow: float, capacity: float, growth: float, start_pressure: float = 0.0
) -> Value:
    """Return the pressure by the modified model: ``P_0 + ln(1 + c Q_i t / C_i) / c``.

    Parameters and errors as for `modified_capacity`; with c = 0 it is `pressure`.

    Returns:
        float or ndarray: Pa, shape of `time`.

    >>> float(round(modified_pressure(10.0, 1e-5, 1e-9, 1e-5) / 1e5, 6))  # ln 2
    0.693147
    """
    modified_capacity(time, flow, capacity, growth)
    if growth == 0:
        return pressure(time, flow, capacity, start_pressure)
    result: Value = start_pressure + np.log1p(growth * flow * time / capacity) / growth
    return result


def pressure_system(pump: Pump, capacity: float) -> control.StateSpace:
    """Return the pump as a state space, whose transfer function is Eq. (4.6).

    Args:
        pump: The pump.
        capacity: C_i, m^3/Pa, > 0, held constant.

    Returns:
        control.StateSpace: Input `motor_speed`, rad/s; state and output `pressure`, Pa.

    >>> system = pressure_system(Pump(6.61e-4, 0.008), 1e-9)
    >>> float(system.B[0, 0].round(3))
    841.611
    """
    import control

    check_positive(capacity=capacity)
    return control.ss(
        [[0.0]],
        [[pump.displacement / capacity]],
        [[1.0]],
        [[0.0]],
        inputs=["motor_speed"],
        states=["pressure"],
        outputs=["pressure"],
        name="syringe_pump",
    )
