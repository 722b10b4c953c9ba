"""Tables of what the firmware's own files say: pins, limits, and what stops the motor."""

import re
from pathlib import Path

import pandas as pd

from softgrip.board.calibration import nominal
from softgrip.board.firmware.header import SKETCH
from softgrip.board.info import Limits, Scale
from softgrip.board.protocol import CHANNELS, LIMITS
from softgrip.errors import DataFileError
from softgrip.logs.schema import PAD_CHANNELS
from softgrip.simulator.parameters import PumpParameters
from softgrip.units import REV

README = SKETCH.parent / "README.md"

PIN = re.compile(r"^const uint8_t (\w+) = _BV\((P[A-L]\d)\);\s*// (\d+)", re.MULTILINE)
WIRES = {
    "STEP": "STEP (or PUL) of the stepper driver",
    "DIR": "DIR of the stepper driver, high into the syringe",
    "SWITCH": "home switch to ground, normally closed",
    "VENT_OUT": "driver of the valve, if there is one",
}
"""What is wired to the pins of ``pins.h``, by their names there."""
ANALOG = {
    "pressure": "pressure sensor, 0.5 to 4.5 V, with 100 kΩ to ground",
    "flex_1": "flex sensor of finger 1 (left), through its amplifier, 0.5 to 4.5 V",
    "flex_2": "flex sensor of finger 2 (right), the same",
    "spare_1": "spare",
    "spare_2": "spare",
    "layer": "force layer of the pad, through its INA126",
}


def pins(path: Path = SKETCH / "pins.h") -> dict[str, tuple[str, int]]:
    """Return the pins of a header by name: the port's bit and the number on the board.

    Raises
    ------
    DataFileError
        If its names are not those that are known here.

    Examples
    --------
    >>> pins()["STEP"]
    ('PB5', 11)
    """
    found = {name: (bit, int(pin)) for name, bit, pin in PIN.findall(path.read_text())}
    if found.keys() != WIRES.keys():
        raise DataFileError(path, expected=f"the pins {', '.join(WIRES)}", got=", ".join(found))
    return found


def wiring_table() -> pd.DataFrame:
    """Tabulate what goes to which pin of the board."""
    rows = [
        {"pin": f"A{k}", "what": ANALOG.get(channel, channel.replace("_", " ") + " of the pad")}
        for k, channel in enumerate(CHANNELS)
    ]
    # The elements are wired alike: one line.
    first, *_, last = (k for k, name in enumerate(CHANNELS) if name in PAD_CHANNELS[:-1])
    elements = {
        "pin": f"A{first} to A{last}",
        "what": f"elements 1 to {last - first + 1} of the pad, through their amplifiers",
    }
    digital = [{"pin": str(pin), "what": WIRES[name]} for name, (_, pin) in pins().items()]
    return pd.DataFrame([*digital, elements, *rows[last + 1 :]])


def _without_comments(text: str) -> str:
    return re.sub(r"//[^\n]*", "", text)


def _one(pattern: str, path: Path) -> str:
    found = re.findall(pattern, _without_comments(path.read_text()))
    if len(found) != 1:
        raise DataFileError(path, expected=f"one {pattern}", got=str(len(found)))
    return str(found[0])


def constant(name: str, path: Path = SKETCH / "config.h") -> int:
    """Return a whole number of the firmware's configuration.

    Raises
    ------
    DataFileError
        If it is not there, or not once.

    Examples
    --------
    >>> constant("STEPS_PER_REVOLUTION")
    800
    """
    return int(_one(rf"const \w+ {name} = (-?\d+)L?;", path))


def board_limits(name: str, path: Path = SKETCH / "config.h") -> dict[str, int]:
    """Return a set of limits of the firmware's configuration in the board's units.

    Parameters
    ----------
    name
        HARD, LEAST or AT_START.
    path
        Of the configuration.

    Raises
    ------
    DataFileError
        If it is not there, or does not have a number for each limit.

    Examples
    --------
    >>> board_limits("HARD")["silence"]
    200
    """
    cells = [cell.strip() for cell in _one(rf"SetLimits {name} = {{([^}}]*)}}", path).split(",")]
    numbers = [int(cell) for cell in cells if cell]
    if len(numbers) != len(LIMITS):
        raise DataFileError(path, expected=f"{len(LIMITS)} numbers in {name}", got=str(numbers))
    return {field.name: number for field, number in zip(LIMITS, numbers, strict=True)}


def limits(name: str) -> Limits:
    """Return a set of limits of the firmware's configuration in SI units."""
    scale = Scale(constant("STEPS_PER_REVOLUTION"), PumpParameters(), nominal().pressure)
    return scale.limits_in({**board_limits(name)})


def _row(one: Limits) -> list[str]:
    return [
        f"{one.pressure / 1e3:.0f} kPa",
        f"{one.travel * 1e3:.0f} mm",
        f"{one.speed / REV:.4g} rev/s",
        f"{one.acceleration / REV:.4g} rev/s²",
        f"{one.silence * 1e3:.0f} ms",
    ]


def limits_table() -> pd.DataFrame:
    """Tabulate the limits at the start and the bounds that no host can pass."""
    return pd.DataFrame(
        {
            "limit": [
                "gauge pressure, above which nothing is pushed",
                "travel of the plunger from home",
                "speed of the motor",
                "its acceleration",
                "silence of the host",
            ],
            "at the start": _row(limits("AT_START")),
            "furthest that can be set": _row(limits("HARD")),
        }
    )


def readme_section(title: str, path: Path = README) -> str:
    """Return a section of the firmware's description, without its title, as Markdown.

    Raises
    ------
    DataFileError
        If there is no such section.
    """
    found = re.search(rf"^## {re.escape(title)}\n(.*?)(?=^## |\Z)", path.read_text(), re.M | re.S)
    if found is None:
        raise DataFileError(path, expected=f"a section {title!r}", got="none")
    return found[1].strip()
