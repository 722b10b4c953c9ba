"""That a design is the best of all: branch and bound on Eq. (3.20) with bounds that are proved.

What is proved by hand (each factor of `section.torque` and Eq. (3.10) is monotone where b > t):

- the objective falls with t, which is in no other constraint: t is at its lower bound;
- it grows with w: for given a and b, w is as large as its bound and Eq. (3.21) allow;
- ``g = (b - t) A_c / A_w`` grows with a, b and w; ``A_c / A_w`` grows with a and w and falls with
  b; so T and theta in a box of a and b lie below what its corners give, and their sum or product
  does.

What is left is a rectangle of a and b, cut into ever smaller boxes; a box whose bound does not
reach the design's value is dropped, and when none is left the design is proved to be within the
tolerance of the best. A local solver started many times would prove nothing.
"""

from dataclasses import dataclass

import numpy as np

from softgrip.actuator.bending import modified_moment
from softgrip.actuator.design import DesignProblem, combine, objective
from softgrip.actuator.optimize import Design, evaluate, optimal_design
from softgrip.actuator.section import Section, wall_stress_ratio
from softgrip.arrays import Floats, check_positive
from softgrip.errors import InvalidInputError

MOST_BOXES = 2_000_000

TOLERANCE = 1e-5
"""Part of its objective by which another section may be better than a proved design."""


@dataclass(frozen=True)
class Certificate:
    """What branch and bound says of a design.

    Attributes:
        objective: Of the design.
        upper_bound: No section that fulfils the constraints has a larger objective.
        boxes: Number of boxes whose bound was taken.
        better: A section that fulfils the constraints and does better, if one was met: then the
            design is refuted, and the upper bound is the best known so far.
        proven: Whether ``upper_bound - objective`` is within the tolerance asked for.
    """

    objective: float
    upper_bound: float
    boxes: int
    better: Section | None
    proven: bool


@dataclass(frozen=True)
class CertifiedDesign:
    """A design and the certificate that goes with it."""

    design: Design
    certificate: Certificate


def certified_design(
    problem: DesignProblem, start: Section | None = None, *, tolerance: float = TOLERANCE
) -> CertifiedDesign:
    """Solve the design problem for its global optimum, and prove that it is one.

    IPOPT finds a local optimum, and the problem can have several: where the torque scale is large
    and the material nearly linear, one at the smallest height and one at the largest. Branch and
    bound either proves the one found, or meets a better section, from which IPOPT starts again.

    Args:
        problem, start: As of `optimize.optimal_design`, whose errors it raises.
        tolerance: As of `certify`.

    >>> two_peaks = DesignProblem(
    ...     pressure=20e3, fractional_power=1.5, torque_scale=1.0, angle_scale=8.0)
    >>> found = certified_design(two_peaks)
    >>> found.certificate.proven, round(found.design.section.height, 4)
    (True, 0.025)
    """
    design = optimal_design(problem, start)
    found = certify(problem, design, tolerance=tolerance)
    while found.better is not None:
        improved = optimal_design(problem, found.better)
        # A section on a slope of which IPOPT runs to the same peak is itself the better one.
        if improved.objective <= design.objective:
            improved = evaluate(problem, found.better)
        design = improved
        found = certify(problem, design, tolerance=tolerance)
    return CertifiedDesign(design, found)


def certify(problem: DesignProblem, design: Design, *, tolerance: float = TOLERANCE) -> Certificate:
    """Bound the objective over all sections that fulfil the constraints.

    Args:
        problem: Eq. (3.20) with its numbers.
        design: The one that may be the best; it must fulfil the constraints.
        tolerance: Largest part of its objective by which another section may be better, > 0.

    Raises:
        InvalidInputError: If the tolerance is not above zero.
    """
    check_positive(tolerance=tolerance)
    bounds = problem.bounds
    if design.section.bottom < bounds.wall[0]:
        raise InvalidInputError("design", expected="one with b >= t", got=design.section)
    target = design.objective * (1 + tolerance)
    # Rows: least a, largest a, least b, largest b; a column is a box.
    boxes = np.array(
        [[*bounds.top, max(bounds.bottom[0], bounds.wall[0]), bounds.bottom[1]]], np.float64
    ).T
    examined, dropped = 0, -np.inf
    size = boxes[1::2] - boxes[::2]
    while boxes.size:
        examined += boxes.shape[1]
        bound = upper_bound(problem, boxes)
        kept = bound > target
        dropped = max(dropped, float(np.max(bound[~kept], initial=-np.inf)))
        boxes = boxes[:, kept]
        better = _better(problem, boxes, target)
        if better is not None or examined > MOST_BOXES:
            most = max(dropped, float(np.max(bound[kept], initial=-np.inf)))
            return Certificate(design.objective, most, examined, better, proven=False)
        boxes = _halve(boxes, size)
    most = max(dropped, design.objective)
    return Certificate(design.objective, most, examined, None, proven=True)


