"""The physics of the simulated rig in its limit cases."""

from dataclasses import replace

import numpy as np
import pytest

from softgrip.dynamics.integrate import RungeKutta
from softgrip.simulator import laws
from softgrip.simulator.chance import Chance
from softgrip.simulator.laws import AMOUNT, ANGLE, FINGERS, MEMORY, RATE, SENSED_PRESSURE, Plant
from softgrip.simulator.small_signal import OPERATING_ANGLE, small_signal_poles
from softgrip.simulator.statics import FULL_PRESSURE
from softgrip.units import DEG
from tests.simulator.rigs import design_1

LARGE = 1e4  # m^3 of air: its pressure does not feel the finger


def plant(*, dead_volume=None, leakage=0.0, **finger):
    rig = design_1(spread=False)
    gas = replace(rig.gas, leakage=leakage)
    if dead_volume:
        gas = replace(gas, dead_volume=dead_volume)
    rig = replace(rig, fingers=(replace(rig.finger, **finger),), gas=gas)
    return Plant(rig, Chance(rig.spread, fingers=1, seed=0, first=0, runs=1))


def at_pressure(own, gauge, angle=0.0):
    """Return the state at rest with the air in the large volume at a gauge pressure."""
    gas = own.parameters.gas
    state = np.zeros((own.states, 1))
    state[FINGERS + ANGLE] = angle
    volume = laws.finger_volume(angle, gauge, own.parameters.finger) + gas.dead_volume
    state[AMOUNT] = (gauge + gas.atmosphere) * volume
    return state


def run(own, state, seconds, step, syringe=0.0):
    method = RungeKutta(lambda t, y, s: own.slopes(y, s, np.full(1, syringe)), (state.shape[0], 1))
    method.advance(0.0, state, step, round(seconds / step))
    return state


def test_leak_stops_at_the_atmosphere_and_goes_either_way():
    assert laws.leak(0.0, 1e-12, 101325.0) == 0
    assert laws.leak(1e4, 1e-12, 101325.0) > 0 > laws.leak(-1e4, 1e-12, 101325.0)


def test_power_one_without_memory_is_the_closed_second_order_response():
    own = plant(
        dead_volume=LARGE, fractional_power=1.0, memory=(), memory_time=(), friction=0.0,
        ballooning=0.0, stiffness=0.0285, inertia=0.0035, damping=0.0140,
    )  # fmt: skip
    wn = (0.0285 / 0.0035) ** 0.5
    zeta = 0.0140 / (2 * (0.0285 * 0.0035) ** 0.5)
    wd = wn * (1 - zeta**2) ** 0.5
    state, gauge = at_pressure(own, 2e4), 2e4
    end = own.parameters.finger.torque_per_pressure * gauge / 0.0285
    for k in range(1, 9):
        run(own, state, 0.25, 0.0025)
        t = 0.25 * k
        shape = np.cos(wd * t) + zeta * wn / wd * np.sin(wd * t)
        assert state[FINGERS + ANGLE, 0] == pytest.approx(
            end * (1 - np.exp(-zeta * wn * t) * shape), abs=1e-7
        )


def test_sensor_lag_is_first_order():
    own = plant(dead_volume=LARGE)
    state = at_pressure(own, 2e4)
    lag = own.parameters.sensors.pressure_lag
    run(own, state, 2 * lag, lag / 50)
    assert state[SENSED_PRESSURE, 0] == pytest.approx(2e4 * (1 - np.exp(-2)), rel=1e-6)


def test_energy_is_kept_without_losses_and_falls_with_them():
    # Free energy of the isothermal air, work against the atmosphere, spring, and motion. It is kept
    # only if the air does on the finger the work that its growing volume says.
    def energy(own, state, syringe):
        finger, gas = own.parameters.finger, own.parameters.gas
        volume = (
            syringe + gas.dead_volume + laws.finger_volume(state[FINGERS + ANGLE, 0], 0.0, finger)
        )
        spring = finger.stiffness * abs(state[FINGERS + ANGLE, 0]) ** (finger.fractional_power + 1)
        return (
            finger.inertia * state[FINGERS + RATE, 0] ** 2 / 2
            + spring / (finger.fractional_power + 1)
            - state[AMOUNT, 0] * np.log(volume)
            + gas.atmosphere * volume
        )

    def change(**finger):
        own = plant(ballooning=0.0, memory=(), memory_time=(), **finger)
        state, before = at_pressure(own, 3e4), 0.0
        state[AMOUNT] = 131325.0 * 8e-5
        syringe = 5e-5
        before = energy(own, state, syringe)
        run(own, state, 3.0, 0.004, syringe)
        return energy(own, state, syringe) - before

    # 0.05 J is stored at the far end of the swing; 1e-9 is the error of the integration.
    assert change(damping=0.0, friction=0.0) == pytest.approx(0.0, abs=1e-8)
    assert change(damping=0.0) < -1e-6
    assert change() < -1e-3


def test_memory_adds_its_part_to_a_fast_bend_and_fades():
    own = plant(dead_volume=LARGE, friction=0.0)
    state = at_pressure(own, FULL_PRESSURE)
    finger = own.parameters.finger
    run(own, state, 75.0, 0.0125)
    # Nine times the slowest relaxation leaves less than a part in ten thousand of 5 %.
    assert abs(state[FINGERS + MEMORY :]).max() < 1e-4 * float(
        laws.settled_torque(206 * DEG, finger)
    )
    assert state[FINGERS + ANGLE, 0] == pytest.approx(206 * DEG, rel=1e-4)


def test_poles_are_those_of_a_differenced_plant():
    # The closed form against the slopes that the rig runs on.
    own = plant(dead_volume=LARGE, friction=0.0)
    finger = own.parameters.finger
    gauge = laws.settled_torque(OPERATING_ANGLE, finger) / finger.torque_per_pressure
    state = at_pressure(own, gauge, OPERATING_ANGLE)
    rows = [FINGERS + row for row in (ANGLE, RATE, *range(MEMORY, own.rows))]
    matrix = np.empty((len(rows), len(rows)))
    for j, row in enumerate(rows):
        sides = []
        for sign in (1, -1):
            moved, slope = state.copy(), np.empty_like(state)
            moved[row] += sign * 1e-5
            own.slopes(moved, slope, np.zeros(1))
            sides.append(slope[rows, 0])
        matrix[:, j] = (sides[0] - sides[1]) / 2e-5
    found = np.sort_complex(np.linalg.eigvals(matrix))
    np.testing.assert_allclose(
        found,
        np.sort_complex(small_signal_poles(finger, OPERATING_ANGLE)),
        rtol=1e-6,
    )


def test_volume_grows_by_less_than_half_at_the_full_angle():
    finger = design_1().finger
    ratio = laws.finger_volume(206 * DEG, FULL_PRESSURE, finger) / finger.rest_volume
    assert 1.1 < ratio < 1.5
