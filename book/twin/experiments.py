"""The one place where the twin meets the simulator: one experiment on many rigs, repeated on each.

All rigs meet the same chance. The noise of the sensors is that of `Simulation.open_loop`, whose
records begin at the end of the first period, and that of `drive`, whose records begin at rest: so
the same seed gives the runs of the book's logs.
"""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.pid import PERIOD
from softgrip.simulator.chance import SEED
from softgrip.simulator.compiled import drive_compiled
from softgrip.simulator.drive import Driven, drive
from softgrip.simulator.law_controller import LawController
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.rig_batch import run_count, take
from softgrip.simulator.sampled_law import SampledLaw, command_law, of_runs
from softgrip.simulator.simulation import Simulation
from softgrip.simulator.step_size import steps_for

KEPT = ("pressure", "angle", "true_pressure", "true_angle", "plunger")
NOTHING: Floats = np.empty(0)


@dataclass(frozen=True)
class Records:
    """What was recorded of an experiment on some rigs, SI; runs are repeats on one rig.

    What was not asked for is `NOTHING`.

    Attributes:
        time: Shape (N,), even.
        pressure, angle: As measured, shapes (rigs, runs, N) and (rigs, runs, fingers, N).
        true_pressure, true_angle: Without the sensors, same shapes.
        plunger: Its travel, shape (rigs, runs, N).
    """

    time: Floats
    pressure: Floats
    angle: Floats
    true_pressure: Floats
    true_angle: Floats
    plunger: Floats


def open_loop(
    rigs: RigParameters,
    commands: Floats,
    *,
    runs: int = 1,
    plunger: float = 0.0,
    seed: int = SEED,
    keep: Collection[str] = KEPT,
    compiled: bool = True,
) -> Records:
    """Send each rig its commands; the records begin at the end of the first period.

    Args:
        rigs: Their parameters, numbers or shape (rigs,).
        commands: Motor speeds of all or of each, rad/s, shape (N,) or (rigs, N).
        runs: Repeats on each rig.
        plunger: Travel at the start, m.
        seed: Of all chance, the same on all rigs.
        keep: Names of what is recorded.
        compiled: False for the simulator on NumPy, which is hundreds of times slower.
    """
    law = command_law(commands, len(rigs.fingers))
    duration = commands.shape[-1] * PERIOD
    return _records(
        rigs, law, duration, runs, PERIOD, seed, keep, compiled, plunger=plunger, unread=1
    )


def closed_loop(
    rigs: RigParameters,
    law: SampledLaw,
    duration: float,
    *,
    runs: int = 1,
    period: float = PERIOD,
    seed: int = SEED,
    keep: Collection[str] = KEPT,
    compiled: bool = True,
) -> Records:
    """Run a controller on each rig, from rest; the records begin before it moves.

    Args:
        rigs, runs, seed, keep, compiled: As of `open_loop`.
        law: Of all rigs, or with a leading axis of rigs.
        duration: s.
        period: Of rig and controller, s.
    """
    return _records(rigs, law, duration, runs, period, seed, keep, compiled)


def _records(
    rigs: RigParameters,
    law: SampledLaw,
    duration: float,
    runs: int,
    period: float,
    seed: int,
    keep: Collection[str],
    compiled: bool,
    *,
    plunger: float = 0.0,
    unread: int = 0,
) -> Records:
    """Return the samples from number `unread` on."""
    count, every = run_count(rigs), steps_for(rigs, period)
    lanes, steps = np.repeat(np.arange(count), runs), np.repeat(every, runs)

    def rig(which: NDArray[np.intp], step: float | None = None) -> Simulation:
        return Simulation(
            take(rigs, lanes[which]), runs=which.size, seed=seed, cycle=runs, period=period,
            plunger=plunger, step=step,
        )  # fmt: skip

    if compiled:
        made = vars(
            drive_compiled(
                rig(np.arange(lanes.size)), of_runs(law, lanes), duration=duration, unread=unread,
                keep=keep, steps=steps,
            )
        )  # fmt: skip
    else:
        made = {}
        for number in np.unique(steps):
            which = np.flatnonzero(steps == number)
            control = of_runs(law, lanes[which])
            some = _of_numpy(rig(which, period / number), control, duration, unread)
            for name, values in some.items():
                made.setdefault(name, np.empty((lanes.size, *values.shape[1:])))[which] = values
    found = {
        # A view of the kernel's rows.
        name: made[name][..., unread:].reshape(count, runs, *made[name].shape[1:-1], -1)
        for name in keep
    }
    time = period * np.arange(unread, round(duration / period) + 1.0)
    return Records(time, **{name: found.get(name, NOTHING) for name in KEPT})


def _of_numpy(rig: Simulation, law: SampledLaw, duration: float, unread: int) -> dict[str, Floats]:
    """Return what `drive`, or `Simulation.open_loop`, gives of what may be kept, runs first."""
    if unread:
        # Such a law looks at nothing: its reference is what it sends, then rest.
        commands = np.broadcast_to(law.reference, (rig.runs, *law.reference.shape[-2:]))
        seen, true = rig.open_loop(commands[:, :-1, 0].T)
        made = Driven(np.asarray(seen.time), commands, seen, true)
    else:
        made = drive(rig, LawController(law), duration=duration, limit=SPEED_LIMIT)
    parts = {name: getattr(made.measured, name) for name in ("pressure", "angle")}
    parts |= {f"true_{name}": getattr(made.truth, name) for name in parts}
    parts["plunger"] = made.truth.plunger
    moved = {name: np.moveaxis(values, (0, -1), (-1, 0)) for name, values in parts.items()}
    return {
        name: np.concatenate([values[..., :1]] * unread + [values], axis=-1)
        for name, values in moved.items()
    }
