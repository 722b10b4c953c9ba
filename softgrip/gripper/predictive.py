"""Model predictive control of fingers on one pump that answer late, within the motor's limit.

Two parts. A stationary Kalman filter on the delayed model finds pump, angles and rates from noisy
angles; the commands on their way are known, so what they will yet do is predicted exactly: the
filter and the model integrated over the delay are the *state predictor*. Then the commands of the
next two seconds or so are those of a quadratic program: fingers near their targets, near each
other, few changes, each command within the limit. The Hessian is fixed, so that a step costs a few
products and one small program in a box.

Fingers that are not quite those of the model rest elsewhere than it expects. The filter takes what
all are off for the pump's place, and what they are off each other for offsets of their own, both of
which wander slowly: as many as angles are measured, so that at rest nothing is left to explain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, final

import numpy as np
import scipy
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, read_only
from softgrip.checks import check_fields, samples
from softgrip.errors import InvalidInputError
from softgrip.gripper.box_program import BoxPrograms
from softgrip.gripper.delayed_plant import (
    DelayedGripper,
    DelayedModel,
    delayed_model,
    held_finger,
)
from softgrip.gripper.internal_model import PERIOD
from softgrip.units import DEG

if TYPE_CHECKING:
    import casadi

SOLVER = "daqp"
"""Of the small programs, by CasADi's name: an active set, exact, and the fastest of its wheel."""


@final
@dataclass(frozen=True)
class Weights:
    """What the predictive controller weighs, and how it trusts its model; all > 0.

    Attributes:
        horizon: s that are looked ahead once the delay has passed.
        together: Square of the differences of the fingers over that of their errors, both as shares
            of their targets.
        smooth: Square of the change of a command as a share of the limit.
        noise: Root mean square of a measured angle, rad.
        pump_wander: Of the pump's place in a period, as a share of what the limit moves in it.
        rate_wander: Of a finger's rate in a period, as a share of its target a second.
        offset_wander: Of a finger's own offset in a period, as a share of its target.
    """

    horizon: float = 2.0
    together: float = 100.0
    smooth: float = 0.1
    noise: float = 2 * DEG
    pump_wander: float = 0.01
    rate_wander: float = 0.1
    offset_wander: float = 0.01

    def __post_init__(self) -> None:
        check_fields(self)


@final
@dataclass(frozen=True)
class PredictiveLaw:
    """A designed controller: a filter, and a program whose linear part follows from its state.

    Attributes:
        model: Inside, of `with_offsets`.
        correct: The filter's gain: ``x = predicted + correct (y - C predicted)``, (n, fingers).
        H: Of the program in commands as shares of the limit, shape (moves, moves).
        by_state, constant: Its linear part is ``by_state x + constant``, (moves, n) and (moves,).
        target: rad, shape (fingers,).
        limit: Of the command.
    """

    model: DelayedModel
    correct: Floats
    H: Floats
    by_state: Floats
    constant: Floats
    target: Floats
    limit: float


def with_offsets(plant: DelayedGripper, model: DelayedModel, target: ArrayLike) -> DelayedModel:
    """Return a model whose fingers have constant offsets from each other as further, last states.

    They are one less than the fingers, as shares of the targets, and add up to none over them: what
    is common to all cannot be told from the pump's place.

    Args:
        plant, model: The fingers, and their `delayed_model`.
        target: rad, shape (fingers,).
    """
    count, size = model.fingers, len(model.A)
    apart = _unlike(count)
    A = scipy.linalg.block_diag(model.A, np.eye(count - 1))
    for k, (finger, goal) in enumerate(zip(plant.gripper.fingers, np.ravel(target), strict=True)):
        holds = finger.stiffness * goal / finger.gain
        A[1 + 2 * k : 3 + 2 * k, size:] = np.outer(
            held_finger(finger, model.period)[:2, 2] * holds, apart[k]
        )
    return DelayedModel(
        read_only(A),
        read_only(np.pad(model.B, (0, count - 1))),
        read_only(np.pad(model.C, ((0, 0), (0, count - 1)))),
        count,
        model.commands,
        model.period,
    )


