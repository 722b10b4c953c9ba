"""Noise levels of the elastance filter from a record, by maximum likelihood of its innovations."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats
from softgrip.checks import takes_numbers
from softgrip.errors import InvalidInputError
from softgrip.pump.capacity import estimate
from softgrip.pump.elastance import ElastanceModel, NoiseLevels

NAMES = ("pressure_step", "elastance_step", "sensor")
SEARCH_FACTOR = 1e4
"""Levels are searched from the first guess divided by this to the first guess times this."""
FLAT = 0.05
"""Curvature below which a level is not told: its logarithm's standard deviation is above 4.5."""


@dataclass(frozen=True)
class NoiseEstimate:
    """Noise levels that make a record most likely.

    Attributes:
        levels: The levels.
        log_std: Standard deviation of the logarithm of each level, in the order of `NAMES`, from
            the curvature of the likelihood; infinite where the record does not tell the level from
            zero.
        angle_gain: g of `ElastanceModel`, Pa/m^3 a radian: the one given, or the fitted one.
        angle_gain_std: Its standard deviation; 0 if it was given.
        log_likelihood: At the levels found.
    """

    levels: NoiseLevels
    log_std: tuple[float, float, float]
    angle_gain: float
    angle_gain_std: float
    log_likelihood: float

    def apply(self, model: ElastanceModel) -> ElastanceModel:
        """Return the model with the levels and the gain found."""
        return replace(model, noise=self.levels, angle_gain=self.angle_gain)

    @takes_numbers
    def interval(self, name: str, confidence: float = 0.95) -> tuple[float, float]:
        """Return the interval of a level, normal in its logarithm; (0, inf) if it is not told.

        Trust it while `log_std` is below a half or so: a level that may be zero has no bell there.

        Args:
            name: One of `NAMES`.
            confidence: Between 0 and 1, both excluded.

        Raises:
            InvalidInputError: If `name` or `confidence` is not valid.
        """
        if name not in NAMES:
            raise InvalidInputError("name", expected=f"one of {NAMES}", got=name)
        if not 0 < confidence < 1:
            raise InvalidInputError("confidence", expected="a number in (0, 1)", got=confidence)
        level, std = getattr(self.levels, name), self.log_std[NAMES.index(name)]
        if not np.isfinite(std):
            return 0.0, float("inf")
        factor = float(np.exp(scipy.special.ndtri((1 + confidence) / 2) * std))
        return level / factor, level * factor


@takes_numbers
def estimate_noise(
    pressure: ArrayLike,
    flow: ArrayLike,
    angle: ArrayLike,
    model: ElastanceModel,
    *,
    time: ArrayLike,
    fit_gain: bool = False,
) -> NoiseEstimate:
    """Find the three levels, and the gain if wanted, that make a record's innovations most likely.

    The record must move the pump, or the elastance leaves no trace. It takes a few seconds for
    some hundred samples.

    Args:
        pressure, flow, angle: As for `capacity.estimate`; N >= 50.
        model: Its noise levels are the first guess and must be above zero; the rest is held.
        time: As for `capacity.estimate`.
        fit_gain: Whether to fit the angle gain too, from that of the model on.

    Raises:
        InvalidInputError: If the record is too short or the pump stands still in it, a first guess
            is zero, or the search ends without a maximum.
    """
    start = np.array([getattr(model.noise, name) for name in NAMES])
    if not (start > 0).all():
        raise InvalidInputError("model.noise", expected="levels > 0 to start from", got=model.noise)
    size, pushed = np.size(pressure), np.asarray(flow)
    if size < 50 or not pushed.any():
        raise InvalidInputError(
            "pressure, flow",
            expected="at least 50 samples, and a flow that is not zero throughout",
            got=f"{size} samples, largest flow {np.abs(pushed).max(initial=0.0):g}",
        )
    # A finger that doubles its elastance in a radian moves the fourth entry by one.
    unit = model.prior.elastance

    def at(x: Floats) -> ElastanceModel:
        gain = model.angle_gain + (unit * float(x[3]) if fit_gain else 0.0)
        noise = NoiseLevels(*(start * np.exp(x[:3])).tolist())
        return replace(model, noise=noise, angle_gain=gain)

    def cost(x: Floats) -> float:
        return -estimate(pressure, flow, angle, at(x), time=time).log_likelihood

    reach = float(np.log(SEARCH_FACTOR))
    bounds = [(-reach, reach)] * 3 + [(None, None)] * fit_gain
    # Steps of 1e-4: the likelihood is a sum of some hundred terms, rounded at 1e-12 or so.
    found = scipy.optimize.minimize(
        cost, np.zeros(len(bounds)), method="L-BFGS-B", bounds=bounds, options={"eps": 1e-4}
    )
    if not found.success or np.any(found.x[:3] >= 0.999 * reach):
        raise InvalidInputError(
            "model.noise",
            expected=f"a first guess within a factor {SEARCH_FACTOR:g} of the levels",
            got=f"{model.noise}; the search says {found.message}",
        )
    told = np.ones(len(bounds), dtype=bool)
    told[:3] = found.x[:3] > -0.999 * reach
    std = np.full(4, np.inf)
    std[: told.size][told] = _std(cost, found.x, np.flatnonzero(told))
    best = at(found.x)
    return NoiseEstimate(
        best.noise,
        (float(std[0]), float(std[1]), float(std[2])),
        best.angle_gain,
        unit * float(std[3]) if fit_gain else 0.0,
        -float(found.fun),
    )


def _std(cost: Callable[[Floats], float], at: Floats, free: NDArray[np.intp]) -> Floats:
    """Return the standard deviations of the free entries from the curvature of the cost there."""
    h = 0.05  # 5 % of a level
    steps = np.eye(at.size)[free] * h
    curvature = np.empty((free.size, free.size))
    for i, a in enumerate(steps):
        for j, b in enumerate(steps):
            corners = cost(at + a + b) - cost(at + a - b) - cost(at - a + b) + cost(at - a - b)
            curvature[i, j] = corners / (4 * h**2)
    values, vectors = np.linalg.eigh(curvature)
    # A direction without curvature is one that the record does not tell.
    variances = np.divide(1.0, values, out=np.full(values.shape, np.inf), where=values > FLAT)
    weights = np.where(np.isfinite(variances), variances, 0.0)
    result = np.sqrt((vectors**2) @ weights)
    lost = (vectors[:, ~np.isfinite(variances)] ** 2).sum(axis=1) > 0.5
    return np.where(lost, np.inf, result)
