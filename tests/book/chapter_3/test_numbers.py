"""What recomputes the numbers of Chapter 3, and what the notes of its claims say of it."""

from math import isnan, pi

import pytest
from scipy.integrate import solve_bvp

from book.chapter_3 import numbers
from book.chapter_3.tables import READINGS
from book.companion.claims import printed
from softgrip.actuator.bending import Finger, bending_angle
from softgrip.actuator.frequency import spring_constant
from softgrip.actuator.section import Section, torque
from softgrip.control.lqr import Weights, step_response
from softgrip.control.step_metrics import rise_time
from softgrip.dynamics.second_order import SecondOrder

SCRIPT = SecondOrder(1.812, 0.7), Weights(2000.0, (1.0, 0.1, 0.0))
"""Plant and weights of the control script."""
DESIGN_1 = {"top": 20.0, "bottom": 4.0, "width": 30.0, "wall": 1.5}
"""The optimum of Table 3.1, mm."""


@pytest.mark.parametrize("combined", ["sum", "product"])
@pytest.mark.parametrize("power", [1.0, 1.1, 2.5])
def test_bounds_of_the_design_script_give_table_3_1_whatever_is_made_large(combined, power):
    names = ("bottom", "top", "width", "wall")
    found = [numbers.optimum(name, power=power, combined=combined) for name in names]
    assert found == pytest.approx([4.0, 20.0, 30.0, 1.5], abs=1e-3)


def test_stated_bounds_of_b_and_h_give_another_bottom():
    assert numbers.optimum("bottom", bottom_limit=5.0, height_limit=25.0) == pytest.approx(5.0)


@pytest.mark.parametrize("combined", ["sum", "product"])
@pytest.mark.parametrize(
    ("low", "omega", "top"),
    # By hand: a = (12 M omega^2 L^2 / 2 E w)^(1/3) - b, Eq. (3.19) at n = 1.
    [(2.4, 2.6, 19.2998), (2.2, 2.4, 18.0891), (2.2, 2.2, 16.8442)],
)
def test_heights_of_table_3_2_with_the_inputs_of_the_script(combined, low, omega, top):
    found = numbers.optimum("top", (low, omega), combined=combined)
    by_hand = (12 * 0.36 * omega**2 * 0.094**2 / (2 * 0.34e6 * 0.03)) ** (1 / 3) * 1e3 - 4
    assert found == pytest.approx(by_hand, abs=1e-3)
    assert found == pytest.approx(top, abs=1e-3)


@pytest.mark.parametrize("row", [2, 3, 4])
def test_readings_that_give_table_3_3_miss_the_heights_by_more_than_the_script(row):
    height = printed(f"table-3.2-top-{row}")
    band = [printed(f"table-3.2-{end}-{row}") for end in ("low", "high")]
    off = [abs(numbers.optimum("top", band, n, mass) - height) for n, mass in READINGS.values()]
    assert off[0] < min(off[1:])


@pytest.mark.parametrize("power", [1.0, 1.56, 2.5])
def test_mass_that_gives_the_second_height_gives_none_as_low_as_the_third(power):
    """Eq. (3.19) at the upper ends of both bands: ``h**(n + 2)`` goes with ``M omega**2``."""
    second = Finger(Section(0.0193, 0.004, 0.030, 0.0015), fractional_power=power)
    mass = spring_constant(second) / 2.6**2
    found = [numbers.optimum("top", band, power, mass) for band in ((2.4, 2.6), (2.2, 2.4))]
    third = 23.3 * (2.4 / 2.6) ** (2 / (power + 2)) - 4
    assert found == pytest.approx([19.3, third], abs=1e-3)
    assert third > printed("table-3.2-top-3") + 1


def test_band_that_no_section_keeps_gives_no_number():
    assert isnan(numbers.optimum("top", (2.5, 3.5), power=1.1))