def state_filter(
    model: DelayedModel,
    *,
    noise: float,
    pump_wander: float,
    rate_wander: ArrayLike,
    offset_wander: float,
) -> Floats:
    """Return the stationary Kalman gain of a model `with_offsets`, shape (n, fingers).

    Args:
        model: The commands on their way are known exactly.
        noise: Root mean square of a measured angle, rad, > 0.
        pump_wander: Of the pump in a period, unit of the command times s, > 0: leaks, and a gain
            that is not the model's, show as this.
        rate_wander: Of each finger's rate over gain in a period, shape (fingers,) or (), > 0.
        offset_wander: Of an offset in a period, > 0.
    """
    check_positive(noise=noise, pump_wander=pump_wander, offset_wander=offset_wander)
    spread = np.zeros(len(model.A))
    spread[0] = pump_wander**2
    spread[2 : model.last_command : 2] = np.asarray(rate_wander) ** 2
    spread[model.last_command + model.commands :] = offset_wander**2
    R = noise**2 * np.eye(model.fingers)
    P = scipy.linalg.solve_discrete_are(model.A.T, model.C.T, np.diag(spread), R)
    return np.asarray(P @ model.C.T @ np.linalg.inv(model.C @ P @ model.C.T + R))


def predictive_law(
    plant: DelayedGripper,
    target: ArrayLike,
    *,
    limit: float,
    period: float = PERIOD,
    weights: Weights | None = None,
    commands: int = 1,
    widths: Sequence[int] | None = None,
) -> PredictiveLaw:
    """Design the controller.

    Args:
        plant: The fingers as they are taken to be.
        target: rad, shape (fingers,), none 0, along the direction that one pump can hold.
        limit: Largest absolute command, > 0.
        period: Time between commands, s, > 0.
        weights: `Weights`; None for the usual ones.
        commands: As of `delayed_model`.
        widths: For how many periods each move is held; None for short ones at first, then longer.

    Raises:
        InvalidInputError: If a number is outside its range.
    """
    check_positive(limit=limit, period=period)
    own = Weights() if weights is None else weights
    goal = np.asarray(target, dtype=np.float64)
    if goal.shape != (len(plant.delays),) or not (np.isfinite(goal) & (goal != 0)).all():
        raise InvalidInputError("target", expected="an angle of each finger, none 0", got=target)
    model = with_offsets(plant, delayed_model(plant, period, commands=commands), goal)
    gains = np.array([finger.gain for finger in plant.gripper.fingers])
    correct = state_filter(
        model,
        noise=own.noise,
        pump_wander=own.pump_wander * limit * period,
        rate_wander=own.rate_wander * period * np.abs(goal) / gains,
        offset_wander=own.offset_wander,
    )
    if widths is None:
        widths = _widths(round(own.horizon / period))
    steps = sum(widths) + model.commands
    free, forced = _answers(model, goal, steps)
    # Commands after the last move are its own: the block's columns added up.
    edges = np.cumsum([0, *widths])
    blocks = np.stack([forced[..., a:b].sum(axis=-1) for a, b in pairwise(edges.tolist())], -1)
    blocks[..., -1] += forced[..., edges[-1] :].sum(axis=-1)
    blocks *= limit
    count = model.fingers
    unit = np.eye(count)
    apart = own.together * (unit - 1 / count)
    change = np.eye(len(widths)) - np.eye(len(widths), k=-1)
    near, close = (np.einsum("kim,ij->kjm", blocks, Q / count) for Q in (unit, apart))
    H = np.einsum("kim,kin->mn", near + close, blocks) + own.smooth * change.T @ change
    # What offsets keep the fingers apart no command can help: to fight it would move the mean.
    helped = free.copy()
    helped[..., model.last_command + model.commands :] -= _unlike(count)
    by_state = np.einsum("kim,kin->mn", near, free) + np.einsum("kim,kin->mn", close, helped)
    by_state[0, model.last_command] -= own.smooth / limit
    constant = -near.sum(axis=(0, 1))
    scale = 1 / np.trace(H)
    return PredictiveLaw(
        model,
        read_only(correct),
        read_only(scale * (H + H.T) / 2),
        read_only(scale * by_state),
        read_only(scale * constant),
        read_only(goal),
        limit,
    )


def _unlike(count: int) -> Floats:
    """Return directions of so many shares that leave their mean, (count, count - 1)."""
    return np.asarray(scipy.linalg.null_space(np.ones((1, count))))


