"""Memory of a rubber layer under force: a part of what it feels lags behind, and can be undone.

A layer that creeps feels ``(1 - sum(parts)) F`` at once, and each part with a first-order lag. A
constant force is so felt more and more, and a force that is gone is felt for a while. This is the
memory of the simulated force layer; here it is a law of readings, of which the parts may be known
or fitted (`fitted_creep`), and which may be sampled at any times.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize_scalar
from sklearn.isotonic import IsotonicRegression

from softgrip.arrays import Floats, check_positive, floats
from softgrip.checks import check_not_negative, record
from softgrip.errors import InvalidInputError

TRIED_LAGS = (2.0, 5.0, 10.0, 20.0, 40.0, 80.0)
"""s, among which `fitted_creep` chooses."""
LARGEST_PART = 0.5
"""Of the felt force, that `fitted_creep` looks for."""


@dataclass(frozen=True)
class Creep:
    """Parts of the felt force that lag behind.

    Attributes:
        parts: Share of each, >= 0; together below 1. None for a layer without memory.
        lags: s, of each, > 0.

    Raises:
        InvalidInputError: If one of these does not hold, or there are not as many lags as parts.

    >>> Creep((0.1,), (20.0,)).felt([0, 20, 40], [0, 1, 1]).round(3).tolist()
    [0.0, 0.963, 0.986]
    """

    parts: tuple[float, ...] = ()
    lags: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        parts, lags = floats(parts=self.parts, lags=self.lags)
        if parts.ndim != 1 or parts.shape != lags.shape:
            raise InvalidInputError(
                "parts, lags", expected="as many lags as parts", got=(self.parts, self.lags)
            )
        if self.parts:
            check_not_negative(parts=self.parts)
            check_positive(lags=self.lags)
        if not sum(self.parts) < 1:
            raise InvalidInputError("parts", expected="a sum below 1", got=self.parts)

    def felt(self, time: ArrayLike, force: ArrayLike) -> Floats:
        """Return what the layer feels, unit of the force, shape (N,), from rest at zero.

        Args:
            time: s, shape (N,), not falling.
            force: Borne since the sample before, shape (N,).

        Raises:
            InvalidInputError: If the shapes differ, a value is not finite, or time falls.
        """
        return self._passed(time, force, undo=False)[0]

    def undone(self, time: ArrayLike, felt: ArrayLike) -> Floats:
        """Return the force from what is felt of it: the inverse of `felt`, with its arguments."""
        return self._passed(time, felt, undo=True)[0]

    def left(self, time: ArrayLike, force: ArrayLike) -> Floats:
        """Return what would still be felt of all forces before, were each sample's nothing.

        Arguments and errors as of `felt`.
        """
        return self._passed(time, force, undo=False)[1]

    def _passed(self, time: ArrayLike, given: ArrayLike, *, undo: bool) -> tuple[Floats, Floats]:
        """Return what is felt or borne, and what is left of it."""
        t, values = record(at_least=1, time=time, force=given)
        if (np.diff(t) < 0).any():
            raise InvalidInputError("time", expected="times that do not fall", got="one that does")
        found, left = values.copy(), np.zeros(len(t))
        if not self.parts:
            return found, left
        steps = np.diff(t, prepend=t[0])
        kept = np.exp(-steps[:, None] / np.array(self.lags)).tolist()
        remembered = [0.0] * len(self.parts)
        parts = self.parts
        # On floats: many times as fast as on arrays of two.
        for k, (value, keep) in enumerate(zip(values.tolist(), kept, strict=True)):
            old = [w * y for w, y in zip(keep, remembered, strict=True)]
            behind = sum(p * y for p, y in zip(parts, old, strict=True))
            at_once = 1 - sum(p * w for p, w in zip(parts, keep, strict=True))
            force = (value - behind) / at_once if undo else value
            found[k] = force if undo else at_once * force + behind
            left[k] = behind
            remembered = [y + (1 - w) * force for w, y in zip(keep, old, strict=True)]
        return found, left


def fitted_creep(time: ArrayLike, force: ArrayLike, voltage: ArrayLike) -> Creep:
    """Fit one lagging part to a record with known forces, such as that of a calibration.

    Without memory the voltage is one rising curve over the force. With it, it is one over what is
    felt: the part and the lag are taken with which the felt force is the nearest to a rising curve
    over the voltage. A lag much shorter than the time between samples cannot be seen.

    Args:
        time: s, shape (N,), not falling, N >= 3.
        force: N, known, that the layer has borne since the sample before, shape (N,).
        voltage: V, shape (N,).

    Raises:
        InvalidInputError: As of `Creep.felt`; if fewer than three samples or one force are given.
    """
    t, known, v = record(at_least=3, time=time, force=force, voltage=voltage)
    if np.ptp(known) == 0:
        raise InvalidInputError("force", expected="at least two forces", got=known[:1].tolist())
    rising = IsotonicRegression(increasing="auto")

    def best(lag: float) -> tuple[float, float]:
        late = Creep((1 - 1e-12,), (lag,)).felt(t, known)

        def off(part: float) -> float:
            felt = (1 - part) * known + part * late
            left = felt - rising.fit_transform(v, felt)
            # By its variance: a force that is hardly felt would be near any curve.
            return float(left @ left / np.var(felt))

        found = minimize_scalar(off, bounds=(0, LARGEST_PART), method="bounded")
        return float(found.fun), float(found.x)

    (_, part), lag = min((best(lag), lag) for lag in TRIED_LAGS)
    return Creep((part,), (lag,))
