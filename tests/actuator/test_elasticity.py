"""Linear elasticity on boxes, against hand calculation and scikit-fem's own model."""

import numpy as np
import pytest
from skfem import Basis, ElementHex1, ElementVector
from skfem.models.elasticity import lame_parameters, linear_elasticity

from softgrip.actuator.elasticity import Elastic, Solver, nodes, pressure_load, quadratic, stiffness
from softgrip.actuator.finger_mesh import Box, box_mesh
from softgrip.errors import InvalidInputError

# A bar, with an inner corner: 4 x 2 x 2 less a notch.
BAR, NOTCH = Box((0.0, 0.0, 0.0), (4.0, 2.0, 2.0)), Box((1.0, 1.0, 0.0), (2.5, 2.0, 2.0))


def by_component(field):
    return np.concatenate(np.broadcast_arrays(*field))


@pytest.fixture(scope="module")
def notched():
    return quadratic(box_mesh(BAR, 1.1, [NOTCH]))


@pytest.mark.parametrize("nu", [0.3, 0.49])
def test_patch_any_linear_displacement_is_reproduced(notched, nu):
    gradient = np.random.default_rng(3).normal(size=(3, 3))
    exact = (gradient @ notched.doflocs).ravel()
    outside = notched.get_dofs().flatten()
    held = np.concatenate([outside + i * notched.N for i in range(3)])
    assert held.size < exact.size  # there is something to solve
    K = stiffness(notched, Elastic(1.0, nu))
    given = np.zeros_like(exact)
    given[held] = exact[held]
    found = Solver(K, held).solve(np.zeros_like(exact), given)
    np.testing.assert_allclose(found, exact, atol=1e-11 * np.abs(exact).max())


@pytest.mark.parametrize("nu", [0.3, 0.49])
def test_energy_of_uniform_strain(notched, nu):
    x, y, z = notched.doflocs
    K, volume = stiffness(notched, Elastic(2.0, nu)), notched.dx.sum()
    mu, lam = 2 / (2 * (1 + nu)), 2 * nu / ((1 + nu) * (1 - 2 * nu))
    for field, energy in [
        ((x, -nu * y, -nu * z), 2.0),  # a bar that is pulled: E
        ((x, 0, 0), lam + 2 * mu),
        ((y, x, 0), 4 * mu),
        ((0, z, y), 4 * mu),
        ((y, -x, 0), 0),  # rotations cost nothing
        ((z, 0, -x), 0),
        ((1, 0, 0), 0),
    ]:
        u = by_component([part + 0 * x for part in field])
        assert u @ (K @ u) == pytest.approx(energy * volume, abs=1e-10 * lam * volume)


@pytest.mark.parametrize("nu", [0.3, 0.49])
def test_cube_under_pressure_all_around_shrinks_by_the_bulk_modulus(nu):
    E, p = 3e5, 1e4
    basis = quadratic(
        box_mesh(Box((0, 0, 0), (1, 1, 1)), 0.5).with_boundaries(
            {"outside": lambda x: (x > 1 - 1e-9).any(axis=0)}
            | {f"middle {i}": (lambda x, i=i: np.isclose(x[i], 0)) for i in range(3)}
        )
    )
    held = np.concatenate([nodes(basis, f"middle {i}") + i * basis.N for i in range(3)])
    load = p * pressure_load(basis, "outside")
    u = Solver(stiffness(basis, Elastic(E, nu)), held).solve(load, np.zeros_like(load))
    strain = -p * (1 - 2 * nu) / E
    np.testing.assert_allclose(u, strain * basis.doflocs.ravel(), atol=1e-9 * abs(strain))


def end_stiffness(K, clamped, pushed):
    """Force at the end by its displacement, by the energy."""
    given = np.zeros(K.shape[0])
    given[pushed] = 1
    u = Solver(K, np.concatenate([clamped, pushed])).solve(np.zeros_like(given), given)
    return u @ (K @ u)


def too_stiff(nu):
    """A slender cantilever's stiffness by beam theory's, with these and with trilinear elements."""
    L, h, E = 20.0, 2.0, 1.0
    mesh = box_mesh(Box((0, 0, 0), (L, h, h)), 1.0).with_boundaries(
        {"base": lambda x: np.isclose(x[0], 0), "tip": lambda x: np.isclose(x[0], L)}
    )
    basis = quadratic(mesh)
    base, tip, n = nodes(basis, "base"), nodes(basis, "tip"), basis.N
    clamped = np.concatenate([base, base + n, base + 2 * n])
    ours = end_stiffness(stiffness(basis, Elastic(E, nu)), clamped, tip + n)
    linear = Basis(mesh, ElementVector(ElementHex1()))
    trilinear = end_stiffness(
        linear_elasticity(*lame_parameters(E, nu)).assemble(linear).tocsr(),
        linear.get_dofs("base").flatten(),
        linear.get_dofs("tip").all("u^2"),
    )
    # Euler-Bernoulli with Timoshenko's shear.
    EI, G = E * h**4 / 12, E / (2 * (1 + nu))
    expected = 1 / (L**3 / (3 * EI) + L / (5 / 6 * G * h**2))
    return ours / expected, trilinear / expected


def test_trilinear_elements_lock_on_a_mesh_where_these_do_not():
    compressible, rubber, nearly = too_stiff(0.3), too_stiff(0.49), too_stiff(0.4999)
    # The clamp, which keeps the base from contracting, stiffens this beam of ten heights a little.
    for ours, _ in (compressible, rubber, nearly):
        assert ours == pytest.approx(1, abs=0.04)
    # Only the volume's stiffness differs between the three, so that is what locks.
    assert compressible[1] < 1.2
    assert rubber[1] > 1.5
    assert nearly[1] > 3 * rubber[1]


@pytest.mark.parametrize("bad", [{"young_modulus": 0.0}, {"poisson_ratio": 0.5}])
def test_material_that_has_no_finite_moduli_is_refused(bad):
    with pytest.raises(InvalidInputError, match=next(iter(bad))):
        Elastic(**bad)
