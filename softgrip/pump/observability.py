"""Whether measurements tell of the state: observability of a time-varying linear system."""

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, floats
from softgrip.errors import InvalidInputError


def observability_matrix(transitions: ArrayLike, H: ArrayLike) -> Floats:
    """Stack what each sample measures of the first state: ``H, H F_0, H F_1 F_0, ...``.

    Args:
        transitions: F_k of ``x_{k+1} = F_k x_k``, shape (K, n, n).
        H: Measurement matrix, shape (m, n).

    Returns:
        ndarray: Shape ((K + 1) m, n).

    Raises:
        InvalidInputError: If the shapes do not fit.

    >>> observability_matrix([[[1, 0.5], [0, 1]]], [[1, 0]]).tolist()
    [[1.0, 0.0], [1.0, 0.5]]
    """
    F, rows = floats(transitions=transitions, H=H)
    if F.ndim != 3 or rows.ndim != 2 or F.shape[1:] != (rows.shape[1],) * 2:
        raise InvalidInputError(
            "transitions, H", expected="shapes (K, n, n) and (m, n)", got=(F.shape, rows.shape)
        )
    since_start = np.eye(rows.shape[1])
    blocks = [rows]
    for step in F:
        since_start = step @ since_start
        blocks.append(rows @ since_start)
    return np.vstack(blocks)


def observable_rank(transitions: ArrayLike, H: ArrayLike, scale: ArrayLike | None = None) -> int:
    """Count the directions of the state that the measurements tell of.

    Args:
        transitions, H: As for `observability_matrix`.
        scale: Typical size of each state, shape (n,), > 0; None for ones. Without it, a state of
            large numbers, whose column is small, can pass for rounding.

    Raises:
        InvalidInputError: If the shapes do not fit or a scale is not above zero.

    >>> observable_rank([[[1, 0.5], [0, 1]]], [[1, 0]])
    2
    """
    columns = observability_matrix(transitions, H)
    sizes = np.ones(columns.shape[1]) if scale is None else floats(scale=scale)[0]
    if sizes.shape != columns.shape[1:]:
        raise InvalidInputError(
            "scale", expected=f"shape {columns.shape[1:]}", got=f"shape {sizes.shape}"
        )
    check_positive(scale=sizes)
    return int(np.linalg.matrix_rank(columns * sizes))
