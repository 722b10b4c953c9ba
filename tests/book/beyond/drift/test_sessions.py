from dataclasses import replace

import numpy as np
import pytest

from book.beyond.drift.sessions import (
    ABOVE_ZERO,
    HOURS,
    SINGLE,
    TIMES,
    Way,
    bridge_of,
    drawn_drift,
    drifting_voltage,
    session,
    session_holds,
)
from softgrip.simulator.fitted_rigs import fitted_layer
from softgrip.simulator.force_layer import layer_voltage
from softgrip.tactile.drift import DRIFT_WEIGHTS
from softgrip.tactile.drift_model import DriftSize
from softgrip.tactile.force import table_2_2
from softgrip.units import GRAM_FORCE

LAYER = fitted_layer()


def test_drift_is_that_of_chapter_2_above_zero():
    """Chapter 2's layer drifts by its own parameters; here gain and offset are handed over."""
    felt, age = np.linspace(0, 0.7, 6), 3.0
    theirs = layer_voltage(felt, age, LAYER)
    gain, offset = np.full(6, age * LAYER.gain_drift), np.full(6, age * LAYER.offset_drift)
    assert drifting_voltage(felt, gain, offset, LAYER) == pytest.approx(theirs + ABOVE_ZERO)


def test_the_bridge_is_that_of_the_layer():
    felt, nothing = np.linspace(0, 0.7, 6), np.zeros(6)
    fresh, old = (drifting_voltage(felt, nothing + g, nothing, LAYER) for g in (0.0, 0.2))
    assert bridge_of(LAYER).drifted(fresh, 0.2, 0.0) == pytest.approx(old, abs=1e-12)


@pytest.mark.parametrize("return_time", [2.0, np.inf])
def test_wander_spreads_as_its_law_says(return_time):
    size = DriftSize(return_time=return_time)
    ages = np.array([2.0, 2.5, 6.0])
    ends = [
        [path[-1] for path in drawn_drift(size, (0.0, 0.0), ages, np.random.default_rng(seed))]
        for seed in range(2000)
    ]
    expected = np.array([size.gain_wander, size.offset_wander]) * size.spread(6.0) ** 0.5
    # The deviation of 2000 normal numbers is known to 1.6 %.
    assert np.std(ends, axis=0) == pytest.approx(expected, rel=0.07)


@pytest.mark.parametrize("way", [Way(), Way(pauses=False), Way(touched=0.03)])
def test_nothing_lies_on_something_else_and_each_hour_is_table_2_2(way):
    holds = session_holds(LAYER, way, np.random.default_rng(0))
    ends = [hold.begin + hold.seconds for hold in holds]
    assert all(end <= later.begin for end, later in zip(ends, holds[1:], strict=False))
    assert all(0 < hold.read < hold.seconds for hold in holds)
    wanted = sorted(one.true for one in table_2_2().values() for _ in range(TIMES))
    for hour in range(HOURS):
        assert sorted(h.weight for h in holds if h.hour == hour) == pytest.approx(wanted)
    known = [h.weight / GRAM_FORCE for h in holds if h.hour < 0]
    assert known[:4] == pytest.approx(DRIFT_WEIGHTS) == known[-4:]
    assert len(known) == 4 + 4 * HOURS - 1 + 4
    assert set(np.round(known[4:-4], 9)) == {DRIFT_WEIGHTS[SINGLE]}


def test_what_is_read_is_what_lies_there_and_a_seed_is_one_session():
    quiet = replace(LAYER, voltage_noise=0.0, memory=(0.0, 0.0))
    size = DriftSize().scaled(0.0)
    found, again = (session(quiet, size, 5) for _ in range(2))
    record = found.record
    assert record.voltage.tolist() == again.record.voltage.tolist()
    for hold in record.holds[::20]:
        at = record.index(hold)
        borne = hold.weight * hold.part
        assert record.force[at] == pytest.approx(borne)
        expected = ABOVE_ZERO + layer_voltage(np.array(borne), 0.0, LAYER)
        # Within half a count of the converter.
        assert record.voltage[at] == pytest.approx(expected, abs=0.51 * 5 / 1023)


def test_touched_pauses_bear_the_touch():
    record = session(LAYER, DriftSize(), 5, Way(touched=0.03)).record
    assert record.force.min() == 0.03
