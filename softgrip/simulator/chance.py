"""All chance in a simulated rig: a stream of numbers for each run, whatever the batch."""

import numpy as np

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
    own, noise = np.random.SeedSequence(seed, spawn_key=(run,)).spawn(2)
    return np.random.Generator(np.random.PCG64(own)), np.random.Generator(np.random.PCG64(noise))


class Chance:
    """What chance gives to the runs `first` to `first + runs` of a seed.

    Attributes:
        stiffness, damping: Multiples of the parameters of each finger, median 1, shape (fingers,
            runs).
        leakage: The same of the leak, shape (runs,).
    """

    def __init__(self, spread: Spread, *, fingers: int, seed: int, first: int, runs: int) -> None:
        pairs = [streams(seed, first + run) for run in range(runs)]
        drawn = np.array([own.standard_normal(1 + 2 * fingers) for own, _ in pairs]).T
        # So the kept logs were made: the leak of a single finger is drawn last, of several first.
        leak = 2 if fingers == 1 else 0
        own = np.delete(drawn, leak, axis=0)
        self.stiffness: Floats = np.exp(spread.stiffness * own[0::2])
        self.damping: Floats = np.exp(spread.damping * own[1::2])
        self.leakage: Floats = np.exp(spread.leakage * drawn[leak])
        self._noise = [noise for _, noise in pairs]
        self._block = np.empty((_BLOCK, 1 + fingers, runs))
        self._used = _BLOCK

    def noise(self) -> Floats:
        """Return the noise of the next sample, standard normal, shape (1 + fingers, runs).

        Of the pressure, then of each angle.
        """
        if self._used == _BLOCK:
            # A block at a time: a call for each run and sample would cost more than the physics.
            for run, generator in enumerate(self._noise):
                self._block[:, :, run] = generator.standard_normal(self._block.shape[:2])
            self._used = 0
        self._used += 1
        drawn: Floats = self._block[self._used - 1]
        return drawn
