"""The rig of `laws.Plant` in a controller's loop, compiled: `LANES` runs at a time, side by side.

A run is a lane, so that one instruction does several of them: each loop over lanes below reads and
writes rows of one record, whose distances the compiler knows. A state has three rows: at the stage
of the Runge-Kutta step that is being looked at, at the start of the step, and what the stages so
far add to it. Nothing but the samples that are kept is stored for longer than a step.

The formulas are those of the modules in `SHARED`, compiled from there.
"""

from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numba import njit

from softgrip.control import differentiator
from softgrip.pump import gas
from softgrip.simulator import lane_power, laws, motor, sensors

LANES = 128
"""Enough to hide what a loop costs to start: of half, or of more, a run takes longer."""

_STATE, _ROW = ("f8", (3, LANES)), ("f8", (LANES,))
STAGE, START, SUM = range(3)
"""Rows of a state."""


def _record(states: str, rows: str) -> np.dtype[np.void]:
    return np.dtype([(s, *_STATE) for s in states.split()] + [(r, *_ROW) for r in rows.split()])


RIG = _record(
    "amount sensed",
    "volume gauge atmosphere leakage ballooning rest area syringe_volume end backlash"
    " advance speed_limit acceleration_limit command speed screw plunger"
    " pressure_pace angle_pace pressure_range angle_range pressure_noise angle_noise"
    " low_count high_count largest_count pressure step",
)
FINGER = _record(
    "angle rate sensed",
    "stiffness damping power mobility friction slow torque_per_pressure push growth torque",
)
BRANCH = _record("held", "memory relaxation")


class Rows(NamedTuple):
    """Where each quantity of a sample is kept, the last four from there on for each finger.

    -1 for nowhere. Those that are `true` the sensors do not tell, and what is `felt` they tell with
    noise, range and converter.
    """

    command: int
    motor_speed: int
    plunger: int
    amount: int
    true_pressure: int
    felt_pressure: int
    pressure: int
    true_angle: int
    true_rate: int
    felt_angle: int
    angle: int


class Motor(NamedTuple):
    """What `motor` asks of a pump."""

    advance: float
    speed_limit: float
    acceleration_limit: float


class Finger(NamedTuple):
    """What `laws.driving_torque` asks of a finger."""

    torque_per_pressure: float
    damping: float


class Converter(NamedTuple):
    """What `sensors` asks of the converter."""

    low_count: float
    high_count: float
    largest_count: float


class Plan(NamedTuple):
    """How the experiment goes: `every` and `limit` of `drive`, and what can be left out.

    `heard` tells whether a sensor is, `play` whether the pump has any.
    """

    every: int
    limit: float
    heard: bool
    play: bool


class Law(NamedTuple):
    """A `SampledLaw` with a last axis of lanes in each array; `scale` and `jerk` are 0 for none."""

    A: Any
    B_measured: Any
    B_target: Any
    B_sent: Any
    C: Any
    D_measured: Any
    D_target: Any
    start: Any
    integral: Any
    least: Any
    largest: Any
    jerk: Any
    reference: Any
    scale: float
    period: float


# A product and a sum may become one instruction, which rounds once; no more is rearranged.
_compiled: Any = njit(error_model="numpy", fastmath={"contract"})
_power = _compiled(lane_power.power)
_leak, _charge_pressure = _compiled(laws.leak), _compiled(gas.charge_pressure)
_driving_torque, _friction = _compiled(laws.driving_torque), _compiled(laws.friction_torque)
_memory_slope, _predict = _compiled(laws.memory_slope), _compiled(differentiator.predict)
_speed, _travel = _compiled(motor.speed), _compiled(motor.travel)
_turning_time, _follow = _compiled(motor.turning_time), _compiled(motor.follow)
_rounded, _read_back = _compiled(sensors.rounded), _compiled(sensors.read_back)
SHARED = (laws, gas, motor, sensors, differentiator, lane_power)


@_compiled
def _go(rig, state, j, slope, weight, part):
    """Take a slope into the step, and move to the next stage, `part` of it from its start."""
    state[SUM, j] += weight * slope
    state[STAGE, j] = state[START, j] + part * rig.step[j] * slope


@_compiled
def _finish(rig, state):
    for j in range(LANES):
        end = state[START, j] + rig.step[j] * state[SUM, j]
        state[STAGE, j], state[START, j], state[SUM, j] = end, end, 0.0


