"""Drift that is tracked: moments without load and known weights, in a Kalman filter.

The filter knows how large drift is (`DriftSize`) and how it changes a voltage (`DriftLaw`). Each
moment without load measures what it does to the unloaded layer, each known weight what it does
there; between them the filter goes on as the drift is known to. A record is tracked by
`drift_track.track_drift`.
"""

from dataclasses import dataclass, field
from math import inf, sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, floats, one_number
from softgrip.checks import check_not_negative
from softgrip.errors import InvalidInputError
from softgrip.tactile.drift_curve import Curve
from softgrip.tactile.drift_law import DriftLaw, Line
from softgrip.tactile.drift_model import HOUR, DriftSize, gain_and_offset
from softgrip.tactile.pad_model import TOP_COUNT
from softgrip.tactile.rest_moments import RestFinder, one_sample

EVERY = 60.0
"""s between two moments without load that the filter takes: neighbours err alike."""
LEFT = 2.0
"""Deviations of the noise by which such a moment may be off, however many its samples: half of the
band in which it is told."""
GATE = 5.0
"""Deviations above what is expected, from where on a moment is taken for one with a load."""
ENDS = (0.0, TOP_COUNT)
"""V, of the converter of the text's board."""
COUNT = 5.0 / 1023
"""V, of a converter of 10 bits and 5 V: half of it is the least noise that is believed."""


@dataclass(frozen=True, eq=False)
class Event:
    """What is known after a measurement: time (s), state and covariance as of `DriftFilter`.

    `moved` and `grown` are F and Q of the step that led to it, shapes (4, 4).
    """

    time: float
    state: Floats
    covariance: Floats
    moved: Floats
    grown: Floats


