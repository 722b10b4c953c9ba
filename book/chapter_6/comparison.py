"""Controllers of the gripper side by side: one rig, one limit, many runs."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from book.chapter_6.controllers import (
    feedback_of,
    gripper_controller,
    own_model,
    printed_model,
    target_angles,
)
from book.companion.choices import choice
from softgrip.arrays import Floats
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.rig_controller import RigController
from softgrip.control.step_metrics import final_value, settling_time
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.robustness import tolerated_uncertainty
from softgrip.gripper.synchronization import synchronization_error
from softgrip.reads import remembered
from softgrip.simulator.chance import SEED
from softgrip.simulator.drive import Driven, drive
from softgrip.simulator.fitted_rigs import printed_gripper
from softgrip.simulator.gripper_steps import OPEN_LOOP_DURATION
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG

RUNS = 50
CRITERIA: dict[str, tuple[float, bool]] = {
    "2 %": (0.02, False),
    "5 %": (0.05, False),
    "10 %": (0.10, False),
    "1 deg": (1 * DEG, True),
    "2 deg": (2 * DEG, True),
}
"""Half width of the band about the end of a response, and whether it is in rad."""


def criteria() -> dict[str, tuple[float, bool]]:
    """Return `CRITERIA` and the fitted one, as none is printed."""
    return CRITERIA | {"fitted": (choice("gripper_band"), False)}


ENTRIES: dict[str, Callable[[], RigController]] = {
    "open loop": lambda: gripper_controller("open loop"),
    "optimal feedforward": lambda: gripper_controller("optimal feedforward"),
    "LQR on the mean": lambda: gripper_controller("LQR"),
    "faster LQR": lambda: gripper_controller("LQR faster"),
    "4.8/s": lambda: gripper_controller("4.8/s"),
    "4.8/s, knows limit": lambda: gripper_controller("4.8/s", limit=SPEED_LIMIT),
    "4.8/s, on Eq. (6.26)": lambda: gripper_controller("4.8/s", model=printed_model()),
    "2/s": lambda: gripper_controller("2/s"),
    "2/s, knows limit": lambda: gripper_controller("2/s", limit=SPEED_LIMIT),
    "2/s, on Eq. (6.26)": lambda: gripper_controller("2/s", model=printed_model()),
}
"""What makes each controller; all are cut at the motor's limit, whether they know it or not."""


@dataclass(frozen=True)
class Judged:
    """Measures of a batch, each of shape (runs,), from the true angles.

    Attributes:
        settling: By criterion, s: time after which both fingers stay within a band about their own
            ends.
        overshoot: Larger of the two fingers', share of its own end.
        synchronization: Largest over time, rad; see `synchronization_error`, with the targets.
        error: Larger of the two distances of end and target, rad.
        peak: Largest motor speed, rad/s.
    """

    settling: dict[str, Floats]
    overshoot: Floats
    synchronization: Floats
    error: Floats
    peak: Floats


def judge(run: Driven, targets: Floats) -> Judged:
    """Judge runs of a gripper whose fingers were to go to some angles, rad, shape (fingers,)."""
    angles = run.truth.angle.transpose(1, 2, 0)  # fingers, runs, samples
    ends = final_value(run.time, angles)
    settling = {
        name: settling_time(run.time, angles, final=ends, band=band, absolute=absolute).max(axis=0)
        for name, (band, absolute) in criteria().items()
    }
    return Judged(
        settling,
        np.maximum(angles.max(axis=-1) / ends - 1, 0.0).max(axis=0),
        synchronization_error(angles.swapaxes(0, 1), targets).max(axis=-1),
        np.abs(ends - targets[:, None]).max(axis=0),
        np.abs(run.truth.motor_speed).max(axis=0),
    )


@remembered
def robustness_margin(name: str) -> float | None:
    """Return the `tolerated_uncertainty` of one of `ENTRIES` about `own_model`; None in open loop.

    The motor's limit is left out: it is the margin of small motions about rest.
    """
    feedback = feedback_of(ENTRIES[name](), len(own_model().fingers))
    return None if feedback is None else tolerated_uncertainty(own_model(), feedback)


def _unlimited(gripper: RigParameters) -> RigParameters:
    pump = replace(gripper.pump, speed_limit=1e4, acceleration_limit=1e7)
    return replace(gripper, pump=pump)


def _quiet(gripper: RigParameters) -> RigParameters:
    # As many counts as make rounding vanish.
    sensors = replace(gripper.sensors, angle_noise=0.0, low_count=1e5, high_count=9e5, bits=20)
    return replace(gripper, sensors=sensors)


RIGS: dict[str, Callable[[], RigParameters]] = {
    "as it is": printed_gripper,
    "no motor limit": lambda: _unlimited(printed_gripper()),
    "no sensor noise": lambda: _quiet(printed_gripper()),
    "neither": lambda: _unlimited(_quiet(printed_gripper())),
}
"""The simulated gripper, and what it would be without this or that."""


@remembered
def judged(name: str, rig: str = "as it is", *, runs: int = RUNS, seed: int = SEED) -> Judged:
    """Run and judge one of `ENTRIES` on one of `RIGS`, targets being those of its own model."""
    parameters = RIGS[rig]()
    made = drive(
        Simulation(parameters, runs=runs, seed=seed, period=PERIOD),
        ENTRIES[name](),
        duration=OPEN_LOOP_DURATION,
        limit=parameters.pump.speed_limit,
    )
    return judge(made, target_angles(own_model()))
