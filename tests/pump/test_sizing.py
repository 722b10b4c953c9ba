"""Which syringe, screw and motor: against the gas law, by hand, and on the dissertation's parts."""

import dataclasses
from math import inf, pi

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.pump import parts
from softgrip.pump.finger import Finger, least_start_volume, swept_volume
from softgrip.pump.gas import ATMOSPHERE, closed_volume_pressure
from softgrip.pump.sizing import size, sizings
from softgrip.units import ML, REV

SMALL, LARGE = parts.SYRINGES
LONG_LEAD, SHORT_LEAD = parts.SCREWS
LIMIT = 0.15e6
"""Gauge pressure up to which Section 4.3 takes the finger as linear, Pa."""
FINGER = Finger(LIMIT, 10 * ML, 15 * ML, 5 * ML, rise_time=3.0)

fingers = st.builds(
    lambda P, rest, growth, dead, t: Finger(P, rest, rest * (1 + growth), dead, t),
    st.floats(1e3, 5e5),
    st.floats(1e-6, 1e-4),
    st.floats(0, 2),
    st.floats(0, 2e-5),
    st.floats(0.1, 20),
)


@given(finger=fingers, V=st.floats(1e-5, 5e-4))
def test_swept_volume_gives_the_pressure_by_the_exact_law(finger, V):
    """A finger that grows in proportion to its pressure is one of constant compliance."""
    assume(swept_volume(finger, V) <= V)
    growth = finger.volume_at_pressure - finger.volume_at_rest
    gas = V + finger.volume_at_rest + finger.dead_volume
    P = closed_volume_pressure(
        swept_volume(finger, V), gas, compliance=growth / finger.gauge_pressure
    )
    gauge = P - ATMOSPHERE
    assert gauge == pytest.approx(finger.gauge_pressure, rel=1e-6)


@given(finger=fingers)
def test_least_volume_is_pushed_out_to_the_last(finger):
    least = least_start_volume(finger)
    assert swept_volume(finger, least) == pytest.approx(least)
    assert swept_volume(finger, 1.01 * least) < 1.01 * least
    assert swept_volume(finger, 1.01 * least) > least


def test_dissertation_syringe_by_hand():
    found = size(FINGER, SMALL, LONG_LEAD, parts.MOTORS[1])
    # (101.325 / 251.325) (60 + 10 + 5) mL = 30.24 mL are left, 20 of them in finger and tube
    assert found.stroke * SMALL.area / ML == pytest.approx(60 + 20 - 75 * 101.325 / 251.325)
    assert found.motor_speed / REV == pytest.approx(found.stroke / 0.008 / 3.0)
    assert found.thrust == pytest.approx(99.15)  # 0.15 MPa on 6.61 cm^2
    assert found.torque_needed == pytest.approx(99.15 * 0.008 / (2 * pi * 0.9))
    assert found.feasible


def test_seal_friction_adds_to_the_thrust():
    stiff = dataclasses.replace(SMALL, friction=12.0)
    plain, rubbing = (size(FINGER, s, LONG_LEAD, parts.MOTORS[1]) for s in (SMALL, stiff))
    assert rubbing.thrust - plain.thrust == pytest.approx(12.0)
    assert rubbing.margin < plain.margin


@pytest.mark.parametrize("motor", parts.MOTORS)
def test_large_syringe_leaves_no_margin_at_the_pressure_limit(motor):
    """The larger reverse force of Section 4.4: 249 N, against 99 N.

    On the 8 mm screw the 200 mL syringe asks for more than each motor of the frame can give with
    the margin; two of the three stall even at standstill.
    """
    small, large = (size(FINGER, s, LONG_LEAD, motor) for s in parts.SYRINGES)
    assert large.thrust / small.thrust == pytest.approx(16.62 / 6.61)
    assert large.margin < 1.5
    assert small.margin > 1
    assert (large.torque_needed > motor.holding_torque) == (motor.holding_torque < 0.353)


def test_large_syringe_started_full_is_no_faster():
    """Both need about the same stroke: the larger one also compresses more gas."""
    strokes = [size(FINGER, s, LONG_LEAD, parts.MOTORS[2]).stroke for s in parts.SYRINGES]
    assert strokes[1] / strokes[0] == pytest.approx(1, abs=0.1)


def test_large_syringe_started_with_the_same_air_is_faster_by_its_area():
    full = size(FINGER, SMALL, LONG_LEAD, parts.MOTORS[2])
    part = size(FINGER, LARGE, LONG_LEAD, parts.MOTORS[2], fill=60 / 200)
    assert full.stroke / part.stroke == pytest.approx(16.62 / 6.61)


