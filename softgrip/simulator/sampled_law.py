"""The controllers of a rig in one form, which the kernel can run: a linear law within limits.

What is not linear in them is little: the limits, integrals that stop at these, a command that is
rounded, and the robust differentiator, which may stand ahead of the law.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats, Number
from softgrip.control.differentiator import PolynomialDifferentiator, RobustDifferentiator
from softgrip.control.loop import Controller
from softgrip.control.pid import PID
from softgrip.control.pressure_command import PressureAsSpeed
from softgrip.control.rig_controller import CommandSequence, RigController, Tracking
from softgrip.control.state_feedback import SPEED_DIGITS, ObserverFeedback, StateFeedback
from softgrip.errors import InvalidInputError
from softgrip.gripper.internal_model import ControllerMatrices, InternalModelController


@dataclass(frozen=True)
class SampledLaw:
    """A sampled linear controller, of all runs, or with a leading axis of runs in any array.

    Attributes:
        matrices: From measured angles, or what the differentiator makes of their mean, and targets
            to the command: n states, as many inputs, as many targets.
        reference: The targets, one row a period of the controller, the last one held; shape
            (periods, targets). By default 0 for one target.
        start: What each state is of the first measurement before the first update, shape (n,
            inputs); None for 0.
        integral: States that are not moved further where the command is cut and they would push on,
            shape (n,); None for none.
        least, largest: Limits that the law knows, rad/s; numbers or shape (runs,).
        digits: Decimals to which the command is given; None for all.
        jerk: Of a `RobustDifferentiator` that gives angle, rate and acceleration of the mean of the
            measured angles as the law's three inputs, a number or shape (runs,); None for none.
    """

    matrices: ControllerMatrices
    reference: Floats = field(default_factory=lambda: np.zeros((1, 1)))
    start: Floats | None = None
    integral: Floats | None = None
    least: Number = -np.inf
    largest: Number = np.inf
    digits: int | None = None
    jerk: Number | None = None


AXES = {
    "A": 2, "B_measured": 2, "B_target": 2, "B_sent": 1, "C": 1, "D_measured": 1, "D_target": 1,
    "reference": 2, "start": 2, "integral": 1, "least": 0, "largest": 0, "jerk": 0,
}  # fmt: skip
"""Of each array of a law, without that of the runs."""


def of_runs(law: SampledLaw, which: NDArray[np.intp]) -> SampledLaw:
    """Return the law whose runs are some of a law's, or some again; what is of all stays so."""

    def taken(part: SampledLaw | ControllerMatrices) -> dict[str, Any]:
        own: dict[str, Any] = {name: getattr(part, name, None) for name in AXES}
        runs = {name for name, value in own.items() if np.ndim(value) > AXES[name]}
        return {name: own[name][which] for name in runs if len(own[name]) > 1}

    return replace(law, matrices=replace(law.matrices, **taken(law.matrices)), **taken(law))


def command_law(commands: ArrayLike, fingers: int) -> SampledLaw:
    """Return the law that looks at nothing: commands [rad/s], shape (periods,) or (runs, periods).

    After them the motor rests.
    """
    sequence = np.asarray(commands, dtype=np.float64)
    rest = np.zeros((*sequence.shape[:-1], 1))
    followed = np.concatenate([sequence, rest], axis=-1)[..., None]
    return SampledLaw(_static(np.zeros((1, fingers)), np.ones((1, 1)), np.nan), followed)


def sampled_law(controller: RigController, fingers: int) -> SampledLaw:
    """Return a controller, as it is before its first update, in the kernel's form.

    Args:
        controller: A `CommandSequence`, an `InternalModelController`, or `Tracking` with a `PID`,
            that of `PressureAsSpeed`, `StateFeedback` or `ObserverFeedback`.
        fingers: Of the rig, >= 1.

    Raises:
        InvalidInputError: If it is another.
    """
    match controller:
        case CommandSequence():
            return command_law(controller.commands, fingers)
        case InternalModelController():
            return SampledLaw(
                controller.matrices,
                controller.target[None],
                least=-controller.limit,
                largest=controller.limit,
                digits=controller.digits,
            )
        case Tracking():
            law = _of_one_angle(controller.controller)
            law = replace(law, reference=controller.reference[:, None])
            return _of_mean(law, fingers) if law.jerk is None else law
    raise _unknown(controller)


def _unknown(controller: object) -> InvalidInputError:
    return InvalidInputError(
        "controller",
        expected="CommandSequence, InternalModelController, or Tracking with PID, PressureAsSpeed"
        " of a PID, StateFeedback with a known differentiator, or ObserverFeedback",
        got=type(controller).__name__,
    )


