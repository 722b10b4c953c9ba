"""Some laboratories, each with rigs of its own: what several of their experiments need in common.

What was recorded once is kept: the controllers know of a rig what its own step tests and pushes
tell, as in the laboratory.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from softgrip.arrays import Floats
from softgrip.control.pid import PERIOD
from softgrip.control.rig_controller import CommandSequence
from softgrip.gripper.internal_model import PERIOD as GRIPPER_PERIOD
from softgrip.gripper.plant import FingerDynamics, Gripper
from softgrip.simulator.gripper_calibration import OPEN_LOOP_DURATION, push_commands
from softgrip.simulator.parameters import RigParameters, Spread
from softgrip.simulator.steps import DURATION, step_commands
from softgrip.twin import rigs as making
from softgrip.twin.experiments import Records, closed_loop, open_loop
from softgrip.twin.identification import SecondOrders, identify_second_order
from softgrip.twin.pressure_models import Flags, Push, first_capacity
from softgrip.twin.space import Values, rows
from softgrip.twin.statics import travel_for
from softgrip.units import DEG, ML, MM, REV, MPa

RUNS = 7
"""Of a step test (Sections 5.4 and 6.4)."""
LARGEST, STROKE = 0.15 * MPa, 60 * ML
"""Of a push: the pressure at which it ends, and what it sweeps at most."""
LOW_PRESSURE = 20e3
"""Pa, below which the controllers' capacity is taken: what a bend of 90 deg needs."""
CORRECTIONS = 2
"""Simulations that correct the closed form of a step's travel: to a tenth of a degree."""


def travels(rigs: Sequence[RigParameters], angle: Floats) -> Floats:
    """Return the travel of the plunger, m, with which rigs without spread end at angles, rad."""
    alike = [replace(rig, spread=Spread()) for rig in rigs]
    stroke = np.array([0.95 * rig.pump.stroke for rig in rigs])
    aim = angle
    travel = np.minimum(travel_for(rigs, aim, DURATION), stroke)
    for _ in range(CORRECTIONS):
        made = open_loop(alike, [step_commands(float(x)) for x in travel])
        aim = np.asarray(aim * angle / made.true_angle[:, 0, 0, -1])
        travel = np.minimum(travel_for(rigs, aim, DURATION), stroke)
    return np.asarray(travel)


