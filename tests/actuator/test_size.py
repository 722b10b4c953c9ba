"""Rubber, air and box of a finger: the mesh of its finite elements is the other way to them."""

import casadi as ca
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.actuator.finger_mesh import FingerShape, finger_mesh
from softgrip.actuator.frequency import rubber_mass
from softgrip.actuator.section import Section
from softgrip.actuator.size import (
    Layout,
    air_volume,
    check_layout,
    envelope,
    finger_mass,
    layout_of,
    rubber_volume,
)
from softgrip.errors import InvalidInputError
from softgrip.units import MM

DESIGN_1 = Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM)


@pytest.mark.parametrize("chambers", [1, 2, 5])
def test_rubber_is_that_of_the_mesh(chambers):
    """Elements are boxes, so that their sum is exact; the mesh is of half a finger, no duct."""
    layout = Layout(chambers, duct=0.0)
    shape = FingerShape(DESIGN_1, chambers, groove_floor=layout.groove_floor)
    mesh = finger_mesh(shape, 20 * MM)
    low, high = (end(mesh.p[:, mesh.t], axis=1) for end in (np.min, np.max))
    assert rubber_volume(DESIGN_1, layout) == pytest.approx(
        2 * np.prod(high - low, axis=0).sum(), rel=1e-12
    )
    assert air_volume(DESIGN_1, layout) == pytest.approx(
        np.prod([18.5, 27.0, chambers * shape.chamber_length / MM]) * MM**3, rel=1e-12
    )


def test_duct_by_hand():
    """Design 1: five dividers of 5 mm and a cap of 3 mm are pierced by 4 mm x 4 mm."""
    pierced = air_volume(DESIGN_1, Layout()) - air_volume(DESIGN_1, Layout(duct=0.0))
    assert pierced == pytest.approx((5 * 5 + 3) * 16 * MM**3, rel=1e-12)


def test_a_wall_without_caps_and_grooves_is_that_of_remark_2():
    layout = Layout(1, cap=1e-12, duct=0.0)
    found = finger_mass(DESIGN_1, layout, 1080.0)
    assert found == pytest.approx(rubber_mass(DESIGN_1, layout.length, 1080.0), rel=1e-9)


dimensions = st.tuples(
    st.floats(14, 24), st.floats(2, 5), st.floats(10, 30), st.floats(1.5, 3.0)
).map(lambda x: [one * MM for one in x])


@given(dimensions, st.integers(1, 8), st.integers(0, 3), st.floats(1e-4, 0.2))
def test_what_grows_with_what(dimension, chambers, which, by):
    """The ground of the certificates, by differences in the whole box of Section 3.3."""
    layout, other = layout_of(chambers), list(dimension)
    other[which] *= 1 + by
    if other[3] > 3 * MM:
        return
    before, after = Section(*dimension), Section(*other)
    assert rubber_volume(after, layout) > rubber_volume(before, layout)
    signs = np.sign([f(after, layout) - f(before, layout) for f in (envelope, air_volume)]).tolist()
    assert signs == [[1, 1], [1, 0], [1, 1], [0, -1]][which]


def test_symbols_give_what_numbers_do():
    x = ca.SX.sym("x", 4)
    law = ca.Function("f", [x], [rubber_volume(Section(*ca.vertsplit(x)), Layout())])
    sides = [DESIGN_1.top, DESIGN_1.bottom, DESIGN_1.width, DESIGN_1.wall]
    assert float(law(sides)) == pytest.approx(rubber_volume(DESIGN_1, Layout()), rel=1e-14)


@pytest.mark.parametrize(
    ("layout", "told"),
    [
        ({"chambers": 0}, "chambers"),
        ({"length": -1.0}, "length"),
        ({"chambers": 40}, "room for 40"),
        ({"duct": 28 * MM}, "duct"),
        ({"groove_floor": 3 * MM}, "groove_floor"),
        ({"groove_floor": 19 * MM}, "groove_floor"),
    ],
)
def test_a_finger_that_is_none_is_refused(layout, told):
    with pytest.raises(InvalidInputError, match=told):
        check_layout(Layout(**layout), DESIGN_1)
