"""Several rigs at once, as their sensors feel them."""

from dataclasses import replace

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.simulator.each_rig import felt
from softgrip.simulator.free_parameters import free_parameters, parameter_values, with_values
from softgrip.simulator.parameters import SensorParameters
from softgrip.simulator.simulation import Simulation
from tests.simulator.rigs import design_1, printed_gripper

COMMANDS = np.repeat([12.0, 0.0, -6.0, 0.0], 20)


def drawn(rig, count):
    """Rigs whose free parameters are all others than those of a rig."""
    random, values = np.random.default_rng(1), parameter_values(rig)
    names = [one.name for one in free_parameters(len(rig.fingers))]
    factors = np.exp(0.2 * random.standard_normal((count, len(names))))
    return [
        with_values(rig, {n: values[n] * f for n, f in zip(names, row, strict=True)})
        for row in factors.tolist()
    ]


def exact(rig):
    """The rig with a converter so fine, and such a scale, that it changes nothing."""
    sensors = replace(
        rig.sensors, pressure_noise=0.0, angle_noise=0.0, bits=40,
        low_count=2.0**39, high_count=2.0**40 - 1,
    )  # fmt: skip
    return replace(rig, sensors=sensors)


@pytest.mark.parametrize("rig", [design_1(spread=False), printed_gripper(spread=False)])
def test_each_rig_is_as_it_is_alone(rig):
    rigs = drawn(rig, 4)
    pressure, angle = felt(rigs, COMMANDS, period=0.025, plunger=1e-3, torque=-1e-3)
    for k, one in enumerate(rigs):
        # The step of a batch is that of its fastest rig.
        alone = Simulation(exact(one), plunger=1e-3, step=0.0125)
        alone.push(-1e-3)
        seen, _ = alone.open_loop(COMMANDS)
        # An eighth of a count of the converter, by which two steps of the integration differ.
        np.testing.assert_allclose(pressure[:, k], seen.pressure[:, 0], atol=80)
        np.testing.assert_allclose(angle[..., k], seen.angle[..., 0], atol=3e-4)


def test_the_sensor_ends_where_it_ends():
    _, angle = felt([design_1()], np.full(120, 25.0), period=0.025)
    assert angle.max() == design_1().sensors.angle_range


def test_fast_and_damped_rigs_stay_finite():
    fast = {"sensors.pressure_lag": 0.01, "finger.inertia": 5e-4, "finger.damping": 0.1}
    pressure, angle = felt([with_values(design_1(), fast)], COMMANDS, period=0.025)
    assert np.isfinite(pressure).all()
    assert np.abs(angle).max() < 3


@pytest.mark.parametrize("bits", [0, 53, 1e12])
def test_a_converter_that_no_number_holds_is_refused(bits):
    with pytest.raises(InvalidInputError, match="bits"):
        SensorParameters(bits=bits)
