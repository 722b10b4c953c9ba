"""Many runs of the simulated rig, in memory that does not grow with their number."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from softgrip.dynamics.chunks import chunks
from softgrip.simulator.finger import SimulatedRig
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.sensors import Measurement
from softgrip.simulator.truth import Truth

NUMBERS_PER_SAMPLE = 25
"""Kept of one run at one sample by `SimulatedRig.open_loop`, with its intermediate results."""


def in_parts(
    parameters: RigParameters,
    commands: ArrayLike,
    *,
    runs: int,
    seed: int = 0,
    period: float = 0.025,
    plunger: float = 0.0,
    limit: float = 64e6,
) -> Iterator[tuple[slice, Measurement, Truth]]:
    """Run a sequence of commands on any number of runs, in memory that does not grow with them.

    Parameters
    ----------
    parameters, runs, seed, period, plunger
        As of `SimulatedRig`.
    commands
        As of `SimulatedRig.open_loop`.
    limit
        About the largest memory that a part takes, bytes.

    Yields
    ------
    part, measurement, truth
        The runs of the part, the same as if all were run at once.
    """
    sequence = np.asarray(commands, dtype=np.float64)
    for part in chunks(runs, 8 * NUMBERS_PER_SAMPLE * len(sequence), limit=limit):
        rig = SimulatedRig(
            parameters,
            runs=part.stop - part.start,
            seed=seed,
            first=part.start,
            period=period,
            plunger=plunger,
        )
        yield part, *rig.open_loop(sequence[:, part] if sequence.ndim == 2 else sequence)
