"""Solids of triangles: whether they are watertight, what they hold, and their files for a printer.

An STL file has no unit. What prints it takes its numbers for millimetres, by convention; so these
solids are in millimetres, unlike all else here, and the file's first line says so.
"""

import struct
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.files import existing

HEADER = 80
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attributes", "<u2")])
"""Of a binary STL file: 50 bytes a triangle."""


@dataclass(frozen=True, eq=False)
class Solid:
    """A body bounded by triangles, in mm.

    Attributes:
        points: Corners, mm, shape (N, 3).
        triangles: Rows of `points`, anticlockwise seen from outside, shape (M, 3).
    """

    points: Floats
    triangles: NDArray[np.int64]

    @property
    def corners(self) -> Floats:
        """Corners of each triangle, mm, shape (M, 3, 3)."""
        return self.points[self.triangles]

    @property
    def volume(self) -> float:
        """Volume, mm^3: of the tetrahedra between the triangles and the origin (Gauss)."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)

    @property
    def size(self) -> Floats:
        """Sides of the box around it, mm, shape (3,)."""
        return np.asarray(np.ptp(self.points, axis=0))

    @property
    def watertight(self) -> bool:
        """Whether each edge is passed as often one way as the other, and no triangle is a line."""
        edges = np.concatenate([self.triangles[:, [i, (i + 1) % 3]] for i in range(3)])
        there, back = np.unique(edges, axis=0), np.unique(edges[:, ::-1], axis=0)
        once = len(there) == len(edges)
        return bool(len(edges) and once and np.array_equal(there, back))


def write_stl(solid: Solid, path: Path, about: str) -> Path:
    """Write a binary STL file, in mm, and return its path.

    Args:
        solid: It must be watertight.
        path: Of the file; its folder is made.
        about: What it is, in ASCII; the file begins with it and with the unit.

    Raises:
        InvalidInputError: If the solid is not watertight.
    """
    if not solid.watertight:
        raise InvalidInputError("solid", expected="one that is watertight", got=about)
    a, b, c = np.moveaxis(solid.corners, 1, 0)
    normal = np.cross(b - a, c - a)
    rows = np.zeros(len(solid.triangles), TRIANGLE)
    rows["normal"] = normal / np.linalg.norm(normal, axis=1)[:, None]
    rows["corners"] = solid.corners
    head = f"{about}, in mm".encode("ascii", "replace")[:HEADER].ljust(HEADER)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(head + struct.pack("<I", len(rows)) + rows.tobytes())
    return path


def read_stl(path: Path) -> Solid:
    """Read a binary STL file; corners at one place are one point.

    Raises:
        DataFileError: If it is none, or is torn.
    """
    existing(path)
    content = path.read_bytes()
    count = struct.unpack_from("<I", content, HEADER)[0] if len(content) >= HEADER + 4 else -1
    if len(content) != HEADER + 4 + count * TRIANGLE.itemsize:
        raise DataFileError(path, expected="a whole binary STL file", got=f"{len(content)} bytes")
    corners = np.frombuffer(content, TRIANGLE, offset=HEADER + 4)["corners"].reshape(-1, 3)
    points, rows = np.unique(corners, axis=0, return_inverse=True)
    return Solid(points.astype(np.float64), rows.reshape(-1, 3))
