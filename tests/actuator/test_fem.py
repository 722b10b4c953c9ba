"""The finger by finite elements: beam theory, exact torques, balance, symmetry, kept results."""

from dataclasses import astuple

import numpy as np
import pytest

from softgrip.actuator import fem_results
from softgrip.actuator.elasticity import Elastic, Solver, nodes, pressure_load, quadratic, stiffness
from softgrip.actuator.fem import centre_line, plate_motions, respond, solve, tip_response
from softgrip.actuator.finger_mesh import Box, FingerShape, box_mesh, finger_mesh, voids, within
from softgrip.actuator.printed import table_3_1
from softgrip.actuator.prismatic import prismatic_torque
from softgrip.actuator.section import Section, chamber_area, torque, wall_area
from softgrip.errors import InvalidInputError, UnknownNameError
from softgrip.units import MM

DESIGN_1 = Section(20 * MM, 4 * MM, 30 * MM, 1.5 * MM)
COARSE = 6 * MM
RUBBER = Elastic()
SHAPES = {"beam": FingerShape(DESIGN_1), "chambers": FingerShape(DESIGN_1, 6)}


def wall_second_moment(section):
    """Return the second moment of the wall about its centroid, m^4: I of the hollow section."""
    a, b, w, t = section.top, section.bottom, section.width, section.wall
    A_c, A_w = chamber_area(section), wall_area(section)
    centroid = (w * (a + b) * (a - b) / 2 - A_c * (a - t) / 2) / A_w
    about_neutral = (w * (a**3 + b**3) - (w - 2 * t) * (a - t) ** 3) / 3
    return about_neutral - A_w * centroid**2


@pytest.fixture(scope="module", params=SHAPES)
def solved(request):
    return SHAPES[request.param], solve(finger_mesh(SHAPES[request.param], COARSE), RUBBER)


def ends(length):
    return {
        "base": lambda x: np.isclose(x[0], 0),
        "tip": lambda x: np.isclose(x[0], length),
        "symmetry": lambda x: np.isclose(x[2], 0),
    }


def test_solid_cantilever_is_timoshenkos():
    """And a prop holds the tip of one under a uniform load with 3/8 of it: Eq. (3.24)."""
    L, h, w, E = 10.0, 1.0, 0.8, 2.0
    mesh = box_mesh(Box((0, -h / 2, 0), (L, h / 2, w / 2)), 0.5).with_boundaries(
        ends(L) | {"pressure": lambda x: np.isclose(x[1], h / 2)}
    )
    # With nu = 0 the clamp and the plate agree with the beam's own sections.
    found = tip_response(solve(mesh, Elastic(E, 0.0)))
    EI, GA, EA = E * w * h**3 / 12, E / 2 * w * h, E * w * h
    assert found.bending_stiffness == pytest.approx(EI, rel=1e-9)
    assert found.compliance[0, 0] == pytest.approx(L / EA, rel=1e-9)
    assert found.compliance[1, 2] == pytest.approx(L**2 / (2 * EI), rel=1e-9)
    # Ends that cannot warp take a little of the shear's small share away (0.25 %).
    assert found.compliance[1, 1] == pytest.approx(L**3 / (3 * EI) + L / (5 / 6 * GA), rel=1e-3)
    # Pressure on the top is a uniform load of w per length and pascal.
    drop = w * L**4 / (8 * EI) + w * L**2 / (2 * 5 / 6 * GA)
    assert found.free_motion[1] == pytest.approx(drop, rel=1e-3)
    assert found.free_motion[2] == pytest.approx(w * L**3 / (6 * EI), rel=1e-3)
    # A prop at the tip bears 3/8 of it, but for the shear.
    prop = drop / (L**3 / (3 * EI) + L / (5 / 6 * GA))
    assert found.scale_torque == pytest.approx(prop * L, rel=1e-3)
    assert prop == pytest.approx(3 / 8 * w * L, rel=0.01)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.49])
