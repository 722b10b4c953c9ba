"""The optimal design of Eq. (3.17) and (3.20): bounds, solver, rounding, certificate."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import differential_evolution

from softgrip.actuator import optimize
from softgrip.actuator.certificate import certified_design, certify, upper_bound
from softgrip.actuator.design import (
    DIMENSIONS,
    Bounds,
    DesignProblem,
    FrequencyBand,
    InfeasibleDesignError,
    check_feasible,
    objective,
    product,
)
from softgrip.actuator.frequency import natural_frequency, spring_constant
from softgrip.actuator.optimize import evaluate, manufacturable, optimal_design
from softgrip.actuator.section import Section
from softgrip.errors import InvalidInputError, UnknownNameError

PRINTED = Bounds(top=(0.014, 0.020), bottom=(0.002, 0.004))
"""With the printed optimum's a and b as upper bounds."""


@st.composite
def problems(draw):
    n = draw(st.floats(1.0, 2.6))
    problem = DesignProblem(
        pressure=draw(st.floats(0.02e6, 0.3e6)),
        young_modulus=draw(st.floats(0.06e6, 0.6e6)),
        fractional_power=n,
        torque_scale=draw(st.floats(0.1, 1.0)),
        angle_scale=draw(st.floats(0.5, 8.0)),
        bounds=draw(st.sampled_from([Bounds(), PRINTED])),
        combined=draw(st.sampled_from(["sum", "product"])),
    )
    if draw(st.booleans()):
        # A band within what the box allows, by the frequency of two of its sections.
        low, high = sorted(draw(st.floats(0.05, 0.95)) for _ in range(2))
        slow = natural_frequency(problem.finger(Section(0.014, 0.003, 0.012, 0.0015)), 0.36)
        fast = natural_frequency(problem.finger(Section(0.020, 0.004, 0.03, 0.0015)), 0.36)
        band = FrequencyBand(*(slow + x * (fast - slow) for x in (low, high)))
        problem = replace(problem, band=band)
    return problem


def _random_sections(problem, count, seed):
    """Sections that fulfil all constraints, drawn and sieved."""
    rng, bounds = np.random.default_rng(seed), problem.bounds
    drawn = Section(*(rng.uniform(*getattr(bounds, name), count) for name in DIMENSIONS))
    first, last = problem.product_range
    value, height = product(problem, drawn), drawn.height
    good = (height >= bounds.height[0]) & (height <= bounds.height[1])
    good &= (value >= first) & (value <= last) & (drawn.bottom > drawn.wall)
    return Section(*(getattr(drawn, name)[good] for name in DIMENSIONS))


@settings(max_examples=40)
@given(problems(), st.integers(0, 99))
def test_no_section_is_better_than_the_certified_one(problem, seed):
    found = certified_design(problem, tolerance=1e-4).certificate
    assert found.proven
    others = objective(problem, _random_sections(problem, 3000, seed))
    assert others.size == 0 or others.max() <= found.upper_bound * (1 + 1e-9)


@settings(max_examples=30)
@given(problems(), st.integers(0, 99))
def test_a_bound_holds_in_its_box(problem, seed):
    """The bound of a part of the box against sections drawn within that part."""
    points = _random_sections(problem, 500, seed)
    if points.top.size == 0:
        return
    part = np.array([points.top[0], points.bottom[0]])
    box = np.array([part[0], part[0] * 1.05, part[1], part[1] * 1.1])[:, None]
    inside = (points.top >= box[0]) & (points.top <= box[1])
    inside &= (points.bottom >= box[2]) & (points.bottom <= box[3])
    values = objective(problem, points)[inside]
    assert values.max() <= upper_bound(problem, box)[0] * (1 + 1e-12)


@pytest.mark.parametrize("combined", ["sum", "product"])
def test_the_bound_of_a_point_is_its_objective(combined):
    problem = DesignProblem(fractional_power=1.5, combined=combined)
    section = Section(0.019, 0.0035, problem.bounds.width[1], problem.bounds.wall[0])
    box = np.array([[section.top, section.top, section.bottom, section.bottom]]).T
    bound = upper_bound(problem, box)[0]
    assert bound == pytest.approx(objective(problem, section), rel=1e-12)


