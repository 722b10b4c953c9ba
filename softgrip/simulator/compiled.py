"""A controller on many runs of the simulated rig, compiled: `drive.drive`, but faster."""

from collections.abc import Collection
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats, chunks
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.rig_controller import RigController
from softgrip.errors import InvalidInputError
from softgrip.pump.gas import GAS_CONSTANT
from softgrip.simulator.sampled_law import SampledLaw, command_law, sampled_law
from softgrip.simulator.simulation import Simulation


@dataclass(frozen=True)
class Trajectories:
    """What is kept of a batch of runs; None of the rest.

    Attributes:
        time: s, from 0, shape (samples,).
        command: rad/s, held *until* each time, shape (runs, samples).
        pressure, angle: Measured: Pa gauge and rad, shape (runs, samples) and (runs, fingers,
            samples).
        felt_pressure, felt_angle: The same without noise, range and converter.
        true_pressure, true_angle, true_rate: The same without the sensors, and rad/s.
        motor_speed, plunger, amount: As in `Truth`, shape (runs, samples).
    """

    time: Floats
    command: Floats | None = None
    pressure: Floats | None = None
    angle: Floats | None = None
    felt_pressure: Floats | None = None
    felt_angle: Floats | None = None
    true_pressure: Floats | None = None
    true_angle: Floats | None = None
    true_rate: Floats | None = None
    motor_speed: Floats | None = None
    plunger: Floats | None = None
    amount: Floats | None = None


PUMP = ("area", "syringe_volume", "backlash", "advance", "speed_limit", "acceleration_limit")
SENSORS = (
    *("pressure_range", "angle_range", "pressure_noise", "angle_noise"),
    *("low_count", "high_count", "largest_count"),
)
FINGER = (*("stiffness", "damping", "power", "friction", "slow", "torque_per_pressure"),)
"""Rows of the kernel's records that `Simulation` has by the same name."""

OF_FINGERS = ("angle", "felt_angle", "true_angle", "true_rate")
QUANTITIES = tuple(field.name for field in fields(Trajectories))[1:]


