"""How often the intervals of a fitted rig hold the truth, of rigs that a seed hid from it.

``python -m softgrip.rig.fit_coverage`` writes ``data/rig/fit_coverage.csv``. Each rig is drawn from
the declared ranges, and recorded as a reader's would be, with noise, converter
and the spread from run to run: a step to 60 deg, and a slow push to the end of the flex sensor.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.pid import PERIOD
from softgrip.kept import Kept
from softgrip.rig.record import record
from softgrip.rig.simulated import SimulatedRig
from softgrip.simulator.chance import SEED
from softgrip.simulator.fit_estimates import Estimate
from softgrip.simulator.fitted_rigs import design_1
from softgrip.simulator.free_parameters import free_parameters, parameter_values, with_values
from softgrip.simulator.inference import infer
from softgrip.simulator.laws import settled_torque
from softgrip.simulator.parameters import RigParameters, Spread
from softgrip.simulator.simulation import Simulation
from softgrip.simulator.steps import simulate_step_test, step_commands, travel_to
from softgrip.simulator.trial import read_trial
from softgrip.units import DEG

RIGS = 40
ANGLES = (60 * DEG, 90 * DEG)
"""At the ends of step and push."""
SHARES = (0.1, 0.9)
"""Of the ranges on their scales, between which rigs are drawn."""
PRESSURES = (5e3, 1e5)
"""Pa, gauge: far above the noise of the pressure sensor, and below what bursts a finger."""
PUSH, REST = 6.0, 2.0
"""Of the push, and of the rest after it, s."""


@dataclass(frozen=True)
class Coverage:
    """How a parameter fared over the rigs.

    Attributes:
        name: Of the parameter.
        rigs: Number of fits.
        held: In how many its interval held the truth.
        told: In how many it was told.
        told_held: In how many of these its interval held the truth.
        width: Median width of its interval, as a share of the declared range on its scale.
    """

    name: str
    rigs: int
    held: int
    told: int
    told_held: int
    width: float


def hidden_rig(number: int) -> RigParameters:
    """Return a rig of one finger, drawn from the declared ranges without their outer tenths.

    One that does not bend to the last of `ANGLES` within `PRESSURES` and the time of a step is
    drawn again: with such a finger nobody would make these logs.
    """
    random = np.random.default_rng([SEED, number])
    space = free_parameters(1)
    while True:
        shares = random.uniform(*SHARES, len(space)).tolist()
        drawn = {one.name: one.at(share) for one, share in zip(space, shares, strict=True)}
        rig = with_values(design_1(), drawn)
        finger = rig.finger
        needed = settled_torque(ANGLES[-1], finger) / finger.torque_per_pressure
        if PRESSURES[0] < needed < PRESSURES[1] and _reaches(rig):
            return rig


def _reaches(rig: RigParameters) -> bool:
    alike = replace(rig, spread=Spread())
    deepest = simulate_step_test(alike, 0.8 * rig.pump.stroke, runs=1, seed=0)
    return bool(deepest.angle[-1] > ANGLES[-1])


def reader_logs(rig: RigParameters, folder: Path, *, seed: int) -> list[Path]:
    """Record a step and a push on a rig, each a run of its own, and return the logs' paths."""
    step, push = (travel_to(rig, angle) for angle in ANGLES)
    steady = np.full(round(PUSH / PERIOD), push / rig.pump.advance / PUSH)
    runs: list[tuple[str, Floats, float]] = [
        ("step", step_commands(step), 6.0), ("push", steady, PUSH + REST),
    ]  # fmt: skip
    paths = []
    for first, (name, commands, duration) in enumerate(runs):
        with SimulatedRig(Simulation(rig, seed=seed, first=first, period=PERIOD)) as one:
            one.home()
            path = folder / f"{name}.csv"
            record(one, commands, duration, path, limit=SPEED_LIMIT)
            paths.append(path)
    return paths


def fitted(number: int) -> tuple[dict[str, float], tuple[Estimate, ...]]:
    """Return the truth of a hidden rig, and what a fit to its logs says."""
    rig = hidden_rig(number)
    with TemporaryDirectory() as folder:
        trials = [read_trial(path) for path in reader_logs(rig, Path(folder), seed=number)]
    return parameter_values(rig), infer(trials, design_1()).estimates


def coverage(found: Sequence[tuple[dict[str, float], Sequence[Estimate]]]) -> Iterator[Coverage]:
    """Yield how each parameter fared, from what `fitted` returns of each rig."""
    for k, one in enumerate(free_parameters(1)):
        estimates = [estimates[k] for _, estimates in found]
        truths = [truth[one.name] for truth, _ in found]
        held = [e.low <= truth <= e.high for e, truth in zip(estimates, truths, strict=True)]
        told = [e.told for e in estimates]
        yield Coverage(
            one.name,
            rigs=len(found),
            held=sum(held),
            told=sum(told),
            told_held=sum(h and t for h, t in zip(held, told, strict=True)),
            width=float(np.median([one.share(e.low, e.high) for e in estimates])),
        )


def study() -> Iterator[Coverage]:
    """Fit `RIGS` hidden rigs; takes some minutes."""
    return coverage([fitted(number) for number in range(RIGS)])


KEPT = Kept(
    "rig/fit_coverage.csv",
    Coverage,
    study,
    "python -m softgrip.rig.fit_coverage",
    notes="Fits of hidden simulated rigs to a step and a push each: in how many the 90 % interval "
    "of a\nparameter held the truth, of all and of those in which it was told.",
    number=".3g",
)

if __name__ == "__main__":
    KEPT.main()