@pytest.mark.parametrize("name", ["Opt. parameters", "Variance 4"])
def test_constant_section_held_straight_has_exactly_the_prismatic_torque(nu, name):
    """A slice between two rollers: on any mesh, for the virtual displacements are quadratic."""
    section, L = table_3_1()[name], 5 * MM
    a, b, w, t = section.top, section.bottom, section.width, section.wall
    hole = Box((0, 0, 0), (L, a - t, w / 2 - t))
    mesh = box_mesh(Box((0, -b, 0), (L, a, w / 2)), 4 * MM, [hole]).with_boundaries(
        ends(L) | {"pressure": lambda x: within(x, [hole], 1e-9)}
    )
    basis = quadratic(mesh)
    n, base, tip = basis.N, nodes(basis, "base"), nodes(basis, "tip")
    held = np.concatenate([base, tip, nodes(basis, "symmetry") + 2 * n, base[:1] + n])
    K, load = stiffness(basis, Elastic(1.0, nu)), pressure_load(basis, "pressure")
    solver, plate = Solver(K, held), plate_motions(basis, "tip")[:, [0, 2]]
    stretch = solver.solve(0 * load, plate[:, 0])
    pressed = solver.solve(load, 0 * load)
    # What wall and pressure on the chamber's end exert on the plate: force and moment.
    area = chamber_area(section)
    end = np.array([area, area * (a - t) / 2])
    push = end - 2 * plate.T @ (K @ pressed - load)
    S = 2 * plate.T @ (K @ stretch)
    np.testing.assert_allclose(push, (1 - 2 * nu) * end, atol=1e-7 * end[1])
    found = push[1] - S[1] * push[0] / S[0]
    expected = prismatic_torque(section, 1.0, nu)
    assert found == pytest.approx(expected, rel=1e-6)
    if nu == 0:  # where no stress around the chamber counts, Eq. (3.4) is exact
        assert found == pytest.approx(torque(section, 1.0), rel=1e-6)


def test_beam_tends_to_the_prismatic_torque_and_stiffness_as_it_gets_longer():
    lengths = (0.15, 0.3)
    short, long = (respond(FingerShape(DESIGN_1, length=L), COARSE) for L in lengths)
    limit = prismatic_torque(DESIGN_1, 1.0, RUBBER.poisson_ratio)
    # What the ends add is a fixed couple of moment and length, so it falls with 1 / L.
    excess = [(found.torque - limit) * L for found, L in zip((short, long), lengths, strict=True)]
    assert excess[0] > 0
    assert excess[1] == pytest.approx(excess[0], rel=0.05)
    assert long.bending_stiffness == pytest.approx(
        RUBBER.young_modulus * wall_second_moment(DESIGN_1), rel=0.02
    )


def test_forces_and_moments_of_the_whole_finger_balance(solved):
    """The pressure in a closed chamber has no resultant: base and tip balance each other."""
    shape, solution = solved
    fields = np.column_stack([solution.motions, solution.held])
    forces = solution.K @ fields
    forces[:, 3] -= solution.load
    base, tip = (plate_motions(solution.basis, end).T @ forces for end in ("base", "tip"))
    scale = np.abs(tip).max(axis=0)
    np.testing.assert_allclose(base[:2] + tip[:2], 0, atol=1e-8 * scale.max())
    # Moment about the base's neutral point: a downward force at the tip has the arm L.
    np.testing.assert_allclose(base[2] + tip[2] + shape.length * tip[1], 0, atol=1e-8 * scale.max())
    pressed = np.abs(tip[:, 3]).max()
    np.testing.assert_allclose(base[:2, 3] + tip[:2, 3], 0, atol=1e-8 * pressed)


def test_stiffness_is_symmetric_and_definite(solved):
    S = tip_response(solved[1]).stiffness
    np.testing.assert_allclose(S, S.T, atol=1e-8 * np.abs(S).max())
    assert np.linalg.eigvalsh((S + S.T) / 2).min() > 0


@pytest.mark.parametrize("pressure", [2e4, -5e3])
def test_one_solution_under_pressure_is_the_sum_of_the_four_cases(solved, pressure):
    """A plate that is moved as far as a free one moves feels no force."""
    solution = solved[1]
    basis, K, n = solution.basis, solution.K, solution.basis.N
    plate = plate_motions(basis, "tip")
    given = plate @ tip_response(solution).free_motion * pressure
    both = np.concatenate([nodes(basis, "base"), nodes(basis, "tip")])
    held = np.concatenate([both, both + n, both + 2 * n, nodes(basis, "symmetry") + 2 * n])
    u = Solver(K, held).solve(pressure * solution.load, given)
    force = plate.T @ (K @ u - pressure * solution.load)
    blocked = plate.T @ (K @ solution.held - solution.load) * pressure
    np.testing.assert_allclose(force, 0, atol=1e-6 * np.abs(blocked).max())


