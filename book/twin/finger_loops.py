"""The control of one finger in Chapters 3 and 4 on many rigs: regulator, PIDs, staircase."""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from book.twin import rigs
from book.twin.experiments import closed_loop
from book.twin.identification import SecondOrders
from book.twin.laboratory import Laboratory
from book.twin.matrix_exponential import matrix_exponential
from book.twin.step_tests import Measures
from softgrip.arrays import Floats, Number
from softgrip.control.differentiator import RobustDifferentiator
from softgrip.control.loop import SPEED_LIMIT, Controller, run_loop
from softgrip.control.lqr import FINGER, Weights, input_gain, lqr_gain
from softgrip.control.pid import PERIOD, PID, Gains
from softgrip.control.pressure_command import SET_PRESSURE, PressureAsSpeed
from softgrip.control.rig_controller import Tracking
from softgrip.control.staircase import HOLD, staircase
from softgrip.control.state_feedback import StateFeedback
from softgrip.control.step_metrics import final_value, settling_time
from softgrip.control.ziegler_nichols import ReactionCurve, ziegler_nichols
from softgrip.dynamics.second_order import free_motion
from softgrip.logs.steps import END, WINDOW, smoothed
from softgrip.simulator.sampled_law import sampled_law
from softgrip.units import DEG

DURATION = 20.0
"""Of a controlled step, s."""
PIDS = ("actuator", "full")
LONGEST = 3.0
"""Largest delay that is tried, s, as of `logs.staircase.lag`."""


def actuator_curve(finger: SecondOrders) -> ReactionCurve:
    """Return the tangents at the inflexion of fingers' step responses, in closed form."""
    w, z = finger.natural_frequency, finger.damping_ratio
    away = np.abs(1 - z * z) ** 0.5
    turned = np.where(z < 1, np.arccos(np.minimum(z, 1.0)), np.arccosh(np.maximum(z, 1.0)))
    time = np.where(away > 1e-9, turned / np.maximum(away, 1e-9), 1.0) / w
    c, s = free_motion(time, w, z)
    slope = finger.gain * w * w * s
    level = finger.gain * (1 - c - z * w * s)
    return ReactionCurve(time - level / slope, slope, finger.gain)


def full_curve(finger: SecondOrders, pump_gain: Number) -> ReactionCurve:
    """Return the asymptote of the step response of pump and finger, in closed form."""
    return ReactionCurve(
        2 * finger.damping_ratio / finger.natural_frequency, finger.gain * pump_gain
    )


def models(lab: Laboratory) -> tuple[SecondOrders, Floats]:
    """Return finger and pump gain that each laboratory identified, shape (rigs,).

    Where one identified none, any serves: what follows is not told, see `_told`.
    """
    known = (*vars(lab.finger).values(), lab.pump_gain)
    w, z, k, pump_gain = (np.where(lab.known, x, 1.0) for x in known)
    return SecondOrders(w, z, k), pump_gain


def _told(lab: Laboratory, found: Measures) -> Measures:
    """Return measures, NaN where no model was identified."""
    return {name: np.where(lab.known, values, np.nan) for name, values in found.items()}


def pid_gains(lab: Laboratory, design: str) -> Gains:
    """Return the gains of a PID: those of Ziegler and Nichols, times what trial and error chose.

    Args:
        lab: With models that were identified.
        design: One of `PIDS`.
    """
    finger, pump_gain = models(lab)
    curve = actuator_curve(finger) if design == "actuator" else full_curve(finger, pump_gain)
    rule = ziegler_nichols(curve)
    own = {n: getattr(rule, n) * lab[f"choice.{design}_{n}"] for n in ("kp", "ki", "kd")}
    return replace(rule, **own)


def _pid(lab: Laboratory, design: str) -> Controller:
    gains = pid_gains(lab, design)
    if design == "full":
        return PID(gains, limits=(-SPEED_LIMIT, SPEED_LIMIT))
    return PressureAsSpeed(PID(gains, limits=(-SET_PRESSURE, SET_PRESSURE)))


