"""The pressure models of Chapter 4 against pushes on many rigs: `logs.pushes`, a column a rig."""

from dataclasses import dataclass

import numpy as np

from book.twin.least_squares import Which, differences, fit
from softgrip.arrays import Flags, Floats
from softgrip.logs.pushes import HIGH
from softgrip.pump.elastance import NoiseLevels


@dataclass(frozen=True)
class Push:
    """Pushes at one flow each, from atmospheric pressure.

    Attributes:
        period: s.
        flow: Of the plunger, m^3/s, shape (rigs,).
        swept, measured: m^3 and gauge Pa, shape (rigs, N).
        until: How many samples count, shape (rigs,): the push ends at a pressure, or with the
            stroke.
    """

    period: float
    flow: Floats
    swept: Floats
    measured: Floats
    until: Which

    @property
    def counts(self) -> Flags:
        """Which samples count, shape (rigs, N)."""
        return np.asarray(np.arange(self.measured.shape[1]) < self.until[:, None])

    def error(self, model: Floats) -> Floats:
        """Return (model - measured) / measured where its size is largest above `HIGH`.

        Shape (rigs,); NaN where the pressure does not come so high.
        """
        high = self.counts & (self.measured > HIGH)
        relative = (model - self.measured) / np.where(high, self.measured, 1.0)
        at = np.argmax(np.where(high, np.abs(relative), -1.0), axis=1)
        found = relative[np.arange(len(at)), at]
        return np.where(high.any(axis=1), found, np.nan)


def fitted_capacity(push: Push, below: Floats | float) -> Floats:
    """Return C of Eq. (4.5), m^3/Pa, fitted to all samples below a pressure, Pa; shape (rigs,)."""
    low = push.counts & (push.measured < np.reshape(below, (-1, 1)))
    return _slope(push, low)


def first_capacity(push: Push, below: float) -> Floats:
    """Return the same, fitted until the pressure first passes the bound."""
    passed = np.cumsum(push.measured > below, axis=1) > 0
    return _slope(push, push.counts & ~passed)


def _slope(push: Push, which: Flags) -> Floats:
    """Return the slope of the line through the origin from pressure to swept volume."""
    q, p = np.where(which, push.swept, 0.0), np.where(which, push.measured, 0.0)
    return np.asarray(np.sum(q * q, axis=1) / np.sum(q * p, axis=1))


LEAST_GROWTH = -0.999
"""Of the capacity over the whole push, as a share: it may fall, but not to zero."""


def modified_pressure(push: Push, capacity: Floats) -> Floats:
    """Return the pressure by Eq. (4.7), Pa, its c fitted to the whole push, shape (rigs, N)."""
    last = np.take_along_axis(push.swept, push.until[:, None] - 1, axis=1)
    largest = last / capacity[:, None]
    share = np.where(push.counts, push.swept / last, 0.0)
    wanted = np.where(push.counts, push.measured / largest, 0.0)

    def model(x: Floats, which: Which) -> Floats:
        growth = LEAST_GROWTH + np.exp(x)
        # Without growth the law is a line; near it the series saves the digits.
        small = np.abs(growth) < 1e-8
        safe = np.where(small, 1.0, growth)
        part = share[which]
        return np.asarray(np.where(small, part, np.log1p(safe * part) / safe))

    squares = differences(lambda x, which: model(x, which) - wanted[which])
    found = fit(squares, np.full((len(last), 1), np.log(0.499)))
    return np.asarray(largest * model(found, np.arange(len(last))))


def filtered_pressure(
    push: Push, capacity: Floats, levels: NoiseLevels, factor: Floats | float = 1.0
) -> Floats:
    """Return the pressure by Eq. (4.5) with the capacity that the elastance filter holds, Pa.

    The filter of `pump.elastance` without its angle, with the prior of `logs.pushes.prior`.

    Args:
        push: What is filtered.
        capacity: Of the prior, m^3/Pa, shape (rigs,).
        levels: Of the filter's noise.
        factor: Multiplies the elastance's, shape (rigs,).
    """
    wander, sensor = (factor * levels.elastance_step) ** 2, levels.sensor**2
    z, moved = push.measured, push.flow * push.period
    pressure, elastance = np.zeros(len(z)), 1 / capacity
    pp, ps, ss = np.full(len(z), 1e6), np.zeros(len(z)), (0.3 * elastance) ** 2
    held = np.empty_like(z)
    for k in range(z.shape[1]):
        if k:
            pressure = pressure + moved * elastance
            pp = pp + moved * (2 * ps + moved * ss) + levels.pressure_step**2
            ps = ps + moved * ss
            ss = ss + wander
        weight = 1 / (pp + sensor)
        off = z[:, k] - pressure
        pressure, elastance = pressure + pp * weight * off, elastance + ps * weight * off
        kept = sensor * weight
        pp, ps, ss = kept * pp, kept * ps, ss - ps * ps * weight
        held[:, k] = elastance
    rises = np.cumsum(moved[:, None] * held[:, :-1], axis=1)
    return np.asarray(z[:, :1] + np.concatenate([np.zeros((len(z), 1)), rises], axis=1))
