"""Some laboratories, each with rigs of its own: what several of their experiments need in common.

What was recorded once is kept: the controllers know of a rig what its own step tests and pushes
tell, as in the laboratory.
"""

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from book.twin import rigs as making
from book.twin.experiments import KEPT, Records, closed_loop, open_loop
from book.twin.identification import SecondOrders, identify_second_order
from book.twin.least_squares import Which
from book.twin.pressure_models import Push, first_capacity
from book.twin.space import Values
from softgrip.arrays import Flags, Floats
from softgrip.control.pid import PERIOD
from softgrip.gripper.internal_model import PERIOD as GRIPPER_PERIOD
from softgrip.simulator.gripper_steps import OPEN_LOOP_DURATION, push_commands
from softgrip.simulator.parameters import RigParameters, Spread
from softgrip.simulator.rig_batch import take
from softgrip.simulator.sampled_law import command_law
from softgrip.simulator.statics import travel_for
from softgrip.simulator.steps import DURATION, step_commands
from softgrip.units import DEG, ML, MM, REV, MPa

RUNS = 7
"""Of a step test (Sections 5.4 and 6.4)."""
LARGEST, STROKE = 0.15 * MPa, 60 * ML
"""Of a push: the pressure at which it ends, and what it sweeps at most."""
LOW_PRESSURE = 20e3
"""Pa, below which the controllers' capacity is taken: what a bend of 90 deg needs."""
CORRECTIONS = 2
"""Simulations that correct the closed form of a step's travel: to a tenth of a degree."""


def travels(rigs: RigParameters, angle: Floats, *, compiled: bool = True) -> Floats:
    """Return the travel of the plunger, m, with which rigs without spread end at angles, rad."""
    alike, stroke = replace(rigs, spread=Spread()), 0.95 * rigs.pump.stroke
    aim = angle
    travel = np.minimum(travel_for(rigs, aim, DURATION), stroke)
    for _ in range(CORRECTIONS):
        made = open_loop(alike, step_commands(travel), keep=("true_angle",), compiled=compiled)
        aim = np.asarray(aim * angle / made.true_angle[:, 0, 0, -1])
        travel = np.minimum(travel_for(rigs, aim, DURATION), stroke)
    return np.asarray(travel)


@dataclass(frozen=True, eq=False)
class Laboratory:
    """Laboratories whose rigs and choices have some values each.

    Attributes:
        values: By name, shape (rigs,); see `space.values`.
        compiled: False for the simulator on NumPy.
        loops, steps: Runs of a closed loop of the gripper of which the median is taken, and of its
            steps at two speeds: those of the book. Fewer are faster, and more chance is left.
        splits: In training and testing, over which accuracies of kinds of contact are averaged.
    """

    values: Values
    compiled: bool = True
    loops: int = 50
    steps: int = 200
    splits: int = 20

    def __getitem__(self, name: str) -> Floats:
        """Return a value of each, shape (rigs,)."""
        return self.values[name]

    @cached_property
    def count(self) -> int:
        """Number of laboratories."""
        return len(next(iter(self.values.values())))

    def step_test(
        self, make: making.Make, angle: Floats, *, keep: Collection[str] = KEPT
    ) -> Records:
        """Return a step test of one finger, pushed as fast as can be, that ends at angles, rad."""
        rigs = make(self.values)
        commands = step_commands(travels(rigs, angle, compiled=self.compiled))
        return open_loop(rigs, commands, runs=RUNS, keep=keep, compiled=self.compiled)

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
        rigs = making.design_1(self.values)
        pump = replace(rigs.pump, area=area, lead=lead, syringe_volume=syringe)
        flow = area * pump.advance * speed
        commands = np.full(round((STROKE / flow + 1.0) / PERIOD), speed)
        made = open_loop(
            replace(rigs, pump=pump), commands, plunger=(syringe - STROKE) / area,
            keep=("pressure", "true_pressure", "plunger"), compiled=self.compiled,
        )  # fmt: skip
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
        gain = self.pump_gain
        return np.asarray(self.finger.usable & np.isfinite(gain) & (gain > 0))

    def pushed(self, speed: Floats) -> tuple[Floats, Which]:
        """Return the commands that push the gripper's fingers at speeds, and how many they are.

        Args:
            speed: Of the motor, rad/s, shape (rigs,).

        Returns:
            tuple: rad/s, shape (rigs, periods), then rest; and shape (rigs,).
        """
        pump = making.gripper(self.values).pump
        commands = push_commands(self["choice.gripper_travel"] * MM, pump, speed)
        return commands, np.count_nonzero(commands, axis=1)

    def gripper_steps(
        self,
        commands: Floats,
        duration: float,
        runs: int,
        which: Which | slice = slice(None),
        *,
        keep: Collection[str] = ("angle",),
    ) -> Records:
        """Send commands, rad/s, to the fingers of some grippers, shape (rigs, periods)."""
        rigs = take(making.gripper(self.values), which)
        return closed_loop(
            rigs, command_law(commands, len(rigs.fingers)), duration, runs=runs,
            period=GRIPPER_PERIOD, keep=keep, compiled=self.compiled,
        )  # fmt: skip

    @cached_property
    def gripper_commands(self) -> Floats:
        """Those of the steps at high speed, rad/s, over all of the test, shape (rigs, periods)."""
        commands, _ = self.pushed(self["choice.gripper_speed"] * REV)
        rest = round(OPEN_LOOP_DURATION / GRIPPER_PERIOD) - commands.shape[1]
        return np.pad(commands, ((0, 0), (0, rest)))

    @cached_property
    def gripper_open(self) -> Records:
        """Seven steps of the gripper in open loop at high speed."""
        return self.gripper_steps(self.gripper_commands, OPEN_LOOP_DURATION, RUNS)

    def identified_fingers(self, angles: Floats, start: SecondOrders | None = None) -> SecondOrders:
        """Identify fingers from the angle of the motor, rad, to theirs, rad; shape (rigs, ...).

        Args:
            angles: Shape (rigs, ..., N), of `gripper_open`.
            start: Where to begin, of a shape that broadcasts to (rigs, ...).
        """
        turned = GRIPPER_PERIOD * np.cumsum(self.gripper_commands, axis=1)
        turned = np.pad(turned, ((0, 0), (1, 0))).reshape(len(turned), *[1] * (angles.ndim - 2), -1)
        return identify_second_order(self.gripper_open.time, turned, angles, start=start)

    @cached_property
    def gripper_fingers(self) -> SecondOrders:
        """By the mean of the runs in open loop, input in rad, shape (rigs, fingers)."""
        return self.identified_fingers(self.gripper_open.angle.mean(axis=1))