def drive_compiled(
    rig: Simulation,
    control: RigController | SampledLaw | Floats,
    *,
    duration: float,
    limit: float = SPEED_LIMIT,
    push: ArrayLike | None = None,
    every: int = 1,
    delay: int = 0,
    unread: int = 0,
    keep: Collection[str] = ("pressure", "angle"),
    steps: NDArray[np.intp] | None = None,
) -> Trajectories:
    """Run a controller on a rig at rest, as `drive.drive` does and to 1e-9 of what it gives.

    The rig stays where it is. The first call of a process compiles, or loads what an earlier one
    has left on disk; see `kernel`.

    Args:
        rig: Which; nothing may be touched by its fingers.
        control: One of the controllers that `sampled_law` knows, as it is before its first update;
            a law of one's own; or motor speeds, rad/s, shape (periods,) or (runs, periods).
        duration, limit, every, delay: As of `drive.drive`.
        push: Torque on the fingers, N m, over each period of the rig, the last one held; shape
            (periods, fingers) or (runs, periods, fingers); None for what `Simulation.push` says.
        unread: Samples at the start whose noise is none, >= 0: 1 for a rig that is first read at
            the end of a period, as `Simulation.open_loop` does, so that the noise is the same.
        keep: Names of what is returned, of `QUANTITIES`: each costs 8 bytes a run and sample.
        steps: Of the integration in a period, >= 1, shape (runs,); None for those of the rig. Runs
            of as many are put side by side.

    Raises:
        InvalidInputError: If an argument is not as said.
    """
    from softgrip.simulator import kernel

    unknown = sorted(set(keep) - set(QUANTITIES))
    if unknown or not keep:
        raise InvalidInputError("keep", expected=f"some of {QUANTITIES}", got=unknown or keep)
    count, fingers = rig.runs, len(rig.parameters.fingers)
    if rig.time > 0 or rig.plant.contact is not None:
        raise InvalidInputError(
            "rig",
            expected="one that has not moved, with nothing between its fingers",
            got=f"{rig.time:g} s, {type(rig.plant.contact).__name__}",
        )
    samples = round(duration / rig.period) + 1
    if samples < 2 or not limit > 0 or every < 1 or delay < 0:
        raise InvalidInputError(
            "duration, limit, every, delay",
            expected="a period or more, > 0, >= 1, >= 0",
            got=(duration, limit, every, delay),
        )
    if isinstance(control, np.ndarray):
        control = command_law(control, fingers)
    elif not isinstance(control, SampledLaw):
        control = sampled_law(control, fingers)
    law = _arrays_of_law(control, rig, every)
    pushed = rig.plant.push.T[:, None] if push is None else push
    torque = _of_runs("push", pushed, (None, fingers), count)
    air, own, branches = _arrays_of_rig(rig)
    rows, size = _rows(keep, fingers)
    taken = np.full(count, rig.steps) if steps is None else _checked_steps(steps, count)
    order = np.argsort(taken, kind="stable")
    out = np.empty((count, size, samples))
    looks = any(law[name].any() for name in ("D_measured", "B_measured", "start"))
    heard = looks or not {"pressure", "angle"}.isdisjoint(keep)
    noise = np.zeros((kernel.LANES, samples, 1 + fingers))
    plan = kernel.Plan(every, float(limit), heard, bool(np.any(rig.parameters.pump.backlash)))
    for part in chunks(count, 1.0, limit=kernel.LANES):
        # A batch that does not fill its lanes repeats its last run.
        runs = order[part]
        lanes = np.pad(runs, (0, kernel.LANES - runs.size), mode="edge")
        if heard:
            rig.chance.noises(runs, noise[: runs.size, unread:])
        kernel.experiment(
            _records(kernel.RIG, air, lanes, (1,)),
            _records(kernel.FINGER, own, lanes, (fingers,)),
            _records(kernel.BRANCH, branches, lanes, (fingers, len(rig.plant.memory))),
            kernel.Law(
                **{name: _in_lanes(array, lanes) for name, array in law.items()},
                scale=0.0 if control.digits is None else 10.0**control.digits,
                period=every * rig.period,
            ),
            noise,
            _in_lanes(torque, lanes),
            _elapsed(taken[lanes], rig.period),
            plan,
            np.zeros((delay + 1, kernel.LANES)),
            kernel.Rows(**rows),
            out,
            runs,
        )
    if "amount" in keep:
        out[:, rows["amount"]] /= np.reshape(GAS_CONSTANT * rig.parameters.gas.temperature, (-1, 1))
    kept = {
        name: out[:, row : row + fingers] if name in OF_FINGERS else out[:, row]
        for name, row in rows.items()
        if row >= 0
    }
    return Trajectories(np.arange(float(samples)) * rig.period, **kept)


