"""The control of one finger in Chapters 3 and 4 on many rigs: regulator, PIDs, staircase."""

from functools import partial
from math import acos, acosh

import numpy as np

from softgrip.arrays import Floats
from softgrip.control.designs import linear_loop
from softgrip.control.differentiator import RobustDifferentiator
from softgrip.control.loop import SPEED_LIMIT, Controller
from softgrip.control.lqr import FINGER, Weights, input_gain, lqr_gain
from softgrip.control.pid import PERIOD, PID, Gains
from softgrip.control.pressure_command import SET_PRESSURE, PressureAsSpeed
from softgrip.control.rig_controller import RigController, Tracking
from softgrip.control.staircase import HOLD, staircase
from softgrip.control.state_feedback import StateFeedback
from softgrip.control.step_metrics import final_value, settling_time
from softgrip.control.ziegler_nichols import ReactionCurve, ziegler_nichols
from softgrip.dynamics.second_order import SecondOrder, free_motion, full_state_space, state_space
from softgrip.logs.staircase import lag
from softgrip.logs.steps import END, WINDOW, smoothed
from softgrip.twin import rigs
from softgrip.twin.experiments import closed_loop
from softgrip.twin.laboratory import Laboratory
from softgrip.twin.step_tests import Measures
from softgrip.units import DEG

DURATION = 20.0
"""Of a controlled step, s."""
PIDS = ("actuator", "full")


def actuator_curve(finger: SecondOrder) -> ReactionCurve:
    """Return the tangent at the inflexion of a finger's step response, in closed form."""
    w, z = finger.natural_frequency, finger.damping_ratio
    away = abs(1 - z * z) ** 0.5
    time = (acos(z) if z < 1 else acosh(z)) / (away * w) if away > 1e-9 else 1 / w
    c, s = (float(part) for part in free_motion(time, w, z))
    slope = finger.gain * w * w * s
    level = finger.gain * (1 - c - z * w * s)
    return ReactionCurve(time - level / slope, slope, finger.gain)


def full_curve(finger: SecondOrder, pump_gain: float) -> ReactionCurve:
    """Return the asymptote of the step response of pump and finger, in closed form."""
    return ReactionCurve(
        2 * finger.damping_ratio / finger.natural_frequency, finger.gain * pump_gain
    )


def models(lab: Laboratory) -> list[tuple[SecondOrder, float]]:
    """Return finger and pump gain that each laboratory identified.

    Where one identified none, any serves: what follows is not told, see `_told`.
    """
    columns = (*vars(lab.finger).values(), lab.pump_gain)
    rows = zip(*(np.where(lab.known, x, 1.0).tolist() for x in columns), strict=True)
    return [(SecondOrder(w, z, k), pump_gain) for w, z, k, pump_gain in rows]


def _told(lab: Laboratory, found: Measures) -> Measures:
    """Return measures, NaN where no model was identified."""
    return {name: np.where(lab.known, values, np.nan) for name, values in found.items()}


def pid_gains(lab: Laboratory, design: str) -> list[Gains]:
    """Return the gains of a PID: those of Ziegler and Nichols, times what trial and error chose.

    Args:
        lab: With models that were identified.
        design: One of `PIDS`.
    """
    found = []
    for k, (finger, pump_gain) in enumerate(models(lab)):
        curve = actuator_curve(finger) if design == "actuator" else full_curve(finger, pump_gain)
        rule = ziegler_nichols(curve)
        kp, ki, kd = (
            getattr(rule, name) * float(lab[f"choice.{design}_{name}"][k])
            for name in ("kp", "ki", "kd")
        )
        found.append(Gains(kp, ki, kd, rule.derivative_filter))
    return found


def _pid(gains: Gains, design: str) -> Controller:
    if design == "full":
        return PID(gains, limits=(-SPEED_LIMIT, SPEED_LIMIT))
    return PressureAsSpeed(PID(gains, limits=(-SET_PRESSURE, SET_PRESSURE)))


