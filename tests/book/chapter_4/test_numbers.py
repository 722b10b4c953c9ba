"""What recomputes the numbers of Chapter 4, against what is known of it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal

from book.author import scripts
from book.chapter_4.numbers import (
    fastest,
    gain_ratio,
    growth_when_compressed,
    rate_ratio,
    settling_by_author,
    settling_on_model,
)
from book.companion.claims import claim_of, printed
from softgrip.control.ziegler_nichols import ReactionCurve, ziegler_nichols
from softgrip.pump.flow import TABLE_4_1
from softgrip.pump.gas import ATMOSPHERE
from softgrip.units import REV


def test_parameters_of_the_package_are_those_that_are_printed():
    ids = {
        "area": ("area-60-ml", "area-200-ml"),
        "lead": ("lead-fulride", "lead-monocarrier"),
        "motor_speed": ("speed-lower", "speed-higher"),
    }
    for name, values in TABLE_4_1.items():
        unit = REV if name == "motor_speed" else 1
        claimed = [printed(f"table-4.1-{id}") * unit for id in ids[name]]
        assert list(values) == pytest.approx(claimed, rel=1e-12), name


def test_fastest_set_has_the_largest_of_everything():
    sets = {"areas": [2e-4, 9e-4, 5e-4], "leads": [0.01, 0.004], "speeds": [1.0, 3.0, 2.0]}
    assert [fastest(name, **sets) for name in ("area", "lead", "motor speed")] == [9e-4, 0.01, 3.0]


@given(st.floats(1e-4, 1e-2), st.floats(1e-4, 1e-2), st.floats(1e-3, 0.1), st.floats(1e-3, 0.1))
def test_rates_are_the_same_where_area_times_lead_is(small, large, short, long):
    got = rate_ratio(small, large, short, long)
    assert got == pytest.approx((large * short) / (small * long), rel=1e-12)


@given(st.floats(0.01, 10), st.floats(1e-6, 1e6))
def test_rule_of_ziegler_and_nichols_has_one_gain_ratio_whatever_the_plant(delay, slope):
    gains = ziegler_nichols(ReactionCurve(delay, slope))
    assert gain_ratio(gains.kp, gains.ki, gains.kd) == pytest.approx(4, rel=1e-12)


@pytest.mark.parametrize("pressure", [ATMOSPHERE, 2.5e5])
def test_capacity_of_a_rigid_chamber_falls_and_only_softening_makes_it_grow(pressure):
    rigid = growth_when_compressed(pressure)
    assert rigid == pytest.approx(-2 / pressure, rel=1e-12)
    assert growth_when_compressed(pressure, softening=1e-16) > rigid
    assert growth_when_compressed(pressure, softening=1e-12) > 0


def test_settling_of_the_authors_loop_is_that_of_its_transfer_function():
    # Without a filter of the derivative, which moves the poles of the loop by less than 1 %.
    (kp, ki, kd), (w, zeta, gain) = (3.6, 1.0, 0.25), (1.812, 0.7, 0.455)
    numerator = gain * np.array([kd, kp, ki])
    denominator = np.polyadd([1, 2 * zeta * w, w**2, 0, 0], numerator)
    time, y = signal.step((numerator, denominator), T=np.linspace(0, 60, 6001))
    for band in (0.02, 0.05, 0.1):
        last = time[np.flatnonzero(abs(y - 1) > band)[-1]]
        assert settling_by_author((kp, ki, kd), w, zeta, gain, band) == pytest.approx(
            last, abs=0.02
        )


def test_full_speed_from_the_start_is_no_sooner_than_the_note_says():
    """The finger's step response is never negative, so that no command within the limit is."""
    inputs, note = scripts.inputs("control"), claim_of(4, "4.4-settling-full").note
    w, zeta = inputs["natural_frequency"], inputs["damping_ratio"]
    time = np.linspace(0, 5, 50001)
    pushed = inputs["gain"] * printed("4.2-speed-limit")
    _, rate = signal.step(([pushed], [1, 2 * zeta * w, w**2]), T=time)
    assert (rate >= 0).all()
    assert f"by {np.degrees(pushed / w**2):.1f} deg/s" in note
    angle = np.degrees(np.cumsum(rate) * time[1])
    for target, band in ((90, 0.1), (60, 0.02)):
        within = time[np.argmax(angle >= (1 - band) * target)]
        assert f"{100 * band:g} % after {within:.2f} s" in note
    assert time[np.argmax(angle >= 0.9 * 90)] > printed("4.4-settling-full")


def test_less_gain_settles_later():
    slow, fast = (settling_on_model("actuator", share=share) for share in (0.2, 1.0))
    assert slow > 2 * fast
