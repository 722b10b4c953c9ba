"""Loop shaping after Glover and McFarlane, and the filter H(s) that it gives.

Section 6.3 takes H from "loop-shaping synthesis" with a target loop such as 4.8/s. What is kept of
it is the complementary sensitivity of the shaped loop.

D. McFarlane and K. Glover, "A loop-shaping design procedure using H-infinity synthesis", IEEE
Transactions on Automatic Control 37 (1992) 759-769.
"""

from dataclasses import dataclass
from typing import final

import control
import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import solve_continuous_are
from scipy.optimize import minimize_scalar

from softgrip.arrays import Floats, check_positive
from softgrip.errors import InvalidInputError

SUBOPTIMAL = 1.1
"""Factor on the least gamma, without which the controller has a pole that runs to infinity."""


@final
@dataclass(frozen=True)
class ShapedLoop:
    """A loop shape made robust.

    Attributes:
        shape: The loop that was asked for, ``P W``.
        loop: The one that came out, ``P W K``, with negative feedback.
        gamma: Least gamma: ``1 / gamma`` is the largest size of the normalised coprime factors'
            error that some controller withstands. Below 4 the shape is held to be a sound one.
    """

    shape: control.StateSpace
    loop: control.StateSpace
    gamma: float

    @property
    def complementary(self) -> control.StateSpace:
        """``L / (1 + L)``: H(s), which is 1 at frequency 0."""
        return control.feedback(self.loop, 1)


def glover_mcfarlane(shape: control.StateSpace, *, factor: float = SUBOPTIMAL) -> ShapedLoop:
    """Return the loop of a shape and the controller that makes it most robust.

    Args:
        shape: Plant times weight: minimal, continuous, D = 0.
        factor: On the least gamma, > 1.

    The least gamma is ``sqrt(1 + rho(X Z))`` with X, Z of the two Riccati equations.

    Raises:
        InvalidInputError: If the factor is not above 1, or the shape has a direct term.

    >>> round(glover_mcfarlane(control.ss(0, 1, 3, 0)).gamma ** 2, 6)  # any k / s
    2.0
    """
    if not factor > 1 or np.any(shape.D) or shape.dt:
        raise InvalidInputError(
            "shape, factor", expected="a continuous system with D = 0, a factor > 1", got=factor
        )
    A, B, C = shape.A, shape.B, shape.C
    X, Z = _riccati(shape)
    least = float(np.sqrt(1 + np.max(np.linalg.eigvals(X @ Z).real)))
    square = (factor * least) ** 2
    F = -B.T @ X
    inner = (1 - square) * np.eye(len(A)) + X @ Z
    gain = square * np.linalg.solve(inner.T, Z @ C.T)
    # The formulas are those of positive feedback: its sign is taken up here.
    controller = control.ss(A + B @ F + gain @ C, gain, -B.T @ X, 0)
    return ShapedLoop(shape, control.series(controller, shape), least)


def target_loop(crossover: float, roll_off: float, order: int = 2) -> control.StateSpace:
    """Return ``crossover / s``, rolled off: ``(roll_off / (s + roll_off))**order``.

    The plant has a relative degree of 3, so no proper weight gives it the loop ``crossover / s``:
    two poles must be added, and the text does not say where. Which plant it is then does not
    matter, since the weight cancels it.

    Args:
        crossover: rad/s, > 0: 4.8 or 2 in Section 6.4.
        roll_off: rad/s, > 0.
        order: Poles added, >= 1.
    """
    check_positive(crossover=crossover, roll_off=roll_off, order=order)
    A = np.diag([-roll_off] * order + [0.0]) + roll_off * np.eye(order + 1, k=1)
    B, C = np.zeros((order + 1, 1)), np.zeros((1, order + 1))
    B[-1], C[0, 0] = crossover, 1.0
    return control.ss(A, B, C, 0)


def magnitude_gap(first: control.StateSpace, second: control.StateSpace, w: ArrayLike) -> Floats:
    """Return ``|first| / |second| - 1`` at frequencies w, rad/s, shape (N,)."""
    points = 1j * np.asarray(w, dtype=np.float64)
    return np.asarray(np.abs(first(points)).ravel() / np.abs(second(points)).ravel() - 1)


def fit_roll_off(
    crossover: float,
    filter: control.StateSpace,
    frequency: ArrayLike,
    *,
    factor: float = SUBOPTIMAL,
    order: int = 2,
) -> tuple[float, ShapedLoop]:
    """Return the roll-off [rad/s] that brings the shaped loop nearest to a filter, and that loop.

    It is a fit of the one number that a target loop leaves open, by the root mean square of the
    logarithm of the ratio of the gains.

    Args:
        crossover: Of the target loop, rad/s, > 0.
        filter: H(s) to come near to.
        frequency: rad/s, > 0, shape (N,), at which they are compared.
        factor: As for `glover_mcfarlane`.
        order: As for `target_loop`.
    """

    def shaped(log_ratio: float) -> ShapedLoop:
        shape = target_loop(crossover, crossover * float(np.exp(log_ratio)), order)
        return glover_mcfarlane(shape, factor=factor)

    def cost(log_ratio: float) -> float:
        gap = magnitude_gap(shaped(log_ratio).complementary, filter, frequency)
        return float(np.mean(np.log1p(gap) ** 2))

    found = minimize_scalar(cost, bounds=(0.0, 4.0), method="bounded")
    return crossover * float(np.exp(found.x)), shaped(float(found.x))


def _riccati(system: control.StateSpace) -> tuple[Floats, Floats]:
    A, B, C = system.A, system.B, system.C
    X = solve_continuous_are(A, B, C.T @ C, np.eye(B.shape[1]))
    Z = solve_continuous_are(A.T, C.T, B @ B.T, np.eye(C.shape[0]))
    return X, Z