@dataclass(frozen=True, eq=False)
class Laboratory:
    """Laboratories whose rigs and choices have some values each.

    Attributes:
        values: By name, shape (rigs,); see `space.values`.
    """

    values: Values

    def __getitem__(self, name: str) -> Floats:
        """Return a value of each, shape (rigs,)."""
        return self.values[name]

    @property
    def count(self) -> int:
        """Number of laboratories."""
        return len(next(iter(self.values.values())))

    def rigs(self, make: making.Make) -> list[RigParameters]:
        """Return the rigs of a kind, such as `rigs.design_1`."""
        return [make(row) for row in rows(self.values)]

    def step_test(self, make: making.Make, angle: Floats) -> Records:
        """Return a step test of one finger, pushed as fast as can be, that ends at angles, rad."""
        rigs = self.rigs(make)
        commands = [step_commands(float(x)) for x in travels(rigs, angle)]
        return open_loop(rigs, commands, runs=RUNS)

    @cached_property
    def first_step(self) -> Records:
        """The step test of Design 1 to 60 deg."""
        return self.step_test(making.design_1, np.full(self.count, 60 * DEG))

    @cached_property
    def finger(self) -> SecondOrders:
        """Eq. (4.14), rad by Pa: the mean of the seven runs of the first step, as measured."""
        test = self.first_step
        return identify_second_order(
            test.time, test.pressure.mean(axis=1), test.angle[:, :, 0].mean(axis=1)
        )

    def push(self, area: float, lead: float, syringe: float, speed: float) -> Push:
        """Push at one speed, rad/s, from 60 mL of air in the syringe of a pump, m^2, m, m^3."""
        pump = {"area": area, "lead": lead, "syringe_volume": syringe}
        rigs = [replace(rig, pump=replace(rig.pump, **pump)) for rig in self.rigs(making.design_1)]
        flow = area * rigs[0].pump.advance * speed
        commands = np.full(round((STROKE / flow + 1.0) / PERIOD), speed)
        made = open_loop(rigs, [commands] * self.count, plunger=(syringe - STROKE) / area)
        over = (made.true_pressure[:, 0] >= LARGEST) | (made.plunger[:, 0] >= syringe / area)
        until = np.where(over.any(axis=1), np.argmax(over, axis=1) + 1, commands.size)
        flows = np.full(self.count, flow)
        return Push(PERIOD, flows, flows[:, None] * made.time, made.pressure[:, 0], until)

    @cached_property
    def default_push(self) -> Push:
        """The push with the default set of Section 4.2."""
        return self.push(6.61e-4, 8 * MM, 60 * ML, 1.65 * REV)

    @cached_property
    def pump_gain(self) -> Floats:
        """``A l / (2 pi C_i)`` of Eq. (4.5), Pa/s per rad/s, C_i by the default push."""
        push = self.default_push
        return push.flow / (1.65 * REV) / first_capacity(push, LOW_PRESSURE)

    @cached_property
    def known(self) -> Flags:
        """Which laboratories have a model of finger and pump to design a controller on."""
        positive = (*vars(self.finger).values(), self.pump_gain)
        return np.asarray(np.all([np.isfinite(x) & (x > 0) for x in positive], axis=0))

    def gripper_steps(
        self, speed: Floats, runs: int, *, rest: float | None = None
    ) -> tuple[Records, Floats]:
        """Push the gripper's fingers in open loop, and return how many samples count on each rig.

        Args:
            speed: Of the motor, rad/s, shape (rigs,).
            runs: Repeats on each rig.
            rest: s, after the push; None for a test of 6 s.
        """
        rigs = self.rigs(making.gripper)
        travel = self["choice.gripper_travel"] * MM
        commands = [
            push_commands(float(x), rig.pump, float(v))
            for rig, x, v in zip(rigs, travel, speed, strict=True)
        ]
        ends = np.array([GRIPPER_PERIOD * own.size + (rest or 0.0) for own in commands])
        ends = ends if rest else np.full(self.count, OPEN_LOOP_DURATION)
        controllers = [partial(CommandSequence, own) for own in commands]
        made = closed_loop(rigs, controllers, float(ends.max()), runs=runs, period=GRIPPER_PERIOD)
        return made, np.rint(ends / GRIPPER_PERIOD).astype(int) + 1

    @cached_property
    def gripper_open(self) -> Records:
        """Seven steps of the gripper in open loop at high speed."""
        return self.gripper_steps(self["choice.gripper_speed"] * REV, RUNS)[0]

    def identified_fingers(self, angles: Floats) -> SecondOrders:
        """Identify fingers from the angle of the motor, rad, to theirs, rad.

        Args:
            angles: Shape (rigs, ..., N), of `gripper_open`.
        """
        test = self.gripper_open
        turned = GRIPPER_PERIOD * np.cumsum(test.command, axis=1)
        turned = turned.reshape(len(turned), *[1] * (angles.ndim - 2), -1)
        flat = (np.broadcast_to(turned, angles.shape), angles)
        return identify_second_order(test.time, *(x.reshape(-1, x.shape[-1]) for x in flat))

    @cached_property
    def grippers(self) -> list[Gripper | None]:
        """P(s) of each gripper, by the mean of the runs in open loop, input in rad/s.

        None where the runs identify none.
        """
        found = self.identified_fingers(self.gripper_open.angle.mean(axis=1))
        w, z, k = (x.reshape(self.count, -1).tolist() for x in vars(found).values())
        return [_gripper(*rows) for rows in zip(w, z, k, strict=True)]


def _gripper(w: list[float], z: list[float], k: list[float]) -> Gripper | None:
    """Return P(s) of natural frequencies, damping ratios and gains, if all are above zero."""
    if not all(x > 0 for x in (*w, *z, *k)):
        return None
    elements = zip(w, z, k, strict=True)
    return Gripper(tuple(FingerDynamics(2 * d * f, f**2, gain * f**2) for f, d, gain in elements))
