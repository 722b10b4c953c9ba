"""Weights and objects put down on the simulated force layer, each read once."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, Number
from softgrip.simulator.chance import streams
from softgrip.simulator.fitted_rigs import fitted_layer
from softgrip.simulator.force_layer import (
    ForceLayer,
    layer_voltage,
    read_counts,
    volts,
)
from softgrip.simulator.sensors import Counts
from softgrip.tactile.force import WEIGHTS
from softgrip.units import GRAM_FORCE

PERIOD = 0.05
"""s, from sample to sample."""

READ, LOADED, UNLOADED = 5.0, 8.0, 8.0
"""s: a weight is read so long after it was put down, rests so long, and is off so long. Assumed."""

REPETITIONS = 3
"""Section 2.3: each weight is measured three times."""


@dataclass(frozen=True)
class Reading:
    """What was read: time (s), true force (N), counts and voltage (V), each of shape (N,)."""

    time: Floats
    force: Floats
    counts: Counts
    voltage: Floats


def reading(
    time: Floats, true: Floats, felt: Floats, age: ArrayLike, noise: Floats, layer: ForceLayer
) -> Reading:
    """Return what is read of the felt force, N, at some times, s; `age` in h, noise of size 1."""
    voltage = layer_voltage(felt, np.asarray(age, dtype=float) + time / 3600, layer)
    counts = read_counts(voltage, noise, layer)
    return Reading(time, true, counts, volts(counts, layer))


def put_down(
    forces: ArrayLike,
    *,
    seed: int,
    run: int,
    layer: ForceLayer | None = None,
    seating: Number | None = None,
    age: float = 0.0,
    unloaded: float | Floats = UNLOADED,
) -> Reading:
    """Put weights on the layer one after the other, and read each once.

    Args:
        forces: N, shape (weights,), exact: what is recorded is the weight itself.
        seed, run: Of chance.
        layer: Its parameters; None for `fitted_layer`. For several layers, numbers of shape
            (layers, 1): all meet the same chance.
        seating: Spread of what the layer feels of a weight; None for that of calibration weights.
        age: h, when the first weight is put down.
        unloaded: s, after each weight; a number or shape (weights,).
    """
    layer = layer or fitted_layer()
    true = np.asarray(forces, dtype=float)
    own, noise = streams(seed, run)
    spread = layer.seating if seating is None else seating
    felt_parts = np.exp(spread * own.standard_normal(len(true)))
    loaded = round(LOADED / PERIOD)
    lengths = loaded + np.rint(np.broadcast_to(unloaded, true.shape) / PERIOD).astype(int)
    starts = np.concatenate([[0], np.cumsum(lengths)[:-1]])
    read = starts + round(READ / PERIOD)
    force = true * felt_parts
    felt = (1 - sum(layer.memory)) * force
    on = read[:, None] - starts
    off = np.maximum(on - loaded, 0)
    for part, lag in zip(layer.memory, layer.lag, strict=True):
        # As `felt_force`, in closed form: the force of each weight is a pulse.
        kept = np.exp(-PERIOD / lag)
        felt = felt + part * (force @ np.where(on > 0, kept**off - kept ** np.maximum(on, 0), 0).T)
    return reading(read * PERIOD, true, felt, age, noise.standard_normal(len(true)), layer)


def weight_forces() -> Floats:
    """Return the forces of the 69 points of Section 2.3, N: three rounds from 0 to 70 gf."""
    return np.tile((0.0, *WEIGHTS), REPETITIONS) * GRAM_FORCE
