from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.simulator.force_layer import ForceLayer, layer_voltage
from softgrip.tactile.drift_law import Bridge, Line

LAYER = ForceLayer(offset_drift=0.01)
BESIDE = LAYER.bridge_resistance
BRIDGE = Bridge(LAYER.supply * LAYER.amplification, BESIDE / (BESIDE + LAYER.rest_resistance))
LAWS = [Line(), BRIDGE]


@pytest.mark.parametrize("gain", [-0.3, 0.0, 0.05, 0.4])
def test_bridge_drifts_as_the_simulated_layer(gain):
    felt = np.linspace(0, 0.7, 8)
    fresh = layer_voltage(felt, 0.0, LAYER)
    drifted = layer_voltage(felt, 1.0, replace(LAYER, gain_drift=gain))
    assert BRIDGE.drifted(fresh, gain, 0.01) == pytest.approx(drifted, abs=1e-12)


@given(st.sampled_from(LAWS), st.floats(0, 4), st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
def test_what_is_drifted_is_calibrated_back(law, voltage, gain, offset):
    drifted = law.drifted(voltage, gain, offset)
    assert law.calibrated(drifted, gain, offset) == pytest.approx(voltage, abs=1e-9)


@given(st.sampled_from(LAWS), st.floats(0, 4), st.floats(-0.4, 0.4))
def test_slope_over_the_gain_is_that_of_a_small_step(law, voltage, gain):
    step = 1e-6
    above, below = (law.drifted(voltage, gain + s, 0.2) for s in (step, -step))
    assert law.per_gain(voltage, gain) == pytest.approx((above - below) / (2 * step), abs=1e-6)


@pytest.mark.parametrize(("scale", "balance"), [(0, 0.1), (25, 0), (25, 1), (np.nan, 0.1)])
def test_bridges_that_are_none_are_refused(scale, balance):
    with pytest.raises(InvalidInputError):
        Bridge(scale, balance)