@_compiled
def _sweep(rig, finger):
    for j in range(LANES):
        rig.volume[j] += finger.torque_per_pressure[j] * finger.angle[STAGE, j]


@_compiled
def _press(rig, syringe):
    for j in range(LANES):
        volume = rig.volume[j] + syringe[j] + rig.rest[j]
        air = _charge_pressure(rig.amount[STAGE, j], volume, rig.ballooning[j], rig.atmosphere[j])
        rig.gauge[j] = air - rig.atmosphere[j]


@_compiled
def _gauge_pressure(rig, fingers, syringe):
    for j in range(LANES):
        rig.volume[j] = 0.0
    for f in range(len(fingers)):
        _sweep(rig, fingers[f])
    _press(rig, syringe)


@_compiled
def _flow(rig, weight, part):
    for j in range(LANES):
        gauge = rig.gauge[j]
        _go(rig, rig.amount, j, -_leak(gauge, rig.leakage[j], rig.atmosphere[j]), weight, part)
        late = gauge - rig.sensed[STAGE, j]
        _go(rig, rig.sensed, j, late * rig.pressure_pace[j], weight, part)


@_compiled
def _drive(rig, finger):
    for j in range(LANES):
        angle, rate, power = finger.angle[STAGE, j], finger.rate[STAGE, j], finger.power[j]
        own = Finger(finger.torque_per_pressure[j], finger.damping[j])
        secant = _power(abs(angle), power - 1) * finger.stiffness[j]
        finger.growth[j] = secant * rate * power
        finger.torque[j] = _driving_torque(rig.gauge[j], angle, rate, secant, own)


@_compiled
def _remember(rig, finger, branch, weight, part):
    for j in range(LANES):
        held = branch.held[STAGE, j]
        finger.torque[j] -= held
        slope = _memory_slope(held, finger.growth[j], branch.memory[j], branch.relaxation[j])
        _go(rig, branch.held, j, slope, weight, part)


@_compiled
def _bend(rig, finger, weight, part):
    for j in range(LANES):
        angle, rate = finger.angle[STAGE, j], finger.rate[STAGE, j]
        friction = _friction(rate, finger.friction[j], finger.slow[j])
        torque = finger.torque[j] - friction + finger.push[j]
        _go(rig, finger.angle, j, rate, weight, part)
        _go(rig, finger.rate, j, torque * finger.mobility[j], weight, part)
        late = angle - finger.sensed[STAGE, j]
        _go(rig, finger.sensed, j, late * rig.angle_pace[j], weight, part)


@_compiled
def _stage(rig, fingers, branches, syringe, weight, part):
    _gauge_pressure(rig, fingers, syringe)
    _flow(rig, weight, part)
    for f in range(len(fingers)):
        _drive(rig, fingers[f])
        for b in range(branches.shape[1]):
            _remember(rig, fingers[f], branches[f, b], weight, part)
        _bend(rig, fingers[f], weight, part)


@_compiled
def _step(rig, fingers, branches, elapsed, syringe, k):
    """Take a classical Runge-Kutta step; the air in the syringe is given at three of its times.

    A run that is at the end of the period already, as it has fewer steps than others, stays there.
    """
    for j in range(LANES):
        rig.step[j] = elapsed[2, j] if elapsed[k + 2, j] > elapsed[k, j] else 0.0
    _stage(rig, fingers, branches, syringe[k], 1 / 6, 1 / 2)
    _stage(rig, fingers, branches, syringe[k + 1], 1 / 3, 1 / 2)
    _stage(rig, fingers, branches, syringe[k + 1], 1 / 3, 1.0)
    _stage(rig, fingers, branches, syringe[k + 2], 1 / 6, 1.0)
    _finish(rig, rig.amount)
    _finish(rig, rig.sensed)
    for f in range(len(fingers)):
        _finish(rig, fingers[f].angle)
        _finish(rig, fingers[f].rate)
        _finish(rig, fingers[f].sensed)
        for b in range(branches.shape[1]):
            _finish(rig, branches[f, b].held)


