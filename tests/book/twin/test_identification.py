"""The identifications of many records are those of one."""

import numpy as np
import pytest

from book.chapter_5.step_models import FORCE_PER_PRESSURE, kept_test
from book.twin.identification import (
    SecondOrders,
    fit_ludwick,
    identify_second_order,
    ludwick_responses,
    second_order_responses,
)
from softgrip.dynamics.identify import identify
from softgrip.dynamics.ludwick import LudwickFinger, pressure_response
from softgrip.dynamics.ludwick_fit import fit_finger
from softgrip.dynamics.second_order import SecondOrder, response
from softgrip.errors import InvalidInputError

TESTS = [kept_test(design, angle) for design in ("Design 1", "Design 2") for angle in (60, 90)]
TIME = TESTS[0].time
PRESSURE, ANGLE = (np.stack([getattr(test, n) for test in TESTS]) for n in ("pressure", "angle"))


def test_responses_are_those_of_single_systems():
    w, z = np.array([0.5, 2.0, 3.0, 40.0]), np.array([0.1, 1.0, 4.0, 0.7])
    found = second_order_responses(PRESSURE, TIME[1] - TIME[0], w, z)
    for own, pressure, *system in zip(found, PRESSURE, w, z, strict=True):
        known = response(SecondOrder(*system), TIME, pressure, initial_pressure=0.0)
        assert own == pytest.approx(known, rel=1e-9, abs=1e-6 * np.ptp(known))


def test_ludwick_responses_are_those_of_single_fingers():
    mass, damping, stiffness, power = np.array(
        [[0.04, 0.1, 0.1, 1.0], [0.04, 0.14, 0.1, 2.4], [0.2, 0.4, 0.3, 1.7], [0.1, 0.2, 0.2, 2.0]]
    ).T
    finger = LudwickFinger(mass, damping, stiffness, power)
    found = ludwick_responses(finger, TIME, PRESSURE, FORCE_PER_PRESSURE)
    for k, own in enumerate(found):
        alone = LudwickFinger(*(float(x[k]) for x in (mass, damping, stiffness, power)))
        known = pressure_response(alone, TIME, PRESSURE[k], force_per_pressure=FORCE_PER_PRESSURE)
        assert own == pytest.approx(known, abs=1e-9)


def test_second_order_identification_is_that_of_one_record():
    found = identify_second_order(TIME, PRESSURE, ANGLE)
    for k in range(len(TESTS)):
        known = identify(TIME, PRESSURE[k], ANGLE[k], initial_input=0.0, dead_time=0.0).system
        # Both stop where a step gains 1e-10 of the sum of squares, or 1e-12.
        own = [getattr(found, name)[k] for name in vars(known)]
        assert own == pytest.approx(list(vars(known).values()), rel=1e-4)


@pytest.mark.parametrize("power", [1.0, 2.0])
def test_ludwick_fit_is_that_of_one_record(power):
    found = fit_ludwick(TIME, PRESSURE, ANGLE, power, FORCE_PER_PRESSURE)
    for k in (0, 3):
        known = fit_finger(
            TIME,
            PRESSURE[k],
            ANGLE[k],
            force_per_pressure=FORCE_PER_PRESSURE,
            fractional_power=power,
        ).finger
        for name in ("mass", "damping", "stiffness"):
            assert getattr(found, name)[k] == pytest.approx(getattr(known, name), rel=1e-4), name


def test_a_record_that_tells_no_frequency_gives_none():
    """An angle that follows the pressure at once: any frequency above the sampling will do."""
    found = identify_second_order(TIME, PRESSURE, 1e-4 * PRESSURE)
    assert np.isnan(found.natural_frequency).all()
    with pytest.raises(InvalidInputError, match="determines"):
        identify(TIME, PRESSURE[0], 1e-4 * PRESSURE[0], initial_input=0.0)


def test_without_an_offset_it_is_the_linear_finger():
    found = identify_second_order(TIME, PRESSURE, ANGLE, offset=False)
    known = fit_ludwick(TIME, PRESSURE, ANGLE, 1.0, FORCE_PER_PRESSURE)
    # Exact responses against Runge-Kutta's with a step of a period.
    frequency = (known.stiffness / known.mass) ** 0.5
    assert found.natural_frequency == pytest.approx(frequency, rel=1e-4)
    ratio = known.damping / known.mass / frequency / 2
    assert found.damping_ratio == pytest.approx(ratio, rel=1e-4)
    assert found.gain == pytest.approx(FORCE_PER_PRESSURE / known.stiffness, rel=1e-4)


def test_a_start_changes_nothing_but_the_way():
    grid = identify_second_order(TIME, PRESSURE, ANGLE)
    start = SecondOrders(np.array([2.0, np.nan, 2.0, 2.0]), np.full(4, 0.9), np.ones(4))
    found = identify_second_order(TIME, PRESSURE, ANGLE, start=start)
    for name, known in vars(grid).items():
        assert getattr(found, name) == pytest.approx(known, rel=1e-4), name
