"""A controller of lower order, by balanced truncation of its normalised coprime factors."""

import control
import numpy as np
from scipy.linalg import solve_continuous_are, solve_continuous_lyapunov

from softgrip.errors import InvalidInputError


def reduce_order(system: control.StateSpace, order: int) -> control.StateSpace:
    """Return the system of a lower order whose coprime factors are nearest, as truncation goes.

    The factors are stable whatever the system is, so that an unstable one may be given too, and
    what is near in them behaves alike in a loop (McFarlane and Glover, 1990).

    Args:
        system: One input, one output, minimal, continuous.
        order: From 1 to that of the system, which is then returned as it is.

    >>> slow_and_fast = control.ss(control.tf([500], np.polymul([1, 1], [1, 500])))
    >>> reduce_order(slow_and_fast, 1).poles().real.round(2).tolist()
    [-0.99]
    """
    if not 1 <= order <= system.nstates:
        raise InvalidInputError("order", expected=f"1 to {system.nstates}", got=order)
    if order == system.nstates:
        return system
    A, B, C, D = system.A, system.B, system.C, system.D
    one = (1 + D @ D.T).item()
    Z = solve_continuous_are(A.T, C.T, B @ B.T, one * np.eye(1), s=B @ D.T)
    H = -(B @ D.T + Z @ C.T) / one
    root = one**-0.5
    # [N, M] with K = N / M: stable, with M = root at infinity.
    A_f, B_f, C_f = A + H @ C, np.hstack([B + H @ D, H]), root * C
    P = solve_continuous_lyapunov(A_f, -B_f @ B_f.T)
    Q = solve_continuous_lyapunov(A_f.T, -C_f.T @ C_f)
    U, S, V = np.linalg.svd(_root(Q).T @ _root(P))
    left = _root(Q) @ U[:, :order] / np.sqrt(S[:order])
    right = _root(P) @ V[:order].T / np.sqrt(S[:order])
    A_r, B_r, C_r = left.T @ A_f @ right, left.T @ B_f, C_f @ right / root
    return control.ss(A_r - B_r[:, 1:] @ C_r, B_r[:, :1] - B_r[:, 1:] @ D, C_r, D)


def _root(gramian: np.ndarray) -> np.ndarray:
    values, vectors = np.linalg.eigh(gramian)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0)))
