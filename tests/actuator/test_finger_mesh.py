"""Meshes of half a finger: volumes, walls and refused sizes, against hand calculation."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from skfem import Basis, ElementHex0, FacetBasis

from softgrip.actuator.finger_mesh import FingerShape, finger_mesh, grid_lines
from softgrip.actuator.section import Section, wall_area
from softgrip.errors import InvalidInputError
from softgrip.units import MM

DESIGN_1 = Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM)


def volume(mesh):
    return Basis(mesh, ElementHex0()).dx.sum()


def walls(mesh, boundary):
    """Area of a boundary, and the integral of its outward normal."""
    facets = FacetBasis(mesh, ElementHex0(), facets=mesh.boundaries[boundary])
    return facets.dx.sum(), (facets.normals * facets.dx).sum(axis=(1, 2))


def test_beam_has_the_volume_of_walls_and_caps():
    shape = FingerShape(DESIGN_1)
    expected = wall_area(DESIGN_1) * shape.chamber_length + 2 * 3 * MM * 24 * MM * 30 * MM
    assert 2 * volume(finger_mesh(shape, 5 * MM)) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("floor", [0.0, 3 * MM])
def test_chambers_have_the_volume_of_what_is_cut_out(floor):
    shape = FingerShape(DESIGN_1, 6, groove_floor=floor)
    # 94 mm less two caps of 3 mm and five dividers of 1.5 + 2 + 1.5 mm, over six chambers.
    assert shape.chamber_length == pytest.approx(10.5 * MM)
    chambers, grooves = 6 * 10.5 * 18.5 * 27, 5 * 2 * (20 - floor / MM) * 30
    expected = (94 * 24 * 30 - chambers - grooves) * MM**3
    assert 2 * volume(finger_mesh(shape, 5 * MM)) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("chambers", "length"), [(1, 88.0), (6, 10.5)])
def test_pressure_walls_close_each_chamber(chambers, length):
    area, normal = walls(finger_mesh(FingerShape(DESIGN_1, chambers), 5 * MM), "pressure")
    one = 2 * 18.5 * 13.5 + 2 * 13.5 * length + 18.5 * length  # ends, floor and top, side
    assert area == pytest.approx(chambers * one * MM**2, rel=1e-12)
    # Half a closed chamber: all cancels but the side, which faces inwards.
    np.testing.assert_allclose(normal, [0, 0, -chambers * 18.5 * length * MM**2], atol=1e-12)


def test_ends_and_plane_of_symmetry_are_whole():
    mesh = finger_mesh(FingerShape(DESIGN_1, 6), 5 * MM)
    assert walls(mesh, "base")[0] == pytest.approx(24 * 15 * MM**2)
    assert walls(mesh, "tip")[0] == pytest.approx(24 * 15 * MM**2)
    cut = 94 * 24 - 6 * 10.5 * 18.5 - 5 * 2 * 20
    assert walls(mesh, "symmetry")[0] == pytest.approx(cut * MM**2)


@given(st.lists(st.integers(0, 50), min_size=2, max_size=6, unique=True), st.floats(0.3, 20))
def test_grid_lines_lie_on_all_breaks_and_no_farther_apart_than_asked(breaks, size):
    lines = grid_lines([float(x) for x in breaks], size)
    assert np.diff(lines).min() > 0
    assert np.diff(lines).max() <= size * (1 + 1e-6)
    assert all(np.isclose(lines, x).any() for x in breaks)


@pytest.mark.parametrize(
    ("name", "changed"),
    [
        ("wall", {"section": Section(20 * MM, 4 * MM, 30 * MM, 15 * MM)}),
        ("bottom", {"section": Section(20 * MM, 0.0, 30 * MM, 1.5 * MM)}),
        ("chambers", {"chambers": 0}),
        ("cap", {"cap": -1 * MM}),
        ("groove_width", {"groove_width": 0.0}),
        ("groove_floor", {"groove_floor": 18.5 * MM}),
        ("length", {"chambers": 20}),
        ("length", {"cap": 47 * MM}),
    ],
)
def test_shape_without_chambers_is_refused(name, changed):
    with pytest.raises(InvalidInputError, match=name):
        FingerShape(**{"section": DESIGN_1, **changed})


@pytest.mark.parametrize("size", [0.0, -1 * MM, 94 * MM, np.nan])
def test_size_that_makes_no_elements_is_refused(size):
    with pytest.raises(InvalidInputError, match="size"):
        finger_mesh(FingerShape(DESIGN_1), size)