def test_sum_and_product_are_of_the_two_shares():
    problem, section = DesignProblem(fractional_power=1.5), Section(0.019, 0.0035, 0.030, 0.0015)
    found = evaluate(problem, section)
    shares = found.torque / problem.torque_scale, found.angle / problem.angle_scale
    assert found.objective == pytest.approx(sum(shares), rel=1e-12)
    other = evaluate(replace(problem, combined="product"), section)
    assert other.objective == pytest.approx(shares[0] * shares[1], rel=1e-12)


@settings(max_examples=25)
@given(problems())
def test_objective_falls_with_the_wall_and_grows_with_the_width(problem):
    """What solver and certificate take as proved, by exact derivatives at drawn sections."""
    import casadi as ca

    x = ca.SX.sym("x", 4)
    slope = ca.Function("g", [x], [ca.gradient(objective(problem, Section(*ca.vertsplit(x))), x)])
    drawn = _random_sections(replace(problem, band=None), 50, 1)
    for k in range(drawn.top.size):
        found = np.array(slope([float(getattr(drawn, name)[k]) for name in DIMENSIONS])).ravel()
        assert found[2] > 0
        assert found[3] < 0


def test_differential_evolution_finds_nothing_better():
    """Eq. (3.20) by a global search on the four dimensions, with the band as a penalty."""
    problem = DesignProblem(fractional_power=1.05, band=FrequencyBand(1.6, 1.8))
    design = optimal_design(problem)
    first, last = problem.product_range
    bounds = problem.bounds

    def cost(x):
        section = Section(*x)
        value, height = product(problem, section), section.height
        if section.bottom <= section.wall:  # bends backwards: no angle
            return 1e3
        outside = (
            max(0.0, value / last - 1)
            + max(0.0, 1 - value / first)
            + max(0.0, height / bounds.height[1] - 1)
            + max(0.0, 1 - height / bounds.height[0])
        )
        return -float(objective(problem, section)) + 100 * outside

    found = differential_evolution(
        cost, [getattr(bounds, name) for name in DIMENSIONS], seed=1, tol=1e-10, maxiter=400
    )
    assert -found.fun <= design.objective * (1 + 1e-6)
    assert -found.fun == pytest.approx(design.objective, rel=1e-3)


@pytest.mark.parametrize("n", [1.0, 1.05, 1.538, 2.5])
@pytest.mark.parametrize("banded", [False, True])
def test_the_optimum_does_not_hang_on_the_start(n, banded):
    problem = DesignProblem(fractional_power=n)
    if banded:
        # A mass with which the printed optimum lies above the band, so that the band cuts the box.
        stiffness = spring_constant(problem.finger(Section(0.020, 0.004, 0.030, 0.0015)))
        mass = stiffness / 2.2**2
        problem = replace(problem, band=FrequencyBand(1.6, 1.8, mass, mass))
    rng = np.random.default_rng(3)
    best = optimal_design(problem)
    for _ in range(20):
        # Also sections that bend backwards, b < t, and far outside the box.
        start = Section(*(rng.uniform(0.1, 3) * getattr(problem.bounds, d)[1] for d in DIMENSIONS))
        found = optimal_design(problem, start)
        assert found.objective == pytest.approx(best.objective, rel=1e-6)
        assert found.iterations <= 10


def test_a_start_that_bends_backwards_is_taken():
    backwards = Section(0.014, 0.002, 0.030, 0.003)
    found = optimal_design(DesignProblem(fractional_power=2.5, bounds=PRINTED), backwards)
    assert found.section.bottom == pytest.approx(0.004, rel=1e-6)


