"""What the rig's board is made of: its pins, its motor, its limits, and what stops it.

The one table of these: ``config.h``, ``pins.h`` and the tables of the firmware's README are made
from it by ``python -m softgrip.board.firmware.header``.
"""

from typing import NamedTuple

from softgrip.board.calibration import nominal
from softgrip.board.info import Scale
from softgrip.board.protocol import CHANNELS, SPEED_SCALE, SetUp
from softgrip.logs.schema import PAD_CHANNELS
from softgrip.simulator.parameters import PumpParameters
from softgrip.units import REV


class Pin(NamedTuple):
    """A pin of the Arduino MEGA 2560: the port's bit, the number on the board, what is wired."""

    bit: str
    number: int
    wire: str


class Constant(NamedTuple):
    """A number of the firmware: its type there, its value, words."""

    type: str
    value: int
    words: str


SET_UP, VALVE = SetUp.GRIPPER, False
"""Of a firmware that is compiled without saying so: the pad's has no pump; a valve vents."""
STEPS = 800
"""A revolution: 200 of the motor, of which the driver makes quarters."""

PINS = {
    "STEP": Pin(
        "PB5",  # the output OC1A of timer 1
        11,
        f"STEP (or PUL) of the stepper driver, which is set to {STEPS} steps a revolution; pulses "
        "of 50 µs, high active",
    ),
    "DIR": Pin("PB6", 12, "DIR of the stepper driver, high into the syringe"),
    "SWITCH": Pin(
        "PH5",
        8,
        "home switch to ground, **normally closed**, at the end where the plunger is drawn out: "
        "high at home or broken",
    ),
    "VENT_OUT": Pin("PH6", 9, "driver of the valve, if there is one"),
}
ANALOG = {
    "layer": "force layer of the pad, through its INA126",
    "pressure": "pressure sensor, 0.5 to 4.5 V, **with 100 kΩ to ground**, so that a broken wire "
    "reads 0 V",
    "flex_1": "flex sensor of finger 1 (left), through its amplifier, 0.5 to 4.5 V",
    "flex_2": "flex sensor of finger 2 (right), the same",
    "spare_1": "spare",
    "spare_2": "spare",
}
"""What is wired to the channels beside the pad's elements."""

HARD = {"pressure": 547, "position": 12000, "speed": 4000, "acceleration": 40000, "silence": 200}
"""Furthest limits that a host can set, in the board's units; 12 000 steps are 200 mL."""
LEAST = {"pressure": 110, "position": 0, "speed": 1, "acceleration": 100, "silence": 20}
AT_START = {"pressure": 399, "position": 9000, "speed": 4000, "acceleration": 40000, "silence": 200}
"""Limits after a reset; 9 000 steps are the stroke of a syringe of 60 mL."""

CONSTANTS = {
    "STEPS_PER_REVOLUTION": Constant("uint16_t", STEPS, "of the motor as its driver steps it"),
    "PRESSURE_LOW": Constant("uint16_t", 51, "count: below, the wire is broken or shorted"),
    "PRESSURE_HIGH": Constant("uint16_t", 972, "count: above, likewise"),
    "PRESSURE_RELEASE": Constant("uint16_t", 8, "counts below the limit, to push again"),
    # 4 mm of a closed 60 mL syringe make 6 counts.
    "STUCK_STEPS": Constant("int32_t", 400, "that must change the pressure by STUCK_COUNTS:"),
    "STUCK_COUNTS": Constant("uint16_t", 2, "else the sensor is stuck or its tube is off"),
    "HOMING_SPEED": Constant("int32_t", 400 * SPEED_SCALE, "400 step/s"),
    "LEAVING_STEPS": Constant("int32_t", 400, "to leave the switch when homing starts on it"),
    "SWITCH_STEPS": Constant("int32_t", 400, "from home, where it may still be pressed"),
}
SCALE = Scale(STEPS, PumpParameters(), nominal().pressure)
"""In which the limits are told: a lead of 8 mm, a sensor of 0 to 80 psi."""


def limits_in_words(limits: dict[str, int]) -> list[str]:
    """Return limits with their units.

    >>> limits_in_words(AT_START)
    ['200 kPa', '90 mm', '5 rev/s', '50 rev/s²', '200 ms']
    """
    one = SCALE.limits_in(limits)
    return [
        f"{one.pressure / 1e3:.0f} kPa",
        f"{one.travel * 1e3:.0f} mm",
        f"{one.speed / REV:.4g} rev/s",
        f"{one.acceleration / REV:.4g} rev/s²",
        f"{one.silence * 1e3:.0f} ms",
    ]


def _wiring() -> list[tuple[str, ...]]:
    elements = len(PAD_CHANNELS) - 1  # the first channels; wired alike: one line
    return [
        *((str(pin.number), pin.wire) for pin in PINS.values()),
        (
            f"A0 to A{elements - 1}",
            f"elements 1 to {elements} of the pad, through their amplifiers, 0 to 5 V",
        ),
        *((f"A{k}", ANALOG[CHANNELS[k]]) for k in range(elements, len(CHANNELS))),
    ]


def _limits() -> list[tuple[str, ...]]:
    what = (
        "gauge pressure, above which nothing is pushed",
        "travel of the plunger from home",
        "speed of the motor",
        "its acceleration",
        "silence of the host",
    )
    return [*zip(what, limits_in_words(AT_START), limits_in_words(HARD), strict=True)]


def _stops() -> list[tuple[str, ...]]:
    value = {name: one.value for name, one in CONSTANTS.items()}
    low, high = (f"{value[f'PRESSURE_{end}'] * 5 / 1023:.2f} V" for end in ("LOW", "HIGH"))
    return [
        ("emergency stop", "stops at once, latched", "CLEAR"),
        (
            f"no valid frame for {AT_START['silence']} ms",
            "stops at once",
            "the next frame; it moves at the next SETPOINT",
        ),
        (
            "pressure at its limit, two samples of 1 ms",
            "pushing stops at once; drawing back is allowed",
            f"{value['PRESSURE_RELEASE']} counts below the limit",
        ),
        (
            f"pressure below {low} or above {high}, two samples",
            "the same, latched",
            "CLEAR, once it is in range",
        ),
        (
            f"pressure within a count over {value['STUCK_STEPS']} steps of pushing",
            "the same, latched",
            "CLEAR",
        ),
        ("an end of the stroke", "never passed by a step, and braked for", "the other way"),
        ("not homed since the reset", "no pushing; drawing back stops at the switch", "HOME"),
        (
            f"switch pressed beyond {value['SWITCH_STEPS']} steps from home",
            "stops at once, latched, position no longer trusted",
            "CLEAR, HOME",
        ),
        (
            "the main program hangs",
            "no more than 12 steps, 3 ms at full speed; reset after 250 ms",
            "HELLO, HOME",
        ),
    ]


TABLES = {
    "Wiring": (("pin", "what"), _wiring()),
    "Limits": (("limit", "at the start", "furthest that can be set"), _limits()),
    "What stops the motor": (("cause", "what happens", "ends by"), _stops()),
}
"""Of the README, by the titles of its sections: a head, and rows."""