def test_short_lead_trades_torque_for_speed():
    long, short = (size(FINGER, SMALL, screw, parts.MOTORS[2]) for screw in parts.SCREWS)
    assert short.torque_needed == pytest.approx(long.torque_needed / 4)
    assert short.motor_speed == pytest.approx(long.motor_speed * 4)
    assert "5.0 rev/s are allowed" in short.reasons[0]


@pytest.mark.parametrize(
    ("syringe", "screw", "motor"), [(SMALL, LONG_LEAD, m) for m in parts.MOTORS]
)
def test_fastest_rise_is_the_edge_of_what_is_feasible(syringe, screw, motor):
    edge = size(FINGER, syringe, screw, motor).fastest_rise
    just, too_fast = (
        size(dataclasses.replace(FINGER, rise_time=edge * f), syringe, screw, motor)
        for f in (1 + 1e-9, 1 - 1e-3)
    )
    assert just.feasible
    assert not too_fast.feasible


def test_each_reason_is_given():
    weak = parts.Motor("weak", 0.01, 3 * REV, 2 * REV)
    found = size(dataclasses.replace(FINGER, rise_time=0.5), SMALL, LONG_LEAD, weak, fill=0.4)
    assert len(found.reasons) == 3
    assert "the syringe holds 24.0 mL" in found.reasons[0]
    assert "2.0 rev/s are allowed" in found.reasons[1]
    assert "the motor has 0.000 N m" in found.reasons[2]
    assert found.fastest_rise == inf


@pytest.mark.parametrize("order", ["margin", "rise time"])
def test_list_holds_all_combinations_the_best_first(order):
    found = sizings(FINGER, order=order)
    assert len({(s.syringe.name, s.screw.name, s.motor.name) for s in found}) == 12
    flags = [s.feasible for s in found]
    assert flags == sorted(flags, reverse=True)
    best = [s for s in found if s.feasible]
    assert len(best) > 1
    keys = [-s.margin if order == "margin" else s.fastest_rise for s in best]
    assert keys == sorted(keys)


@given(torque=st.floats(0.0, 0.5))
def test_motor_speed_inverts_its_torque(torque):
    motor = parts.Motor("", 0.4, 60.0)
    speed = motor.speed(torque)
    assert motor.torque(speed) == pytest.approx(min(torque, 0.4), abs=1e-12)


def test_motor_torque_of_an_array():
    motor = parts.Motor("", 0.4, 60.0)
    np.testing.assert_allclose(
        motor.torque(np.array([-30.0, 0, 30, 60, 90])), [0.2, 0.4, 0.2, 0, 0]
    )


@given(force=st.floats(0, 1e3))
def test_screw_force_inverts_its_torque(force):
    assert LONG_LEAD.force(LONG_LEAD.torque(force)) == pytest.approx(force)


def test_screw_turns_work_into_work():
    # one turn: 2 pi T eta = F l
    torque = parts.Screw("", 0.008, 1.0).torque(100.0)
    assert 2 * pi * torque == pytest.approx(100.0 * 0.008)


def test_strokes_of_the_dissertation_syringes():
    assert [s.stroke for s in parts.SYRINGES] == pytest.approx([0.0908, 0.1203], abs=5e-5)


@pytest.mark.parametrize(
    "make",
    [
        lambda: dataclasses.replace(FINGER, gauge_pressure=0.0),
        lambda: dataclasses.replace(FINGER, volume_at_pressure=9 * ML),
        lambda: dataclasses.replace(FINGER, dead_volume=-1.0),
        lambda: dataclasses.replace(FINGER, rise_time=float("nan")),
        lambda: parts.Syringe("", 0.0, 1e-4),
        lambda: parts.Syringe("", 1e-4, 1e-4, friction=-1.0),
        lambda: parts.Screw("", 0.008, 1.2),
        lambda: parts.Motor("", 0.4, 0.0),
        lambda: parts.Motor("", 0.4, 60.0, speed_limit=-1.0),
        lambda: parts.winding_limited_speed(24.0, 0.0, 1.0),
        lambda: size(FINGER, SMALL, LONG_LEAD, parts.MOTORS[0], least_margin=0.5),
        lambda: size(FINGER, SMALL, LONG_LEAD, parts.MOTORS[0], fill=1.5),
        lambda: size(FINGER, SMALL, LONG_LEAD, parts.MOTORS[0], atmosphere=0.0),
        lambda: sizings(FINGER, order="price"),
    ],
)
def test_bad_input_is_refused(make):
    with pytest.raises(InvalidInputError, match="expected"):
        make()
