"""What a calibration of the force layer says of drift: the voltage of each known force."""

from dataclasses import dataclass
from math import sqrt

import numpy as np

from softgrip.arrays import Floats, one_number
from softgrip.errors import InvalidInputError
from softgrip.tactile.own_pad import PadReadings


@dataclass(frozen=True)
class KnownWeight:
    """A known force on the layer: when, s, how large, N, and the voltage then, V.

    Raises:
        InvalidInputError: If one is no finite number.
    """

    time: float
    force: float
    voltage: float

    def __post_init__(self) -> None:
        one_number(**vars(self))


NEAR = 7
"""Known forces about one, through which its voltage is told."""


@dataclass(frozen=True)
class Curve:
    """What a calibration says: mean voltages over forces, and how far its readings scatter.

    Attributes:
        force: N, of the known forces, shape (K,), rising, from 0; K >= 2.
        voltage: V, the mean of each, shape (K,); without load the least, as a layer that remembers
            the weight before can only read more.
        scatter: V, one deviation of a reading of a force and its neighbours, shape (K,); 0 if none
            was read twice.
    """

    force: Floats
    voltage: Floats
    scatter: Floats

    @classmethod
    def of(cls, calibration: PadReadings) -> "Curve":
        """Take it from readings of one channel with forces, some of them without load.

        Raises:
            InvalidInputError: If the readings are others, or the largest force gives no larger
                voltage than none.
        """
        labels, volts = calibration.labels, calibration.voltages
        if labels.dtype.kind != "f" or volts.shape[1] != 1 or float(labels.min()) != 0:
            raise InvalidInputError(
                "calibration",
                expected="readings of one channel with forces [N], some of them with none",
                got=(calibration.channels, sorted(set(labels.tolist()))[:3]),
            )
        known, which = np.unique(np.asarray(labels, dtype=np.float64), return_inverse=True)
        count = np.bincount(which)
        mean = np.bincount(which, volts[:, 0]) / count
        if known.size < 2 or mean[-1] <= mean[0]:
            raise InvalidInputError(
                "calibration", expected="voltages that rise with the force", got=mean.tolist()
            )
        mean[0] = volts[which == 0, 0].min()
        squares = np.bincount(which, (volts[:, 0] - mean[which]) ** 2)
        scatter = np.zeros(known.size)
        for k in range(known.size):
            near = _near(k, known.size)
            free = (count[near] - 1).sum()
            scatter[k] = sqrt(squares[near].sum() / free) if free else 0.0
        return cls(known, mean, scatter)

    def at(self, force: float) -> tuple[float, float]:
        """Return the voltage of a force and its scatter, V.

        By a parabola through its neighbours, if there are enough: a known weight that lies a little
        off the middle errs by more than that does.

        Raises:
            InvalidInputError: If it lies beyond the calibration.
        """
        (force,) = one_number(weight=force)
        if not self.force[0] <= force <= self.force[-1] * (1 + 1e-9):
            most = f"a force of up to {self.force[-1]:g} N, as calibrated"
            raise InvalidInputError("weight", expected=most, got=force)
        scatter = float(np.interp(force, self.force, self.scatter))
        middle = int(np.argmin(np.abs(self.force - force)))
        near = _near(middle, self.force.size)
        if force == 0 or near.stop - near.start < NEAR:
            return float(np.interp(force, self.force, self.voltage)), scatter
        parabola = np.polyfit(self.force[near] - force, self.voltage[near], 2)
        return float(parabola[2]), scatter


def _near(middle: int, count: int) -> slice:
    """Return the neighbours of one of some numbers, itself among them; none is 0, but for it."""
    if middle == 0:
        return slice(0, 1)
    first = max(1, min(middle - NEAR // 2, count - NEAR))
    return slice(first, min(first + NEAR, count))