def _followed(
    lab: Laboratory, controller: Controller, reference: Floats, duration: float
) -> tuple[Floats, Floats]:
    """Return time and measured angle of controllers that follow references, (rigs, periods)."""
    law = replace(sampled_law(Tracking(controller, 0.0), 1), reference=reference[..., None])
    made = closed_loop(
        rigs.design_1(lab.values), law, duration, keep=("angle",), compiled=lab.compiled
    )
    return made.time, made.angle[:, 0, 0]


def settled(
    time: Floats, angle: Floats, target: Floats, band: Floats, *, window: float = WINDOW
) -> Floats:
    """Return when angles stay within bands about their targets, s; as `logs.steps.judge_step`.

    Args:
        time: s, shape (N,).
        angle: rad, shape (rigs, N).
        target, band: rad, shape (rigs,).
        window: Of the averaging, s.

    Returns:
        Floats: Shape (rigs,); infinite within the last seconds, which are too short for rest.
    """
    mean = smoothed(angle, PERIOD, window=window)
    found = settling_time(time, mean / band[:, None], final=target / band, band=1.0, absolute=True)
    return np.where(found > time[-1] - END, np.inf, found)


def responses(lab: Laboratory) -> dict[str, tuple[Floats, Floats]]:
    """Return time, s, and angles, rad, (rigs, N), of regulator, PIDs and staircase, by name."""
    controllers = {"lqr": _regulator(lab)} | {f"pid-{name}": _pid(lab, name) for name in PIDS}
    found = {}
    for name, controller in controllers.items():
        step = lab[f"choice.{name.partition('-')[0]}_step"] * DEG
        found[name] = _followed(lab, controller, step[:, None], DURATION)
    stairs = stairs_of(lab)
    return found | {"staircase": _followed(lab, _pid(lab, "full"), stairs, _length(stairs))}


def _step(lab: Laboratory, controller: Controller, step: str, band: str) -> Measures:
    """Run a step, and return when it settles, s, and the size of what error is left, deg."""
    target = lab[step] * DEG
    time, angle = _followed(lab, controller, target[:, None], DURATION)
    left = np.abs(target - final_value(time, angle, window=END))
    settling = settled(time, angle, target, lab[band] * DEG)
    return _told(lab, {"settling": settling, "error": left / DEG})


def _regulator(lab: Laboratory) -> Controller:
    finger, pump_gain = models(lab)
    # The printed frequency and damping; the static gain is the constant obtained by experiment.
    plant = finger.gain * pump_gain * input_gain(FINGER, 1.0, SPEED_LIMIT)
    gain = np.repeat(lqr_gain(FINGER, Weights())[:, None], lab.count, axis=1)
    return StateFeedback(gain, plant, RobustDifferentiator(lab["choice.lqr_jerk"]))


def regulator(lab: Laboratory) -> Measures:
    """Return settling time, s, and error, % of the step, of the regulator of Figure 3.12."""
    found = _step(lab, _regulator(lab), "choice.lqr_step", "choice.lqr_band")
    return {**found, "error": 100 * found["error"] / lab["choice.lqr_step"]}


def pid(lab: Laboratory) -> Measures:
    """Return settling time, s, and error, deg, of the two PIDs of Figure 4.5 on the rig."""
    found: Measures = {}
    for design in PIDS:
        step = _step(lab, _pid(lab, design), "choice.pid_step", "choice.pid_band")
        found |= {f"{name}-{design}": value for name, value in step.items()}
    return found


