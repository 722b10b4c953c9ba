"""Moments at which nothing lies on the force layer, found in its voltage alone.

A load can only raise the voltage, and drift is slow. So a moment of quiet is without load if its
voltage is not higher than at the last such moment by more than noise and drift explain. Rubber that
remembers a load stays above until it has forgotten it, and is not taken for one.

What this cannot see: a layer that bears something all the time. The first moment of quiet is taken
for one without load, and its load for none.
"""

from dataclasses import dataclass, field
from math import inf, isfinite, sqrt
from statistics import median

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import check_positive, one_number
from softgrip.checks import check_not_negative, record, samples
from softgrip.errors import InvalidInputError, NotFiniteError

LENGTH = 10.0
"""s, of a moment."""
LEAST = 4
"""Samples that a moment needs."""
ABOVE, WIDE = 4.0, 8.0
"""How many deviations of the noise a moment may lie above the last one, and its samples apart."""
LIKELY = 3.0
"""Deviations of the drift that a moment may lie above the last one."""
HOUR = 3600.0
"""s."""
NORMAL = 0.6744897501960817
"""Half of all normal numbers are nearer to zero."""


@dataclass(frozen=True)
class Rest:
    """A moment without load: when it ended, s, its voltage, V, and the number of its samples."""

    time: float
    voltage: float
    samples: int


def noise_of(voltage: ArrayLike) -> float:
    """Return the deviation of the noise of a record, V, from how its samples differ; robust.

    Args:
        voltage: V, shape (N,), N >= 3; most neighbours under one load.

    Raises:
        InvalidInputError: If there are fewer, or one is not finite.
    """
    (v,) = record(at_least=3, voltage=voltage)
    return float(np.median(np.abs(np.diff(v))) / (NORMAL * sqrt(2)))


def one_sample(time: float, voltage: float) -> tuple[float, float]:
    """Return a time and a voltage that are a finite number each.

    Raises:
        NotFiniteError: If one is none, or several.
    """
    if type(time) is type(voltage) is float and isfinite(time) and isfinite(voltage):
        return time, voltage  # many times as fast
    t, v = samples(time=time, voltage=voltage)
    if t.ndim or v.ndim:
        raise NotFiniteError("time, voltage", got=(time, voltage))
    return float(t), float(v)


@dataclass
class RestFinder:
    """Tells moments without load, sample by sample.

    Attributes:
        noise: V, of a sample, one deviation, > 0; not below half a count of the converter.
        rate, wander: V/h and V/sqrt(h), of the unloaded layer's voltage by drift, one deviation
            each, >= 0.
        length: s, of a moment, > 0.
        last: The last moment without load; None before the first.

    Raises:
        InvalidInputError: If one is out of range.
    """

    noise: float
    rate: float = 0.0
    wander: float = 0.0
    length: float = LENGTH
    last: Rest | None = field(default=None, init=False)
    _from: float = field(default=-inf, init=False)
    _latest: float = field(default=-inf, init=False)
    _samples: list[float] = field(default_factory=list, init=False)

    def __post_init__(self) -> None:
        check_positive(noise=self.noise, length=self.length)
        check_not_negative(rate=self.rate, wander=self.wander)
        one_number(**{name: getattr(self, name) for name in ("noise", "rate", "wander", "length")})

    def push(self, time: float, voltage: float) -> Rest | None:
        """Take a sample, and return a moment without load if one has just ended.

        Args:
            time: s, not before the last sample's.
            voltage: V.

        Raises:
            NotFiniteError: If one is NaN or infinite; nothing has changed.
            InvalidInputError: If time falls; nothing has changed.
        """
        time, voltage = one_sample(time, voltage)
        if time < self._latest:
            raise InvalidInputError("time", expected=f"a time from {self._latest} s on", got=time)
        found = None
        if self._samples and time - self._from >= self.length:
            found = self._ended()
            self._samples.clear()
        if not self._samples:
            self._from = time
        self._samples.append(voltage)
        self._latest = time
        return found

    def _ended(self) -> Rest | None:
        """Judge the moment that is over."""
        read, count = self._samples, len(self._samples)
        if count < LEAST or max(read) - min(read) > WIDE * self.noise:
            return None
        half = count // 2
        first, second, level = median(read[:half]), median(read[half:]), median(read)
        # Of a median: a quarter more than of a mean.
        if abs(first - second) > ABOVE * 1.25 * self.noise * sqrt(2 / half):
            return None
        found = Rest(self._latest, level, count)
        if self.last and level > self.last.voltage + self._allowed(found.time - self.last.time):
            return None
        self.last = found
        return found

    def _allowed(self, seconds: float) -> float:
        """Return by how much the voltage without load may have risen, V."""
        hours = seconds / HOUR
        drift = sqrt((self.rate * hours) ** 2 + self.wander**2 * hours)
        return ABOVE * self.noise + LIKELY * drift


def rest_moments(time: ArrayLike, voltage: ArrayLike, finder: RestFinder) -> list[Rest]:
    """Return the moments without load of a record.

    Args:
        time, voltage: s, not falling, and V, shape (N,).
        finder: What tells them, new.

    Raises:
        InvalidInputError: If the shapes differ, one is not finite, or time falls.

    >>> time = np.arange(100.0)
    >>> voltage = np.where((time > 30) & (time < 70), 2.0, 0.1)
    >>> [rest.time for rest in rest_moments(time, voltage, RestFinder(noise=0.01))]
    [9.0, 19.0, 29.0, 79.0, 89.0]
    """
    t, v = record(at_least=1, time=time, voltage=voltage)
    found = (finder.push(*sample) for sample in zip(t.tolist(), v.tolist(), strict=True))
    return [rest for rest in found if rest]
