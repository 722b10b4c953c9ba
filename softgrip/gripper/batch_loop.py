"""The sampled loop of many grippers at once: their states as each period starts, and measures."""

from collections import deque
from dataclasses import replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from softgrip.arrays import Floats
from softgrip.gripper.gripper_batch import Bools, GripperBatch, Trial, uniforms
from softgrip.gripper.internal_model import ControllerMatrices
from softgrip.gripper.sampled_plant import held_motion


def unaware(controller: ControllerMatrices) -> ControllerMatrices:
    """Return a controller whose model takes its whole command as sent, whatever the motor does.

    So Figure 6.3 draws it: the model P is fed by u_c. What a limit cuts off then shows as an error
    of the fingers, and is made up for; a model that knows the limit finds the fingers where it
    expects them, short of the target, and stays there.
    """
    whole, fingers = controller.linear(), controller.D_measured.size
    return replace(
        controller,
        A=whole.A,
        B_measured=whole.B[:, :fingers],
        B_target=whole.B[:, fingers:],
        B_sent=np.zeros_like(controller.B_sent),
    )


def loop_states(
    grippers: GripperBatch, controller: ControllerMatrices | None, trial: Trial
) -> Floats:
    """Run the loop from rest; parameters as of `monte_carlo.in_parts`.

    Returns:
        ndarray: Angle, rate, pump and command, the state of `sampled_plant.held_motion`, as each
            period starts and at the end, which has no command; shape (count, fingers, periods + 1,
            4).
    """
    count, fingers = grippers.count, grippers.fingers
    motion = held_motion(grippers.damping, grippers.stiffness, grippers.gain, trial.period, 1)
    step = np.stack([motion.angle[..., 0], motion.rate], axis=-2)
    states = np.zeros((count, fingers, trial.periods + 1, 4))
    noise = sensor_noise(grippers, trial)
    own = np.zeros((count, 0 if controller is None else len(controller.A)))
    late = deque([np.zeros(count)] * trial.delay_samples)
    for k in range(trial.periods):
        now = states[:, :, k]
        measured = now[..., 0] + noise[:, k]
        command = np.full(count, trial.feedforward[k] if trial.feedforward else 0.0)
        if controller is not None:
            command += own @ controller.C + measured @ controller.D_measured
            command += controller.D_target @ trial.target
        sent = np.clip(command, -trial.limit, trial.limit)
        if controller is not None:
            own = own @ controller.A.T + measured @ controller.B_measured.T
            own += controller.B_target @ trial.target + np.outer(sent, controller.B_sent)
        late.append(sent)
        now[..., 3] = late.popleft()[:, None]
        states[:, :, k + 1, :2] = np.einsum("pfij,pfj->pfi", step, now)
        states[:, :, k + 1, 2] = now[..., 2] + trial.period * now[..., 3]
    return states


def sensor_noise(grippers: GripperBatch, trial: Trial) -> Floats:
    """Return the noise of the measured angles, rad, shape (count, periods, fingers)."""
    shape = (grippers.count, trial.periods, grippers.fingers)
    if not trial.noise:
        return np.broadcast_to(0.0, shape)
    return trial.noise * np.asarray(ndtri(uniforms(trial.seed, 1, grippers.first, shape)))