class Models:
    """The linear models of Eq. (4.14) or (4.15) of many rigs, exact for a held command.

    Args:
        finger: Parameters of shape (rigs,).
        pump_gain: Pa/s per rad/s, shape (rigs,); None for a finger whose command is a pressure.
    """

    def __init__(self, finger: SecondOrders, pump_gain: Floats | None) -> None:
        w, zero, one = (
            finger.natural_frequency,
            np.zeros_like(finger.gain),
            np.ones_like(finger.gain),
        )
        rows = [
            [zero, zero, zero, zero if pump_gain is None else pump_gain],
            [zero, zero, one, zero],
            [finger.gain * w**2, -(w**2), -2 * finger.damping_ratio * w, zero],
            [zero] * 4,
        ]
        if pump_gain is None:
            # The command is the pressure itself.
            rows = [[zero] * 4, rows[1], [zero, *rows[2][1:3], rows[2][0]], [zero] * 4]
        self._step = matrix_exponential(np.moveaxis(np.array(rows), -1, 0) * PERIOD)[:, :3]
        self._state = np.zeros((len(w), 3))

    def advance(self, command: ArrayLike, duration: float) -> Floats:
        """Hold the command for a period, or none, and return the angles, rad, shape (rigs,)."""
        if duration:
            moved = np.einsum("rij,rj->ri", self._step[..., :3], self._state)
            self._state = moved + self._step[..., 3] * np.asarray(command)[:, None]
        return np.asarray(self._state[:, 1])


def pid_on_models(lab: Laboratory) -> Measures:
    """Return the settling times of the two PIDs on the models that they were designed on, s."""
    found: Measures = {}
    step = lab["choice.pid_step"] * DEG
    band = step * lab["choice.model_band"] / 100
    reference = np.repeat(step[:, None], round(DURATION / PERIOD) + 1, axis=1)
    finger, pump_gain = models(lab)
    for design in PIDS:
        alone = design == "actuator"
        limit = SET_PRESSURE if alone else SPEED_LIMIT
        plant = Models(finger, None if alone else pump_gain)
        controller = PID(pid_gains(lab, design), limits=(-limit, limit))
        made = run_loop(plant, controller, reference, duration=DURATION, limit=limit)
        found[design] = settled(made.time, made.measured, step, band, window=0.0)
    return _told(lab, found)


def lags(reference: Floats, angle: Floats) -> Floats:
    """Return the delays, s, of the largest correlation with a reference; as `logs.staircase.lag`.

    Args:
        reference: Of all rigs, up to a factor, shape (N,).
        angle: rad, shape (rigs, N).
    """
    size, most = reference.size, round(LONGEST / PERIOD)
    delayed = np.zeros((most + 1, size))
    for k, row in enumerate(delayed):
        row[k:] = reference[: size - k] - reference[: size - k].mean()
    y = angle - angle.mean(axis=1, keepdims=True)
    # What of a record is left after a delay: its mean and its sum of squares.
    left = size - np.arange(most + 1)
    mean, power = (np.cumsum(x[:, ::-1], axis=1)[:, left - 1] for x in (y, y * y))
    along = y @ delayed.T / np.sum(delayed**2, axis=1) ** 0.5
    return np.asarray(np.argmax(along / np.sqrt(power - mean**2 / left), axis=1) * PERIOD)


STAIRS = staircase(increment=1.0, top=6.0, hold=HOLD, period=PERIOD)
"""Of one increment each, shape (N,)."""


def stairs_of(lab: Laboratory) -> Floats:
    """Return the staircases of Figure 4.7, rad, shape (rigs, N)."""
    return np.asarray((lab["choice.stair_increment"] * DEG)[:, None] * STAIRS)


def _length(reference: Floats) -> float:
    return float((reference.shape[1] - 1) * PERIOD)


def tracking(lab: Laboratory) -> Measures:
    """Return the delay of the angle behind the staircase of Figure 4.7, s."""
    stairs = stairs_of(lab)
    _, angle = _followed(lab, _pid(lab, "full"), stairs, _length(stairs))
    return _told(lab, {"lag": lags(STAIRS, angle)})


FAST = {
    "regulator": regulator,
    "pid": pid,
    "pid on models": pid_on_models,
    "staircase": tracking,
}
