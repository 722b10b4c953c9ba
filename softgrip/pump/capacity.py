"""The capacity of pump and finger along a record, by the elastance filter."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, floats, intervals, read_only
from softgrip.checks import record
from softgrip.errors import InvalidInputError
from softgrip.pump.elastance import ElastanceModel, elastance_filter, transitions


@dataclass(frozen=True)
class CapacityEstimate:
    """What the filter holds after each of N measurements; the arrays cannot be written to.

    Attributes:
        time: s, from 0, shape (N,).
        state: Pressure, Pa, and elastance, Pa/m^3, shape (N, 2).
        covariance: Of the state, shape (N, 2, 2).
        innovation: Measured minus predicted pressure, Pa, shape (N,); NaN where none was measured.
        innovation_variance: What the filter expects of its square, Pa^2, shape (N,).
    """

    time: Floats
    state: Floats
    covariance: Floats
    innovation: Floats
    innovation_variance: Floats

    @property
    def pressure(self) -> Floats:
        """Filtered pressure, Pa, shape (N,)."""
        return self.state[:, 0]

    @property
    def elastance(self) -> Floats:
        """S, Pa/m^3, shape (N,)."""
        return self.state[:, 1]

    @property
    def capacity(self) -> Floats:
        """C = 1/S, m^3/Pa, shape (N,); NaN where noise has pushed S to zero or below."""
        S = self.elastance
        result: Floats = np.divide(1.0, S, out=np.full(S.shape, np.nan), where=S > 0)
        return result

    @property
    def capacity_std(self) -> Floats:
        """Standard deviation of C to first order, std(S) C^2; good if std(S) is well below S."""
        std: Floats = np.sqrt(self.covariance[:, 1, 1]) * self.capacity**2
        return std

    @property
    def normalized_innovation_squared(self) -> Floats:
        """Innovation squared over its variance, shape (N,): chi-square, 1 degree of freedom.

        NaN where nothing was measured.
        """
        result: Floats = self.innovation**2 / self.innovation_variance
        return result

    @property
    def log_likelihood(self) -> float:
        """Logarithm of the density of the measurements, 1/Pa each."""
        terms = np.log(2 * np.pi * self.innovation_variance) + self.normalized_innovation_squared
        return -0.5 * float(np.nansum(terms))


def estimate(
    pressure: ArrayLike,
    flow: ArrayLike,
    angle: ArrayLike,
    model: ElastanceModel,
    *,
    time: ArrayLike,
) -> CapacityEstimate:
    """Run the elastance filter over a record.

    The prior of the model holds at the first sample, before its measurement. Over missing samples
    the filter predicts once for each and measures nothing, so that its noises are those of the time
    that went by; what is missing has no part in the likelihood. (filterpy's `update(None)` would
    count as a perfect measurement.)

    Args:
        pressure: Measured, Pa, shape (N,), N >= 2; NaN where a sample is missing: there
            the filter predicts and measures nothing.
        flow: Commanded, m^3/s, shape (N,); ``flow[k]`` holds from sample k to k + 1, so the last is
            not used. Its sign is that of Eq. (4.2): above zero the plunger goes in.
        angle: Measured bending angle, rad, shape (N,); NaN where a sample is missing: the angle
            turns evenly from the one before to the one after.
        model: Time step, noise levels, prior and angle gain.
        time: Of the samples, s, shape (N,), increasing. It is asked for, as rows get lost: at two
            time steps of the model a sample is missing between two. The flow holds over it.

    Raises:
        InvalidInputError: If the shapes differ, fewer than two pressures or no angle are measured,
            a value is infinite, a flow is not finite, or the time does not increase.
    """
    measured, pushed, bent = _measured(pressure, flow, angle)
    kalman = elastance_filter(model)
    N = measured.size
    apart = _steps(time, N, model.time_step)
    since = np.concatenate([[0.0], np.cumsum(apart)]) * model.time_step
    seen = ~np.isnan(bent)
    bent = np.interp(since, since[seen], bent[seen])
    predictions = np.maximum(np.rint(apart), 1)
    moves = transitions(pushed[:-1] * (apart / predictions), model.time_step)
    turns = np.diff(bent) / predictions
    state, covariance = np.empty((N, 2)), np.empty((N, 2, 2))
    innovation, variance = np.empty(N), np.empty(N)
    for k in range(N):
        for _ in range(int(predictions[k - 1]) if k else 0):
            # A column for the input: with a scalar, filterpy spreads the state into a matrix.
            kalman.predict(u=turns[k - 1].reshape(1, 1), F=moves[k - 1])
        innovation[k] = measured[k] - kalman.x[0, 0]
        variance[k] = kalman.P[0, 0] + kalman.R.item()
        if np.isfinite(measured[k]):
            kalman.update(measured[k])
        state[k], covariance[k] = kalman.x[:, 0], kalman.P
    return CapacityEstimate(
        *(read_only(values) for values in (since, state, covariance, innovation, variance))
    )


def _measured(
    pressure: ArrayLike, flow: ArrayLike, angle: ArrayLike
) -> tuple[Floats, Floats, Floats]:
    """Return the record, checked; pressures and angles that are missing stay NaN."""
    z, theta = floats(pressure=pressure, angle=angle)
    known = [np.where(np.isnan(values), 0.0, values) for values in (z, theta)]
    _, pushed, _ = record(at_least=2, pressure=known[0], flow=flow, angle=known[1])
    counts = [np.count_nonzero(~np.isnan(values)) for values in (z, theta)]
    if counts[0] < 2 or not counts[1]:
        raise InvalidInputError(
            "pressure, angle",
            expected="two pressures and an angle or more that are not NaN",
            got=f"{counts[0]} and {counts[1]}",
        )
    return z, pushed, theta


def _steps(time: ArrayLike, samples: int, time_step: float) -> Floats:
    """Return the time from each sample to the next in time steps of the model, shape (N - 1,)."""
    (t,) = record(at_least=2, time=time)
    if t.size != samples or not (np.diff(t) > 0).all():
        raise InvalidInputError(
            "time", expected=f"shape ({samples},), increasing, s", got=t.tolist()
        )
    return intervals(t, time_step)