@_compiled
def _turn(rig, elapsed, syringe, play):
    """Turn the screw as the motor can, and give the air in the syringe over the period."""
    last = len(elapsed) - 1
    for j in range(LANES):
        syringe[0, j] = syringe[last, j]
    for k in range(1, last + 1):
        for j in range(LANES):
            own = Motor(rig.advance[j], rig.speed_limit[j], rig.acceleration_limit[j])
            moved = rig.screw[j] + _travel(rig.speed[j], rig.command[j], elapsed[k, j], own)
            screw = min(max(moved, 0.0), rig.end[j])
            place = screw
            if play:
                turned = min(elapsed[k, j], _turning_time(rig.speed[j], rig.command[j], own))
                peak = rig.screw[j] + _travel(rig.speed[j], rig.command[j], turned, own)
                behind = _follow(rig.plunger[j], min(max(peak, 0.0), rig.end[j]), rig.backlash[j])
                place = _follow(behind, screw, rig.backlash[j])
            syringe[k, j] = rig.syringe_volume[j] - rig.area[j] * place
            if k == last:
                speed = _speed(rig.speed[j], rig.command[j], elapsed[k, j], own)
                stopped = (screw <= 0 and speed < 0) or (screw >= rig.end[j] and speed > 0)
                rig.speed[j] = 0.0 if stopped else speed
                rig.screw[j], rig.plunger[j] = screw, place


@_compiled
def _read(rig, state, full, deviation, noise, found):
    """Read a sensor through the converter."""
    for j in range(LANES):
        own = Converter(rig.low_count[j], rig.high_count[j], rig.largest_count[j])
        felt = min(state[STAGE, j], full[j]) + deviation[j] * noise[j]
        found[j] = _read_back(_rounded(felt, full[j], own), full[j], own)


@_compiled
def _measure(rig, fingers, noise, sample, drawn, angle):
    """Read the sensors into the rig's pressure and the angles, shape (fingers, lanes)."""
    for sensor in range(len(drawn)):
        for j in range(LANES):
            drawn[sensor, j] = noise[j, sample, sensor]
    _read(rig, rig.sensed, rig.pressure_range, rig.pressure_noise, drawn[0], rig.pressure)
    for f in range(len(fingers)):
        _read(rig, fingers[f].sensed, rig.angle_range, rig.angle_noise, drawn[1 + f], angle[f])


@_compiled
def _write(out, runs, row, sample, values):
    if row >= 0:
        for j in range(len(runs)):
            out[runs[j], row, sample] = values[j]


@_compiled
def _keep(rig, fingers, angle, syringe, rows, sample, out, runs):
    """Write what is kept of a sample of some runs into `out`, shape (runs, rows, samples)."""
    _write(out, runs, rows.command, sample, rig.command)
    _write(out, runs, rows.motor_speed, sample, rig.speed)
    _write(out, runs, rows.plunger, sample, rig.plunger)
    _write(out, runs, rows.amount, sample, rig.amount[STAGE])
    _write(out, runs, rows.felt_pressure, sample, rig.sensed[STAGE])
    _write(out, runs, rows.pressure, sample, rig.pressure)
    if rows.true_pressure >= 0:
        _gauge_pressure(rig, fingers, syringe)
        _write(out, runs, rows.true_pressure, sample, rig.gauge)
    for f in range(len(fingers)):
        if rows.true_angle >= 0:
            _write(out, runs, rows.true_angle + f, sample, fingers[f].angle[STAGE])
        if rows.true_rate >= 0:
            _write(out, runs, rows.true_rate + f, sample, fingers[f].rate[STAGE])
        if rows.felt_angle >= 0:
            _write(out, runs, rows.felt_angle + f, sample, fingers[f].sensed[STAGE])
        if rows.angle >= 0:
            _write(out, runs, rows.angle + f, sample, angle[f])


@_compiled
def _fill(row, value):
    for j in range(LANES):
        row[j] = value


@_compiled
def _copy(rows, row):
    for i in range(len(row)):
        for j in range(LANES):
            row[i, j] = rows[i, j]


@_compiled
def _add(total, weights, values):
    for j in range(LANES):
        total[j] += weights[j] * values[j]


@_compiled
def _see(law, angle, predicted, first, inputs):
    """Write what the law looks at: the angles, or the derivatives of their mean."""
    if law.jerk[0] == 0:
        _copy(angle, inputs)
        return
    for j in range(LANES):
        mean = 0.0
        for f in range(len(angle)):
            mean += angle[f, j]
        mean /= len(angle)
        if first:
            predicted[0, j], predicted[1, j], predicted[2, j] = mean, 0.0, 0.0
        a, b, c = predicted[0, j], predicted[1, j], predicted[2, j]
        inputs[0, j], inputs[1, j], inputs[2, j] = a, b, c
        a, b, c = _predict(a, b, c, mean, law.jerk[j], law.period)
        predicted[0, j], predicted[1, j], predicted[2, j] = a, b, c