def test_width_and_wall_left_to_the_designer_are_those_that_the_optimum_has():
    """Eq. (6.8), a and b alone on a fine grid, does as well as the search over four dimensions."""
    problem = DesignProblem(fractional_power=1.05, bounds=PRINTED, band=FrequencyBand(1.6, 1.8))
    a, b = np.linspace(0.014, 0.020, 601)[:, None], np.linspace(0.002, 0.004, 201)
    sections = Section(a, b, 0.030, 0.0015)
    (first, last), values = problem.product_range, product(problem, sections)
    good = (values >= first) & (values <= last) & (a + b >= 0.015) & (a + b <= 0.025)
    best = np.where(good, objective(problem, sections), 0).max()
    # Steps of 10 um, along a constraint that fixes a + b: some 1e-3 of the objective.
    assert optimal_design(problem).objective == pytest.approx(best, rel=2e-3)
    assert optimal_design(problem).objective >= best * (1 - 1e-6)


@given(st.floats(1, 2.6), st.floats(0.1, 1.0), st.integers(0, 99))
def test_the_band_of_products_is_the_band_of_frequencies(n, mass, seed):
    """Eq. (3.21) with the ends of Eq. (3.23) holds where omega_n is between both frequencies."""
    problem = DesignProblem(
        fractional_power=n, band=FrequencyBand(2.0, 3.0, least_mass=mass, largest_mass=mass)
    )
    sections = _random_sections(replace(problem, band=None), 50, seed)
    frequency = natural_frequency(problem.finger(sections), mass)
    value, (first, last) = product(problem, sections), problem.product_range
    inside = (first <= value) & (value <= last)
    np.testing.assert_array_equal(inside, (frequency >= 2.0) & (frequency <= 3.0))


def test_ends_of_the_band_by_hand():
    """Eq. (3.23) at n = 1: ``1/2 * 4 * 3 * M omega**2 L**2``, each end with its mass."""
    problem = DesignProblem(band=FrequencyBand(2.5, 3.5, least_mass=0.3, largest_mass=0.4))
    expected = [6 * 0.3 * 2.5**2 * 0.094**2, 6 * 0.4 * 3.5**2 * 0.094**2]
    assert problem.product_range == pytest.approx(expected)


@given(st.floats(1, 2.6), st.integers(0, 99))
def test_no_section_of_the_box_is_stiffer_or_softer_than_its_corners(n, seed):
    """Eq. (3.22): the product lies between those of the smallest and the largest a, b and w."""
    problem = DesignProblem(fractional_power=n)
    drawn = product(problem, _random_sections(problem, 500, seed))
    bounds = problem.bounds
    ends = [
        product(problem, Section(*(getattr(bounds, name)[end] for name in DIMENSIONS)))
        for end in (0, 1)
    ]
    assert ends[0] <= drawn.min()
    assert drawn.max() <= ends[1]


def test_the_printed_optimum_hits_its_bounds():
    """Eq. (3.17) gives Table 3.1's b = 4.0 mm if that is its bound; with the stated 5 it is 5."""
    stated = optimal_design(DesignProblem())
    printed = optimal_design(DesignProblem(bounds=PRINTED))
    assert stated.section.bottom == pytest.approx(0.005, rel=1e-6)
    assert "bottom <= 0.005 m" in stated.active
    assert printed.section.bottom == pytest.approx(0.004, rel=1e-6)
    assert stated.objective > printed.objective


def test_the_certificate_refuses_a_design_that_is_not_the_best():
    problem = DesignProblem(bounds=PRINTED)
    worse = evaluate(problem, Section(0.0195, 0.004, 0.030, 0.0015))
    found = certify(problem, worse)
    assert not found.proven
    assert objective(problem, found.better) > worse.objective


def test_a_local_peak_is_refuted_and_left():
    """Two peaks, at the smallest and at the largest height; IPOPT from the middle takes the less.

    The objective on a fine grid, wall and width at their proved ends, is the oracle.
    """
    problem = DesignProblem(
        pressure=20e3, young_modulus=365859.0, fractional_power=1.5, torque_scale=1, angle_scale=8
    )
    local = optimal_design(problem)
    a, b = np.linspace(0.014, 0.024, 401)[:, None], np.linspace(0.002, 0.005, 301)
    values = np.where(a + b <= 0.025, objective(problem, Section(a, b, 0.03, 0.0015)), 0)
    assert local.objective < values.max()
    assert certify(problem, local).better is not None
    found = certified_design(problem)
    assert found.certificate.proven
    assert found.design.objective == pytest.approx(values.max(), rel=1e-5)