@dataclass
class DriftFilter:
    """Tracks gain and offset of one layer.

    Attributes:
        curve: What the calibration says.
        size, law: How much drift is expected, and what it does.
        noise: V, of a sample, one deviation, > 0.
        calibrated_at: s, when it was calibrated, on the clock of the samples.
        weight_deviation: V, by which a reading of a known weight may be off at least; as much as in
            the calibration if that is more.
        ends: V, of the converter: what reaches one was cut off, and measures nothing.
        state: Rates and wanders of `DriftSize.prior`, shape (4,), at `time`.
        covariance: Of the state, shape (4, 4).
        refused: How many measurements were cut off, or moments taken for ones with a load.
        events: The calibration, then each measurement.

    Raises:
        InvalidInputError: If the noise is not above zero.

    >>> curve = Curve(np.array([0.0, 0.5]), np.array([0.1, 2.1]), np.zeros(2))
    >>> drift = DriftFilter(curve, noise=0.002)
    >>> drift.rest(3600.0, 0.13)
    True
    >>> bool(0.095 < drift.corrected(0.13) < 0.105)
    True
    """

    curve: Curve
    size: DriftSize = field(default_factory=DriftSize)
    law: DriftLaw = field(default_factory=Line)
    noise: float = COUNT / 2
    calibrated_at: float = 0.0
    weight_deviation: float = 0.0
    ends: tuple[float, float] = ENDS
    time: float = field(default=-inf, init=False)
    refused: int = field(default=0, init=False)
    events: list["Event"] = field(default_factory=list, init=False)
    _kalman: Any = field(init=False)
    _finder: RestFinder = field(init=False)
    _taken: float = field(default=-inf, init=False)

    def __post_init__(self) -> None:
        check_positive(noise=self.noise)
        check_not_negative(weight_deviation=self.weight_deviation)
        one_number(noise=self.noise, calibrated_at=self.calibrated_at)
        # It brings SciPy's distributions and more along: only who filters waits for them.
        from filterpy.kalman import KalmanFilter

        self._finder = finder(self.curve, self.size, self.law, self.noise)
        self._kalman = KalmanFilter(dim_x=4, dim_z=1)
        self._kalman.x = np.zeros((4, 1))
        self._kalman.P = self.size.prior(self.noise)
        self.time = self.calibrated_at
        self._keep(np.eye(4), np.zeros((4, 4)))

    @property
    def state(self) -> Floats:
        """Rates and wanders, as of `DriftSize.prior`, shape (4,)."""
        found: Floats = self._kalman.x[:, 0]
        return found

    @property
    def covariance(self) -> Floats:
        """Of the state, shape (4, 4)."""
        found: Floats = self._kalman.P
        return found

    def _moved(self, time: float) -> tuple[Floats, Floats]:
        if not time >= self.time:
            raise InvalidInputError("time", expected=f"a time from {self.time} s on", got=time)
        F, Q = self.size.transition((time - self.time) / HOUR)
        self._kalman.predict(F=F, Q=Q)
        self.time = time
        return F, Q

    def _seen(self, calibrated: float) -> tuple[float, Floats]:
        """Return the expected voltage and its slopes over the state, shape (1, 4)."""
        age = (self.time - self.calibrated_at) / HOUR
        gain, offset = (float(one) for one in gain_and_offset(self.state, age))
        slope = self.law.per_gain(calibrated, gain)
        expected = float(self.law.drifted(calibrated, gain, offset))
        return expected, np.array([[slope * age, age, slope, 1.0]])

    def _measured(self, time: float, calibrated: float, voltage: float, error: float, *,
                  gated: bool) -> bool:  # fmt: skip
        time, voltage = one_sample(time, voltage)
        F, Q = self._moved(time)
        expected, H = self._seen(calibrated)
        R = np.array([[error**2]])
        inside = self.ends[0] < voltage < self.ends[1]
        if inside and gated:
            spread = float((H @ self.covariance @ H.T + R)[0, 0])
            inside = voltage - expected <= GATE * sqrt(spread)
        if inside:
            # As a linear filter sees it: the slopes times the state, plus what was not expected.
            seen = H @ self._kalman.x + (voltage - expected)
            self._kalman.update(seen, R=R, H=H)
        else:
            self.refused += 1
        self._keep(F, Q)
        return inside

    def _keep(self, F: Floats, Q: Floats) -> None:
        self.events.append(Event(self.time, self.state.copy(), self.covariance.copy(), F, Q))

    def rest(self, time: float, voltage: float) -> bool:
        """Take a moment without load, and tell whether it was believed.

        Args:
            time: s, not before the last one's.
            voltage: V, of the moment.

        Raises:
            NotFiniteError: If one is not finite; nothing has changed.
            InvalidInputError: If time falls.
        """
        at_rest = float(self.curve.voltage[0])
        return self._measured(time, at_rest, voltage, LEFT * self.noise, gated=True)

    def weigh(self, time: float, voltage: float, force: float) -> bool:
        """Take a known weight; arguments and result as of `rest`, the force in N, calibrated."""
        known, scatter = self.curve.at(force)
        error = max(scatter, self.weight_deviation, self.noise)
        return self._measured(time, known, voltage, error, gated=False)

    def step(self, time: float, voltage: float) -> float:
        """Take a sample of a running record: find moments without load, and correct the sample.

        Args:
            time: s, not before the last sample's.
            voltage: V.

        Returns:
            float: What the voltage would have been at the calibration, V.

        Raises:
            NotFiniteError: If one is NaN or infinite; nothing has changed.
            InvalidInputError: If time falls.
        """
        time, voltage = one_sample(time, voltage)
        if time < self.calibrated_at:
            expected = f"a time from {self.calibrated_at} s on, the calibration's"
            raise InvalidInputError("time", expected=expected, got=time)
        found = self._finder.push(time, voltage)
        if found and found.time - self._taken >= EVERY:
            self._taken = found.time
            self.rest(found.time, found.voltage)
        age = (time - self.calibrated_at) / HOUR
        since = (time - self.time) / HOUR
        kept = self.size.kept(max(since, 0.0))
        rate, shift, gain, offset = self.state.tolist()
        return float(
            self.law.calibrated(voltage, rate * age + kept * gain, shift * age + kept * offset)
        )

    def corrected(self, voltage: ArrayLike) -> Floats:
        """Return what voltages (V, any shape) would have been at the calibration, as of `time`."""
        age = (self.time - self.calibrated_at) / HOUR
        found: Floats = self.law.calibrated(
            floats(voltage=voltage)[0], *gain_and_offset(self.state, age)
        )
        return found

    def smoothed(self) -> tuple[Floats, Floats]:
        """Return the states of all events as their whole series tells them, and covariances.

        By Rauch, Tung and Striebel (1965). What does not wander has a covariance without an
        inverse; the pseudo-inverse does. Shapes (events, 4) and (events, 4, 4).
        """
        found = self._kalman.rts_smoother(
            np.array([event.state for event in self.events])[..., None],
            np.array([event.covariance for event in self.events]),
            Fs=[event.moved for event in self.events],
            Qs=[event.grown for event in self.events],
            inv=np.linalg.pinv,
        )
        return found[0][..., 0], found[1]


def finder(curve: Curve, size: DriftSize, law: DriftLaw, noise: float) -> RestFinder:
    """Return what finds moments without load, for a layer that drifts so."""
    slope = float(law.per_gain(float(curve.voltage[0]), 0.0))
    return RestFinder(
        noise,
        rate=float(np.hypot(slope * size.gain_rate, size.offset_rate)),
        wander=float(np.hypot(slope * size.gain_wander, size.offset_wander)),
    )
