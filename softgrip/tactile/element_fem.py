"""Finite elements as the judge of Eq. (2.1): an element clamped at its base, loaded on its top.

Round elements are solved over half their profile (r, z), the square pyramid over a quarter of its
body (x, y, z), both with quadratic displacements. The volume change is integrated at fewer points
than the change of form (selective reduced integration), so that nu = 0.49 does not lock them.
Strains are small and the material is linear, as in Section 2.2.

Heights of the meshes count from the top, which is zero: the smallest elements are there, and
rounding is relative to the coordinate. Their boundaries are named "base", "top", and "plane 0" (and
"plane 1"), those of symmetry.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import isqrt, pi
from typing import Any

import numpy as np
from skfem import (
    Basis,
    BilinearForm,
    ElementHex2,
    ElementQuad2,
    ElementVector,
    FacetBasis,
    LinearForm,
    MeshHex,
    MeshQuad,
)

from softgrip.actuator.elasticity import Elastic, Solver
from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError
from softgrip.tactile.element import STATED_MODULUS, Element, cross_section


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


RUBBER = Elastic(STATED_MODULUS, 0.49)
"""Section 2.2's Ecoflex 00-30."""


@dataclass(frozen=True)
class TopCompliance:
    """Displacement of the top along the force, by force, m/N.

    Attributes:
        mean, largest: Of the top's points, where the force is spread evenly over the top.
        plate: Where a rigid plate without friction presses.
    """

    mean: float
    largest: float
    plate: float


@dataclass(frozen=True)
class Solution:
    """A solved element.

    Attributes:
        basis: Of scikit-fem; its points are (r, z) or (x, y, z), m, with z = 0 at the top.
        displacement: Under 1 N spread evenly over the top, m/N, at the degrees of freedom of
            `basis`.
        top: How the top gives way.
    """

    basis: Any
    displacement: Floats
    top: TopCompliance


def solve(element: Element, divisions: int, material: Elastic = RUBBER) -> Solution:
    """Solve an element: a round one in r, z, a pyramid in x, y, z.

    Args:
        element: With a flat top: cut > 0.
        divisions: Finite elements along half the width and along the height, >= 1.
        material: Its constants.

    Raises:
        InvalidInputError: If the top is sharp, or there are no divisions.
    """
    if element.shape == "pyramid":
        return solve_body(element, divisions, material)
    mesh = profile(element, divisions)
    return _solve(mesh, ElementQuad2(), material, _on_rings, lambda w: 2 * pi * w.x[0])


def solve_body(element: Element, divisions: int, material: Elastic = RUBBER) -> Solution:
    """Solve a quarter of any element in x, y, z; parameters as in `solve`."""
    return _solve(body(element, divisions), ElementHex2(), material, _in_space, lambda _: 4.0)


def middle_section(solution: Solution) -> tuple[Floats, Floats]:
    """Return half the middle section of an element: where its points are and go to.

    Returns:
        tuple of ndarray: Position across and above the base, m, and displacement under 1 N, m/N,
            both of shape (2, n + 1, n + 1) for n divisions: by layer from the base, then from the
            middle outwards.
    """
    mesh = solution.basis.mesh
    up = mesh.dim() - 1
    at = np.flatnonzero(np.abs(mesh.p[1]) < 1e-12) if up == 2 else np.arange(mesh.p.shape[1])
    side = isqrt(at.size)
    at = at[np.argsort(mesh.p[up, at], kind="stable")].reshape(side, side)
    order = np.argsort(mesh.p[0, at], axis=1)
    at = np.take_along_axis(at, order, axis=1)
    axes = [0, up]
    place = mesh.p[axes][:, at]
    place[1] -= place[1].min()
    return place, solution.displacement[solution.basis.nodal_dofs[axes][:, at]]


def _in_space(u: Any, _: Any) -> Any:
    """Return the gradient of a motion, by component and direction."""
    return u.grad


def _on_rings(u: Any, w: Any) -> Any:
    """Return the gradient of a motion that is the same all around, in r, z and along the ring."""
    g, none = u.grad, 0 * w.x[0]
    hoop = np.asarray(u)[0] / w.x[0]
    return np.array([[g[0, 0], g[0, 1], none], [g[1, 0], g[1, 1], none], [none, none, hoop]])


def _solve(
    mesh: Any,
    scalar: Any,
    material: Elastic,
    gradient: Callable[[Any, Any], Any],
    measure: Callable[[Any], Any],
) -> Solution:
    """Assemble and solve; an integral over the mesh times `measure` is one over the element."""

    def form_change(u: Any, v: Any, w: Any) -> Any:
        a, b = gradient(u, w), gradient(v, w)
        return material.mu * np.einsum("ij...,ij...", a + np.swapaxes(a, 0, 1), b) * measure(w)

    def volume_change(u: Any, v: Any, w: Any) -> Any:
        a, b = gradient(u, w), gradient(v, w)
        return material.lam * np.einsum("ii...", a) * np.einsum("ii...", b) * measure(w)

    kind, axes = ElementVector(scalar), mesh.dim()
    basis = Basis(mesh, kind, intorder=5)
    coarse = Basis(mesh, kind, intorder=3)
    K = BilinearForm(form_change).assemble(basis) + BilinearForm(volume_change).assemble(coarse)
    facets = FacetBasis(mesh, kind, facets=mesh.boundaries["top"], intorder=5)
    load = LinearForm(lambda v, w: -v[axes - 1] * measure(w)).assemble(facets)

    fixed = [basis.get_dofs("base").all()]
    for i in range(axes - 1):
        fixed.append(basis.get_dofs(f"plane {i}").all([f"u^{i + 1}"]))
    held = np.unique(np.concatenate(fixed))
    down = f"u^{axes}"
    pushed = basis.get_dofs("top").all([down])
    area = -float(load.sum())
    u = Solver(K, held).solve(load / area, np.zeros_like(load))

    unit = np.zeros_like(load)
    unit[pushed] = -1
    pressed = Solver(K, np.union1d(held, pushed)).solve(np.zeros_like(load), unit)
    top = TopCompliance(
        mean=float(load @ u) / area,
        largest=float(-u[pushed].min()),
        plate=1 / float(pressed @ (K @ pressed)),
    )
    return Solution(basis, u, top)
