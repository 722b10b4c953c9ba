"""What an identification of Eq. (5.16) gives."""

from dataclasses import dataclass

from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.dynamics.identify import Estimate
from softgrip.dynamics.ludwick import LudwickFinger
from softgrip.dynamics.ludwick_response import pressure_response


@dataclass(frozen=True)
class FittedFinger:
    """A finger after Ludwick's law, or with n = 1 after Hooke's, fitted to a record.

    Attributes
    ----------
    mass, damping, stiffness, fractional_power
        As in `LudwickFinger`, with 95 % intervals; those of a given number have no width.
    force_per_pressure
        F over P that was supposed, N/Pa. Mass, damping and stiffness are proportional to it: a
        record of pressure and angle tells their ratios alone.
    fitted
        Angle of the fitted finger at the samples, rad, shape (N,).
    rms
        Root mean square of the residual, rad.
    fit_percent
        ``100 (1 - |residual| / |angle - mean|)``, the fit of MATLAB's ``compare``.
    """

    mass: Estimate
    damping: Estimate
    stiffness: Estimate
    fractional_power: Estimate
    force_per_pressure: float
    fitted: Floats
    rms: float
    fit_percent: float

    @property
    def finger(self) -> LudwickFinger:
        """The fitted finger."""
        return LudwickFinger(
            self.mass.value, self.damping.value, self.stiffness.value, self.fractional_power.value
        )

    def response(self, time: ArrayLike, pressure: ArrayLike) -> Floats:
        """Return the angle, rad, that another pressure (Pa) makes; see `pressure_response`."""
        return pressure_response(
            self.finger, time, pressure, force_per_pressure=self.force_per_pressure
        )