def _followed(make: partial[Controller], reference: Floats | float) -> RigController:
    return Tracking(make(), reference)


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


def _step(lab: Laboratory, makers: list[partial[Controller]], step: str, band: str) -> Measures:
    """Run a step, and return when it settles, s, and the size of what error is left, deg."""
    target = lab[step] * DEG
    made = closed_loop(
        lab.rigs(rigs.design_1),
        [partial(_followed, m, float(t)) for m, t in zip(makers, target, strict=True)],
        DURATION,
    )
    angle = made.angle[:, 0, 0]
    left = np.abs(target - final_value(made.time, angle, window=END))
    settling = settled(made.time, angle, target, lab[band] * DEG)
    return _told(lab, {"settling": settling, "error": left / DEG})


def _regulator(finger: SecondOrder, pump_gain: float, jerk: float) -> Controller:
    # The printed frequency and damping; the static gain is the constant obtained by experiment.
    known = SecondOrder(FINGER.natural_frequency, FINGER.damping_ratio, finger.gain)
    gain = input_gain(known, pump_gain, SPEED_LIMIT)
    return StateFeedback(lqr_gain(FINGER, Weights()), gain, RobustDifferentiator(jerk))


def regulator(lab: Laboratory) -> Measures:
    """Return settling time, s, and error, % of the step, of the regulator of Figure 3.12."""
    makers = [
        partial(_regulator, finger, pump_gain, float(jerk))
        for (finger, pump_gain), jerk in zip(models(lab), lab["choice.lqr_jerk"], strict=True)
    ]
    found = _step(lab, makers, "choice.lqr_step", "choice.lqr_band")
    return {**found, "error": 100 * found["error"] / lab["choice.lqr_step"]}


def pid(lab: Laboratory) -> Measures:
    """Return settling time, s, and error, deg, of the two PIDs of Figure 4.5 on the rig."""
    found: Measures = {}
    for design in PIDS:
        makers = [partial(_pid, gains, design) for gains in pid_gains(lab, design)]
        step = _step(lab, makers, "choice.pid_step", "choice.pid_band")
        found |= {f"{name}-{design}": value for name, value in step.items()}
    return found


def pid_on_models(lab: Laboratory) -> Measures:
    """Return the settling times of the two PIDs on the models that they were designed on, s."""
    found: Measures = {}
    step = lab["choice.pid_step"] * DEG
    band = step * lab["choice.model_band"] / 100
    for design in PIDS:
        angles = []
        alone = design == "actuator"
        limit = SET_PRESSURE if alone else SPEED_LIMIT
        designed = zip(models(lab), pid_gains(lab, design), step.tolist(), strict=True)
        for (finger, pump_gain), gains, size in designed:
            system = state_space(finger) if alone else full_state_space(finger, pump_gain)
            made = linear_loop(system, gains, limit, step=size, duration=DURATION)
            angles.append(np.ravel(made.measured))
        found[design] = settled(made.time, np.array(angles), step, band, window=0.0)
    return _told(lab, found)


def tracking(lab: Laboratory) -> Measures:
    """Return the delay of the angle behind the staircase of Figure 4.7, s."""
    increments = lab["choice.stair_increment"] * DEG
    stairs = [
        staircase(increment=float(i), top=6 * float(i), hold=HOLD, period=PERIOD)
        for i in increments
    ]
    makers = [partial(_pid, gains, "full") for gains in pid_gains(lab, "full")]
    made = closed_loop(
        lab.rigs(rigs.design_1),
        [partial(_followed, m, r) for m, r in zip(makers, stairs, strict=True)],
        (stairs[0].size - 1) * PERIOD,
    )
    delays = [lag(r, y, PERIOD) for r, y in zip(stairs, made.angle[:, 0, 0], strict=True)]
    return _told(lab, {"lag": np.array(delays)})


FAST = {
    "regulator": regulator,
    "pid": pid,
    "pid on models": pid_on_models,
    "staircase": tracking,
}
