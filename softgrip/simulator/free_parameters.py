"""What is free when a simulated rig is fitted to logs: names, ranges, and their place in a rig.

A name says where a parameter stands in `RigParameters`, as ``finger.stiffness``,
``finger_2.memory[0]`` or ``gas.leakage``; fingers are counted as in the columns of logs.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from math import exp, log
from typing import Any, Literal

from softgrip.errors import InvalidInputError, UnknownNameError
from softgrip.logs.fingers import column
from softgrip.simulator.parameters import (
    FingerParameters,
    GasParameters,
    PumpParameters,
    RigParameters,
    SensorParameters,
    Spread,
)
from softgrip.units import ML

_PLACE = re.compile(r"(?P<part>\w+)\.(?P<name>\w+)(\[(?P<entry>\d+)\])?")


Scale = Literal["log", "linear"]


@dataclass(frozen=True)
class Parameter:
    """A free parameter.

    Attributes:
        name: Its place in a rig.
        low, high: Declared range, SI, within which it is sought.
        scale: Whether its logarithm or itself is sought: what can be nothing is sought by itself,
            for to a rig it does as much as it is.
        reason: Why that range.
    """

    name: str
    low: float
    high: float
    scale: Scale
    reason: str

    def __post_init__(self) -> None:
        positive = self.low > 0 or (self.scale == "linear" and self.low == 0)
        if not (positive and self.low < self.high < float("inf")):
            raise InvalidInputError(
                self.name,
                expected="0 < low < high (0 <= low if linear), finite",
                got=(self.low, self.high),
            )

    def at(self, share: float) -> float:
        """Return the value at a share of the range, on its scale.

        >>> Parameter("an.example", 0.0, 100.0, "linear", "").at(0.5)
        50.0
        """
        if self.scale == "log":
            return self.low * exp(share * log(self.high / self.low))
        return self.low + share * (self.high - self.low)

    def share(self, low: float, high: float) -> float:
        """Return how much of the range lies between two values, on its scale."""
        if self.scale == "log":
            return log(high / low) / log(self.high / self.low)
        return (high - low) / (self.high - self.low)


OF_FINGER = (
    Parameter("stiffness", 1e-3, 0.1, "log", "a decade about the fingers of Chapters 3 and 6"),
    Parameter("fractional_power", 1.0, 3.5, "linear", "1 is a linear spring; Table 5.1 has 2.5"),
    Parameter("inertia", 5e-4, 0.02, "log", "the printed frequencies ask for 2.5e-3 to 1.6e-2"),
    Parameter("damping", 1e-3, 0.1, "log", "0.7 of critical (Section 3.4), far to both sides"),
    Parameter("torque_per_pressure", 4e-7, 5e-6, "log", "a third to three times Figure 3.9"),
    Parameter("rest_volume", 8 * ML, 80 * ML, "linear", "a third to three times Table 3.1"),
    Parameter("ballooning", 0.0, 3e-11, "linear", "0.15 MPa grows a held finger by 4.5 mL at most"),
    Parameter("memory[0]", 0.0, 0.4, "linear", "from nothing to 0.4 of the settled torque"),
    Parameter("memory[1]", 0.0, 0.4, "linear", "as the fast one"),
    Parameter("memory_time[0]", 0.1, 2.0, "log", "the fast branch: within a step test"),
    Parameter("memory_time[1]", 2.0, 60.0, "log", "the slow branch: within what is recorded"),
    Parameter("friction", 0.0, 1e-3, "linear", "to what would hold a finger at 25 deg"),
)
"""Of each finger; the names are those of its fields."""

OF_RIG = (
    Parameter("gas.dead_volume", 0.0, 10 * ML, "linear", "2 m of tube of 2.5 mm bore at most"),
    Parameter("gas.leakage", 0.0, 1e-11, "linear", "3 % of the air a second at 0.15 MPa at most"),
    # Shorter lags than half a period show nowhere in a log, and ask for short steps.
    Parameter("sensors.pressure_lag", 0.01, 0.2, "linear", "a transducer behind a tube"),
    Parameter("sensors.angle_lag", 0.01, 0.2, "linear", "a flex sensor within rubber"),
)

UNITS: dict[type[object], dict[str, str]] = {
    FingerParameters: {
        "stiffness": "N m/rad^n", "fractional_power": "1", "inertia": "kg m^2",
        "damping": "N m s/rad", "torque_per_pressure": "N m/Pa", "rest_volume": "m^3",
        "ballooning": "m^3/Pa", "memory": "1", "memory_time": "s", "friction": "N m",
        "friction_rate": "rad/s",
    },
    PumpParameters: {
        "area": "m^2", "lead": "m", "syringe_volume": "m^3", "speed_limit": "rad/s",
        "acceleration_limit": "rad/s^2", "backlash": "m",
    },
    GasParameters: {
        "temperature": "K", "atmosphere": "Pa", "dead_volume": "m^3", "leakage": "m^3/(s Pa)",
    },
    SensorParameters: {
        "pressure_range": "Pa", "pressure_noise": "Pa", "pressure_lag": "s", "angle_range": "rad",
        "angle_noise": "rad", "angle_lag": "s", "low_count": "count", "high_count": "count",
        "bits": "1",
    },
    Spread: {"stiffness": "1", "damping": "1", "leakage": "1"},
}  # fmt: skip
"""Of the fields of each part of a rig."""


def free_parameters(fingers: int) -> tuple[Parameter, ...]:
    """Return what is free in a rig with so many fingers.

    >>> [one.name for one in free_parameters(2)][11:13]
    ['finger.friction', 'finger_2.stiffness']
    """
    own = [
        replace(one, name=f"{column('finger', k)}.{one.name}")
        for k in range(fingers)
        for one in OF_FINGER
    ]
    return (*own, *OF_RIG)


def parts(rig: RigParameters) -> dict[str, Any]:
    """Return the parts of a rig by name: its fingers, pump, gas, sensors, spread."""
    own = {column("finger", k): finger for k, finger in enumerate(rig.fingers)}
    return own | {entry.name: getattr(rig, entry.name) for entry in fields(rig)[1:]}


def parameter_values(rig: RigParameters) -> dict[str, float]:
    """Return all numbers of a rig by name, in the order of its parts.

    >>> from softgrip.simulator.fitted_rigs import design_1
    >>> parameter_values(design_1())["pump.lead"]
    0.008
    """
    found: dict[str, float] = {}
    for name, part in parts(rig).items():
        for entry in fields(part):
            value = getattr(part, entry.name)
            if isinstance(value, tuple):
                found |= {f"{name}.{entry.name}[{k}]": one for k, one in enumerate(value)}
            else:
                found[f"{name}.{entry.name}"] = value
    return found


def unit_of(name: str) -> str:
    """Return the unit of a parameter, "1" if it has none.

    >>> unit_of("finger_2.memory_time[0]")
    's'
    """
    part, field, _ = _place(name)
    kinds: dict[str, type[object]] = {
        "pump": PumpParameters, "gas": GasParameters, "sensors": SensorParameters, "spread": Spread,
    }  # fmt: skip
    units = UNITS[kinds.get(part, FingerParameters)]
    if field not in units:
        raise UnknownNameError("parameter", name, [*units])
    return units[field]


def with_values(rig: RigParameters, values: Mapping[str, float]) -> RigParameters:
    """Return a rig with other values of some parameters.

    >>> from softgrip.simulator.fitted_rigs import design_1
    >>> with_values(design_1(), {"finger.memory[1]": 0.2}).finger.memory[1]
    0.2

    Raises:
        UnknownNameError: If the rig has no such parameter.
        InvalidInputError: If a value is out of range.
    """
    own = parts(rig)
    changed: dict[str, dict[str, Any]] = {name: {} for name in own}
    for name, value in values.items():
        part, field, entry = _place(name)
        before = changed.get(part, {}).get(field, getattr(own.get(part), field, None))
        if entry is None and isinstance(before, int) and value == int(value):
            changed[part][field] = int(value)
        elif entry is None and isinstance(before, float):
            changed[part][field] = value
        elif entry is not None and isinstance(before, tuple) and entry < len(before):
            changed[part][field] = (*before[:entry], value, *before[entry + 1 :])
        else:
            raise UnknownNameError("parameter", name, [*parameter_values(rig)])
    made = {name: replace(part, **changed[name]) for name, part in own.items()}
    fingers = tuple(made.pop(column("finger", k)) for k in range(len(rig.fingers)))
    return RigParameters(fingers, **made)


def _place(name: str) -> tuple[str, str, int | None]:
    found = _PLACE.fullmatch(name)
    if found is None:
        raise InvalidInputError("name", expected="'part.field' or 'part.field[entry]'", got=name)
    entry = found["entry"]
    return found["part"], found["name"], None if entry is None else int(entry)