@settings(max_examples=20)
@given(problems())
def test_rounding_keeps_every_constraint(problem):
    fine = {"top": 2e-4, "bottom": 2e-4, "width": 5e-4, "wall": 2.5e-4}
    try:
        rounded = manufacturable(problem, fine)
    except InfeasibleDesignError:
        return  # a band narrower than a step
    first, last = problem.product_range
    assert first * (1 - 1e-8) <= product(problem, rounded.section) <= last * (1 + 1e-8)
    best = certified_design(problem, tolerance=1e-4)
    assert rounded.objective <= best.certificate.upper_bound * (1 + 1e-9)


def test_rounding_gives_the_whole_millimetres_of_table_3_1():
    section = manufacturable(DesignProblem(bounds=PRINTED)).section
    assert [round(1e3 * getattr(section, d), 6) for d in DIMENSIONS] == [20.0, 4.0, 30.0, 1.5]


def test_an_infeasible_band_names_the_nearest_feasible_one():
    problem = DesignProblem(fractional_power=1.05, band=FrequencyBand(4.0, 5.0))
    with pytest.raises(InfeasibleDesignError, match=r"frequency band.*nearest band") as raised:
        optimal_design(problem)
    # What it calls the fastest feasible frequency is feasible, and a little more is not.
    fastest = float(str(raised.value).split(" to ")[-1].split()[0])
    check_feasible(replace(problem, band=FrequencyBand(fastest * 0.999, 5.0)))
    with pytest.raises(InfeasibleDesignError):
        check_feasible(replace(problem, band=FrequencyBand(fastest * 1.001, 5.0)))


def test_heights_and_bottoms_that_cannot_be_met_are_named():
    with pytest.raises(InfeasibleDesignError, match="height"):
        optimal_design(DesignProblem(bounds=Bounds(height=(0.035, 0.040))))
    with pytest.raises(InfeasibleDesignError, match="bottom"):
        optimal_design(DesignProblem(bounds=Bounds(bottom=(0.0005, 0.0012))))


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: Bounds(top=(0.02, 0.01)), "top"),
        (lambda: Bounds(wall=(-0.001, 0.003)), "wall"),
        (lambda: Bounds(width=(0.003, 0.03)), "width"),
        (lambda: DesignProblem(pressure=0.0), "pressure"),
        (lambda: DesignProblem(fractional_power=0.5), "fractional_power"),
        (lambda: DesignProblem(combined="ratio"), "combined"),
        (lambda: FrequencyBand(3.0, 2.0), "low, high"),
        (lambda: manufacturable(DesignProblem(), {"top": 0.001}), "steps"),
    ],
)
def test_impossible_problems_are_refused(make, name):
    with pytest.raises(InvalidInputError, match=f"^{name}: expected"):
        make()


def test_an_unknown_material_lists_those_that_are():
    with pytest.raises(UnknownNameError, match="Dragon Skin 20"):
        DesignProblem.for_material("Dragon Skin 21")


def test_a_solver_that_gives_up_says_so(monkeypatch):
    import casadi as ca

    x, p = ca.SX.sym("x", 3), ca.SX.sym("p", 7)
    few = {**optimize.OPTIONS, "ipopt.max_iter": 0}
    program = {"x": x, "p": p, "f": ca.sumsqr(x - 1), "g": ca.vertcat(x[0], x[1])}
    stuck = ca.nlpsol("stuck", "ipopt", program, few)
    monkeypatch.setattr(optimize, "_solver", lambda combined: stuck)
    with pytest.raises(optimize.SolverError, match="iterations"):
        optimal_design(DesignProblem(angle_scale=pi))
