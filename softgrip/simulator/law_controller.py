"""A `SampledLaw` as a controller of the rig on NumPy: the reference of the kernel."""

from typing import final

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.checks import samples
from softgrip.control.differentiator import RobustDifferentiator
from softgrip.simulator.sampled_law import SampledLaw


@final
class LawController:
    """A law as it is before its first update.

    Args:
        law: Of the runs that it will be asked for, or of all.
    """

    def __init__(self, law: SampledLaw) -> None:
        self.law, self._updates = law, 0
        self._differentiator = (
            None if law.jerk is None else RobustDifferentiator(law.jerk, period=law.matrices.period)
        )
        self._state: Floats | None = None

    def update(self, measured: ArrayLike) -> Floats:
        """Return the command, rad/s, shape (runs,); angles in rad, shape (fingers, runs)."""
        (seen,) = samples(measured=measured)
        law, m = self.law, self.law.matrices
        if self._differentiator is not None:
            seen = self._differentiator.update(seen.mean(axis=0))
        y = seen.T
        goal = law.reference[..., min(self._updates, law.reference.shape[-2] - 1), :]
        if self._state is None:
            self._state = np.zeros((len(y), m.C.shape[-1]))
            if law.start is not None:
                self._state = self._state + _times(law.start, y)
        self._updates += 1
        x = self._state
        free = sum(np.sum(a * b, axis=-1) for a, b in ((m.C, x), (m.D_measured, y)))
        free = np.asarray(free + np.sum(m.D_target * goal, axis=-1))
        sent = np.minimum(np.maximum(free, law.least), law.largest)
        ahead = _times(m.A, x) + _times(m.B_measured, y) + _times(m.B_target, goal)
        ahead = ahead + m.B_sent * sent[:, None]
        if law.integral is not None:
            pushed = (free - sent)[:, None] * m.C * (ahead - x)
            ahead = np.where((law.integral > 0) & (pushed > 0), x, ahead)
        self._state = ahead
        return np.asarray(sent if law.digits is None else np.round(sent, law.digits))


def _times(matrix: Floats, vector: Floats) -> Floats:
    return np.asarray(np.einsum("...ij,...j->...i", matrix, vector))
