import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.tactile.drift_curve import NEAR, Curve
from softgrip.tactile.own_pad import PadReadings


def readings(forces, voltages):
    return PadReadings(("layer",), np.array(voltages, dtype=float)[:, None], forces)


def test_voltages_are_means_and_scatter_is_that_about_them():
    found = Curve.of(readings([0.0, 0.5, 0.0, 0.5], [0.1, 2.0, 0.3, 2.4]))
    # Without load the least: a memory of weights can only raise it.
    assert found.voltage == pytest.approx([0.1, 2.2])
    # Two readings each: the deviation with one degree of freedom.
    assert found.scatter[1] == pytest.approx(0.08**0.5)


def test_few_forces_are_joined_by_lines():
    found = Curve.of(readings([0.0, 0.2, 0.4], [0.0, 1.0, 3.0]))
    assert found.at(0.3) == pytest.approx((2.0, 0.0))


def test_a_voltage_is_told_by_its_neighbours_too():
    """Against a fit by hand; the curve is a cubic, which no parabola of its own would be."""
    forces = np.linspace(0, 0.7, 15)
    voltages = forces + 2 * forces**3
    found = Curve.of(readings(forces, voltages))
    middle = 8
    near = slice(middle - NEAR // 2, middle + NEAR // 2 + 1)
    by_hand = np.polynomial.Polynomial.fit(forces[near], voltages[near], 2)(forces[middle])
    assert found.at(float(forces[middle]))[0] == pytest.approx(by_hand, abs=1e-12)
    # And a bad reading counts for less than all.
    voltages[middle] += 0.1
    off = Curve.of(readings(forces, voltages)).at(float(forces[middle]))[0] - by_hand
    assert 0 < off < 0.05


def test_the_unloaded_layer_is_its_own_neighbour_alone():
    """How weights scatter, which lie off the middle, says nothing of it."""
    forces = np.repeat(np.linspace(0, 0.7, 15), 2)
    voltages = 4 * forces**0.3 + 0.1 * (forces > 0) * np.tile([0, 1], 15)
    assert Curve.of(readings(forces, voltages)).at(0.0) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("forces", "voltages"),
    [([0.1, 0.2], [1, 2]), ([0.0, 0.2], [2, 1]), ([0.0, 0.0], [1, 1]), (["a", "b"], [1, 2])],
)
def test_calibrations_that_are_none_are_refused(forces, voltages):
    with pytest.raises(InvalidInputError, match="calibration"):
        Curve.of(readings(forces, voltages))


@pytest.mark.parametrize("force", [-0.1, 0.41, 20.0])
def test_a_weight_beyond_the_calibration_is_refused(force):
    with pytest.raises(InvalidInputError, match="weight"):
        Curve.of(readings([0.0, 0.4], [0, 1])).at(force)
