"""Linear elasticity that does not lock when the material is nearly incompressible.

Displacements are triquadratic on hexahedra; the pressure is linear in each element and need not be
continuous, the stable pair Q2/P1. As no two elements share a pressure, it is eliminated in each,
and what is left has displacements only and is symmetric and positive definite: the volume change
enters by its projection on 1, x, y and z, element by element,

``a(u, v) = int 2 mu e(u) : e(v) + lambda Pi(div u) Pi(div v)``.

Displacements are stored by component: all u_x, then all u_y, then all u_z. Deformations and
rotations are small, and pressure keeps its direction.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementHex0, ElementHex2, FacetBasis, LinearForm

from softgrip.actuator.finger_mesh import Mesh
from softgrip.arrays import Floats, check_positive
from softgrip.errors import InvalidInputError
from softgrip.units import MPa

Indices = NDArray[np.int64]
Matrix = Any
"""A scipy.sparse matrix (the library ships no types)."""

# Exact for products of two gradients on a box: 3 Gauss points an axis.
_ORDER = 4


@dataclass(frozen=True)
class Elastic:
    """An isotropic linear elastic material; the defaults are those of Section 3.4.

    Attributes:
        young_modulus: E, Pa, > 0.
        poisson_ratio: nu, above -1 and below 0.5.
    """

    young_modulus: float = 0.34 * MPa
    poisson_ratio: float = 0.49

    def __post_init__(self) -> None:
        check_positive(young_modulus=self.young_modulus)
        if not -1 < self.poisson_ratio < 0.5:
            raise InvalidInputError(
                "poisson_ratio", expected="above -1 and below 0.5", got=self.poisson_ratio
            )

    @property
    def mu(self) -> float:
        """Shear modulus, Pa."""
        return self.young_modulus / (2 * (1 + self.poisson_ratio))

    @property
    def lam(self) -> float:
        """First parameter of Lame, Pa."""
        return 2 * self.mu * self.poisson_ratio / (1 - 2 * self.poisson_ratio)


def quadratic(mesh: Mesh) -> Any:
    """Return the basis of one displacement component on a mesh of boxes."""
    return Basis(mesh, ElementHex2(), intorder=_ORDER)


def stiffness(basis: Any, material: Elastic) -> Matrix:
    """Assemble a(u, v) of the module's head, N/m, shape (3 n, 3 n) for n nodes.

    Args:
        basis: Of `quadratic`. The elements must be boxes along the axes: 1, x, y and z, from an
            element's centre, are then orthogonal, which makes the projection a sum of four terms.
        material: Its constants.
    """
    upper = {(i, j): _gradients(i, j).assemble(basis) for i in range(3) for j in range(i, 3)}
    G = [[upper[i, j] if i <= j else upper[j, i].T for j in range(3)] for i in range(3)]
    laplacian = G[0][0] + G[1][1] + G[2][2]
    blocks = [[G[i][j] + (laplacian if i == j else 0) for j in range(3)] for i in range(3)]
    K = material.mu * sparse.bmat(blocks, format="csr")

    element = basis.with_element(ElementHex0())
    centre = basis.mesh.p[:, basis.mesh.t].mean(axis=1)[:, :, None]
    x = np.asarray(basis.global_coordinates()) - centre
    for mode in (np.ones_like(x[0]), *x):
        B = sparse.hstack(
            [_volume_change(i).assemble(basis, element, mode=mode) for i in range(3)], format="csr"
        )
        norm = np.sum(mode**2 * basis.dx, axis=1)
        K = K + material.lam * B.T @ sparse.diags(1 / norm) @ B
    return K


def pressure_load(basis: Any, boundary: str) -> Floats:
    """Assemble the forces of a unit pressure on a boundary, N/Pa, shape (3 n,)."""
    facets = FacetBasis(basis.mesh, basis.elem, facets=basis.mesh.boundaries[boundary], intorder=4)
    return np.concatenate([_push(i).assemble(facets) for i in range(3)])


def nodes(basis: Any, boundary: str) -> Indices:
    """Return the indices of a boundary's nodes, shape (m,)."""
    return np.asarray(basis.get_dofs(basis.mesh.boundaries[boundary]).flatten(), dtype=np.int64)


class Solver:
    """Factors K with some displacements held, for any number of loads.

    Args:
        K: Of `stiffness`.
        held: Indices of the displacements that are given, shape (m,).
    """

    def __init__(self, K: Matrix, held: Indices) -> None:
        self.K = K.tocsr()
        self.held = np.unique(held)
        self.free = np.setdiff1d(np.arange(K.shape[0]), self.held)
        # Symmetric and positive definite: no pivoting, and an ordering for symmetric matrices.
        self._factor = splu(
            self.K[self.free][:, self.free].tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )

    def solve(self, load: Floats, given: Floats) -> Floats:
        """Return the displacements, m, under a load, N, with the held ones as given (others 0)."""
        u = np.array(given, dtype=np.float64)
        u[self.free] = 0
        u[self.free] = self._factor.solve((load - self.K @ u)[self.free])
        return u


def _gradients(i: int, j: int) -> Any:
    """Return the form that, times mu, couples component j of the trial to i of the test."""
    return BilinearForm(lambda u, v, _: u.grad[i] * v.grad[j])


def _volume_change(i: int) -> Any:
    return BilinearForm(lambda u, q, w: u.grad[i] * q * w.mode)


def _push(i: int) -> Any:
    return LinearForm(lambda v, w: -w.n[i] * v)
