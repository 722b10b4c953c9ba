"""What of the firmware is made from tables: that it is up to date, and says what is so."""

import re

import pytest

from softgrip.board.emulated.build import CORE
from softgrip.board.emulated.link import emulated_finger
from softgrip.board.firmware.config import AT_START, HARD, PINS, SCALE, STEPS, TABLES
from softgrip.board.firmware.header import MADE
from softgrip.board.protocol import CHANNELS, LIMITS
from tests.board.emulated import needs_emulator


@pytest.mark.parametrize("path", MADE, ids=lambda path: path.name)
def test_what_is_made_is_up_to_date(path):
    # Else run: python -m softgrip.board.firmware.header
    assert path.read_text(encoding="utf-8") == MADE[path]()


def test_pins_are_those_of_the_board():
    variant = CORE / "variants" / "mega" / "pins_arduino.h"
    if not variant.is_file():
        pytest.skip("needs Debian's arduino-core-avr")
    # The core's own table of ports, in the order of the board's pins: "// PB 5 ** 11 ** PWM11".
    told = re.findall(r"// P([A-L]) (\d) \*\* (\d+) \*\*", variant.read_text())
    known = {f"P{port}{bit}": int(pin) for port, bit, pin in told}
    assert len(PINS) == 4
    for name, pin in PINS.items():
        assert known[pin.bit] == pin.number, name


def test_the_wiring_has_each_wire_once():
    rows = TABLES["Wiring"][1]
    what = dict(rows)
    assert len(what) == len(rows)
    assert "STEP" in what["11"]
    assert "DIR" in what["12"]
    assert "switch" in what["8"]
    assert "valve" in what["9"]
    assert "pressure" in what[f"A{CHANNELS.index('pressure')}"]
    assert "finger 2" in what[f"A{CHANNELS.index('flex_2')}"]
    assert "force layer" in what[f"A{CHANNELS.index('layer')}"]
    assert what["A0 to A7"].startswith("elements 1 to 8")


def test_limits_have_a_number_for_each_and_are_told_in_units():
    assert {*AT_START} == {*HARD} == {one.name for one in LIMITS}
    # 399 counts: 102.3 are 0 psi and 818.4 more are 80 psi, 551.58 kPa; 9000 steps of 0.01 mm.
    _, start, hard = zip(*TABLES["Limits"][1], strict=True)
    assert start == ("200 kPa", "90 mm", "5 rev/s", "50 rev/s²", "200 ms")
    assert hard[:2] == ("300 kPa", "120 mm")


@needs_emulator
def test_the_limits_are_those_that_the_firmware_tells():
    with emulated_finger() as rig:
        assert rig.info.limits == SCALE.limits_in(AT_START)
        assert rig.info.bounds == SCALE.limits_in(HARD)
        assert rig.scale.steps == STEPS


def test_what_stops_the_motor_is_told_with_its_numbers():
    # By hand: 51 and 972 of 1023 counts of 5 V.
    causes = " ".join(" ".join(row) for row in TABLES["What stops the motor"][1])
    for words in (
        *("no valid frame for 200 ms", "8 counts below", "below 0.25 V or above 4.75 V"),
        *("over 400 steps", "beyond 400 steps"),
    ):
        assert words in causes
