"""The simulated grasp of Section 2.4: gripper, object and force layer, as a plant of the loop."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.control.loop import run_loop
from softgrip.control.pid import PERIOD, Gains
from softgrip.simulator.chance import streams
from softgrip.simulator.fitted_rigs import fitted_layer
from softgrip.simulator.force_layer import layer_voltage, read_counts
from softgrip.simulator.pad_gripper import GraspGripper, Squeeze, servo_position
from softgrip.tactile.force_control import Command, ForceController


class PadGrasp:
    """A gripper that closes on an object, for a batch of runs; command m, measurement N.

    Args:
        squeeze: How the force rises.
        gripper: The gripper, open at position 0.
        told: What force the pad says for each count of its converter, N, shape (counts,).
        samples: Most measurements that will be taken.
        runs, seed: Number of grasps, and of chance: what part of the force the layer feels in each,
            and noise.

    Attributes:
        force: True contact forces after each measurement so far, N, a list of shape (runs,) each.
    """

    def __init__(
        self,
        squeeze: Squeeze,
        gripper: GraspGripper,
        told: Floats,
        *,
        samples: int,
        runs: int,
        seed: int,
    ) -> None:
        self._squeeze, self._gripper, self._told = squeeze, gripper, told
        self._layer = fitted_layer()
        chance = [streams(seed, run) for run in range(runs)]
        drawn = np.array([own.standard_normal() for own, _ in chance])
        self._felt_part = np.exp(self._layer.object_seating * drawn)
        self._noise = iter(np.stack([noise.standard_normal(samples) for _, noise in chance], -1))
        self._position = np.zeros(runs)
        self._lagged = np.zeros((len(self._layer.lag), runs))
        self.force: list[Floats] = []

    def advance(self, command: ArrayLike, duration: float) -> Floats:
        """Hold a position, m, for a time, s, and return the force that the pad then says, N."""
        step, layer = self._gripper.resolution, self._layer
        before = self._squeeze.at(self._position - self._gripper.opening)
        target = np.rint(np.asarray(command) / step) * step
        self._position = servo_position(self._position, target, duration, self._gripper)
        force = self._squeeze.at(self._position - self._gripper.opening)
        # The lags of `force_layer.felt_force`, sample by sample.
        kept = np.exp(-duration / np.array(layer.lag))[:, None]
        self._lagged = kept * self._lagged + (1 - kept) * before
        felt = (1 - sum(layer.memory)) * force + np.array(layer.memory) @ self._lagged
        voltage = layer_voltage(self._felt_part * felt, 0.0, layer)
        self.force.append(force)
        return np.asarray(self._told[read_counts(voltage, next(self._noise), layer)])


@dataclass(frozen=True, eq=False)
class GraspRecord:
    """What happened in a batch of grasps.

    Attributes:
        time: s, shape (samples,).
        desired: Contact force, N.
        measured, force: What the pad says and what the force is, N, shape (runs, samples).
    """

    time: Floats
    desired: float
    measured: Floats
    force: Floats


def grasp(
    squeeze: Squeeze,
    gains: Gains,
    desired: float,
    told: Floats,
    *,
    command: Command = "change",
    gripper: GraspGripper | None = None,
    duration: float = 10.0,
    runs: int = 1,
    seed: int = 0,
) -> GraspRecord:
    """Close the gripper on an object under force control.

    Args:
        squeeze: Of the object.
        gains, command: As of `ForceController`.
        desired: Contact force, N.
        told: As of `PadGrasp`.
        gripper: None for `GraspGripper`.
        duration: s.
        runs, seed: As of `PadGrasp`.
    """
    gripper = gripper or GraspGripper()
    samples = round(duration / PERIOD) + 2
    plant = PadGrasp(squeeze, gripper, told, samples=samples, runs=runs, seed=seed)
    result = run_loop(
        plant,
        ForceController(gains, command, speed=gripper.speed),
        desired,
        duration=duration,
        delay_samples=gripper.delay,
    )
    true = np.stack(plant.force[: result.time.size], axis=-1)
    return GraspRecord(result.time, desired, result.measured, true)
