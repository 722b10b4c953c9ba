"""Elements by finite elements: bars, another formulation, 3-D against rings, bounds, limits."""

from math import pi

import numpy as np
import pytest

from softgrip.actuator.elasticity import Elastic, Solver, nodes, pressure_load, quadratic, stiffness
from softgrip.actuator.finger_mesh import Box, box_mesh
from softgrip.errors import InvalidInputError
from softgrip.tactile.element import SHAPES, Element, compliance
from softgrip.tactile.element_fem import RUBBER, middle_section, solve, solve_body

E = RUBBER.young_modulus
LOOSE = Elastic(E, 0.0)
HALF = {shape: Element(shape, cut=1.0 if shape == "cylinder" else 0.5) for shape in SHAPES}


@pytest.mark.parametrize("shape", SHAPES)
def test_prism_without_lateral_strain_is_a_bar(shape):
    """With nu = 0 the clamp does not hinder: Eq. (2.1) is exact, whatever the mesh."""
    prism = Element(shape, cut=1.0)
    top = solve(prism, 3, LOOSE).top
    found = np.array([top.mean, top.largest, top.plate])
    assert found == pytest.approx(compliance(prism), rel=1e-9)


@pytest.mark.parametrize("shape", ["hemisphere", "pyramid"])
def test_without_lateral_strain_the_equation_is_a_lower_bound(shape):
    """Plane sections are one admissible motion: with nu = 0 the body gives way at least as much."""
    top = solve(HALF[shape], 4, LOOSE).top
    assert top.plate > compliance(HALF[shape])


def test_cylinder_is_stiffer_than_the_equation():
    """The even stress is admissible, so by Castigliano no clamped cylinder gives way more."""
    assert solve(HALF["cylinder"], 8).top.mean < compliance(HALF["cylinder"])


def test_tall_cylinder_is_saint_venants_bar():
    """The clamp counts over about one width only: twice the height adds a free bar's length."""
    short, tall = (Element("cylinder", height=h * 6e-3) for h in (2.0, 4.0))
    added = solve(tall, 24).top.mean - solve(short, 24).top.mean
    # What is left at the clamp's rim depends on the elements' height: 2e-3 with half as many.
    assert added == pytest.approx(compliance(tall) - compliance(short), rel=2e-3)


@pytest.mark.parametrize("shape", SHAPES)
def test_plate_gives_way_less_than_the_mean_and_that_less_than_the_largest(shape):
    top = solve(HALF[shape], 4).top
    assert top.plate < top.mean < top.largest


def test_block_agrees_with_the_mixed_formulation():
    """A quarter of a block by the Q2/P1 pair of Chapter 3, with its own assembly and mesh."""
    n, side, height = 4, 6e-3, 3e-3
    mesh = box_mesh(Box((0, 0, 0), (side / 2, side / 2, height)), side / 2 / n).with_boundaries(
        {
            "base": lambda x: np.isclose(x[2], 0),
            "pressure": lambda x: np.isclose(x[2], height),
            "x": lambda x: np.isclose(x[0], 0),
            "y": lambda x: np.isclose(x[1], 0),
        }
    )
    basis = quadratic(mesh)
    N, base = basis.N, nodes(basis, "base")
    held = [base, base + N, base + 2 * N, nodes(basis, "x"), nodes(basis, "y") + N]
    load = pressure_load(basis, "pressure")
    u = Solver(stiffness(basis, RUBBER), np.concatenate(held)).solve(load, np.zeros_like(load))
    mean = load @ u / (side / 2) ** 2 / side**2
    largest = -u[nodes(basis, "pressure") + 2 * N].min() / side**2
    top = solve(Element("pyramid", cut=1.0), n).top
    # Two ways to relax the volume: the difference is that of meshes like these.
    assert top.mean == pytest.approx(mean, rel=5e-3)
    assert top.largest == pytest.approx(largest, rel=2e-2)


@pytest.mark.parametrize("shape", ["cylinder", "hemisphere"])
def test_body_in_space_agrees_with_rings(shape):
    rings, space = solve(HALF[shape], 12).top, solve_body(HALF[shape], 4).top
    # Flat facets cut off 1 - (sin x) / x = 0.6 % of the disc's area at x = pi / 16.
    assert space.mean == pytest.approx(rings.mean, rel=0.015)
    assert space.largest == pytest.approx(rings.largest, rel=0.015)


def test_small_top_sinks_into_a_half_space():
    """Even pressure on a disc of radius a, Love: the middle by 2 (1 - nu^2) / (pi E a) per N."""
    cut = 0.02
    a = cut * 3e-3
    half_space = 2 * (1 - 0.49**2) / (pi * E * a)
    top = solve(Element("hemisphere", cut=cut), 32).top
    # Around the top the sphere falls off, and below it is clamped: of the order of the cut, 2 %.
    assert top.largest == pytest.approx(half_space, rel=0.02)
    # The mean is 8 / (3 pi) of the middle; the rim converges later (0.4 % at twice as many).
    assert top.mean == pytest.approx(8 / (3 * pi) * half_space, rel=0.025)
    # A rigid plate on it, Sneddon: less, and on any mesh less again (the pressure at its rim).
    assert 0.8 < top.plate * 2 * E * a / (1 - 0.49**2) < 1
    assert top.mean > 5 * compliance(Element("hemisphere", cut=cut))


def test_does_not_lock():
    """Near incompressibility: from nu = 0.49 to 0.4999 little changes, on a coarse mesh too."""
    near = solve(HALF["cylinder"], 4, Elastic(E, 0.4999)).top.mean
    assert near == pytest.approx(solve(HALF["cylinder"], 4).top.mean, rel=0.06)
    assert near == pytest.approx(solve(HALF["cylinder"], 12, Elastic(E, 0.4999)).top.mean, rel=0.01)


def test_scales_as_one_over_modulus_and_length():
    small, large = Element("hemisphere", 6e-3, 3e-3, 0.5), Element("hemisphere", 12e-3, 6e-3, 0.5)
    top = solve(small, 4).top
    assert solve(large, 4, Elastic(2 * E, 0.49)).top.mean == pytest.approx(top.mean / 4, rel=1e-9)


@pytest.mark.parametrize("shape", ["hemisphere", "pyramid"])
def test_middle_section_is_the_profile(shape):
    at, moved = middle_section(solve(HALF[shape], 3))
    assert at.shape == moved.shape == (2, 4, 4)
    assert at[0, 0] == pytest.approx(np.linspace(0, 3e-3, 4))
    assert at[1, :, 0] == pytest.approx(at[1, :, -1])
    assert at[0, -1, -1] == pytest.approx(1.5e-3)
    assert moved[:, 0] == pytest.approx(0)
    # The middle goes straight down, the side outwards.
    assert moved[0, :, 0] == pytest.approx(0)
    assert moved[1, -1, 0] < 0 < moved[0, 1, -1]


@pytest.mark.parametrize("case", [(Element("pyramid", cut=0.0), 2), (Element("cylinder"), 0)])
def test_sharp_tops_and_empty_meshes_are_refused(case):
    with pytest.raises(InvalidInputError, match="cut > 0 and at least 1"):
        solve(*case)
