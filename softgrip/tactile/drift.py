"""Drift of the force-measurement layer, Section 2.3: a line through four known weights.

The text corrects the drift "with the linear regression method" on four weights at the start of an
experiment, and does not say what is regressed on what. Here the voltage that a weight gave when
the layer was calibrated is a line in what it gives now.
"""

from dataclasses import dataclass
from typing import Self

from numpy.typing import ArrayLike
from scipy.stats import linregress

from softgrip.arrays import Floats, floats
from softgrip.checks import check_finite
from softgrip.errors import InvalidInputError

DRIFT_WEIGHTS = (5.0, 20.0, 50.0, 70.0)
"""The weights of Section 2.3 for it, gram-force."""


@dataclass(frozen=True)
class LinearDrift:
    """The voltage at calibration, as `offset` (V) plus `gain` times the voltage now."""

    offset: float
    gain: float

    @classmethod
    def from_weights(cls, calibrated: ArrayLike, now: ArrayLike) -> Self:
        """Fit the line by least squares.

        Args:
            calibrated, now: Voltages of the same weights at the calibration and now, V, shape (N,),
                N >= 2.

        Raises:
            InvalidInputError: If the shapes differ, or the voltages now are all one.

        >>> LinearDrift.from_weights([1.0, 2.0, 3.0], [1.5, 2.5, 3.5])
        LinearDrift(offset=-0.5, gain=1.0)
        """
        then, found = floats(calibrated=calibrated, now=now)
        check_finite(calibrated=then, now=found)
        if then.shape != found.shape or then.ndim != 1 or len(set(found.tolist())) < 2:
            raise InvalidInputError(
                "calibrated, now", expected="two arrays of one shape (N,), not all equal now",
                got=(then.shape, found.shape),
            )  # fmt: skip
        line = linregress(found, then)
        return cls(float(line.intercept), float(line.slope))

    def corrected(self, voltage: ArrayLike) -> Floats:
        """Return what voltages (V, any shape) would have been at the calibration."""
        found: Floats = self.offset + self.gain * floats(voltage=voltage)[0]
        return found


@dataclass(frozen=True)
class DriftBetween:
    """Two such lines, from the start and the end of an experiment, and what lies between.

    Of our own: one line cannot know what the layer does afterwards. A drift that is linear in time
    is in the middle of the experiment halfway between the two.
    """

    start: LinearDrift
    end: LinearDrift

    def corrected(self, voltage: ArrayLike, share: ArrayLike) -> Floats:
        """Return what voltages would have been at the calibration.

        Args:
            voltage: V, any shape.
            share: Time since the first line by the time between the two, same shape.
        """
        (part,) = floats(share=share)
        found: Floats = (1 - part) * self.start.corrected(voltage)
        return found + part * self.end.corrected(voltage)