def _widths(periods: int) -> list[int]:
    """Return for how many periods each move is held: one each at first, then longer."""
    found: list[int] = []
    while sum(found) < periods:
        width = 1 if len(found) < 6 else 2 if len(found) < 9 else 4
        found.append(min(width, periods - sum(found)))
    return found


def _answers(model: DelayedModel, goal: Floats, steps: int) -> tuple[Floats, Floats]:
    """Return shares of the target after 1, 2, ... periods: by the state, and by each command.

    Shapes (steps, fingers, n) and (steps, fingers, steps).
    """
    rows, free, pulse = model.C / goal[:, None], [], []
    for _ in range(steps):
        pulse.append(rows @ model.B)
        rows = rows @ model.A
        free.append(rows)
    forced = np.zeros((steps, model.fingers, steps))
    for k in range(steps):
        for j in range(k + 1):
            forced[k, :, j] = pulse[k - j]
    return np.array(free), forced


@final
class PredictiveController:
    """The predictive controller for one run or a batch of runs; a `RigController`.

    One run's program is solved by an active set in CasADi, a batch's by `BoxPrograms`.

    Args:
        law: Of `predictive_law`.
        digits: Decimals to which the command is given; None for all.

    >>> from softgrip.gripper.plant import PRINTED
    >>> plant = DelayedGripper(PRINTED, (0.2, 0.2))
    >>> loop = PredictiveController(predictive_law(plant, [0.76, 0.9], limit=2.0))
    >>> loop.update([0.0, 0.0]).round(3).item()  # the limit, at first
    2.0
    """

    def __init__(self, law: PredictiveLaw, *, digits: int | None = None) -> None:
        self.law, self.digits = law, digits
        self._program = _casadi_program(law.H)
        self._many = BoxPrograms.of(law.H)
        self.reset()

    def reset(self) -> None:
        """Forget the past: at rest at an angle of 0."""
        self._predicted: Floats = np.zeros(len(self.law.model.A))
        self._moves: casadi.DM | None = None
        self._start: tuple[Floats, Floats] | None = None

    def update(self, measured: ArrayLike) -> Floats:
        """Return the command for the next period.

        Args:
            measured: Angles, rad, shape (fingers,) or (fingers, runs).

        Returns:
            ndarray: Within the limit, shape () or (runs,).

        Raises:
            NotFiniteError: If an angle is NaN or infinite; the filter is as before.
            InvalidInputError: If there are more or fewer fingers.
        """
        (y,) = samples(measured=measured)
        law, model = self.law, self.law.model
        if y.ndim not in (1, 2) or len(y) != model.fingers:
            raise InvalidInputError(
                "measured", expected=f"shape ({model.fingers},) or (fingers, runs)", got=y.shape
            )
        if y.shape[1:] == (1,):
            return self.update(y[:, 0])[None]
        before = self._predicted
        if y.ndim == 2 and before.ndim == 1:
            before = np.broadcast_to(before[:, None], (len(before), y.shape[1]))
        now = before + law.correct @ (y - model.C @ before)
        g = law.by_state @ now + (law.constant if y.ndim == 1 else law.constant[:, None])
        first = self._one(g) if y.ndim == 1 else self._of_runs(g)
        command = np.clip(law.limit * first, -law.limit, law.limit)
        if self.digits is not None:
            command = np.round(command, self.digits)
        self._predicted = model.A @ now + np.multiply.outer(model.B, command)
        return np.asarray(command)

    def _one(self, g: Floats) -> Floats:
        start = {} if self._moves is None else {"x0": self._moves}
        found = self._program(h=self.law.H, g=g, lbx=-1, ubx=1, **start)["x"]
        self._moves = found
        return np.asarray(float(found[0]))

    def _of_runs(self, g: Floats) -> Floats:
        moves, lasting = self._many.solve(g.T, self._start)
        self._start = moves, lasting
        return moves[:, 0]


def _casadi_program(H: Floats) -> casadi.Function:
    import casadi

    shape = {"h": casadi.DM(H).sparsity(), "a": casadi.Sparsity(0, len(H))}
    return casadi.conic("moves", SOLVER, shape)