def test_plate_stands_for_a_free_end():
    """Without the plate the end cap bulges; the mean turn of its face is close to the plate's.

    Only of chambers: the beam bends so little that the bulge would be a large part of its angle.
    """
    solution = solve(finger_mesh(SHAPES["chambers"], COARSE), RUBBER)
    basis, n = solution.basis, solution.basis.N
    base, tip = nodes(basis, "base"), nodes(basis, "tip")
    held = np.concatenate([base, base + n, base + 2 * n, nodes(basis, "symmetry") + 2 * n])
    u = Solver(solution.K, held).solve(solution.load, 0 * solution.load)
    turn = np.polyfit(basis.doflocs[1, tip], u[tip], 1)[0]
    assert turn == pytest.approx(tip_response(solution).angle, rel=0.05)


def test_half_a_finger_is_half_of_the_whole():
    shape, size = FingerShape(DESIGN_1, 2, length=40 * MM), 7 * MM
    inside, grooves = voids(shape)
    both = [Box((*box.low[:2], -box.high[2]), box.high) for box in (*inside, *grooves)]
    w = DESIGN_1.width
    # 7 mm divides 13.5 mm by 2 and 27 mm by 4: the two grids are one.
    mesh = box_mesh(Box((0, -4 * MM, -w / 2), (40 * MM, 20 * MM, w / 2)), size, both)
    mesh = mesh.with_boundaries(
        ends(40 * MM)
        # The whole needs no plane of symmetry; its base is held already.
        | {"symmetry": ends(40 * MM)["base"], "pressure": lambda x: within(x, both[:2], 1e-9)}
    )
    whole, half = tip_response(solve(mesh, RUBBER)), respond(shape, size)
    np.testing.assert_allclose(whole.push / 2, half.push, rtol=1e-7, atol=1e-7 * half.push[2])
    assert whole.bending_stiffness / 2 == pytest.approx(half.bending_stiffness, rel=1e-7)


def test_torque_does_not_depend_on_the_modulus_and_the_angle_falls_with_it(solved):
    shape, solution = solved
    found, stiffer = tip_response(solution), respond(shape, COARSE, Elastic(3 * 0.34e6))
    assert stiffer.torque == pytest.approx(found.torque, rel=1e-6)
    assert stiffer.angle == pytest.approx(found.angle / 3, rel=1e-6)


def test_centre_line_runs_from_the_clamp_to_the_plate(solved):
    shape, solution = solved
    x, u = centre_line(solution)
    stretch, drop, _ = tip_response(solution).free_motion
    assert (x[0], x[-1]) == pytest.approx((0, shape.length))
    np.testing.assert_allclose(u[:, 0], 0, atol=1e-15)
    np.testing.assert_allclose(u[:, -1], [stretch, -drop])


def test_kept_row_is_what_the_command_computes():
    for kept in fem_results.read("convergence"):
        if kept.size == COARSE:
            again = fem_results.compute(kept.design, kept.chambers, kept.groove_floor, kept.size)
            assert astuple(again)[:5] == astuple(kept)[:5]
            # Six digits are kept.
            assert astuple(again)[5:] == pytest.approx(astuple(kept)[5:], rel=1e-5)


def test_kept_rows_are_those_that_the_command_makes():
    assert tuple(table_3_1()) == fem_results.DESIGNS
    for table, cases in fem_results.TABLES.items():
        kept = [astuple(row)[:4] for row in fem_results.read(table)]
        assert kept == list(cases)


def test_results_settle_as_the_mesh_is_refined():
    for chambers in (1, 6):
        rows = [row for row in fem_results.read("convergence") if row.chambers == chambers]
        values = np.array([astuple(row)[5:9] for row in rows])
        off = np.abs(values / values[-1] - 1)
        assert [row.size for row in rows] == sorted((row.size for row in rows), reverse=True)
        assert off[-2].max() < 0.05  # the size of Table 3.1's rows
        assert off[0].max() < 0.3  # the size of these tests


def test_unknown_table_and_size_are_refused():
    with pytest.raises(UnknownNameError, match="convergence"):
        fem_results.read("table_9")
    with pytest.raises(InvalidInputError, match="size"):
        respond(SHAPES["beam"], 0.0)
