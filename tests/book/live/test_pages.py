"""The pages of the rig: that they open no port, and say what firmware and protocol say."""

import re
from pathlib import Path

import jupytext
import pytest
import serial

from book.companion.show import show
from book.live import protocol as rig_protocol
from book.live.acceptance import bands_table
from book.live.emulated import emulated_table, measured_firmware
from book.live.panel import ControlPanel, FinishedRun
from softgrip.board.firmware.config import TABLES
from softgrip.board.firmware.header import markdown
from softgrip.board.framing import Frame, encode
from softgrip.board.protocol import MESSAGES, Flag
from softgrip.logs.reader import read_log
from softgrip.provenance import data_folder
from softgrip.rig.acceptance import judge
from tests.logs.test_gaps import rewrite

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
def test_a_page_runs_and_opens_no_port(root, page, mode, monkeypatch, tmp_path, tmp_path_factory):
    monkeypatch.setenv("SOFTGRIP_BOOK", mode)
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path_factory.mktemp("ipython")))  # of any kernel
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


def test_the_pages_show_the_firmwares_own_tables(root):
    shown = {"commissioning": ["Wiring"], "protocol": ["Limits", "What stops the motor"]}
    for page, titles in shown.items():
        text = "\n".join(cells(root, page))
        for title in titles:
            assert f'readme_section("{title}")' in text
            assert markdown(*TABLES[title]) in rig_protocol.readme_section(title).text


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
    for part in ("message_table()", "all_fields()", "reason_table(Reason)"):
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
    assert {*table["experiment"]} == {"pid, simulated", "gripper, simulated"}


def test_a_log_that_swings_to_its_end_never_settles(path):
    def swings(rows):
        at = list(read_log(KEPT / "pid-full.csv").columns).index("angle")
        return [[*row[:at], str(1 + k % 2), *row[at + 1 :]] for k, row in enumerate(rows)]

    table = bands_table({"pid": rewrite(path, KEPT / "pid-full.csv", swings)})
    (found,) = table["found"][table["quantity"].str.contains("settled")]
    assert found == "never"


def test_the_simulated_rig_fails_by_settling_late_alone():
    """It is fitted to the printed times within bands of its own."""
    logs = {"lqr": "lqr-fast", "pid": "pid-full", "gripper": "gripper-fast-1"}
    bands = [band for name, log in logs.items() for band in judge(KEPT / f"{log}.csv", name)]
    assert {band.passed: "settled" in band.quantity for band in bands} == {True: False, False: True}
    assert all(band.found > band.high for band in bands if not band.passed)


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
