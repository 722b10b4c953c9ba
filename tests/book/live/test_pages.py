"""The pages of the rig: that they open no port, and say what firmware and protocol say."""

import re
from pathlib import Path

import jupytext
import pytest
import serial

from book.companion.show import show
from book.live import firmware as rig_firmware
from book.live import protocol as rig_protocol
from book.live.acceptance import bands_table
from book.live.emulated import emulated_table, measured_firmware
from book.live.finished import FinishedRun
from book.live.panel import ControlPanel
from softgrip.board.driver import HUNG_AFTER
from softgrip.board.emulated.build import CORE
from softgrip.board.framing import Frame, encode
from softgrip.board.protocol import CHANNELS, MESSAGES, Flag
from softgrip.board.session import HEARTBEAT_EVERY
from softgrip.errors import DataFileError
from softgrip.provenance import data_folder
from softgrip.rig.acceptance import judge
from tests.board.emulated import needs_emulator

PAGES = ("rig", "commissioning", "protocol")
KEPT = data_folder() / "simulated"


@pytest.fixture
def no_port(monkeypatch):
    """Make whatever would open or list a port fail."""

    def refuse(*_args, **_options):
        raise AssertionError("a page wants a port")

    monkeypatch.setattr(serial, "serial_for_url", refuse)
    monkeypatch.setattr(serial.Serial, "open", refuse)
    monkeypatch.setattr("serial.tools.list_ports.comports", refuse)
    monkeypatch.setattr("softgrip.rig.connect.Board", refuse)


def cells(root, page):
    read = jupytext.read(root / "book" / f"{page}.md")
    return [cell.source for cell in read.cells if cell.cell_type == "code"]


@pytest.mark.parametrize("mode", ["static", "live"])
@pytest.mark.parametrize("page", PAGES)
@pytest.mark.usefixtures("no_port")
def test_a_page_runs_and_opens_no_port(root, page, mode, monkeypatch, tmp_path):
    monkeypatch.setenv("SOFTGRIP_BOOK", mode)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path))
    names = {}
    for source in cells(root, page):
        exec(compile(source, page, "exec"), names)  # the pages are ours
    if page == "rig":
        panel = names["panel"]
        assert isinstance(panel, FinishedRun if mode == "static" else ControlPanel)
        if mode == "live":
            assert panel.run is None
            assert names["rig"].rig.truth.plunger == 0
            assert names["logs"] == []
    assert [*tmp_path.iterdir()] == []


def test_pages_connect_to_simulated_rigs_only(root):
    found = []
    for page in PAGES:
        text = "\n".join(cells(root, page))
        found += re.findall(r"connect\(([^)]*)\)", text)
        assert not re.search(r"\bRig\(|SerialLink|find_board|candidates", text)
    assert found
    assert all(one.startswith('"simulated"') for one in found)


# Wiring.


def test_pins_are_those_of_the_board():
    variant = CORE / "variants" / "mega" / "pins_arduino.h"
    if not variant.is_file():
        pytest.skip("needs Debian's arduino-core-avr")
    # The core's own table of ports, in the order of the board's pins: "// PB 5 ** 11 ** PWM11".
    told = re.findall(r"// P([A-L]) (\d) \*\* (\d+) \*\*", variant.read_text())
    known = {f"P{port}{bit}": int(pin) for port, bit, pin in told}
    pins = rig_firmware.pins()
    assert len(pins) == 4
    for name, (bit, pin) in pins.items():
        assert known[bit] == pin, name


def test_the_wiring_table_has_each_wire_once():
    table = rig_firmware.wiring_table()
    what = dict(zip(table["pin"], table["what"], strict=True))
    assert len(what) == len(table)
    assert "STEP" in what["11"]
    assert "DIR" in what["12"]
    assert "switch" in what["8"]
    assert "valve" in what["9"]
    assert "pressure" in what[f"A{CHANNELS.index('pressure')}"]
    assert "finger 2" in what[f"A{CHANNELS.index('flex_2')}"]
    assert "force layer" in what[f"A{CHANNELS.index('layer')}"]
    assert what["A0 to A7"].startswith("elements 1 to 8")


def test_the_wiring_table_is_that_of_the_firmware_and_the_page_shows_it(root):
    readme = rig_firmware.readme_section("Wiring")
    told = re.findall(r"^\| (\d+) \| (\w+)", readme, re.MULTILINE)
    names = {"STEP": "STEP", "DIR": "DIR", "home": "SWITCH", "valve": "VENT_OUT"}
    found = {name: pin for name, (_, pin) in rig_firmware.pins().items()}
    assert {names[word]: int(pin) for pin, word in told} == found
    assert "wiring_table()" in "\n".join(cells(root, "commissioning"))


def test_other_pins_are_refused(tmp_path):
    other = tmp_path / "pins.h"
    other.write_text("const uint8_t STEP = _BV(PB5);    // 11, OC1A\n")
    with pytest.raises(DataFileError, match="STEP, DIR, SWITCH, VENT_OUT"):
        rig_firmware.pins(other)


# Limits.


@needs_emulator
def test_limits_of_the_page_are_those_that_the_firmware_tells():
    from softgrip.board.emulated.link import emulated_finger

    with emulated_finger() as rig:
        assert rig.info.limits == rig_firmware.limits("AT_START")
        assert rig.info.bounds == rig_firmware.limits("HARD")
        assert rig.scale.steps == rig_firmware.constant("STEPS_PER_REVOLUTION")


def test_the_live_page_tells_the_boards_silence(root):
    text = (root / "book" / "rig.md").read_text()
    assert re.findall(r"(\d+) ms stops the motor", text) == ["200"]
    assert rig_firmware.board_limits("AT_START")["silence"] == 200


