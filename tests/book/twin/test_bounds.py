"""Bounds that no rig passes: against random rigs of the space, and against all pushes there are."""

import numpy as np
import pytest

from book.twin import bounds
from book.twin.bounds import BOUNDS, constant_capacity, least_time, swept, tried
from book.twin.gripper_tests import REST
from book.twin.laboratory import LARGEST, STROKE
from book.twin.space import space
from book.twin.targets import targets
from softgrip.arrays import Floats
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.uncertainty import excited_band
from softgrip.logs.pushes import HIGH
from softgrip.simulator.gripper_steps import OPEN_LOOP_DURATION
from softgrip.simulator.parameters import PumpParameters
from softgrip.simulator.statics import FULL_PRESSURE
from softgrip.units import DEG, MM, REV, MPa

RNG = np.random.default_rng(8)


def _drawn(name: str, count: int) -> Floats:
    return space()[name].at(RNG.random(count))


def test_each_is_of_a_target_with_a_reason():
    assert set(BOUNDS) <= {one.id for one in targets()}
    assert all(make().reason for make in BOUNDS.values())


def _passes(bound, value):
    return value > bound.value if bound.side == "at most" else value < bound.value


def test_no_rig_that_is_drawn_passes():
    """By what the simulator gives, with all of friction, leak, motion and noise."""
    found = list(tried(48))
    assert [one.id for one in found] == [*BOUNDS]
    for one in found:
        assert one.rigs >= 8, one.id
        assert not _passes(BOUNDS[one.id](), one.nearest * (1 - 1e-9)), one.id


@pytest.mark.parametrize("share", [0.01, 0.5])
def test_the_first_line_of_any_push_counts(share):
    """All lengths of a push that the space allows: of the fast steps, and of the slow ones."""
    record, rest = (round(time / PERIOD) for time in (OPEN_LOOP_DURATION, REST))
    longest = space()["choice.gripper_travel"].high * MM / (
        PumpParameters().advance * space()["choice.low_speed"].low * REV * PERIOD
    )  # fmt: skip
    records = [(n, record) for n in range(1, record)]
    records += [(n, n + rest) for n in range(1, int(np.ceil(longest)) + 1)]
    for pushing, size in records:
        low, _ = excited_band(np.arange(size) < pushing, PERIOD, share=share)
        assert low == pytest.approx(2 * np.pi / (size * PERIOD)), pushing


def test_the_slow_bound_is_that_of_the_shortest_push():
    shortest = space()["choice.gripper_travel"].low * MM / (PumpParameters().lead)
    seconds = shortest / (space()["choice.low_speed"].high)  # 0.375: four periods
    assert seconds == pytest.approx(0.375)
    assert bounds.lowest_slow_frequency().value == pytest.approx(2 * np.pi / 5.4)


def test_a_constant_capacity_lies_below_whatever_the_closed_rig():
    """By the gas law for rigs of the space: the pressure is convex in what is swept."""
    count = 400
    names = ("finger.rest_volume", "gas.dead_volume", "finger.ballooning", "rubber.power")
    rest, dead, ballooning, power = (_drawn(name, count)[:, None] for name in names)
    full = _drawn("finger.full_angle", count)[:, None] * DEG
    torque = _drawn("finger.torque_per_pressure", count)[:, None]
    below = _drawn("choice.capacity_below", count) * MPa
    p = np.linspace(1.0, LARGEST, 2000)
    bent = torque * full * (p / FULL_PRESSURE) ** (1 / power)
    q = swept(p, STROKE + rest + dead, bent + ballooning * p)
    assert (np.diff(p / q, axis=1) > 0).all()
    bound = constant_capacity().value
    judged = 0
    for own, limit in zip(q, below, strict=True):
        # Sampled evenly in what is swept, as a steady push is.
        even = np.linspace(own[0], min(own[-1], STROKE), 400)
        pressure = np.interp(even, own, p)
        if pressure[-1] <= HIGH:
            continue
        low = pressure < limit
        capacity = even[low] @ even[low] / (even[low] @ pressure[low])
        off = 100 * ((even / capacity - pressure) / pressure)[pressure > HIGH]
        assert off.max() <= bound
        judged += 1
    assert judged > count / 2


def test_the_least_time_falls_to_the_corner_of_the_space():
    """Monotone in each parameter, so the corner is the least of all: by moving each of random rigs.

    To the step in which it is summed, 0.1 ms.
    """
    rng = np.random.default_rng(3)
    ends = [
        (10 * DEG, 85 * DEG, 1), (0.7, 20.0, -1), (150 * DEG, 280 * DEG, -1), (1.1, 3.0, -1),
        (70e-6, 140e-6, 1), (30.0, 3000.0, -1),
    ]  # fmt: skip
    low, high, sign = np.array(ends).T
    for _ in range(20):
        about = low + rng.random(len(ends)) * (high - low)
        first = least_time(*about)
        for k in range(len(ends)):
            moved = about.copy()
            moved[k] += 0.5 * (high[k] - moved[k])
            assert sign[k] * (least_time(*moved) - first) >= -1.01e-4


def test_the_least_time_is_that_of_a_constant_push():
    """A motor that is at full speed at once, and air so large that its pressure rises evenly.

    ``theta'' = c P_atm q' t / V``, so ``theta = c P_atm q' t^3 / 6 V``: by hand.
    """
    pump, volume = PumpParameters(), 1.0
    flow = pump.area * pump.advance * pump.speed_limit
    rise = 4.0 * 2.0**2 / 2 * 101325.0 * flow / volume / FULL_PRESSURE
    angle = rise * 2.0**3 / 6
    assert least_time(angle, 2.0, 2.0, 2.0, volume, 1e9) == pytest.approx(2.0, abs=1e-3)
