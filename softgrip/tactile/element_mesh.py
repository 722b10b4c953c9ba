"""Meshes of sensing elements: half a profile of quadrilaterals, a quarter body of hexahedra.

Heights count from the top, which is zero: the smallest elements are there, and rounding is relative
to the coordinate. The boundaries are named "base", "top", and "plane 0" (and "plane 1"), those of
symmetry.
"""

from typing import Any

import numpy as np
from skfem import MeshHex, MeshQuad

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.tactile.element import Element, cross_section


def _levels(element: Element, divisions: int) -> tuple[Floats, Floats]:
    """Return heights from base to top and half the width at each, as parts of the element's."""
    if element.cut == 0 or divisions < 1:
        raise InvalidInputError(
            "element, divisions", expected="cut > 0 and at least 1", got=(element.cut, divisions)
        )
    part = np.linspace(0, 1, divisions + 1)
    k = element.cut
    if element.shape == "hemisphere" and k < 1:
        # Steps along the arc in proportion to the distance from the pole.
        polar = (np.pi / 2) ** (1 - part) * np.arcsin(k) ** part
        part = np.cos(polar) / np.cos(np.arcsin(k))
    elif element.shape == "pyramid" and k < 1:
        # Layers as thin as the element is narrow.
        part = (1 - k**part) / (1 - k)
    part = np.clip(part, 0, 1)
    half = np.sqrt(cross_section(element, part * element.height) / element.base_area) / 2
    return part, half


def _named(mesh: Any, height: float) -> Any:
    up = mesh.dim() - 1
    planes = {f"plane {i}": (lambda x, i=i: np.abs(x[i]) < 1e-12) for i in range(up)}
    return mesh.with_boundaries(
        planes
        | {
            "base": lambda x: np.abs(x[up] + height) < 1e-9 * height,
            "top": lambda x: np.abs(x[up]) < 1e-9 * height,
        }
    )


def profile(element: Element, divisions: int) -> Any:
    """Return a mesh of half the profile of a round element, in r and z, m."""
    part, half = _levels(element, divisions)
    across = np.linspace(0, 1, divisions + 1)
    mesh = MeshQuad.init_tensor(across, np.arange(divisions + 1.0))
    level = np.rint(mesh.p[1]).astype(int)
    points = np.array([mesh.p[0] * half[level] * element.width, (part[level] - 1) * element.height])
    return _named(MeshQuad(points, mesh.t), element.height)


def body(element: Element, divisions: int) -> Any:
    """Return a mesh of a quarter of an element, in x, y and z, m."""
    part, half = _levels(element, divisions)
    across = np.linspace(0, 1, divisions + 1)
    mesh = MeshHex.init_tensor(across, across, np.arange(divisions + 1.0))
    x, y, _ = mesh.p
    level = np.rint(mesh.p[2]).astype(int)
    if element.shape != "pyramid":
        # The square becomes a disc: its grid lines become ellipses.
        x, y = x * np.sqrt(1 - y**2 / 2), y * np.sqrt(1 - x**2 / 2)
    wide = half[level] * element.width
    points = np.array([x * wide, y * wide, (part[level] - 1) * element.height])
    return _named(MeshHex(points, mesh.t), element.height)
