"""Loop shaping after Glover and McFarlane: the controller with the largest coprime-factor margin.

The margin ``b`` of a loop is the size of the error of the plant's normalised coprime factors that
it withstands: one over the norm of ``[I; K] (I + G K)^-1 [I, G]``. No controller has more than
``1 / sqrt(1 + rho(X Z))``, with X and Z of two Riccati equations.

D. McFarlane and K. Glover, "A loop-shaping design procedure using H-infinity synthesis", IEEE
Transactions on Automatic Control 37 (1992) 759-769.
"""

from dataclasses import dataclass
from typing import final

import control
import numpy as np
from scipy.linalg import solve_continuous_are

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError

BACK_OFF = 1.01
"""Factor on the least gamma, without which the controller has a pole that runs to infinity."""


@final
@dataclass(frozen=True)
class RobustLoop:
    """A loop shape and the controller that makes it robust, with negative feedback.

    Attributes:
        shape: The loop that was asked for, ``G W``.
        controller: K, of the order of the shape.
        gamma: Least gamma: ``1 / gamma`` is the largest margin that a controller has. Below 4 the
            shape is held to be a sound one.
    """

    shape: control.StateSpace
    controller: control.StateSpace
    gamma: float

    @property
    def loop(self) -> control.StateSpace:
        """``G W K``."""
        return control.series(self.controller, self.shape)

    @property
    def complementary(self) -> control.StateSpace:
        """``L / (1 + L)``: H(s), which is 1 at frequency 0 if the shape integrates."""
        return control.feedback(self.loop, 1)


def least_gamma(system: control.StateSpace) -> float:
    """Return ``sqrt(1 + rho(X Z))``: one over the largest coprime-factor margin of any loop.

    Args:
        system: One input, one output, minimal, continuous.

    >>> round(least_gamma(control.ss(0, 1, 3, 0)) ** 2, 6)  # any k / s
    2.0
    """
    X, Z = _riccati(system)
    return _gamma(X, Z)


def coprime_margin(plant: control.LTI, controller: control.LTI) -> float:
    """Return the coprime-factor margin of a loop with negative feedback.

    It is 0 if the loop is not stable, or has no solution because direct terms cancel.

    Args:
        plant, controller: One input, one output, continuous, proper.

    >>> round(coprime_margin(control.tf([3], [1, 0]), control.tf([1], [1])), 4)  # 1 / sqrt(2)
    0.7071
    """
    G, K = control.ss(plant), control.ss(controller)
    if (1 + G.D * K.D).item() == 0:
        return 0.0
    parts = control.append(G, K)
    # The plant gets what disturbs it less K's output; K gets the plant's output and its noise.
    crossed = control.ss([], [], [], [[0.0, -1.0], [1.0, 0.0]])
    closed = control.feedback(parts, crossed, sign=1)
    if closed.poles().real.max(initial=-1.0) >= 0:
        return 0.0
    # The signals that count are K's input, which holds the noise itself, and K's output.
    direct = closed.D + np.array([[0.0, 1.0], [0.0, 0.0]])
    return float(1 / control.system_norm(control.ss(closed.A, closed.B, closed.C, direct), p="inf"))


def glover_mcfarlane(shape: control.StateSpace, *, factor: float = BACK_OFF) -> RobustLoop:
    """Return the controller that makes a loop shape most robust.

    Args:
        shape: Plant times weight: one input, one output, minimal, continuous.
        factor: On the least gamma, > 1.

    Raises:
        InvalidInputError: If the factor is not above 1, or the shape is sampled.
    """
    if not factor > 1 or shape.dt:
        raise InvalidInputError(
            "shape, factor", expected="a continuous system, a factor > 1", got=(shape.dt, factor)
        )
    A, B, C, D = shape.A, shape.B, shape.C, shape.D
    X, Z = _riccati(shape)
    least = _gamma(X, Z)
    square = (factor * least) ** 2
    F = -np.linalg.solve(1 + D.T @ D, D.T @ C + B.T @ X)
    inner = (1 - square) * np.eye(len(A)) + X @ Z
    gain = square * np.linalg.solve(inner.T, Z @ C.T)
    # The formulas are those of positive feedback: its sign is taken up here.
    controller = control.ss(A + B @ F + gain @ (C + D @ F), gain, -B.T @ X, D.T)
    return RobustLoop(shape, controller, least)


def _gamma(X: Floats, Z: Floats) -> float:
    return float(np.sqrt(1 + np.max(np.linalg.eigvals(X @ Z).real)))


def _riccati(system: control.StateSpace) -> tuple[Floats, Floats]:
    A, B, C, D = system.A, system.B, system.C, system.D
    one = 1 + D.T @ D
    X = solve_continuous_are(A, B, C.T @ C, one, s=C.T @ D)
    Z = solve_continuous_are(A.T, C.T, B @ B.T, one, s=B @ D.T)
    return X, Z
