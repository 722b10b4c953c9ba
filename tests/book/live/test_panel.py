"""The panel: its buttons, its picture, and what it is in a page without a kernel."""

import threading

import matplotlib as mpl
import matplotlib.pyplot as plt
import pytest

from book.live.experiments import experiments
from book.live.panel import ControlPanel, FinishedRun, control_panel
from book.live.plot import LivePlot
from softgrip.board.driver import Board
from softgrip.board.protocol import Flag
from softgrip.errors import InvalidInputError
from softgrip.logs.reader import read_log
from softgrip.provenance import data_folder
from softgrip.rig.connect import connect
from softgrip.rig.live import Sample
from softgrip.units import DEG, REV
from tests.rig.test_live import SOON, until


@pytest.fixture
def panel(tmp_path):
    with connect("simulated") as rig:
        made = control_panel(rig, tmp_path)
        yield made
        made.close()


def begin(panel):
    panel.start.click()
    assert panel.run is not None, panel.words.value
    until(lambda: len(panel.run.samples) > 8 or not panel.run.is_alive())
    assert panel.run.is_alive(), panel.run.error


def over(panel):
    panel.run.join(SOON)
    assert not panel.run.is_alive(), panel.words.value
    until(lambda: not panel.start.disabled)


def test_nothing_moves_before_a_click(panel, tmp_path):
    assert isinstance(panel, ControlPanel)
    assert not [one for one in threading.enumerate() if one.name == "softgrip run"]
    assert panel.run is None
    assert panel.rig.rig.time == 0
    assert [*tmp_path.iterdir()] == []
    assert "nothing moves before a click" in panel.words.value


def test_stop_clear_and_start_again(panel):
    begin(panel)
    assert panel.clear.disabled
    assert not panel.stop.disabled
    panel.start.click()  # a second run at once is not begun
    first = panel.run
    panel.stop.click()
    over(panel)
    assert panel.run is first
    assert "stopped: simulated rig: refused: emergency stop" in panel.words.value
    assert panel.logs == {"step": [], "staircase": []}  # it was not finished
    panel.clear.click()
    assert panel.words.value == '<div role="status">cleared</div>'
    panel.start.click()
    assert panel.run is not first
    assert panel.run.is_alive()
    panel.stop.click()
    over(panel)


def test_two_panels_of_one_rig_do_not_drive_it_both(panel, tmp_path):
    other = ControlPanel(panel.rig, tmp_path / "other")
    begin(panel)
    other.start.click()
    assert "no other run" in other.words.value
    assert other.run is None
    assert not other.start.disabled
    panel.stop.click()
    over(panel)


def test_the_stop_works_without_a_run(panel):
    panel.stop.click()
    assert "clear the stop" in panel.words.value
    panel.start.click()
    over(panel)
    assert "refused: emergency stop" in panel.words.value


def test_a_finished_run_leaves_its_log_and_picture(tmp_path):
    before, open_figures = dict(mpl.rcParams), plt.get_fignums()
    with connect("simulated") as rig:
        panel = control_panel(rig, tmp_path, real_time=False)
        panel.experiment.value = "staircase"
        panel.start.click()
        over(panel)
        (path,) = panel.logs["staircase"]
        assert read_log(path)["time"].size == 624
        assert f"done; log: {path}" in panel.words.value
        assert 'src="data:image/png' in panel.picture.value
        assert 'alt="The staircase on the simulated rig to 15.6 s' in panel.picture.value
    assert dict(mpl.rcParams) == before
    assert plt.get_fignums() == open_figures


def test_the_button_stops_a_board(pty_board, tmp_path):
    port, board = pty_board
    panel = ControlPanel(Board(port, emulated=True), tmp_path, rest=0.0)
    begin(panel)
    panel.stop.click()
    assert board.flags & Flag.ESTOPPED
    assert board.speed == 0
    over(panel)
    assert "refused: estopped" in panel.words.value
    panel.close()


def test_to_close_ends_a_run_for_good(pty_board, tmp_path):
    port, board = pty_board
    panel = ControlPanel(Board(port, emulated=True), tmp_path, rest=0.0)
    begin(panel)
    panel.close()
    assert not panel.run.is_alive()
    # Nobody opens the line again: it would be tried five times a second, and the heart would beat.
    until(lambda: board.now() > board.heard + 1.0)
    assert board.speed == 0


def test_the_book_shows_a_finished_simulated_run(tmp_path, monkeypatch):
    monkeypatch.setenv("SOFTGRIP_BOOK", "static")
    with connect("simulated") as rig:
        panel = control_panel(rig, tmp_path)
    assert isinstance(panel, FinishedRun)
    assert not panel.run._paced  # a build does not wait for a clock
    shown = panel._repr_mimebundle_()["text/html"]
    assert "no kernel" in shown
    assert "<b>simulated</b>" in shown
    assert 'alt="The staircase' in shown
    with connect("simulated") as rig:  # the same, to the bit, whenever it is built
        again = control_panel(rig)
    assert again._repr_mimebundle_()["text/html"] == shown
    assert panel.logs["staircase"] == [tmp_path / "staircase.csv"]


def test_the_book_moves_no_board(stub, tmp_path, monkeypatch):
    monkeypatch.setenv("SOFTGRIP_BOOK", "static")
    replay = connect(f"replay:{data_folder() / 'simulated' / 'staircase.csv'}")
    with Board(stub) as board:
        for rig in (board, replay):
            with pytest.raises(InvalidInputError, match="expected the simulated rig"):
                control_panel(rig, tmp_path)
        assert "home" not in stub.received
        assert "setpoint" not in stub.received


def test_a_rig_with_another_period_has_no_panel(tmp_path):
    with connect("simulated:gripper") as rig, pytest.raises(InvalidInputError, match="period"):
        control_panel(rig, tmp_path)


def test_the_plot_shows_the_samples():
    plot = LivePlot(experiments()["step"], 2, "emulated board")
    samples = [Sample(0.025, REV, 1e3, (DEG, 2 * DEG)), Sample(0.05, -REV, 40e3, (3 * DEG, 0.0))]
    plot.update([])
    empty = plot.png()
    plot.update(samples)
    angle, pressure, motor = plot.figure.axes
    drawn = {line.get_label(): line.get_ydata() for line in angle.lines}
    assert drawn["finger 1"] == pytest.approx([1.0, 3.0])
    assert drawn["finger 2"] == pytest.approx([2.0, 0.0])
    assert pressure.lines[0].get_ydata() == pytest.approx([1.0, 40.0])
    assert pressure.get_ylim()[1] > 40
    assert motor.lines[0].get_ydata() == pytest.approx([1.0, -1.0])
    assert plot.png() != empty
    assert "emulated board to 0.1 s" in plot.alt(samples)
