"""The mould: watertight by counting edges, full of the model's rubber; what cannot be made."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from softgrip.actuator.mould import BED, SHELL, mould, write_mould
from softgrip.actuator.section import Section
from softgrip.actuator.size import Layout, rubber_volume
from softgrip.actuator.stl import Solid, read_stl, write_stl
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.units import MM

DESIGN_1 = Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM)
PARTS = ("upper", "lower", "core")


def closed(solid):
    """Tell whether every edge is walked once each way: a second counting, one edge at a time."""
    edges = Counter()
    for row in solid.triangles.tolist():
        for one, other in zip(row, row[1:] + row[:1], strict=True):
            edges[one, other] += 1
    return all(count == 1 and edges[other, one] == 1 for (one, other), count in edges.items())


def inside(solid, points):
    """Tell which points lie in a solid: the solid angle of its triangles (Van Oosterom, 1983)."""
    turns = np.zeros(len(points))
    for k, point in enumerate(points):
        a, b, c = np.moveaxis(solid.corners - point, 1, 0)
        la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
        top = np.einsum("ij,ij->i", a, np.cross(b, c))
        below = la * lb * lc
        for x, y, far in ((a, b, lc), (b, c, la), (c, a, lb)):
            below = below + np.einsum("ij,ij->i", x, y) * far
        turns[k] = np.arctan2(top, below).sum() / (2 * np.pi)
    return turns > 0.5


@settings(max_examples=15, deadline=None)
@given(
    st.floats(15, 24), st.floats(2, 5), st.floats(14, 30), st.floats(1.5, 2.5), st.integers(1, 6)
)
def test_each_part_is_closed_and_the_cavity_is_the_rubber(a, b, w, t, chambers):
    section, layout = Section(a * MM, b * MM, w * MM, t * MM), Layout(chambers)
    parts = mould(section, layout)
    for name in PARTS:
        solid = getattr(parts, name)
        assert solid.watertight
        assert closed(solid)
        assert solid.size.max() <= BED
    assert parts.cavity * MM**3 == pytest.approx(rubber_volume(section, layout), rel=1e-9)


def test_sizes_by_hand():
    """Design 1: 94 x 30 mm in walls of 3 mm; five fins of 2 x 13 mm; chambers of 10.5 x 27 mm."""
    parts = mould(DESIGN_1, Layout())
    block = 100 * 36
    assert parts.lower.volume == pytest.approx(block * 7 - 94 * 30 * 4, rel=1e-12)
    assert parts.upper.volume == pytest.approx(block * 23 - 94 * 30 * 20 + 5 * 2 * 13 * 30)
    chambers, duct = 6 * 10.5 * 27 * 18.5, (3 + 5 * 5) * 16
    assert parts.core.volume == pytest.approx(block * 3 + chambers + duct, rel=1e-12)


def test_what_is_rubber_and_what_is_not():
    """Points of the upper tray: a groove's fin stands, a chamber's place is free for the core."""
    parts = mould(DESIGN_1, Layout())
    pitch, floor_of_fin = 15.5, 20 - 7
    groove = 3 + 10.5 + 1.5 + 1.0
    points = np.array(
        [
            [groove, 15.0, floor_of_fin - 0.5], [groove, 15.0, floor_of_fin + 0.5],
            [3 + 5.25, 15.0, 10.0], [-SHELL / 2, 15.0, 10.0], [groove + pitch, 15.0, 1.0],
        ]
    )  # fmt: skip
    assert inside(parts.upper, points).tolist() == [True, False, False, True, True]
    plugs = np.array([[3 + 5.25, 15.0, 18.0], [3 + 5.25, 15.0, 19.0], [1.5, 15.0, 2.0],
                      [1.5, 15.0, 5.0], [92.5, 15.0, 2.0]])  # fmt: skip
    assert inside(parts.core, plugs).tolist() == [True, False, True, False, False]


def test_files_hold_what_was_made(tmp_path):
    parts = mould(DESIGN_1, Layout())
    for path, name in zip(write_mould(DESIGN_1, Layout(), tmp_path / "new"), PARTS, strict=True):
        again = read_stl(path)
        assert closed(again)
        assert again.volume == pytest.approx(getattr(parts, name).volume, rel=1e-6)
        head = path.read_bytes()[:80].decode().strip()
        assert head == f"softgrip mould, {name}, in mm"
        assert not head.startswith("solid")  # so begins an STL file in text


@pytest.mark.parametrize(
    ("section", "layout", "told"),
    [
        (DESIGN_1, Layout(length=0.25), "bed of 200 mm"),
        (DESIGN_1, Layout(groove=0.5 * MM), "groove"),
        (replace(DESIGN_1, wall=0.5 * MM), Layout(), "wall"),
        (replace(DESIGN_1, wall=16 * MM), Layout(), "wall"),
        (replace(DESIGN_1, bottom=0.9 * MM), Layout(), "bottom"),
        (replace(DESIGN_1, top=8 * MM), Layout(), "groove_floor"),
        (DESIGN_1, Layout(chambers=20), "room for 20"),
        (Section(20.0, 4.0, 30.0, 1.5), Layout(), "probably mm"),
    ],
)
def test_what_cannot_be_made_is_refused(section, layout, told):
    with pytest.raises(InvalidInputError, match=told):
        mould(section, layout)


def test_a_solid_with_a_hole_is_not_written(tmp_path):
    whole = mould(DESIGN_1, Layout(1)).lower
    torn = Solid(whole.points, whole.triangles[1:])
    assert not torn.watertight
    with pytest.raises(InvalidInputError, match="watertight"):
        write_stl(torn, tmp_path / "torn.stl", "torn")
    assert not (tmp_path / "torn.stl").exists()


def test_a_torn_file_is_said(tmp_path):
    path = write_stl(mould(DESIGN_1, Layout(1)).lower, tmp_path / "lower.stl", "lower")
    path.write_bytes(path.read_bytes()[:-7])
    with pytest.raises(DataFileError, match="a whole binary STL file"):
        read_stl(path)
