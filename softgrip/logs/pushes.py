"""The three pressure models of Chapter 4 held against a log of a push, whichever rig made it."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy

from softgrip.arrays import Floats, intervals
from softgrip.errors import DataFileError
from softgrip.kept import Kept
from softgrip.logs.gaps import period_of
from softgrip.logs.pump import check_start, even_push, pump_of, swept_volume
from softgrip.logs.reader import read_log
from softgrip.logs.schema import Log
from softgrip.provenance import Provenance, data_file
from softgrip.pump import pressure as law
from softgrip.pump.capacity import CapacityEstimate, estimate
from softgrip.pump.elastance import ElastanceModel, NoiseLevels, Prior
from softgrip.pump.noise import NoiseEstimate, estimate_noise
from softgrip.reads import remembered
from softgrip.units import MPa

LOW = 0.03 * MPa
"""Gauge pressure, Pa, below which the constant capacity is fitted."""
HIGH = 0.10 * MPa
"""Gauge pressure, Pa, above which Section 4.3 states the errors."""
FIRST_GUESS = NoiseLevels(pressure_step=50.0, elastance_step=1e6, sensor=700.0)
REFERENCE = "simulated/push-a.csv"
"""The record whose noise levels are used for all: those of one sensor and one finger."""


@dataclass(frozen=True)
class PressureComparison:
    """A push, measured and as three models have it.

    Attributes:
        time: s, shape (N,).
        measured, constant, modified, filtered: Gauge pressure, Pa, shape (N,): measured; by Eq.
            (4.5); by Eq. (4.7); and by Eq. (4.5) with the capacity that the filter holds at each
            sample, integrated without correction.
        capacity: Of the constant model, m^3/Pa.
        growth: c of the modified model, 1/Pa.
        estimated: What the filter holds.
        provenance: Of the log.
    """

    time: Floats
    measured: Floats
    constant: Floats
    modified: Floats
    filtered: Floats
    capacity: float
    growth: float
    estimated: CapacityEstimate
    provenance: Provenance

    def error(self, model: Floats) -> float:
        """Return (model - measured) / measured where its size is largest above `HIGH`."""
        high = self.measured > HIGH
        relative = (model[high] - self.measured[high]) / self.measured[high]
        return float(relative[np.argmax(np.abs(relative))])


def _fit_capacity(path: Path | str, log: Log, swept: Floats, below: float = LOW) -> float:
    """Return C of Eq. (4.5), fitted below a pressure, Pa."""
    volume, pressure = even_push(path, log, swept, below)
    low = pressure < below
    check_start(path, volume[low], pressure[low])
    return float(volume[low] @ volume[low] / (volume[low] @ pressure[low]))


def _fit_growth(swept: Floats, pressure: Floats, capacity: float) -> float:
    """Return c of Eq. (4.7), fitted to the whole push."""
    # The capacity may fall, but not to zero within the push.
    largest = swept[-1] / capacity

    def misfit(x: Floats) -> Floats:
        growth = float(x[0]) / largest
        result: Floats = (law.modified_pressure(swept, 1.0, capacity, growth) - pressure) / largest
        return result

    found = scipy.optimize.least_squares(misfit, [-0.5], bounds=(-0.999, 10.0))
    return float(found.x[0] / largest)


def measure_noise() -> NoiseEstimate:
    """Estimate the filter's noise levels from `REFERENCE`; takes some seconds."""
    path = data_file(REFERENCE).path
    log = read_log(path)
    flow = pump_of(path, log).displacement * log["command"]
    capacity = _fit_capacity(path, log, swept_volume(path, log, flow))
    model = ElastanceModel(period_of(log), FIRST_GUESS, prior(capacity))
    return estimate_noise(log["pressure"], flow, log["angle"], model, time=log["time"])


KEPT = Kept(
    "control/filter_noise.csv",
    NoiseLevels,
    lambda: [measure_noise().levels],
    "python -m softgrip.logs.pushes",
    notes=f"Noise levels of the elastance filter, of largest likelihood on {REFERENCE}:\n"
    "pressure_step Pa, elastance_step Pa/m^3, sensor Pa.",
    number=".4g",
)


@remembered
def reference_noise() -> NoiseLevels:
    """Read the kept noise levels of the filter."""
    (levels,) = KEPT.read()
    return levels


def prior(capacity: float) -> Prior:
    """Return what is known at rest: a capacity in m^3/Pa, taken to be good to about a third."""
    return Prior(0.0, 1e3, 1 / capacity, 0.3 / capacity)


def compare(
    path: Path | str, *, noise: NoiseLevels | None = None, below: float = LOW
) -> PressureComparison:
    """Hold the three models against a log of a push at one motor speed.

    Args:
        path: A log in the one schema, with area and lead of the pump in its header.
        noise: Levels of the filter, which follows faster and noisier the more the elastance has;
            None for `reference_noise`.
        below: Gauge pressure below which the capacity is fitted, Pa, up to `HIGH`.

    Raises:
        DataFileError: If the log cannot be read, or does not name its pump, or holds no pressure
            below that and above `HIGH`, or its gaps or its start leave open what was swept.
    """
    log = read_log(path)
    pump = pump_of(Path(path), log)
    time, measured, period = log["time"], log["pressure"], period_of(log)
    if not (measured.min() < below and measured.max() > HIGH):
        raise DataFileError(
            path,
            expected=f"a push from below {below / MPa:g} to above {HIGH / MPa:g} MPa",
            got=f"{measured.min() / MPa:.3f} to {measured.max() / MPa:.3f} MPa",
        )
    flow = pump.displacement * log["command"]
    swept, steps = swept_volume(path, log, flow), intervals(time, period)
    capacity = _fit_capacity(path, log, swept, below)
    growth = _fit_growth(swept, measured, capacity)
    levels = reference_noise() if noise is None else noise
    model = ElastanceModel(period, levels, prior(capacity))
    estimated = estimate(measured, flow, log["angle"], model, time=time)
    # What holds at a sample counts until the next one; over a gap, straight from one to the other.
    held, beyond = estimated.elastance[:-1], np.maximum(steps - 1, 0.0) / 2
    over = steps * held + beyond * np.diff(estimated.elastance)
    rises = flow[:-1] * period * over
    return PressureComparison(
        time,
        measured,
        constant=swept / capacity,
        modified=law.modified_pressure(swept, 1.0, capacity, growth),
        filtered=measured[0] + np.concatenate([[0.0], np.cumsum(rises)]),
        capacity=capacity,
        growth=growth,
        estimated=estimated,
        provenance=log.header.provenance,
    )


if __name__ == "__main__":
    KEPT.main()
