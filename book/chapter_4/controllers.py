"""The PID controllers of Chapter 4 with their kept gains, from angles to motor speed."""

from typing import Literal, get_args

from book.chapter_4.identified_model import identified_model
from book.chapter_4.pid_gains import pid_gains
from softgrip.control.loop import SPEED_LIMIT, Controller
from softgrip.control.pid import PID
from softgrip.control.pressure_command import SET_PRESSURE, PressureAsSpeed, PressureByPlunger
from softgrip.errors import InvalidInputError

Name = Literal["actuator", "actuator by plunger", "full"]
"""The (4.14) design under its two readings of `control.pressure_command`, and the (4.15) one."""


def controller(name: Name, stage: str = "tuned") -> Controller:
    """Return a controller with its kept gains, from angles to motor speed.

    Parameters
    ----------
    name
        Which.
    stage
        Of the tuning; see `numbers.pid_gains`.

    Raises
    ------
    InvalidInputError
        If the name is not one of `Name`.
    """
    if name not in get_args(Name):
        raise InvalidInputError("name", expected=f"one of {get_args(Name)}", got=name)
    if name == "full":
        return PID(pid_gains("full", stage), limits=(-SPEED_LIMIT, SPEED_LIMIT))
    pid = PID(pid_gains("actuator", stage), limits=(-SET_PRESSURE, SET_PRESSURE))
    if name == "actuator":
        return PressureAsSpeed(pid)
    return PressureByPlunger(pid, identified_model().pump_gain)
