"""The simulated logs that the package brings."""

import numpy as np
import pytest

from book.chapter_3.logs import LOGS as REGULATED
from book.chapter_4.logs import CONTROLLED, PUSHES
from book.chapter_5.logs import STEPS
from book.companion.simulated_logs import COMMAND, main, make
from softgrip.errors import UnknownNameError
from softgrip.logs.reader import read_log
from softgrip.provenance import Provenance, data_file
from softgrip.simulator.pad_tests import PAD_TESTS
from softgrip.simulator.parameters import SensorParameters
from softgrip.simulator.sensors import from_counts
from softgrip.units import ML, MPa

NAMES = [*PUSHES, *STEPS]


@pytest.mark.parametrize("name", [*NAMES, *CONTROLLED, *REGULATED, *PAD_TESTS])
def test_log_is_made_again_bit_for_bit(name, tmp_path):
    kept = data_file(f"simulated/{name}.csv")
    assert make(name, tmp_path).read_bytes() == kept.path.read_bytes()
    assert (kept.provenance, kept.source) == (Provenance.SIMULATED, f"{COMMAND} {name}")
    assert kept.path.stat().st_size < 150_000


@pytest.mark.parametrize("name", NAMES)
def test_log_reads_clean_and_its_counts_give_its_values(name):
    log = read_log(data_file(f"simulated/{name}.csv").path)
    assert log.repairs == ()
    np.testing.assert_allclose(np.diff(log["time"]), log.header.period, rtol=1e-9)
    sensors = SensorParameters()
    np.testing.assert_array_equal(
        from_counts(log["pressure_counts"].astype(int), sensors.pressure_range, sensors),
        log["pressure"],
    )


@pytest.mark.parametrize("name", [n for n in NAMES if n.startswith("push")])
def test_push_ends_at_its_pressure_or_stroke(name):
    log = read_log(data_file(f"simulated/{name}.csv").path)
    words = log.events[-1][1]
    assert words in ("pressure reached", "end of stroke")
    # Noise, rounding and lag of the sensor: a few kPa.
    if words == "pressure reached":
        assert log["pressure"][-1] == pytest.approx(0.15 * MPa, abs=5e3)
    else:
        pump = PUSHES[name].rig().pump
        moved = pump.advance * log["command"][0] * log["time"][-1]
        # The motor is at its speed after a part of the first period, and the log ends with one.
        periods = 2 * pump.advance * log["command"][0] * log.header.period
        assert PUSHES[name].plunger + moved == pytest.approx(pump.stroke, abs=periods)
        assert log["pressure"].max() < 0.15 * MPa + 5e3


def test_each_push_sweeps_about_the_same_air_in_its_own_time():
    # From 60 mL each, the same pressure takes nearly the same sweep; speed sets the time.
    swept = {}
    for name in ("push-a", "push-b", "push-c", "push-d"):
        pump = PUSHES[name].rig().pump
        log = read_log(data_file(f"simulated/{name}.csv").path)
        swept[name] = pump.area * pump.advance * log["command"][0] * log["time"][-1] / ML
    assert all(57 < air < 62 for air in swept.values())
    # The leak has longest to act in the slowest.
    assert max(swept, key=swept.get) != "push-d"


def test_unknown_name_lists_the_known_ones():
    with pytest.raises(UnknownNameError, match="push-a"):
        make("push-z")


def test_command_makes_what_is_named(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("book.companion.simulated_logs.data_folder", lambda: tmp_path)
    main(["step-60-1"])
    assert capsys.readouterr().out.strip() == str(tmp_path / "simulated" / "step-60-1.csv")
