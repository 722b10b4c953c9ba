"""The pad recorded, by the real firmware, emulated, and simulated, up to what touched it."""

import numpy as np
import pytest

from book.twin.pad_tests import felt as felt_by
from softgrip.board.driver import Board
from softgrip.board.emulated.board import EmulatedBoard
from softgrip.board.emulated.link import EmulatedLink
from softgrip.board.protocol import TELEMETRY_PERIOD, SetUp
from softgrip.errors import InvalidInputError
from softgrip.logs.contacts import read_contacts, read_weights
from softgrip.logs.reader import read_log
from softgrip.logs.schema import PAD_CHANNELS
from softgrip.rig.check import check
from softgrip.rig.connect import connect
from softgrip.rig.record_pad import calibration_steps, record_pad, weight_steps
from softgrip.rig.simulated_pad import SimulatedPad
from softgrip.simulator.chance import SEED
from softgrip.simulator.pad import make_pad, press, responses_to
from softgrip.simulator.pad_hand import PadHand
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_tests import PAD_TESTS
from softgrip.tactile.contact_pose import angle_between
from softgrip.tactile.estimate import estimate, kind_readings
from softgrip.tactile.pad_model import ForceSettings, KindSettings, PadModel
from softgrip.units import DEG, MM
from tests.board.emulated import needs_emulator

COUNTS = [512 + 20 * k for k in range(len(PAD_CHANNELS))]


@pytest.fixture(autouse=True)
def example_pad(monkeypatch):
    """Press a pad whose parameters hang on no fit, and whose changes repeat within 3 %."""
    monkeypatch.setattr("softgrip.simulator.pad_hand.fitted_pad", PadParameters)


@pytest.fixture
def board():
    board = EmulatedBoard(SetUp.PAD)
    for channel, count in enumerate(COUNTS):
        board.set_count(channel, count)
    return board


@needs_emulator
def test_log_holds_the_nine_channels_at_40_hz(board, tmp_path):
    path = tmp_path / "pad.csv"
    with Board(EmulatedLink(board), emulated=True) as rig:
        made = record_pad(rig, 1.0, path, shows="nothing")
        with pytest.raises(InvalidInputError, match="does not exist"):
            record_pad(rig, 1.0, path)
    log = read_log(path)
    assert (log.header.set_up, str(log.header.provenance)) == ("pad", "simulated")
    assert made.samples == log["time"].size == 41
    assert np.diff(log["time"]) == pytest.approx(0.025, abs=1e-6)
    for name, count in zip(PAD_CHANNELS, COUNTS, strict=True):
        assert set(log[f"{name}_counts"]) == {count}
        assert log[name] == pytest.approx(count * 5 / 1024)
    assert not log.repairs


@needs_emulator
def test_check_looks_at_the_pad_and_finds_a_dead_channel(board):
    board.set_count(3, 0)
    with Board(EmulatedLink(board), emulated=True) as rig:
        found = {one.what: one for one in check(rig)}
    assert found["telemetry"].good
    assert {name for name in PAD_CHANNELS if not found[name].good} == {"element_4"}


def test_a_rig_without_a_pad_is_refused_before_anything_is_said(path):
    with connect("simulated") as finger:
        with pytest.raises(InvalidInputError, match="a Board or a SimulatedPad, got <softgrip"):
            record_pad(finger, STEPS, path, say=pytest.fail)
        assert not path.exists()


SECONDS = 1.2
"""Of a step: the hand presses fully from 0.6 s on. Emulated seconds are long."""
STEPS = [
    *calibration_steps(SECONDS),
    *weight_steps([5, 10, 20, 30], SECONDS),
    ("contact: rod 20 mm", SECONDS),
    ("contact: egg", SECONDS),
]


def simulated(path):
    """Record `STEPS` with the simulated pad; return the hand, which knows what it did."""
    pad = SimulatedPad()
    record_pad(pad, STEPS, path, say=pad.obey)
    return pad.hand


def emulated(board, path):
    """Record them with a hand before an emulated board, whose channels have the pad's voltages."""
    hand, now = PadHand(), [0.0]

    def feel(row, _):
        now[0] = row["time"] + TELEMETRY_PERIOD
        for channel, count in enumerate(hand.counts(now[0])):
            board.set_count(channel, int(count))

    with Board(EmulatedLink(board), emulated=True) as rig:
        record_pad(rig, STEPS, path, say=lambda words: hand.obey(words, now[0]), progress=feel)
    return hand


@needs_emulator
def test_log_of_the_emulated_board_leads_to_kind_place_angle_and_force(board, tmp_path):
    assert_log_leads_to_what_was_done(emulated(board, tmp_path / "mine.csv"), tmp_path)


def test_log_of_the_simulated_pad_leads_to_kind_place_angle_and_force(tmp_path):
    assert_log_leads_to_what_was_done(simulated(tmp_path / "mine.csv"), tmp_path)


def assert_log_leads_to_what_was_done(hand, tmp_path):
    """Go the way of the pages: read, fit, estimate; the truth is what the hand did."""
    assert str(read_log(tmp_path / "mine.csv").header.provenance) == "simulated"
    contacts = read_contacts(tmp_path / "mine.csv")
    assert len(contacts) == len(hand.presses) == 2
    assert contacts.objects.tolist() == [done.item.name for done in hand.presses]
    known = felt_by(PAD_TESTS["pad-training"], PadParameters())
    kind = PadModel(KindSettings()).fit(kind_readings(known))
    force = PadModel(ForceSettings()).fit(read_weights(tmp_path / "mine.csv"))
    told = estimate(contacts, kind, force)
    pad = make_pad(hand.parameters, SEED)
    for k, done in enumerate(hand.presses):
        felt = responses_to(pad, press(pad, done.item, done.pose, done.force))
        # Repeatability is 3 % of a change, now and at the calibration: three deviations of both.
        np.testing.assert_allclose(contacts.responses[k], felt, rtol=3 * 0.03 * 2**0.5, atol=0.02)
        assert told.kinds[k] == kind.predict(felt[None])[0]
        away = told.places[k] - done.pose.place
        if done.item.kind == "line":
            # Half the pitch of the elements; the estimate of the angle jumps with the elements.
            away = away @ (-np.sin(done.pose.angle), np.cos(done.pose.angle))
            assert angle_between(told.angles[k], done.pose.angle) < 30 * DEG
        assert np.linalg.norm(away) < 5.5 * MM
        # Half the largest step between the weights, 10 gf.
        assert told.forces[k] == pytest.approx(done.force, abs=0.05)


def test_steps_are_said_as_they_begin_and_stand_in_the_log(tmp_path):
    pad, said = SimulatedPad(), []
    steps = [("rest", 1.0), ("point, or so: egg", 0.5), ("weight: 5 gf", 0.5)]
    made = record_pad(pad, steps, tmp_path / "pad.csv", shows="three steps", say=said.append)
    log = read_log(tmp_path / "pad.csv")
    assert said == [words for words, _ in steps]
    assert [words.replace(";", ",") for _, words in log.events] == said
    assert [time for time, _ in log.events] == pytest.approx([0.0, 1.025, 1.525])
    assert made.samples == len(log["time"]) == 81
    assert log.header.notes["shows"] == "three steps"


def test_minute_without_words_takes_them_as_labels(tmp_path):
    pad = SimulatedPad()
    record_pad(pad, 2.0, tmp_path / "pad.csv", say=pad.obey)
    assert not read_log(tmp_path / "pad.csv").events
    with pytest.raises(InvalidInputError, match="duration"):
        record_pad(pad, [("rest", 0.0)], tmp_path / "other.csv")
