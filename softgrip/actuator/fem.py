"""Finite elements as the judge of Chapter 3's models: torque, bending and stiffness of a finger.

The finger is clamped at its base and ends in a rigid plate. Three unit motions of the plate and a
unit pressure with the plate held are solved with one factorization; what the finger does then
follows from three equations, ``S q = push P + F``, with

- q: stretch U and drop W of the plate (m), measured at the neutral surface, and its curl theta
  (rad): the plate moves by ``u_x = U + theta y``, ``u_y = -W``;
- F: axial force (N), downward force (N) and curling moment about the neutral surface (N m) that
  act on the plate.

All is linear in the pressure: an angle of more than some tenths of a radian is an extrapolation,
and chambers that bulge do not touch each other.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from softgrip.actuator.elasticity import (
    Elastic,
    Matrix,
    Solver,
    nodes,
    pressure_load,
    quadratic,
    stiffness,
)
from softgrip.actuator.finger_mesh import FingerShape, Mesh, finger_mesh
from softgrip.arrays import Floats


@dataclass(frozen=True)
class TipResponse:
    """A finger as it is felt at its tip.

    Attributes:
        length: L, m.
        stiffness: S, shape (3, 3): forces by motions (see the module's head).
        push: What the finger exerts on a plate that is held, per Pa of pressure: axial force,
            downward force, curling moment, shape (3,).
    """

    length: float
    stiffness: Floats
    push: Floats

    @property
    def compliance(self) -> Floats:
        """Inverse of S, shape (3, 3)."""
        return np.asarray(np.linalg.inv(self.stiffness))

    @property
    def free_motion(self) -> Floats:
        """Stretch [m], drop [m] and angle [rad] of a free tip, per Pa, shape (3,)."""
        return np.asarray(self.compliance @ self.push)

    @property
    def angle(self) -> float:
        """Bending angle of a free tip, rad/Pa, as `bending.bending_angle` has it at n = 1."""
        return float(self.free_motion[2])

    @property
    def torque(self) -> float:
        """Moment of a finger held straight but free to stretch, N m/Pa, as of `section.torque`."""
        stretch = self.push[0] / self.stiffness[0, 0]
        return float(self.push[2] - self.stiffness[2, 0] * stretch)

    @property
    def scale_torque(self) -> float:
        """Length times the force of the tip on a scale, Eq. (3.24), N m/Pa.

        The scale keeps the tip from dropping; stretch and curl are free. A uniform beam then gives
        3/2 of the moment M that bends it, since ``F = (M L**2 / (2 E I)) / (L**3 / (3 E I))``.
        """
        return float(self.length * self.free_motion[1] / self.compliance[1, 1])

    @property
    def bending_stiffness(self) -> float:
        """Mean E I, N m^2: a moment at the tip by the mean curvature that it makes."""
        return float(self.length / self.compliance[2, 2])

    @property
    def neutral_height(self) -> float:
        """Height above y = 0 that a moment at the tip leaves unstretched, m."""
        return float(-self.compliance[0, 2] / self.compliance[2, 2])


@dataclass(frozen=True)
class Solution:
    """Displacements of the half finger, m, at n nodes, by component as in `elasticity`.

    Attributes:
        basis: Of `elasticity.quadratic`.
        K: Stiffness, N/m, shape (3 n, 3 n).
        load: Forces of a unit pressure, N/Pa, shape (3 n,).
        motions: For each unit motion of the plate, without pressure, shape (3 n, 3).
        held: For a unit pressure, the plate held, shape (3 n,).
    """

    basis: Any
    K: Matrix
    load: Floats
    motions: Floats
    held: Floats


def solve(mesh: Mesh, material: Elastic) -> Solution:
    """Solve the four cases of the module's head on a mesh with the boundaries of `finger_mesh`."""
    basis = quadratic(mesh)
    K, load, n = stiffness(basis, material), pressure_load(basis, "pressure"), basis.N
    ends = np.concatenate([nodes(basis, "base"), nodes(basis, "tip")])
    held = np.concatenate([ends, ends + n, ends + 2 * n, nodes(basis, "symmetry") + 2 * n])
    solver, none = Solver(K, held), np.zeros(3 * n)
    motions = [solver.solve(none, given) for given in plate_motions(basis, "tip").T]
    return Solution(basis, K, load, np.column_stack(motions), solver.solve(load, none))


def plate_motions(basis: Any, boundary: str) -> Floats:
    """Return the unit motions of a plate (stretch, drop, curl), zero elsewhere, shape (3 n, 3)."""
    at, n = nodes(basis, boundary), basis.N
    motion = np.zeros((3 * n, 3))
    motion[at, 0] = 1
    motion[at + n, 1] = -1
    motion[at, 2] = basis.doflocs[1, at]
    return motion


def tip_response(solution: Solution) -> TipResponse:
    """Return the forces at the plate by virtual work, those of both halves of the finger."""
    plate = 2 * plate_motions(solution.basis, "tip").T
    return TipResponse(
        length=float(np.ptp(solution.basis.mesh.p[0])),
        stiffness=plate @ (solution.K @ solution.motions),
        push=plate @ (solution.load - solution.K @ solution.held),
    )


def respond(shape: FingerShape, size: float, material: Elastic | None = None) -> TipResponse:
    """Mesh a finger, solve it, and return how it is felt at its tip.

    Args:
        shape: Its sizes.
        size: Longest edge of an element, m: 2 mm gives 64 000 unknowns for one chamber along the
            finger, 95 000 for six.
        material: Its constants; those of Section 3.4 if None.

    Raises:
        InvalidInputError: If `size` is not above zero and below the length.
    """
    return tip_response(solve(finger_mesh(shape, size), material or Elastic()))


def centre_line(solution: Solution) -> tuple[Floats, Floats]:
    """Return the neutral surface's middle line when the tip is free.

    Returns:
        tuple of ndarray: Position along the finger, m, shape (m,), and displacement along x and y
            per pressure, m/Pa, shape (2, m).
    """
    along, height, across = solution.basis.doflocs
    line = np.flatnonzero(np.isclose(height, 0) & np.isclose(across, 0))
    line = line[np.argsort(along[line])]
    u = solution.held + solution.motions @ tip_response(solution).free_motion
    return along[line], np.stack([u[line], u[line + solution.basis.N]])
