"""How a drifting gain and offset change a voltage of the force layer, and how that is undone.

Drift is told by two numbers since the calibration: the share `gain` by which the layer conducts
more, and an `offset`, V. Without knowledge of the circuit the gain multiplies the voltage, `Line`:
that is the text's straight line. Where the layer is an arm of a bridge, the gain moves the voltage
of the unloaded layer too, `Bridge`: then a moment without load tells something of both.
"""

from dataclasses import dataclass
from typing import Protocol

from softgrip.arrays import Number, check_positive, is_symbol, one_number
from softgrip.errors import InvalidInputError


class DriftLaw(Protocol):
    """From the voltage at the calibration to that now, and back; V, numbers that broadcast."""

    def drifted(self, calibrated: Number, gain: Number, offset: Number) -> Number:
        """Return the voltage now."""

    def calibrated(self, drifted: Number, gain: Number, offset: Number) -> Number:
        """Return the voltage that it would have been at the calibration."""

    def per_gain(self, calibrated: Number, gain: Number) -> Number:
        """Return the slope of `drifted` over the gain, V; that over the offset is 1."""


@dataclass(frozen=True)
class Line:
    """A straight line: ``(1 + gain) v + offset``.

    >>> Line().calibrated(Line().drifted(2.0, 0.1, 0.3), 0.1, 0.3)
    2.0
    """

    def drifted(self, calibrated: Number, gain: Number, offset: Number) -> Number:
        """Return the voltage now, V."""
        return (1 + gain) * calibrated + offset

    def calibrated(self, drifted: Number, gain: Number, offset: Number) -> Number:
        """Return the voltage at the calibration, V."""
        return (drifted - offset) / (1 + gain)

    def per_gain(self, calibrated: Number, gain: Number) -> Number:
        """Return the voltage itself: the slope over the gain, V."""
        return calibrated + 0 * gain


@dataclass(frozen=True)
class Bridge:
    """The layer as an arm of a voltage divider: with the conductance G and the arm beside it R.

    The voltage is ``scale (u - balance)`` with ``u = R G / (1 + R G)``; the gain multiplies G.

    Attributes:
        scale: V: supply times amplification, > 0.
        balance: u at which the bridge gives nothing, above 0 and below 1: that of the unloaded
            layer at the calibration, if it was balanced there.

    Raises:
        InvalidInputError: If one is not so.

    >>> law = Bridge(25.0, 0.07)
    >>> round(law.drifted(0.0, 0.1, 0.0), 4)
    0.1616
    >>> round(law.calibrated(law.drifted(3.0, 0.1, 0.2), 0.1, 0.2), 12)
    3.0
    """

    scale: float
    balance: float

    def __post_init__(self) -> None:
        if is_symbol(self.balance):
            return
        one_number(scale=self.scale, balance=self.balance)
        check_positive(scale=self.scale, balance=self.balance)
        if not self.balance < 1:
            raise InvalidInputError("balance", expected="a share below 1", got=self.balance)

    def drifted(self, calibrated: Number, gain: Number, offset: Number) -> Number:
        """Return the voltage now, V."""
        share = self.balance + calibrated / self.scale
        return self.scale * (share * (1 + gain) / (1 + gain * share) - self.balance) + offset

    def calibrated(self, drifted: Number, gain: Number, offset: Number) -> Number:
        """Return the voltage at the calibration, V."""
        share = self.balance + (drifted - offset) / self.scale
        return self.scale * (share / (1 + gain * (1 - share)) - self.balance)

    def per_gain(self, calibrated: Number, gain: Number) -> Number:
        """Return the slope over the gain, V."""
        share = self.balance + calibrated / self.scale
        return self.scale * share * (1 - share) / (1 + gain * share) ** 2