def _better(problem: DesignProblem, boxes: Floats, target: float) -> Section | None:
    """Return the best of the sections in the middles of boxes if it beats the target, or None."""
    bounds, t = problem.bounds, problem.bounds.wall[0]
    a, b = (boxes[0] + boxes[1]) / 2, (boxes[2] + boxes[3]) / 2
    first, last = problem.product_range
    stiff = problem.young_modulus * (a + b) ** (problem.fractional_power + 2)
    w = np.minimum(bounds.width[1], last / stiff)
    good = (a + b >= bounds.height[0]) & (a + b <= bounds.height[1]) & (b > t)
    good &= (w >= bounds.width[0]) & (w * stiff >= first)
    if not good.any():
        return None
    values = objective(problem, Section(a[good], b[good], w[good], t))
    best = int(np.argmax(values))
    if values[best] <= target:
        return None
    return Section(float(a[good][best]), float(b[good][best]), float(w[good][best]), t)


def upper_bound(problem: DesignProblem, boxes: Floats) -> Floats:
    """Return a number that the objective exceeds nowhere in a box, shape (N,).

    Minus infinity where no section of the box fulfils the constraints.

    Args:
        problem: Eq. (3.20) with its numbers.
        boxes: Least and largest a, least and largest b, m, shape (4, N), all b >= the thinnest
            wall.
    """
    bounds, P, E = problem.bounds, problem.pressure, problem.young_modulus
    n, t = problem.fractional_power, bounds.wall[0]
    a_low, a_high, b_low, b_high = boxes
    first, last = problem.product_range
    narrow, wide = bounds.width
    # Of the heights in the box, those that the height and Eq. (3.21) allow with some width.
    low = np.maximum(a_low + b_low, max(bounds.height[0], (first / (E * wide)) ** (1 / (n + 2))))
    high = np.minimum(
        a_high + b_high, min(bounds.height[1], (last / (E * narrow)) ** (1 / (n + 2)))
    )
    empty = low > high * (1 + 1e-12)
    high = np.maximum(high, low)
    a_high, b_high = np.minimum(a_high, high - b_low), np.minimum(b_high, high - a_low)
    empty |= (a_high < a_low * (1 - 1e-12)) | (b_high < b_low * (1 - 1e-12))
    a_high, b_high = np.maximum(a_high, a_low), np.maximum(b_high, b_low)
    w = np.minimum(wide, last / (E * low ** (n + 2)))
    lever = (b_high - t) * wall_stress_ratio(Section(a_high, b_high, w, t))
    torque = P / 2 * lever * w * high
    # T / I_n with w cancelled: what is left falls with the height.
    curvature = (P / 2 * lever / (E * modified_moment(n, 1.0, 1.0) * low ** (1 + n))) ** (1 / n)
    longer = 1 + P * wall_stress_ratio(Section(a_high, b_low, w, t)) / E
    angle = n / (n + 1) * curvature * problem.length * longer
    bound = combine(problem.combined, torque / problem.torque_scale, angle / problem.angle_scale)
    return np.where(empty, -np.inf, bound)


def _halve(boxes: Floats, size: Floats) -> Floats:
    """Cut each box in two across the side that is the larger part of the whole one's."""
    part = (boxes[1::2] - boxes[::2]) / np.where(size > 0, size, np.inf)
    side = np.argmax(part, axis=0)
    rows, columns = 2 * side, np.arange(boxes.shape[1])
    middle = (boxes[rows, columns] + boxes[rows + 1, columns]) / 2
    lower, upper = boxes.copy(), boxes.copy()
    lower[rows + 1, columns] = middle
    upper[rows, columns] = middle
    return np.concatenate([lower, upper], axis=1)
