"""Computed numbers in the prose of the pages that drive a rig: live, commissioning, protocol."""

from scipy.special import ndtr

from book.live.experiments import STEP
from softgrip.arrays import Number
from softgrip.board.driver import HUNG_AFTER
from softgrip.board.emulated.board import CLOCK
from softgrip.board.firmware.config import AT_START, PINS, SCALE, STEPS
from softgrip.board.session import HEARTBEAT_EVERY
from softgrip.control.pid import PERIOD
from softgrip.rig.acceptance import WIDTH
from softgrip.rig.check import LISTEN
from softgrip.simulator.fit_problem import DEVIATIONS
from softgrip.simulator.fitted_rigs import design_1
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.parameters import SensorParameters
from softgrip.simulator.statics import settled_pressure
from softgrip.units import DEG, MM

SENSORS, SUPPLY = SensorParameters(), PadParameters().supply


def _volts(count: Number) -> Number:
    return count / SENSORS.largest_count * SUPPLY


WORDS = {
    # The parts of a rig: MHz, V, steps a revolution, mm, deg.
    "clock": lambda: f"{CLOCK / 1e6:g}",
    "supply": lambda: f"{SUPPLY:g}",
    "steps": lambda: f"{STEPS}",
    "stroke": lambda: f"{SCALE.travel_in(AT_START['position']) / MM:g}",
    "sensors_from": lambda: f"{_volts(SENSORS.low_count):g}",
    "sensors_to": lambda: f"{_volts(SENSORS.high_count):g}",
    "vent_pin": lambda: f"{PINS['VENT_OUT'].number}",
    "angle_range": lambda: f"{SENSORS.angle_range / DEG:g}",
    # What is looked at, and what is run: s, %, deg, kPa, ms.
    "listen": lambda: f"{LISTEN:g}",
    "band": lambda: f"{100 * WIDTH:g}",
    "step": lambda: f"{STEP / DEG:g}",
    "needs": lambda: f"{settled_pressure(design_1().finger, STEP) / 1e3:.0f}",
    "interval": lambda: f"{100 * (2 * ndtr(DEVIATIONS) - 1):.0f}",
    "period": lambda: f"{1e3 * PERIOD:g}",
    # Silence: ms, s.
    "silence": lambda: f"{AT_START['silence']}",
    "heartbeat": lambda: f"{1e3 * HEARTBEAT_EVERY:g}",
    "hung_after": lambda: f"{HUNG_AFTER:g}",
}