def test_the_protocol_page_tells_the_drivers_times(root):
    text = (root / "book" / "protocol.md").read_text()
    assert (HEARTBEAT_EVERY, HUNG_AFTER) == (0.05, 0.5)
    assert "something each 50 ms" in text
    assert "half a second after the program asked" in text


def test_limits_in_units():
    table = rig_firmware.limits_table()
    # 399 counts: 102.3 are 0 psi and 818.4 more are 80 psi, 551.58 kPa; 9000 steps of 0.01 mm.
    assert [*table["at the start"]] == ["200 kPa", "90 mm", "5 rev/s", "50 rev/s²", "200 ms"]
    assert [*table["furthest that can be set"]][:2] == ["300 kPa", "120 mm"]


def test_what_stops_the_motor_has_the_numbers_of_the_configuration():
    section = rig_firmware.readme_section("What stops the motor")
    start = rig_firmware.board_limits("AT_START")
    assert f"no valid frame for {start['silence']} ms" in section
    assert f"over {rig_firmware.constant('STUCK_STEPS')} steps" in section
    assert f"beyond {rig_firmware.constant('SWITCH_STEPS')} steps" in section
    assert f"{rig_firmware.constant('PRESSURE_RELEASE')} counts below" in section
    for name, volts in (("PRESSURE_LOW", "0.25"), ("PRESSURE_HIGH", "4.75")):
        assert f"{rig_firmware.constant(name) * 5 / 1024:.2f}" == volts
        assert f"{volts} V" in section


def test_a_configuration_that_cannot_be_read_is_refused(tmp_path):
    config = tmp_path / "config.h"
    config.write_text("const SetLimits HARD = {1, 2,  // three are missing\n};\n")
    with pytest.raises(DataFileError, match="5 numbers in HARD"):
        rig_firmware.board_limits("HARD", config)
    with pytest.raises(DataFileError, match="STEPS"):
        rig_firmware.constant("STEPS", config)
    with pytest.raises(DataFileError, match="'Colours'"):
        rig_firmware.readme_section("Colours")


# Protocol.


def test_the_messages_have_their_lengths():
    table = rig_protocol.message_table()
    assert len(table) == len(MESSAGES)
    for message, (_, row) in zip(MESSAGES, table.iterrows(), strict=True):
        size = len(encode(Frame(message.id, 1, bytes(message.layout.size))))
        assert row["frame (bytes)"] == size, message.name
        assert (row["from"] == "host") == (message.id < 128)


@pytest.mark.parametrize("message", [one for one in MESSAGES if one.fields], ids=lambda m: m.name)
def test_fields_lie_where_the_table_says(message):
    # Each field set by itself to its largest value: the first byte that changes is its own.
    table = rig_protocol.field_table(message)
    nothing = {one.name: 0 if one.count == 1 else (0,) * one.count for one in message.fields}
    for field, (_, row) in zip(message.fields, table.iterrows(), strict=True):
        one = 1 if field.count == 1 else (1,) * field.count
        packed = message.pack(**{**nothing, field.name: one})
        assert packed.index(1) == row["byte"]
        assert row["field"] == f"`{field.name}`"


def test_all_messages_flags_and_reasons_are_shown(root):
    text = rig_protocol.all_fields().text
    assert all(f"`{one.name.upper()}`" in text for one in MESSAGES if one.fields)
    bits = rig_protocol.bit_table(Flag)
    assert [1 << bit for bit in bits["bit"]] == [int(flag) for flag in Flag]
    shown = "\n".join(cells(root, "protocol"))
    for part in ("message_table()", "all_fields()", "limits_table()", "reason_table(Reason)"):
        assert part in shown


def test_the_line_is_counted():
    value = dict(zip(*rig_protocol.line_table().T.to_numpy(), strict=True))
    # 45 bytes of payload and 6 of frame, ten bits a byte, 40 a second.
    assert value["a telemetry frame takes"] == "51 bytes, 2.0 ms"
    assert value["telemetry takes of the line"] == f"{51 * 10 * 40 / 250_000:.0%}"


# What was measured, and what is judged.


def test_the_emulated_board_did_what_was_wanted():
    found = emulated_table().set_index("what")
    assert float(found.loc["telemetry", "value"]) == pytest.approx(40, abs=0.05)
    assert "; 0 frames lost" in found.loc["telemetry", "how"]
    assert float(found.loc["command to acknowledge, p99", "value"]) < 5
    assert float(found.loc["emergency stop to last step, slowest", "value"]) < 1
    assert re.match(r"build [0-9a-f]{8}[,;] ", measured_firmware())


def test_the_table_of_bands_is_the_judgement():
    logs = {"pid": KEPT / "pid-full.csv", "gripper": KEPT / "gripper-fast-1.csv"}
    table = bands_table(logs)
    bands = [band for name, path in logs.items() for band in judge(path, name)]
    assert (table["verdict"] == "pass").tolist() == [band.passed for band in bands]
    assert "never" in [*table["found"]]
    assert {*table["experiment"]} == {"pid, simulated", "gripper, simulated"}


def test_a_chapters_figure_from_a_log_leaves_that_of_the_book_alone(tmp_path, monkeypatch):
    monkeypatch.setenv("SOFTGRIP_BOOK", "static")
    monkeypatch.chdir(tmp_path)
    own = Path(tmp_path / "own.csv")
    own.write_bytes((KEPT / "staircase.csv").read_bytes())
    shown = show("Figure 4.7", logs=[own], numbered=False)._repr_mimebundle_()["text/html"]
    assert "As Figure 4.7" in shown
    assert "own.csv" in shown
    assert "<b>simulated</b>" in shown
    assert [*tmp_path.iterdir()] == [own]
