"""Solving the optimal design problem of Eq. (3.17) and (3.20), and rounding it for a mould."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import casadi as ca
import numpy as np

from softgrip.actuator.bending import Finger, bending_angle
from softgrip.actuator.design import (
    DIMENSIONS,
    Combined,
    DesignProblem,
    InfeasibleDesignError,
    Range,
    check_feasible,
    combine,
    objective,
    product,
)
from softgrip.actuator.section import Section, check_section, torque
from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError, SoftgripError
from softgrip.units import MM

OPTIONS: dict[str, Any] = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.tol": 1e-8,
    # A start is moved well inside its box before the first step, so that a corner costs no steps
    # more than the middle; and the barrier falls fast, because the problem is small and smooth.
    "ipopt.bound_push": 0.49,
    "ipopt.bound_frac": 0.49,
    "ipopt.mu_linear_decrease_factor": 0.05,
    "ipopt.mu_superlinear_decrease_power": 1.9,
    "ipopt.barrier_tol_factor": 100.0,
}
"""Of IPOPT; derivatives are exact, by CasADi."""

MOULD = {"top": 0.5 * MM, "bottom": 0.5 * MM, "width": 1.0 * MM, "wall": 0.25 * MM}
"""Steps of the dimensions in Table 3.1, m."""


class SolverError(SoftgripError, RuntimeError):
    """The solver did not converge; carries its own words."""


@dataclass(frozen=True)
class Design:
    """A section with what it does.

    Attributes:
        section: Its dimensions, m.
        objective: The sum of Eq. (3.20).
        torque, angle: T, N m, and theta, rad, at the problem's pressure.
        active: The constraints at whose ends it lies, such as "bottom <= 0.004 m".
        iterations: Of the solver; 0 where there was none.
    """

    section: Section
    objective: float
    torque: float
    angle: float
    active: tuple[str, ...]
    iterations: int = 0


def evaluate(problem: DesignProblem, section: Section, iterations: int = 0) -> Design:
    """Return what a section of numbers does; InvalidInputError if it is none or bends backwards."""
    check_section(section)
    if section.bottom < section.wall:
        raise InvalidInputError(
            "bottom", expected=f">= the wall, {section.wall:g} m", got=section.bottom
        )
    return Design(
        section,
        float(objective(problem, section)),
        float(torque(section, problem.pressure)),
        float(bending_angle(problem.finger(section), problem.pressure)),
        _active(problem, section),
        iterations,
    )


def optimal_design(problem: DesignProblem, start: Section | None = None) -> Design:
    """Find the best section by IPOPT: over a and b, Eq. (6.8), and w, at the thinnest wall.

    The objective falls with t wherever b > t (see `section.torque`), and t is in no other
    constraint: so t is at its lower bound, and what is left are a, b and w, as logarithms. With
    ``b > t`` as a bound the torque stays positive on the way, where theta is defined.

    Args:
        problem: Eq. (3.20) with its numbers.
        start: First guess, any section, also one that bends backwards: it is moved into the box.
            The middle of the box if None.

    Raises:
        InfeasibleDesignError: If no section fulfils the constraints; it names the one and the
            nearest feasible band.
        InvalidInputError: If a number is likely to be in another unit than SI.
        SolverError: If IPOPT does not converge.

    >>> from softgrip.actuator.design import Bounds
    >>> table_3_2 = Bounds(top=(0.014, 0.020), bottom=(0.002, 0.004))
    >>> found = optimal_design(DesignProblem(bounds=table_3_2)).section
    >>> [round(1e3 * x, 2) for x in (found.bottom, found.top, found.width, found.wall)]
    [4.0, 20.0, 30.0, 1.5]
    """
    check_feasible(problem)
    bounds = problem.bounds
    wall = bounds.wall[0]
    box = np.array([bounds.top, (max(bounds.bottom[0], wall), bounds.bottom[1]), bounds.width])
    box[1, 0] *= 1 + 1e-6 * (box[1, 0] == wall)  # T = 0 exactly has no derivative for n > 1
    first, last = problem.product_range
    guess = box.mean(axis=1)
    if start is not None:
        guess = np.clip(
            np.array([start.top, start.bottom, start.width], np.float64), box[:, 0], box[:, 1]
        )
        if not np.isfinite(guess).all():
            raise InvalidInputError("start", expected="finite dimensions", got=start)
    solver = _solver(problem.combined)
    with np.errstate(divide="ignore"):
        found = solver(
            x0=np.log(guess),
            p=[
                problem.pressure,
                problem.young_modulus,
                problem.fractional_power,
                problem.length,
                problem.torque_scale,
                problem.angle_scale,
                wall,
            ],
            lbx=np.log(box[:, 0]),
            ubx=np.log(box[:, 1]),
            lbg=[bounds.height[0] / MM, np.log(first)],
            ubg=[bounds.height[1] / MM, np.log(last)],
        )
    stats = solver.stats()
    if not stats["success"]:
        raise SolverError(f"IPOPT: {stats['return_status']} after {stats['iter_count']} iterations")
    a, b, w = np.exp(np.array(found["x"]).ravel())
    a, b, w = (float(x) for x in np.clip([a, b, w], box[:, 0], box[:, 1]))
    section = Section(a, b, w, wall)
    return evaluate(problem, section, int(stats["iter_count"]))


@cache
def _solver(combined: Combined) -> Any:
    """Build the nonlinear program once: all numbers of a problem are parameters of it."""
    logs, p = ca.SX.sym("logs", 3), ca.SX.sym("p", 7)
    a, b, w = (ca.exp(logs[i]) for i in range(3))
    P, E, n, length, torque_scale, angle_scale, t = (p[i] for i in range(7))
    section = Section(a, b, w, t)
    bent = bending_angle(Finger(section, length, E, n), P)
    total = combine(combined, torque(section, P) / torque_scale, bent / angle_scale)
    constraints = ca.vertcat(
        section.height / MM, ca.log(E) + ca.log(w) + (n + 2) * ca.log(section.height)
    )
    program: dict[str, Any] = {"x": logs, "p": p, "f": -ca.log(total), "g": constraints}
    return ca.nlpsol("design", "ipopt", program, OPTIONS)


def manufacturable(problem: DesignProblem, steps: Mapping[str, float] = MOULD) -> Design:
    """Return the best section whose dimensions are whole steps of a mould, Table 3.1's rounding.

    All sections of the grid that fulfil the constraints are tried, so it is the best of them, and
    it keeps the frequency band, which rounding the optimum would not. The wall is the thinnest.

    Args:
        problem: Eq. (3.20) with its numbers.
        steps: Of each dimension, m, > 0.

    Raises:
        InfeasibleDesignError: If no section of the grid fulfils the constraints.
    """
    check_feasible(problem)
    if set(steps) != set(DIMENSIONS) or not all(step > 0 for step in steps.values()):
        raise InvalidInputError("steps", expected=f"steps > 0 of {DIMENSIONS}", got=dict(steps))
    bounds = problem.bounds
    a, b, w, t = (_grid(getattr(bounds, name), steps[name]) for name in DIMENSIONS)
    if not all(grid.size for grid in (a, b, w, t)):
        raise InfeasibleDesignError(f"no whole steps of {dict(steps)} m lie within {bounds}")
    grid = Section(*np.meshgrid(a, b, w, t[:1], indexing="ij"))
    slack = 1e-9  # of a length and of a product: grid points are not exact in binary
    first, last = problem.product_range
    height, value = grid.height, product(problem, grid)
    good = (height >= bounds.height[0] - slack * MM) & (height <= bounds.height[1] + slack * MM)
    good &= (value >= first * (1 - slack)) & (value <= last * (1 + slack)) & (grid.bottom > t[0])
    if not good.any():
        raise InfeasibleDesignError(
            f"no whole steps of {dict(steps)} m fulfil the constraints; smaller steps may"
        )
    points = Section(*(x[good] for x in (grid.top, grid.bottom, grid.width, grid.wall)))
    best = int(np.argmax(objective(problem, points)))
    chosen = (points.top, points.bottom, points.width, points.wall)
    return evaluate(problem, Section(*(float(x[best]) for x in chosen)))


def _grid(limits: Range, step: float) -> Floats:
    """Return the whole steps within a range, to the micrometre."""
    low, high = (limits[0] / step, limits[1] / step)
    whole = np.arange(np.ceil(low - 1e-9), np.floor(high + 1e-9) + 1)
    return np.asarray(np.round(whole * step, 6))


def _active(problem: DesignProblem, section: Section) -> tuple[str, ...]:
    """Name the constraints at whose ends a section lies, within 1e-5 of them."""
    bounds, found = problem.bounds, []
    for name in (*DIMENSIONS, "height"):
        value = getattr(section, name)
        for sign, limit in zip((">=", "<="), getattr(bounds, name), strict=True):
            if abs(value - limit) < 1e-5 * limit:
                found.append(f"{name} {sign} {limit:g} m")
    for sign, limit in zip((">=", "<="), problem.product_range, strict=True):
        if abs(float(product(problem, section)) - limit) < 1e-5 * limit and problem.band:
            edge = problem.band.low if sign == ">=" else problem.band.high
            found.append(f"frequency {sign} {edge:g} rad/s")
    return tuple(found)