def test_one_power_gives_five_printed_numbers_within_the_rounding_of_their_inputs():
    """Table 3.3's three estimates, M in newtons, and both sums, with the same n and E in all."""
    n, modulus = 2.068, 0.338
    rows = (
        ("1-e1-", 30, modulus, 0.350),
        ("2-e1-", 29, modulus, 0.338),
        ("3-e2-", 30, 0.261, 0.460),
    )
    for key, width, E, weight in rows:
        assert weight == pytest.approx(printed(f"table-3.3-weight-design-{key}"), abs=0.005)
        assert pytest.approx(printed(f"table-3.3-modulus-design-{key}"), abs=0.005) == E
        full = numbers.frequency_at(20, 4, 30, n, weight, E, 94, newtons=True)
        found = numbers.scaled_frequency(full, (1, 1), width=(width, 30))
        assert found == pytest.approx(printed(f"table-3.3-estimated-design-{key}"), abs=0.005)
    for width, key in ((30, "opt--parameters"), (29, "variance-1")):
        total = numbers.objective_sum(DESIGN_1 | {"width": width}, n, 0.15, modulus, 0.4, 1.4)
        assert total == pytest.approx(printed(f"3.4-sum-{key}"), abs=0.005)


def test_angle_that_a_sum_leaves_is_the_angle_that_makes_it():
    total = numbers.sum_of_measured(0.5 * 0.6, 123.0, 0.4, 1.4)
    assert numbers.angle_left(total, 0.5, 0.15, 0.25, 0.4, 1.4) == pytest.approx(123.0)


def test_narrower_finger_is_weaker_by_its_torque():
    narrow, wide = (torque(Section(20, 4, w, 1.5), 1.0) for w in (29, 30))
    found = numbers.width_torque_ratio(29, 30, top=20, bottom=4, wall=1.5)
    assert found == pytest.approx(narrow / wide, rel=1e-9)


def test_wall_pulls_as_in_the_check_script():
    """Which gives 0.305816 N m at 0.15 MPa."""
    assert numbers.section_torque(0.15, DESIGN_1, wall_pulls=True) == pytest.approx(
        0.305816, abs=5e-7
    )


def test_scaled_frequency_is_that_of_the_formula_whatever_the_power():
    for n in (1.0, 1.7, 2.5):
        first = numbers.frequency_at(20, 4, 30, n, 0.35, 0.34, 94)
        other = numbers.frequency_at(20, 4, 30, n, 0.46, 0.26, 94)
        scaled = numbers.scaled_frequency(first, (0.46, 0.35), modulus=(0.26, 0.34))
        assert other == pytest.approx(scaled, rel=1e-12)


def test_frequency_of_eq_3_19_is_that_of_eq_3_16():
    for n in (1.0, 1.7, 2.5):
        found = numbers.product_frequency(DESIGN_1, 0.34, 94, n, 0.35)
        assert found == pytest.approx(numbers.frequency_at(20, 4, 30, n, 0.35, 0.34, 94), rel=1e-12)


def _second_frequency(guess):
    """Solve the beam equation u'''' = k u as a boundary value problem, without a mass."""
    import numpy as np

    def slope(x, u, p):
        return np.vstack([u[1], u[2], u[3], p[0] * u[0]])

    def ends(left, right, p):
        return np.array([left[0], left[1], right[2], right[3], left[2] - 1])

    x = np.linspace(0, 1, 60)
    shape = np.sin(guess**0.25 * x) ** 2
    found = solve_bvp(
        slope, ends, x, np.vstack([shape] + [np.gradient(shape, x)] * 3), p=[guess], tol=1e-8
    )
    assert found.success
    return found.p[0] ** 0.5


def test_second_mode_of_a_cantilever():
    ratio = _second_frequency(480.0) / _second_frequency(12.0)
    assert numbers.second_mode_ratio(0.0) == pytest.approx(ratio, rel=1e-5)
    # A very heavy tip hardly moves in the second mode: clamped and pinned, tan x = tanh x.
    heavy = 1e4
    first = (3 / heavy) ** 0.5  # the beam as a spring without mass
    assert numbers.second_mode_ratio(heavy) == pytest.approx(3.92660**2 / first, rel=1e-3)


