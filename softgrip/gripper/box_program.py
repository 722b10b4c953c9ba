"""Quadratic programs in a box, many at once: ``min x H x / 2 + g x`` with each ``|x| <= 1``.

All programs of a group share H, so that what has to be inverted is inverted once.
"""

from dataclasses import dataclass
from typing import final

import numpy as np

from softgrip.arrays import Floats, read_only
from softgrip.errors import InvalidInputError

ITERATIONS = 50
RELAXATION = 1.6


@final
@dataclass(frozen=True)
class BoxPrograms:
    """Programs of some groups by the alternating direction method, which multiplies only.

    Attributes:
        inverse: ``(H + rho I)^-1`` of each group, shape (..., moves, moves).
        rho: Of each, shape (..., 1, 1).
    """

    inverse: Floats
    rho: Floats

    @classmethod
    def of(cls, H: Floats) -> "BoxPrograms":
        """Return the programs of Hessians, symmetric and positive, shape (..., moves, moves).

        Raises:
            InvalidInputError: If one is not.

        >>> programs = BoxPrograms.of(np.eye(2))
        >>> programs.solve(np.array([[0.5, -3.0]]))[0].round(6).tolist()
        [[-0.5, 1.0]]
        """
        values = np.linalg.eigvalsh(H)
        if not (np.isfinite(values).all() and (values > 0).all()):
            raise InvalidInputError("H", expected="positive matrices", got=values)
        rho = np.sqrt(values[..., 0] * values[..., -1])[..., None, None]
        unit = np.eye(H.shape[-1])
        return cls(read_only(np.linalg.inv(H + rho * unit)), read_only(rho))

    def solve(
        self, g: Floats, start: tuple[Floats, Floats] | None = None, iterations: int = ITERATIONS
    ) -> tuple[Floats, Floats]:
        """Return the minima in the box, and the scaled multipliers to start the next ones from.

        Args:
            g: Shape (..., runs, moves).
            start: What an earlier call returned, of programs alike; None for 0.
            iterations: >= 1.
        """
        inside, lasting = (np.zeros_like(g), np.zeros_like(g)) if start is None else start
        for _ in range(iterations):
            # The inverse is symmetric: rows of runs times it.
            free = (self.rho * (inside - lasting) - g) @ self.inverse
            free = RELAXATION * free + (1 - RELAXATION) * inside
            inside = np.clip(free + lasting, -1.0, 1.0)
            lasting = lasting + free - inside
        return inside, lasting