def metrics(grippers: GripperBatch, states: Floats, trial: Trial) -> tuple[Floats, Floats, Floats]:
    """Return the measures of fingers that start from 0, at the trial's points.

    They are settling, overshoot and synchronization of `monte_carlo.Outcome`, on many long
    responses, from few of their points. Under a held command the acceleration y of a finger is a
    free vibration, ``y'' + damping y' + stiffness y = 0``, so ``y**2 + y'**2 / stiffness`` never
    grows: it bounds how far the angle leaves the straight line between the ends of the period.
    Where an extreme or the last point outside a band cannot lie need not be looked at; what is
    left are a few periods of each finger, point by point.

    Args:
        grippers, trial: What was simulated.
        states: As of `loop_states`.
    """
    edges = states[..., 0] / np.array(trial.target)[:, None]
    slack = _slack(grippers, states[:, :, :-1], trial)
    high = np.maximum(edges[..., :-1], edges[..., 1:]) + slack
    low = np.minimum(edges[..., :-1], edges[..., 1:]) - slack

    top = np.maximum(edges.max(axis=-1), 1.0)
    higher = high > top[..., None]
    # Of the edges outside a band the last; the start always is one.
    last = [
        trial.periods - np.argmax((np.abs(edges - 1) > band)[..., ::-1], axis=-1)
        for band in trial.bands
    ]
    doubtful = [
        ((high > 1 + band) | (low < 1 - band)) & (np.arange(trial.periods) >= edge[..., None])
        for band, edge in zip(trial.bands, last, strict=True)
    ]
    pairs = list(combinations(range(grippers.fingers), 2))
    gaps = [np.abs(edges[:, i] - edges[:, j]) for i, j in pairs]
    wider = [
        np.maximum(gap[:, :-1], gap[:, 1:]) + slack[:, i] + slack[:, j] > gap.max(axis=1)[:, None]
        for (i, j), gap in zip(pairs, gaps, strict=True)
    ]

    looked = np.logical_or.reduce([higher, *doubtful])
    for (i, j), mask in zip(pairs, wider, strict=True):
        looked[:, [i, j]] |= mask[:, None]
    series = _series(grippers, states[:, :, :-1], trial, looked)
    row = np.cumsum(looked).reshape(looked.shape) - 1
    time = np.linspace(0, 1, trial.points_a_period + 1)
    powers = time ** np.arange(series.shape[1])[:, None]

    np.maximum.at(top, np.nonzero(higher)[:2], (series[row[higher]] @ powers).max(axis=1))
    settling = [
        _settling(series[row[mask]] @ powers, mask, edge, band, trial)
        for mask, edge, band in zip(doubtful, last, trial.bands, strict=True)
    ]
    worst = np.max([gap.max(axis=1) for gap in gaps], axis=0)
    for (i, j), mask in zip(pairs, wider, strict=True):
        gap = (series[row[:, i][mask]] - series[row[:, j][mask]]) @ powers
        np.maximum.at(worst, np.nonzero(mask)[0], np.abs(gap, out=gap).max(axis=1))
    return np.stack(settling), top - 1, worst


def _slack(grippers: GripperBatch, starts: Floats, trial: Trial) -> Floats:
    """Return how far a share leaves the straight line in a period: at most y h^2 / 8."""
    angle, rate, pump, command = np.moveaxis(starts, -1, 0)
    c, k, g = (x[..., None] for x in (grippers.damping, grippers.stiffness, grippers.gain))
    y = g * pump - c * rate - k * angle
    jerk = g * command - c * y - k * rate
    scale = trial.period**2 / 8 / np.abs(trial.target)[:, None]
    # A little more, so that rounding hides no point.
    return np.asarray(np.sqrt(y**2 + jerk**2 / k) * scale * (1 + 1e-9) + 1e-12)


def _series(grippers: GripperBatch, starts: Floats, trial: Trial, looked: Bools) -> Floats:
    """Return the shares in some periods as power series of the time over the period, (some, terms).

    The terms grow to ``exp(damping period)`` before they vanish: the sum is as good as rounding
    times that.
    """
    which = np.nonzero(looked)
    T, scale = trial.period, 1 / np.array(trial.target)[which[1]]
    angle, rate, pump, command = starts[which].T * scale
    c, k, g = (x[which[:2]] for x in (grippers.damping, grippers.stiffness, grippers.gain))
    terms, c, k = [angle, rate * T], c * T, k * T**2
    drive = [g * T**2 * pump, g * T**3 * command]
    while len(terms) < 4 or np.abs(terms[-2:]).max(initial=0.0) > 1e-17:
        n = len(terms) - 2
        push = drive[n] if n < 2 else 0.0
        terms.append((push - c * (n + 1) * terms[-1] - k * terms[-2]) / ((n + 1) * (n + 2)))
    return np.stack(terms, axis=1)


def _settling(
    progress: Floats, doubtful: Bools, last: NDArray[np.int64], band: float, trial: Trial
) -> Floats:
    """Return the settling time, s, from the doubtful periods and the last edge outside."""
    points = trial.points_a_period
    excess = np.abs(progress - 1) - band
    out = excess[:, :-1] > 0
    at = points - 1 - np.argmax(out[:, ::-1], axis=1)
    pick = np.arange(len(at))
    before, after = excess[pick, at], excess[pick, at + 1]
    gripper, finger, period = np.nonzero(doubtful)
    fall = np.where(before > after, before - after, 1.0)
    when = (period * points + at + before / fall) * trial.plant_step
    found = np.where(last == trial.periods, np.inf, 0.0)
    some = out.any(axis=1)
    np.maximum.at(found, (gripper[some], finger[some]), when[some])
    return found