def _of_one_angle(controller: Controller) -> SampledLaw:
    match controller:
        case PID():
            return _pid(controller)
        case PressureAsSpeed(controller=PID() as pid):
            return _pid(pid, controller.speed_per_pressure)
        case StateFeedback(differentiator=RobustDifferentiator() as found):
            return replace(_feedback(controller, found.period), jerk=found.jerk)
        case StateFeedback(differentiator=PolynomialDifferentiator() as found):
            return _fitted(controller, found)
        case ObserverFeedback():
            return _observer(controller)
    raise _unknown(controller)


def _of_mean(law: SampledLaw, fingers: int) -> SampledLaw:
    """Return a law of one angle as one of the mean of several."""
    m, each = law.matrices, np.full((1, fingers), 1 / fingers)
    matrices = replace(
        m, B_measured=m.B_measured @ each, D_measured=(m.D_measured[..., None] @ each)[..., 0, :]
    )
    return replace(law, matrices=matrices, start=None if law.start is None else law.start @ each)


def _static(D_measured: Floats, D_target: Floats, period: float) -> ControllerMatrices:
    """Return a law without states; arrays of shape (runs, inputs) and (runs, targets)."""
    return ControllerMatrices(
        np.zeros((0, 0)),
        np.zeros((0, D_measured.shape[-1])),
        np.zeros((0, D_target.shape[-1])),
        np.zeros(0),
        np.zeros(0),
        D_measured,
        D_target,
        period,
    )


def _pid(pid: PID, scale: float = 1.0) -> SampledLaw:
    """Return a PID whose command goes on times `scale`.

    The states are the integral, and what the filter of the derivative d keeps of the signal s that
    it differentiates: ``z = tau d - kd s``, so that ``d = (z + kd s) / (tau + h)``.
    """
    g, h = pid.gains, pid.period
    gains = np.broadcast_arrays(g.kp, g.ki, g.kd, g.derivative_filter)
    kp, ki, kd, tau = (np.atleast_1d(np.asarray(gain, dtype=np.float64)) for gain in gains)
    kp, ki, kd = scale * kp, scale * ki, scale * kd
    zero, one, slow = np.zeros_like(kp), np.ones_like(kp), tau + h
    on_error = pid.derivative_on == "error"
    now, quick = kp + ki * h, kd / slow
    B_target = _columns([ki * h], [-quick * h if on_error else zero])
    return SampledLaw(
        ControllerMatrices(
            A=_columns([one, zero], [zero, tau / slow]),
            B_measured=_columns([-ki * h], [quick * h]),
            B_target=B_target,
            B_sent=np.zeros(2),
            C=_columns([one, 1 / slow])[:, 0],
            D_measured=-(now + quick)[:, None],
            D_target=(now + quick if on_error else now)[:, None],
            period=h,
        ),
        # Its signal was 0 before the first update, or what it is then.
        start=None if on_error else _columns([zero], [kd]),
        integral=np.array([1.0, 0.0]) if pid.anti_windup else None,
        least=scale * pid.limits[0],
        largest=scale * pid.limits[1],
    )


def _columns(*rows: list[Floats]) -> Floats:
    """Return a matrix of each run, shape (runs, rows, columns), from its elements' values."""
    return np.moveaxis(np.array(rows), -1, 0)


def _feedback(controller: StateFeedback, period: float) -> SampledLaw:
    """Return the law of angle, rate and acceleration."""
    K = controller.speed_gain.reshape(3, -1).T
    return SampledLaw(_static(-K, K[:, :1], period), digits=SPEED_DIGITS)


def _fitted(controller: StateFeedback, fit: PolynomialDifferentiator) -> SampledLaw:
    """Return the law of a fit; the states are the samples before this one, the oldest first."""
    law = _feedback(controller, fit.period)
    weights = law.matrices.D_measured @ fit.rows
    kept = fit.rows.shape[1] - 1
    matrices = replace(
        law.matrices,
        A=np.eye(kept, k=1),
        B_measured=np.eye(kept)[:, -1:],
        B_target=np.zeros((kept, 1)),
        B_sent=np.zeros(kept),
        C=weights[:, :-1],
        D_measured=weights[:, -1:],
    )
    return replace(law, matrices=matrices, start=np.ones((kept, 1)))


def _observer(controller: ObserverFeedback) -> SampledLaw:
    """Return the law whose states are the prediction."""
    K = controller.gain.reshape(3, -1).T
    speed, limit = controller.set_speed, controller.set_speed * controller.limit
    seen = np.eye(3) - controller.correct @ [[controller.input_gain, 0.0, 0.0]]
    return SampledLaw(
        ControllerMatrices(
            A=controller.step @ seen,
            B_measured=controller.step @ controller.correct,
            B_target=np.zeros((3, 1)),
            B_sent=controller.drive[:, 0] / speed,
            C=-speed * K @ seen,
            D_measured=-speed * K @ controller.correct,
            D_target=speed / controller.input_gain * K[:, :1],
            period=controller.period,
        ),
        least=-limit,
        largest=limit,
        digits=SPEED_DIGITS,
    )
