"""All chance in a simulated rig: a stream of numbers for each run, whatever the batch."""

from dataclasses import fields

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats
from softgrip.simulator.parameters import Spread

SEED = 2024
"""Of all simulated data that are kept, and of the studies on them."""

_BLOCK = 64


def streams(seed: int, run: int) -> tuple[np.random.Generator, np.random.Generator]:
    """Return the generators of one run: of what differs from run to run, and of its noise.

    They depend on the seed and on the number of the run alone, so that a run is the same in any
    batch. The kind of generator is named, since NumPy may change its default one.
    """
    return _stream(seed, run, 0), _stream(seed, run, 1)


def _stream(seed: int, run: int, which: int) -> np.random.Generator:
    source = np.random.SeedSequence(seed, spawn_key=(run, which))
    return np.random.Generator(np.random.PCG64(source))


class Chance:
    """What chance gives to the runs `first` to `first + runs` of a seed.

    After `cycle` runs, if that is given, their numbers begin again: rigs of one batch, repeated as
    often each, then meet the same chance.

    Attributes:
        stiffness, damping: Multiples of the parameters of each finger, median 1, shape (fingers,
            runs).
        leakage: The same of the leak, shape (runs,).
    """

    def __init__(
        self,
        spread: Spread,
        *,
        fingers: int,
        seed: int,
        first: int,
        runs: int,
        cycle: int | None = None,
    ) -> None:
        self.seed, self.first = seed, first
        self._single = min(runs, cycle or runs)
        self._which = np.arange(runs) % self._single
        drawn = np.zeros((1 + 2 * fingers, self._single))
        if any(np.any(getattr(spread, field.name)) for field in fields(spread)):
            for run in range(self._single):
                drawn[:, run] = _stream(seed, first + run, 0).standard_normal(len(drawn))
        drawn = drawn[:, self._which]
        # So the kept logs were made: the leak of a single finger is drawn last, of several first.
        leak = 2 if fingers == 1 else 0
        own = np.delete(drawn, leak, axis=0)
        self.stiffness: Floats = np.exp(spread.stiffness * own[0::2])
        self.damping: Floats = np.exp(spread.damping * own[1::2])
        self.leakage: Floats = np.exp(spread.leakage * drawn[leak])
        self._noise: list[np.random.Generator] = []
        self._table: Floats = np.empty((0, 0, 0))
        self._block = np.empty((_BLOCK, 1 + fingers, self._single))
        self._used = _BLOCK

    def noises(self, runs: NDArray[np.intp], out: Floats) -> None:
        """Fill with the noise of the first samples of some runs, shape (runs, samples, sensors)."""
        numbers = self._which[runs].tolist()
        if len(self._which) == self._single:
            for row, number in zip(out, numbers, strict=True):
                self._stream(number).standard_normal(out=row)
            return
        if self._table.shape[1:] != out.shape[1:]:
            self._table = np.stack(
                [self._stream(k).standard_normal(out.shape[1:]) for k in range(self._single)]
            )
        out[:] = self._table[numbers]

    def _stream(self, number: int) -> np.random.Generator:
        """Return the generator, at its start, of the noise of a run, from 0."""
        return _stream(self.seed, self.first + number, 1)

    def noise(self) -> Floats:
        """Return the noise of the next sample, standard normal, shape (1 + fingers, runs).

        Of the pressure, then of each angle.
        """
        if not self._noise:
            self._noise = [self._stream(run) for run in range(self._single)]
        if self._used == _BLOCK:
            # A block at a time: a call for each run and sample would cost more than the physics.
            for run, generator in enumerate(self._noise):
                self._block[:, :, run] = generator.standard_normal(self._block.shape[:2])
            self._used = 0
        self._used += 1
        drawn: Floats = self._block[self._used - 1][:, self._which]
        return drawn
