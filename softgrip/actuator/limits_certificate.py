"""The best section within limits of weight and size, with a proof that none is better.

`certificate` proves Eq. (3.20) in the rectangle of a and b. With `limits.Limits` the same is done
in boxes of a, b, w and t. What a box cannot hold is dropped: each measure is monotone in each
dimension (`section.torque`, `size`), or made of factors that are, so that

- torque and angle lie below what the largest a, b and w and the least t of a box give;
- mass, envelope and the product of Eq. (3.21) lie above what its least a, b, w and t give;
- air lies above what its least a and w and its largest t give;
- the buckling pressure lies below what the largest moment and the least two areas give.

That alone would need millions of boxes: where a limit trades one dimension for another, a box is
long to be told from its neighbours. So the limits enter the bound, too. With multipliers m >= 0 the
objective of a feasible section is at most ``log f + sum m_i (slack of limit i)``, whatever the m
(Lagrange's weak duality). With those of the local optimum this sum is level there, and by the mean
value theorem it exceeds its value in the middle of a box by no more than the box's half sides times
the largest slopes, which interval arithmetic bounds (`enclosure`).

IPOPT proposes a section and the multipliers by exact derivatives; branch and bound proves it or
meets a better one, from which IPOPT starts again. If no section is feasible, it is the multipliers
of the least violation that prove it. A local solver alone would prove nothing.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from math import inf, isfinite
from typing import Any

import casadi as ca
import numpy as np

from softgrip.actuator.bending import Finger, modified_moment
from softgrip.actuator.buckling import buckling_pressures, moments
from softgrip.actuator.certificate import MOST_BOXES, TOLERANCE
from softgrip.actuator.design import DIMENSIONS, Combined, check_units, combine
from softgrip.actuator.enclosure import enclosed
from softgrip.actuator.limits import LimitedProblem, laws, measures, ranges
from softgrip.actuator.section import Section, chamber_area, wall_stress_ratio
from softgrip.actuator.size import Layout, air_volume, envelope, finger_mass
from softgrip.arrays import Flags, Floats, check_positive
from softgrip.errors import SoftgripError

SLACK = 1e-6
"""Part of a limit by which a section may be beyond it: that of the solver."""
LEAST_LEVER = 1e-6
"""By which part b is above t at the least: at b = t there is no torque, and its slope no number."""
NAMES = ("torque", "angle", "stiffness", "mass", "envelope", "air", "up", "aside")
"""Of the limits, after those of height and bottom."""
SAFE: dict[str, Any] = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.tol": 1e-9,
    "ipopt.mu_strategy": "adaptive",
    "ipopt.bound_relax_factor": 1e-10,
}
"""Of IPOPT: limits that meet in a corner ask for more care than `optimize.OPTIONS` take."""
MASS_TOLERANCE = 1e-3
"""Part of its mass by which a section may be heavier than the lightest."""
LOOK = 3
"""Rounds after which the middles of the boxes are looked at."""
RESTART = 12
"""Rounds after which a local search starts from the most promising box, if any are left."""
FEW = 48
"""Boxes up to which each is cut more than once before bounds are taken: a round costs as much."""


class NothingWithinLimitsError(SoftgripError, ValueError):
    """No section is within the limits."""


@dataclass(frozen=True)
class LimitedDesign:
    """A section, what it does, and what was proved of it.

    Attributes:
        section: m.
        values: Its measures, by name; see `limits.measures`.
        upper_bound: No section within the limits has a larger objective.
        boxes: Whose bound was taken.
        proven: Whether the bound is within the tolerance of the objective.
        active: Names of the limits and dimensions at whose ends it lies.
    """

    section: Section
    values: Mapping[str, float]
    upper_bound: float
    boxes: int
    proven: bool
    active: tuple[str, ...]


@dataclass(frozen=True)
class _Proposal:
    """A section and the multipliers of its limits; without a section, of the least violation."""

    section: Section | None
    objective: float
    multipliers: Floats


def proposed_within(limited: LimitedProblem) -> Section | None:
    """Return the section that the solver finds within limits, unproved; None if it finds none.

    It is the one that `best_within` proves, unless that meets a better one on the way.
    """
    check_units(limited.problem)
    return _proposed(limited).section


def best_within(limited: LimitedProblem, *, tolerance: float = TOLERANCE) -> LimitedDesign:
    """Return the best section within limits, proved.

    Args:
        limited: The problem.
        tolerance: Largest part of its objective by which another section may be better, > 0.

    Raises:
        NothingWithinLimitsError: If no section is within the limits; says whether that is proved.
        InvalidInputError: If a number is likely to be in another unit than SI.

    >>> from softgrip.actuator.limits import Limits
    >>> found = best_within(LimitedProblem(limits=Limits(mass=0.025)))
    >>> found.proven, round(found.values["mass"], 6), found.active
    (True, 0.025, ('mass', 'bottom', 'wall'))
    """
    check_units(limited.problem)
    check_positive(tolerance=tolerance)
    proposed, boxes = _proposed(limited), 0
    while True:
        target = proposed.objective * (1 + tolerance)
        bound, examined, better = _search(limited, proposed, target)
        boxes += examined
        if better is None:
            break
        proposed = better
    if proposed.section is None:
        how = "proved" if bound == -inf else "none was found"
        raise NothingWithinLimitsError(
            f"no section within the bounds has: {limited.limits}; {how}, in {boxes} boxes"
        )
    found = measures(limited, proposed.section)
    return LimitedDesign(
        proposed.section,
        {name: float(one) for name, one in found.items()},
        upper_bound=max(bound, proposed.objective),
        boxes=boxes,
        proven=bound <= target,
        active=_active(limited, proposed.section),
    )


@dataclass(frozen=True)
class Lightest:
    """The least mass of rubber for an objective.

    Attributes:
        mass: kg.
        section: Of that mass, m.
        boxes: Whose bound was taken for the proof.
        proven: Whether it is proved that no section lighter by `MASS_TOLERANCE` does as much.
    """

    mass: float
    section: Section
    boxes: int
    proven: bool


def lightest(limited: LimitedProblem, objective: float) -> Lightest:
    """Return the lightest section within limits whose objective is at least so large, proved.

    The best objective grows with the mass that is allowed, so that the least mass is a root.

    Args:
        limited: The problem; its limit of the mass is where the search begins.
        objective: That is wanted, > 0.

    Raises:
        NothingWithinLimitsError: If no section within the limits does as much.
        InvalidInputError: If the objective is not above zero.

    >>> design_1 = Section(0.020, 0.004, 0.030, 0.0015)
    >>> as_good = float(measures(LimitedProblem(), design_1)["objective"])
    >>> found = lightest(LimitedProblem(), as_good)
    >>> found.proven, round(1e3 * found.mass, 1)
    (True, 32.1)
    """
    check_positive(objective=objective)
    best = best_within(limited)
    if best.values["objective"] < objective:
        raise NothingWithinLimitsError(
            f"no section with {limited.limits} has an objective of {objective:.6g}; "
            f"the best has {best.upper_bound:.6g}"
        )
    sides, examined = _sides(limited), 0
    least = finger_mass(Section(*sides[:, 0].tolist()), limited.layout, limited.density)
    section, most = best.section, best.values["mass"]
    while True:
        low, high = np.log(float(least)), np.log(most)
        while high - low > MASS_TOLERANCE / 4:
            middle = (low + high) / 2
            lighter = _proposed(limited.within(mass=float(np.exp(middle))), _sides_of(section))
            if lighter.section is not None and lighter.objective >= objective:
                high, section = middle, lighter.section
            else:
                low = middle
        most = float(np.exp(high))
        under = limited.within(mass=most * (1 - MASS_TOLERANCE))
        bound, boxes, better = _search(under, _proposed(under), objective)
        examined += boxes
        if better is None or better.section is None:
            return Lightest(most, section, examined, bool(bound <= objective))
        section, most = better.section, most * (1 - MASS_TOLERANCE)


def _sides_of(section: Section) -> Floats:
    return np.array([section.top, section.bottom, section.width, section.wall])


def inside(limited: LimitedProblem, section: Section, slack: float = SLACK) -> Flags:
    """Tell which sections of numbers are within all limits, but for a slack."""
    with np.errstate(invalid="ignore"):  # where b < t there is no angle
        found, good = measures(limited, section), section.bottom > section.wall
    limits = {**ranges(limited), "height": limited.problem.bounds.height}
    for name, (low, high) in limits.items():
        value = section.height if name == "height" else found[name]
        good &= (value >= low * (1 - slack)) & (value <= high * (1 + slack))
    return np.asarray(good)


def _search(
    limited: LimitedProblem, proposed: _Proposal, target: float
) -> tuple[float, int, _Proposal | None]:
    """Bound the objective over all feasible sections, by halving boxes.

    Returns:
        The bound, the number of boxes, and a proposal that exceeds the target if one was met.
    """
    sides = _sides(limited)
    boxes, size = sides.reshape(8, 1), np.ptp(sides, axis=1)
    examined, dropped = 0, -inf
    for level in range(1000):
        examined += boxes.shape[1]
        bound, weights = upper_bound(
            limited, boxes, proposed.multipliers, proposed.section is None, target
        )
        kept = bound > target
        dropped = max(dropped, float(np.max(bound[~kept], initial=-inf)))
        boxes, bound, weights = boxes[:, kept], bound[kept], weights[:, kept]
        if not boxes.size:
            break
        better = _middle(limited, boxes, target) if level % LOOK == LOOK - 1 else None
        if better is None and level % RESTART == RESTART - 1:
            first = int(np.argmax(bound))
            better = _proposed(limited, boxes[::2, first] / 2 + boxes[1::2, first] / 2)
            if better.section is None or better.objective <= target:
                better = None
        narrow = ((boxes[1::2] - boxes[::2]) <= 1e-8 * sides[:, :1]).all(axis=0)
        if better is not None or narrow.any() or examined > MOST_BOXES:
            return max(dropped, float(bound.max())), examined, better
        for _ in range(4):
            boxes, weights = _halve(boxes, weights, size)
            if boxes.shape[1] > FEW:
                break
    return dropped, examined, None


def upper_bound(
    limited: LimitedProblem,
    boxes: Floats,
    multipliers: Floats,
    violated: bool = False,
    target: float = -inf,
) -> tuple[Floats, Floats]:
    """Return what the objective of no feasible section in a box exceeds, and what decides it.

    Args:
        limited: The problem.
        boxes: Least and largest a, b, w and t, m, shape (8, N).
        multipliers: Of height, bottom and `NAMES`, in logarithms; any will do. One above zero
            weighs an upper limit, one below a lower one.
        violated: Whether they are those of the least violation: then a box in which the weighed
            slacks sum to less than nothing holds no feasible section.
        target: Bounds below it are not sharpened.

    Returns:
        The bound, shape (N,), minus infinity where no section of the box is feasible, and how much
        of the bound is due to the width of each side, shape (4, N).
    """
    problem = limited.problem
    low, high = _ends(limited)
    weights = np.where(np.isfinite(np.where(multipliers > 0, high, low)), multipliers, 0.0)
    ends = np.where(weights > 0, high, np.where(weights < 0, low, 0.0))
    corners, slopes, value = _bounded(problem.combined, limited.layout)
    numbers = _parameters(limited)
    least, largest = (np.array(one) for one in corners(boxes[::2], boxes[1::2], numbers))
    feasible = (largest[1:] >= low[:, None] - SLACK) & (least[1:] <= high[:, None] + SLACK)
    with np.errstate(over="ignore"):
        bound = np.where(feasible.all(axis=0), np.exp(largest[0]), -inf)
    steep = np.zeros((4, bound.size))
    left = np.flatnonzero(bound > target)
    if not left.size:
        return bound, steep
    low_side, long = boxes[::2, left], boxes[1::2, left] - boxes[::2, left]
    given = numbers, weights, not violated
    falls, rises = (np.array(one) for one in slopes(low_side, boxes[1::2, left], *given))
    # About which point the bound is least (E. Baumann, BIT 28, 1988): an end if the slope has one
    # sign all over the box. Then the side adds nothing, however long it is. What is no number is
    # not known, and bounds nothing.
    falls = np.where(np.isnan(falls), -inf, np.minimum(falls, 0.0))
    rises = np.where(np.isnan(rises), inf, np.maximum(rises, 0.0))
    with np.errstate(invalid="ignore"):
        share = np.where(rises - falls > 0, rises / (rises - falls), 0.0)
        beyond = np.where(long > 0, -falls * share * long, 0.0)
        point = low_side + np.where(np.isfinite(share), share, 0.5) * long
        dual = np.array(value(point, *given, weights @ ends))[0] + beyond.sum(axis=0)
        steep[:, left] = np.maximum(-falls, rises) * long
    dual = np.where(np.isnan(dual), inf, dual)
    if violated:
        bound[left] = np.where(dual < -SLACK, -inf, bound[left])
    else:
        with np.errstate(over="ignore"):
            bound[left] = np.fmin(bound[left], np.exp(dual))
    return bound, steep


def _middle(limited: LimitedProblem, boxes: Floats, target: float) -> _Proposal | None:
    """Return the best of the sections in the middles of boxes if it beats the target, or None."""
    section = Section(*(boxes[::2] + boxes[1::2]) / 2)
    with np.errstate(invalid="ignore"):
        value = np.where(inside(limited, section), measures(limited, section)["objective"], -inf)
    best = int(np.argmax(value))
    if value[best] <= target:
        return None
    start = (boxes[::2, best] + boxes[1::2, best]) / 2
    solved = _proposed(limited, start)
    # A section on a slope from which IPOPT runs to the same peak is itself the better one.
    if solved.section is not None and solved.objective >= value[best]:
        return solved
    return _Proposal(Section(*map(float, start)), float(value[best]), solved.multipliers)


def _halve(boxes: Floats, weights: Floats, size: Floats) -> tuple[Floats, Floats]:
    """Cut each box in two across the side that decides its bound, or the longest."""
    part = (boxes[1::2] - boxes[::2]) / np.where(size > 0, size, inf)[:, None]
    known = np.isfinite(weights).all(axis=0)
    by_weight = np.where(known, weights, 0.0)
    share = by_weight / np.maximum(by_weight.sum(axis=0), 1e-300)
    # A side that is much longer than the others is cut at last, whatever it decides.
    side = np.argmax(share + part / np.maximum(part.max(axis=0), 1e-300) / 4, axis=0)
    rows, columns = 2 * side, np.arange(boxes.shape[1])
    middle = (boxes[rows, columns] + boxes[rows + 1, columns]) / 2
    lower, upper = boxes.copy(), boxes.copy()
    lower[rows + 1, columns] = middle
    upper[rows, columns] = middle
    half = weights.copy()
    half[side, columns] /= 2
    return np.concatenate([lower, upper], axis=1), np.concatenate([half, half], axis=1)


def _sides(limited: LimitedProblem) -> Floats:
    """Return least and largest a, b, w and t, shape (4, 2).

    Torque and angle fall with t, and mass grows: where neither air nor buckling is limited, nothing
    speaks for a thicker wall.
    """
    bounds, limits = limited.problem.bounds, limited.limits
    sides = np.array([getattr(bounds, name) for name in DIMENSIONS], np.float64)
    if limits.air == inf and not limits.buckling:
        sides[3, 1] = sides[3, 0]
    sides[1, 0] = max(sides[1, 0], sides[3, 0])
    return sides


def _ends(limited: LimitedProblem) -> tuple[Floats, Floats]:
    """Return the ends of height, bottom and `NAMES`, as logarithms."""
    known = ranges(limited)
    ends = [limited.problem.bounds.height, limited.problem.bounds.bottom]
    ends += [known.get(name, (0.0, inf)) for name in NAMES]
    with np.errstate(divide="ignore"):
        low, high = np.log(np.array(ends, np.float64)).T
    return low, high


def _parameters(limited: LimitedProblem) -> list[float]:
    problem = limited.problem
    return [
        problem.pressure,
        problem.young_modulus,
        problem.fractional_power,
        problem.torque_scale,
        problem.angle_scale,
        limited.density,
    ]


def _active(limited: LimitedProblem, section: Section) -> tuple[str, ...]:
    """Name the limits and dimensions at whose ends a section lies, within 1e-5 of them."""
    found, names = measures(limited, section), []
    for name, ends in ranges(limited).items():
        if any(isfinite(end) and end and abs(found[name] / end - 1) < 1e-5 for end in ends):
            names.append(name)
    for name in (*DIMENSIONS, "height"):
        value, ends = getattr(section, name), getattr(limited.problem.bounds, name)
        if any(abs(value / end - 1) < 1e-5 for end in ends):
            names.append(name)
    return tuple(names)


def _proposed(limited: LimitedProblem, start: Floats | None = None) -> _Proposal:
    """Return a local optimum by IPOPT, or what violates the limits the least."""
    sides, (low, high) = _sides(limited), _ends(limited)
    best, violation = _solvers(limited.problem.combined, limited.layout)
    ends = np.log(sides)
    # The second unknown is b - t: between b and t lies no path through b < t.
    ends[1] = np.log(sides[1, 0] * LEAST_LEVER), np.log(sides[1, 1] - sides[3, 0])
    guess = sides.mean(axis=1) if start is None else np.asarray(start)
    guess = np.log([guess[0], max(guess[1] - guess[3], guess[1] * LEAST_LEVER), *guess[2:]])
    given: dict[str, Any] = {"p": _parameters(limited)}
    box = {"lbx": ends[:, 0], "ubx": ends[:, 1]}
    size = low.size
    for attempt in range(2):
        found = best(x0=guess, lbg=low, ubg=high, **given, **box)
        if best.stats()["success"]:
            a, lever, w, t = np.exp(np.array(found["x"]).ravel())
            corner = np.clip([a, lever + t, w, t], *sides.T)
            section = Section(*map(float, corner))
            if inside(limited, section):
                value = float(measures(limited, section)["objective"])
                return _Proposal(section, value, np.array(found["lam_g"]).ravel())
        if attempt:
            break
        least = violation(
            x0=[*guess, -0.1],
            lbx=[*ends[:, 0], -20.0],
            ubx=[*ends[:, 1], 0.01],
            lbg=[*low, *np.full(size, -inf)],
            ubg=[*np.full(size, inf), *high],
            **given,
        )
        multipliers = np.array(least["lam_g"]).ravel()
        if violation.stats()["success"] and float(least["x"][4]) < 0:
            return _Proposal(None, -inf, multipliers[:size] + multipliers[size:])
        guess = np.array(least["x"]).ravel()[:4]
    return _Proposal(None, -inf, np.zeros(size))


def _logs(x: Any, p: Any, combined: Combined, layout: Layout) -> tuple[Any, Any]:
    """Return the logarithms of objective and limits of a section of symbols."""
    section = Section(*ca.vertsplit(x))
    P, E, n, torque_scale, angle_scale, density = ca.vertsplit(p)
    found = laws(section, layout, P, E, n, density)
    total = combine(combined, found["torque"] / torque_scale, found["angle"] / angle_scale)
    limits = [section.height, section.bottom, *(found[name] for name in NAMES)]
    return ca.log(total), ca.log(ca.vertcat(*limits))


@cache
def _solvers(combined: Combined, layout: Layout) -> tuple[Any, Any]:
    """Build the nonlinear programs of a layout once: all other numbers are parameters of them."""
    logs, p, margin = ca.SX.sym("logs", 4), ca.SX.sym("p", 6), ca.SX.sym("margin")
    a, lever, w, t = ca.vertsplit(ca.exp(logs))
    total, limits = _logs(ca.vertcat(a, lever + t, w, t), p, combined, layout)
    best: dict[str, Any] = {"x": logs, "p": p, "f": -total, "g": limits}
    least: dict[str, Any] = {
        "x": ca.vertcat(logs, margin),
        "p": p,
        "f": -margin,
        "g": ca.vertcat(limits - margin, limits + margin),
    }
    return (
        ca.nlpsol("within_limits", "ipopt", best, SAFE),
        ca.nlpsol("least_violation", "ipopt", least, SAFE),
    )


@cache
def _bounded(combined: Combined, layout: Layout) -> tuple[Any, Any, Any]:
    """Return what `upper_bound` asks of a box, and of a point in it.

    Of the box: the logarithms of least and largest objective and limits; between what the slopes of
    the weighed sum lie. Of the point: the sum.
    """
    x, p = ca.SX.sym("x", 4), ca.SX.sym("p", 6)
    weights, shift, counts = ca.SX.sym("m", 2 + len(NAMES)), ca.SX.sym("s"), ca.SX.sym("o")
    total, limits = _logs(x, p, combined, layout)
    # Of an upper limit g <= e with m > 0 the slack e - g weighs m; of a lower one g - e weighs -m.
    dual = counts * total - ca.dot(weights, limits) + shift
    given = [p, weights, counts]
    slope = ca.Function("slope", [x, *given], [ca.gradient(dual, x)])
    value = ca.Function("value", [x, *given, shift], [dual])
    low, high = ca.SX.sym("low", 4), ca.SX.sym("high", 4)
    falls, rises = enclosed(slope, 1, positive=2)(low, high, *given)
    least, largest = _corners(low, high, p, combined, layout)
    corners = ca.Function("corners", [low, high, p], [least, largest])
    return corners, ca.Function("slopes", [low, high, *given], [falls, rises]), value


def _corners(low: Any, high: Any, p: Any, combined: Combined, layout: Layout) -> tuple[Any, Any]:
    """Return the logarithms of what objective and limits lie between, by monotone factors."""
    a0, b0, w0, t0 = ca.vertsplit(low)
    a1, b1, w1, t1 = ca.vertsplit(high)
    P, E, n, torque_scale, angle_scale, density = ca.vertsplit(p)
    h0, h1 = a0 + b0, a1 + b1
    small, large = Section(a0, b0, w0, t0), Section(a1, b1, w1, t0)
    lever = ca.fmax(b1 - t0, 0) * wall_stress_ratio(large)
    pushed = P / 2 * lever * w1 * h1
    # T / I_n with w cancelled: what is left falls with the height.
    curvature = (P / 2 * lever / (E * modified_moment(n, 1.0, 1.0) * h0 ** (1 + n))) ** (1 / n)
    longer = 1 + P * wall_stress_ratio(Section(a1, b0, w1, t0)) / E
    bent = n / (n + 1) * curvature * layout.length * longer
    total = combine(combined, pushed / torque_scale, bent / angle_scale)
    column = Finger(small, layout.length, E, n)
    # Of the pressures at the small corner, moment and chamber are exchanged for the best.
    areas = chamber_area(small) / chamber_area(Section(a0, b0, w0, t1))
    stiffer = (most / least for most, least in zip(moments(w1, h1), moments(w0, h0), strict=True))
    resists = [
        pressure * stiff**n * areas / P
        for pressure, stiff in zip(buckling_pressures(column), stiffer, strict=True)
    ]
    power = n + 2
    least = [
        0, h0, b0, 0, 0, E * w0 * h0**power, finger_mass(small, layout, density),
        envelope(small, layout), air_volume(Section(a0, b0, w0, t1), layout), 0, 0,
    ]  # fmt: skip
    largest = [
        total, h1, b1, pushed, bent, E * w1 * h1**power, ca.inf, ca.inf, ca.inf, *resists,
    ]  # fmt: skip
    return ca.log(ca.vertcat(*least)), ca.log(ca.vertcat(*largest))