@_compiled
def _decide(law, x, ahead, inputs, target, free, sent):
    """Update the law's states x, and write its command within its limits, rounded, into `sent`."""
    _fill(free, 0.0)
    for i in range(len(x)):
        _add(free, law.C[i], x[i])
    for i in range(len(inputs)):
        _add(free, law.D_measured[i], inputs[i])
    for i in range(len(target)):
        _add(free, law.D_target[i], target[i])
    for j in range(LANES):
        sent[j] = min(max(free[j], law.least[j]), law.largest[j])
    for i in range(len(x)):
        _fill(ahead[i], 0.0)
        for k in range(len(x)):
            _add(ahead[i], law.A[i, k], x[k])
        for k in range(len(inputs)):
            _add(ahead[i], law.B_measured[i, k], inputs[k])
        for k in range(len(target)):
            _add(ahead[i], law.B_target[i, k], target[k])
        _add(ahead[i], law.B_sent[i], sent)
        for j in range(LANES):
            pushed = (free[j] - sent[j]) * law.C[i, j] * (ahead[i, j] - x[i, j])
            if law.integral[i, j] > 0 and pushed > 0:
                ahead[i, j] = x[i, j]
    _copy(ahead, x)
    if law.scale > 0:
        for j in range(LANES):
            sent[j] = np.rint(sent[j] * law.scale) / law.scale


@_compiled
def _held(values, k, row):
    """Fill a row from values, shape (periods, lanes), of which the last is held."""
    now = values[min(k, len(values) - 1)]
    for j in range(LANES):
        row[j] = now[j]


@_compiled
def _experiment(rigs, fingers, branches, law, noise, push, elapsed, plan, late, rows, out, runs):
    rig = rigs[0]
    inputs, target = np.zeros(law.D_measured.shape), np.zeros(law.D_target.shape)
    x, ahead = np.zeros(law.C.shape), np.zeros(law.C.shape)
    angle, predicted = np.zeros((len(fingers), LANES)), np.zeros((3, LANES))
    drawn = np.zeros((1 + len(fingers), LANES))
    free, sent = np.zeros(LANES), np.zeros(LANES)
    syringe, last = np.zeros((len(elapsed), LANES)), len(elapsed) - 1
    for j in range(LANES):
        syringe[last, j] = rig.syringe_volume[j] - rig.area[j] * rig.plunger[j]
    for sample in range(out.shape[2]):
        if plan.heard:
            _measure(rig, fingers, noise, sample, drawn, angle)
        _keep(rig, fingers, angle, syringe[last], rows, sample, out, runs)
        if sample + 1 == out.shape[2]:
            break
        if sample % plan.every == 0:
            update = sample // plan.every
            _see(law, angle, predicted, update == 0, inputs)
            if update == 0:
                for i in range(len(x)):
                    for k in range(len(inputs)):
                        _add(x[i], law.start[i, k], inputs[k])
            for i in range(len(target)):
                _held(law.reference[:, i], update, target[i])
            _decide(law, x, ahead, inputs, target, free, sent)
            now, then = update % len(late), (update + 1) % len(late)
            for j in range(LANES):
                late[now, j] = min(max(sent[j], -plan.limit), plan.limit)
            for j in range(LANES):
                rig.command[j] = late[then, j]
        for f in range(len(fingers)):
            _held(push[:, f], sample, fingers[f].push)
        _turn(rig, elapsed, syringe, plan.play)
        for k in range(0, last, 2):
            _step(rig, fingers, branches, elapsed, syringe, k)


def _fingerprint() -> int:
    """Return a number that is another when any formula is."""
    files = [Path(str(module.__file__)) for module in SHARED] + [Path(__file__)]
    return int.from_bytes(sha256(b"".join(file.read_bytes() for file in files)).digest()[:7])


def _kernel(fingerprint: int) -> Any:
    """Return the compiled experiment.

    Numba keeps it on disk, beside this file or, where that cannot be written, in the user's cache;
    where neither can, each process compiles anew. It looks at this file's date alone, and at what a
    function closes over: hence the fingerprint, without which it would not see a formula change.
    """

    def experiment(*arguments):
        _experiment(*arguments)
        return fingerprint

    try:
        return njit(experiment, nogil=True, cache=True)
    except RuntimeError:
        return njit(experiment, nogil=True)


experiment = _kernel(_fingerprint())