def _checked_steps(steps: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    if steps.shape != (count,) or not (steps >= 1).all():
        raise InvalidInputError("steps", expected=f"shape ({count},), each >= 1", got=steps)
    return steps


def _elapsed(steps: NDArray[np.intp], period: float) -> Floats:
    """Return the ends and middles of the steps in a period, s, shape (times, lanes).

    As many as most steps have; where there are fewer, the last are the end of the period.
    """
    halves = np.minimum(np.arange(2 * steps.max() + 1)[:, None], 2 * steps)
    return np.asarray(halves * (period / (2 * steps)))


def _rows(keep: Collection[str], fingers: int) -> tuple[dict[str, int], int]:
    """Return in which row of a run each quantity is kept, -1 if not, and the number of rows."""
    rows, size = {}, 0
    for name in QUANTITIES:
        rows[name] = size if name in keep else -1
        size += (fingers if name in OF_FINGERS else 1) * (name in keep)
    return rows, size


def _arrays_of_rig(rig: Simulation) -> tuple[dict[str, Floats], ...]:
    """Return the rows of the kernel's three records, as far as they are not 0 at the start.

    The runs are the last axis, as long as they are many or 1; fingers and branches come before.
    """
    pump, gas, sensors = rig.parameters.pump, rig.parameters.gas, rig.parameters.sensors
    plant, place = rig.plant, rig.truth.plunger
    air = {name: getattr(pump, name) for name in PUMP} | {
        name: getattr(sensors, name) for name in SENSORS
    }
    air |= {name: getattr(plant, name) for name in ("leakage", "ballooning", "rest")}
    volume = pump.syringe_volume - pump.area * place + plant.rest
    air |= {
        "atmosphere": gas.atmosphere,
        "end": pump.stroke + pump.backlash,
        "screw": place,
        "plunger": place,
        "amount": gas.atmosphere * volume,
        # To multiply is faster than to divide.
        "pressure_pace": 1 / sensors.pressure_lag,
        "angle_pace": 1 / sensors.angle_lag,
    }
    own = {name: getattr(plant, name) for name in FINGER} | {"mobility": 1 / plant.inertia}
    branches = {"memory": plant.memory, "relaxation": plant.relaxation}
    return air, own, {name: np.moveaxis(value, 0, 1) for name, value in branches.items()}


def _records(
    kind: np.dtype[np.void],
    rows: dict[str, Floats],
    lanes: NDArray[np.int64],
    shape: tuple[int, ...],
) -> NDArray[np.void]:
    """Return the records of some runs, of zeros but for the rows given."""
    records = np.zeros(shape, kind)
    for name, value in rows.items():
        array = np.asarray(value, dtype=np.float64)
        some = array[..., lanes] if array.ndim and array.shape[-1] > 1 else array
        if records[name].ndim > len(shape) + 1:
            # A state: its sum is 0 when a step starts.
            records[name][..., :2, :] = some
        else:
            records[name] = some
    return records


def _arrays_of_law(law: SampledLaw, rig: Simulation, every: int) -> dict[str, Floats]:
    """Return the arrays of a law by their name in the kernel, with a first axis of runs or 1.

    Raises:
        InvalidInputError: If one has another shape or is not finite, or the period is another.
    """
    m, count = law.matrices, rig.runs
    inputs = len(rig.parameters.fingers) if law.jerk is None else 3
    n, targets = np.shape(m.A)[-1], np.shape(m.D_target)[-1]
    if not (np.isnan(m.period) or np.isclose(m.period, every * rig.period)):
        raise InvalidInputError(
            "period of the controller", expected=f"{every * rig.period:g} s", got=m.period
        )
    shapes: dict[str, tuple[int | None, ...]] = {
        "A": (n, n), "B_measured": (n, inputs), "B_target": (n, targets), "B_sent": (n,),
        "C": (n,), "D_measured": (inputs,), "D_target": (targets,),
    }  # fmt: skip
    arrays = {
        name: _of_runs(name, getattr(m, name), shape, count) for name, shape in shapes.items()
    }
    start = np.zeros((n, inputs)) if law.start is None else law.start
    integral = np.zeros(n) if law.integral is None else law.integral
    return arrays | {
        "start": _of_runs("start", start, (n, inputs), count),
        "integral": _of_runs("integral", integral, (n,), count),
        "least": _of_runs("least", law.least, (), count),
        "largest": _of_runs("largest", law.largest, (), count),
        "jerk": _of_runs("jerk", 0.0 if law.jerk is None else law.jerk, (), count),
        "reference": _of_runs("reference", law.reference, (None, targets), count),
    }


def _of_runs(name: str, value: ArrayLike, shape: tuple[int | None, ...], runs: int) -> Floats:
    """Return an array with a first axis of the runs, or of 1 if it is of all; None: any length."""
    array = np.asarray(value, dtype=np.float64)
    array = array[None] if array.ndim == len(shape) else array
    lengths = array.shape[1:]
    fits = array.ndim == len(shape) + 1 and all(
        length == wanted or (wanted is None and length)
        for length, wanted in zip(lengths, shape, strict=True)
    )
    if not fits or len(array) not in (1, runs) or np.isnan(array).any():
        raise InvalidInputError(
            name, expected=f"numbers of shape {shape}, or {runs} of these", got=array.shape
        )
    return array


def _in_lanes(array: Floats, lanes: NDArray[np.int64]) -> Floats:
    """Return an array of the runs, or of all, with a last axis of lanes."""
    some = array[lanes] if len(array) > 1 else array[np.zeros_like(lanes)]
    return np.ascontiguousarray(np.moveaxis(some, 0, -1))
