"""Regulators on their own linear model with the motor's limit: what weights do within 5 rev/s."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import final

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT, LoopResult, run_loop
from softgrip.control.lqr import Weights, derivatives_from_full_state, input_gain, lqr_gain
from softgrip.control.state_feedback import StateFeedback
from softgrip.control.state_space_plant import StateSpacePlant
from softgrip.control.step_metrics import settling_time
from softgrip.dynamics.second_order import SecondOrder, full_state_space

TRIED = tuple(
    Weights(p=float(10**power), q=(1.0, q2, 0.0))
    for power, q2 in product(np.arange(1, 6.1, 0.25), (0.0, 0.003, 0.01, 0.03, 0.1, 0.3))
)
"""The weights among which `best_within_limit` looks."""


@dataclass(frozen=True)
class BestWeights:
    """The weights of `TRIED` that settle first, and when, s."""

    weights: Weights
    time: float


@final
class TrueStates:
    """In place of a differentiator: the derivatives that a linear plant really has.

    Args:
        plant: The plant of the loop.
        to_derivatives: Matrix from its states to angle, rate and acceleration, shape (3, 3).
    """

    def __init__(self, plant: StateSpacePlant, to_derivatives: Floats) -> None:
        self.plant, self.to_derivatives = plant, to_derivatives

    def update(self, measurement: ArrayLike) -> Floats:  # noqa: ARG002
        """Return angle, rate and acceleration now, whatever was measured."""
        return np.asarray(self.to_derivatives @ self.plant.state)


def limited_loop(
    finger: SecondOrder,
    pump_gain: float,
    gain: ArrayLike,
    step: ArrayLike,
    *,
    duration: float = 6.0,
    limit: float = SPEED_LIMIT,
) -> LoopResult:
    """Run a regulator on its own linear model, with true states and a limited motor.

    Args:
        finger, pump_gain: Model, with the finger's static gain; Pa/s per rad/s.
        gain: K of `lqr.lqr_gain`, shape (3,), or (3, runs) for a map of gains.
        step: rad, a number or shape (runs,).
        duration: s.
        limit: Largest motor speed, rad/s, > 0; infinity for none.
    """
    target = np.asarray(step, dtype=np.float64)
    runs = np.broadcast_shapes(np.shape(gain)[1:], target.shape)
    plant = StateSpacePlant(full_state_space(finger, pump_gain), initial=np.zeros((3, *runs)))
    scale = input_gain(finger, pump_gain, SPEED_LIMIT)
    states = TrueStates(plant, derivatives_from_full_state(finger))
    regulator = StateFeedback(gain, scale, states)
    return run_loop(plant, regulator, lambda _: target, duration=duration, limit=limit)


def best_within_limit(
    finger: SecondOrder,
    pump_gain: float,
    steps: ArrayLike,
    band: float,
    *,
    tried: Sequence[Weights] = TRIED,
) -> list[BestWeights]:
    """Return the weights that settle a step first within the motor's limit, for each step.

    Args:
        finger, pump_gain: As of `limited_loop`.
        steps: rad, shape (N,), > 0.
        band: Share of the step, 0 to 1.
        tried: The weights to choose from.
    """
    sizes = np.asarray(steps, dtype=np.float64)
    gains = np.stack([lqr_gain(finger, weights) for weights in tried], axis=-1)
    every = np.tile(gains, sizes.size), np.repeat(sizes, len(tried))
    found = limited_loop(finger, pump_gain, *every)
    settled = settling_time(found.time, found.measured, final=every[1], band=band)
    table = settled.reshape(sizes.size, len(tried))
    return [BestWeights(tried[k], float(row[k])) for row in table for k in [int(np.argmin(row))]]