def test_poles_and_what_they_are_made_of():
    real, imaginary = (numbers.pole(part, 2.86, 0.7) for part in ("real", "imaginary"))
    assert numbers.pole_frequency(real, imaginary) == pytest.approx(2.86)
    assert numbers.pole_damping(real, imaginary) == pytest.approx(0.7)
    real, imaginary = (numbers.pole(part, 2.856, 0.697) for part in ("real", "imaginary"))
    assert (round(real, 2), round(imaginary, 2)) == (-1.99, 2.05)


def test_design_of_the_control_script_rises_in_the_printed_time_and_settles_later():
    time, response = step_response(*SCRIPT)
    assert float(rise_time(time, response, target=1.0)) == pytest.approx(0.80, abs=0.01)
    settled = [numbers.lqr_settling(2000, (1, 0.1, 0), 1, 1.812, 0.7, band) for band in (0.02, 0.1)]
    assert settled == pytest.approx([1.36, 1.09], abs=0.005)


def test_chamber_that_is_full_weighs_as_the_block():
    block = 1080 * 9.80665 * 0.094 * 0.030 * 0.024
    assert numbers.rubber_weight(DESIGN_1, 94, 1080, filled=1.0) == pytest.approx(block, rel=1e-9)


def test_counts_of_the_tables():
    assert numbers.prototypes() == 6
    assert numbers.off_integers([*DESIGN_1.values()]) == 0.5


def test_heights_decide_a_limit_that_they_pass():
    assert numbers.height_limit("least", 15, tops=[20, 14.4], bottoms=[4, 4]) == 15
    assert numbers.height_limit("least", 19, tops=[20, 14.4], bottoms=[4, 4]) == 18.4
    assert numbers.height_limit("largest", 23, tops=[20, 14.4], bottoms=[4, 4]) == 24


def test_a_design_is_surpassed_only_by_more_of_both():
    assert numbers.surpassing([0.359, 206], others=[[0.4, 150], [0.3, 300], [0.359, 210]]) == 0
    assert numbers.surpassing([0.359, 206], others=[[0.4, 207], [0.5, 300], [0.3, 100]]) == 2


def test_load_of_the_scale_times_gravity_and_length_is_the_torque():
    assert numbers.scale_load(0.359, 94) * 9.80665 * 0.094 == pytest.approx(0.359, rel=1e-12)


def test_any_weights_leave_no_error():
    for q, R in (((1.0, 0.3, 0.0), 1.0), ((2.0, 0.0, 0.5), 7.0)):
        assert numbers.lqr_error(100, q, R, 2.86, 0.7) < 0.01


def test_stretch_by_the_other_area_moves_no_corner():
    """By hand over a grid: the check script has A_c - A_w in the place of A_c in Eq. (3.10)."""
    best = max(
        (
            _pushed_times_bent(Section(a / 4e3, b / 4e3, 0.03, 0.0015)),
            a / 4,
            b / 4,
        )
        for a in range(56, 97)
        for b in range(8, 17)
        if 18 <= (a + b) / 4 <= 24
    )
    assert best[1:] == (20, 4)


def _pushed_times_bent(section):
    area = (section.top - section.wall) * (section.width - 2 * section.wall)
    wall = section.width * section.height - area
    pushed = torque(section, 0.15e6)
    inertia = section.width * section.height**3 / 12
    bent = pushed * 0.094 / (2 * 0.34e6 * inertia) * (1 + 0.15 * (area / wall - 1) / 0.34)
    return pushed * bent * pi


@pytest.mark.parametrize("power", [1.0, 1.5, 2.5])
def test_highest_power_is_that_of_eq_3_10_at_a_pressure_far_above_the_modulus(power):
    finger = Finger(Section(0.020, 0.004, 0.030, 0.0015), fractional_power=power)
    doubled = bending_angle(finger, 2e15) / bending_angle(finger, 1e15)
    assert doubled == pytest.approx(2 ** numbers.highest_power(power), rel=1e-6)
