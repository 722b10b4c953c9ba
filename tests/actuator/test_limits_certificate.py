"""Certified designs within limits: brute force, a second optimum and hand-made lies as oracles."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from softgrip.actuator import limits_certificate as module
from softgrip.actuator.certificate import certified_design
from softgrip.actuator.design import Bounds, DesignProblem, FrequencyBand
from softgrip.actuator.limits import LimitedProblem, Limits, measures, ranges
from softgrip.actuator.limits_certificate import (
    NAMES,
    NothingWithinLimitsError,
    best_within,
    inside,
    upper_bound,
)
from softgrip.actuator.section import Section
from softgrip.errors import InvalidInputError
from softgrip.materials.table import table_5_1
from softgrip.units import ML, MM

NEEDS = Limits(mass=0.022, angle=1.5, air=16 * ML, envelope=45e3 * MM**3, buckling=1.0)
PROBLEM = LimitedProblem.for_material(
    "Dragon Skin 20", limits=NEEDS, pressure=0.12e6, band=FrequencyBand(0.3, 0.9)
)


def drawn(count, seed=0, bounds=None):
    """Return sections all over the box, b above t."""
    rng, bounds = np.random.default_rng(seed), bounds or Bounds()
    a, b, w, t = (
        rng.uniform(*getattr(bounds, name), count) for name in ("top", "bottom", "width", "wall")
    )
    good = b > t * (1 + 1e-6)
    return Section(a[good], b[good], w[good], t[good])


@st.composite
def problems(draw):
    limits = Limits(
        mass=draw(st.floats(0.012, 0.04)),
        angle=draw(st.sampled_from([0.0, 1.5])),
        air=draw(st.sampled_from([np.inf, 15 * ML])),
        envelope=draw(st.sampled_from([np.inf, 50e3 * MM**3])),
        buckling=draw(st.sampled_from([0.0, 1.0])),
    )
    return LimitedProblem.for_material(
        draw(st.sampled_from([*table_5_1()])),
        draw(st.sampled_from([4, 6])),
        limits=limits,
        pressure=draw(st.floats(2e4, 1.5e5)),
        combined=draw(st.sampled_from(["sum", "product", "torque"])),
        band=draw(st.sampled_from([None, FrequencyBand(0.2, 2.0)])),
    )


@settings(max_examples=40, deadline=None)
@given(problems(), st.integers(0, 999), st.floats(0.005, 0.5), st.integers(0, 99))
def test_no_section_of_a_box_exceeds_its_bound(limited, seed, wide, luck):
    """A thousand sections in a drawn box, for multipliers of any size."""
    rng = np.random.default_rng(luck)
    one = drawn(20, seed)
    centre = np.array([x[0] for x in (one.top, one.bottom, one.width, one.wall)])
    bounds = limited.problem.bounds
    ends = np.array([bounds.top, bounds.bottom, bounds.width, bounds.wall])
    low = np.maximum(centre * (1 - wide), ends[:, 0])
    high = np.minimum(centre * (1 + wide), ends[:, 1])
    some = Section(*(rng.uniform(low, high, (1000, 4)).T))
    good = (some.bottom > some.wall) & inside(limited, some, 0.0)
    if not good.any():
        return
    values = measures(limited, Section(*(x[good] for x in (some.top, some.bottom, some.width,
                                                           some.wall))))["objective"]  # fmt: skip
    box = np.array([low, high]).T.reshape(8, 1)
    for size in (0.0, 1.0):
        multipliers = size * rng.normal(size=2 + len(NAMES))
        bound, _ = upper_bound(limited, box, multipliers)
        assert values.max() <= bound[0] * (1 + 1e-9)
        # The proof that there is none must not hold where there is one.
        assert upper_bound(limited, box, multipliers, violated=True)[0][0] > -np.inf


def test_without_limits_it_is_the_certified_design():
    problem = DesignProblem(fractional_power=2.0, band=FrequencyBand(0.4, 0.8))
    known = certified_design(problem).design
    found = best_within(LimitedProblem(problem))
    assert found.proven
    assert found.values["objective"] == pytest.approx(known.objective, rel=1e-5)
    assert found.section.top == pytest.approx(known.section.top, rel=1e-4)


@pytest.mark.parametrize(
    "limited",
    [
        PROBLEM,
        replace(PROBLEM, problem=replace(PROBLEM.problem, band=None, combined="torque")),
        PROBLEM.within(buckling=0.0, mass=np.inf),
    ],
)
def test_brute_force_finds_nothing_better(limited):
    found = best_within(limited)
    assert found.proven
    assert inside(limited, found.section)
    some = drawn(200_000, seed=3)
    value = np.where(inside(limited, some, 0.0), measures(limited, some)["objective"], 0.0)
    assert 0 < value.max() <= found.upper_bound
    assert value.max() > 0.8 * found.values["objective"]  # the draw comes near: it says something


def test_another_solver_reaches_it_and_no_more():
    """SLSQP from drawn starts, with the limits as they are and derivatives by differences."""
    limited = PROBLEM
    found, known = best_within(limited), ranges(limited)
    bounds = limited.problem.bounds

    def slacks(x):
        section = Section(*(x * MM))
        values = measures(limited, section)
        ends = {**known, "height": bounds.height}
        each = [
            (values.get(name, section.height) / end - 1) * sign
            for name, (low, high) in ends.items()
            for end, sign in ((low, 1), (high, -1))
            if 0 < end < np.inf
        ]
        return np.array([*each, section.bottom / section.wall - 1.001])

    best = 0.0
    starts = drawn(12, seed=5)
    for k in range(starts.top.size):
        x0 = np.array([starts.top[k], starts.bottom[k], starts.width[k], starts.wall[k]]) / MM
        with np.errstate(all="ignore"):
            solved = minimize(
                lambda x: -measures(limited, Section(*(x * MM)))["objective"], x0, method="SLSQP",
                bounds=np.array([bounds.top, bounds.bottom, bounds.width, bounds.wall]) / MM,
                constraints={"type": "ineq", "fun": slacks}, options={"ftol": 1e-10},
            )  # fmt: skip
            if solved.success and (slacks(solved.x) >= -1e-8).all():
                best = max(best, -solved.fun)
    assert best == pytest.approx(found.values["objective"], rel=1e-5)


def test_a_worse_section_is_refuted():
    """A proposal that is feasible and no optimum: branch and bound meets a better one."""
    best = best_within(PROBLEM)
    worse = replace(best.section, width=best.section.width * 0.97)
    value = float(measures(PROBLEM, worse)["objective"])
    proposal = module._Proposal(worse, value, np.zeros(2 + len(NAMES)))
    _, _, better = module._search(PROBLEM, proposal, value * (1 + 1e-5))
    assert better is not None
    assert better.objective > value * (1 + 1e-5)


@pytest.mark.parametrize(
    "limits",
    [{"mass": 0.004}, {"mass": 0.012, "torque": 0.2}, {"air": 2 * ML}, {"angle": 8.0}],
)
def test_what_cannot_be_had_is_proved_so(limits):
    limited = LimitedProblem.for_material("Dragon Skin 30", limits=Limits(**limits))
    with pytest.raises(NothingWithinLimitsError, match="proved"):
        best_within(limited)
    some = drawn(50_000, seed=1)
    assert not inside(limited, some, 0.0).any()


def test_what_is_just_feasible_is_found():
    """The least mass is that of the least corner; a little above it there is a section."""
    least = Section(14 * MM, 2 * MM, 10 * MM, 1.5 * MM)
    limited = LimitedProblem()
    mass = float(measures(limited, least)["mass"])
    assert best_within(limited.within(mass=mass * 1.0001)).proven
    with pytest.raises(NothingWithinLimitsError):
        best_within(limited.within(mass=mass * 0.9999))


@pytest.mark.parametrize(
    ("made", "told"),
    [
        (lambda: Limits(mass=0.0), "mass"),
        (lambda: Limits(mass="3 mm"), "mass"),
        (lambda: Limits(angle=-1.0), "angle"),
        (lambda: LimitedProblem(density=-1.0), "density"),
        (lambda: LimitedProblem(DesignProblem(length=0.1)), "layout"),
        (lambda: LimitedProblem(DesignProblem(bounds=Bounds(width=(7e-3, 30e-3)))), "layout"),
        (lambda: best_within(LimitedProblem(), tolerance=0.0), "tolerance"),
    ],
)
def test_numbers_out_of_range_are_refused(made, told):
    with pytest.raises(InvalidInputError, match=told):
        made()
