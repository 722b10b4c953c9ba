"""Example rigs, which hang on no fit; and rigs and commands that differ from run to run."""

from dataclasses import fields, replace

import numpy as np

from book.twin import rigs as twin
from book.twin.space import rows, values
from softgrip.simulator.parameters import Spread
from softgrip.units import REV

(_BEFORE,) = rows(values())
"""What the fit to the print begins with."""


def _with(make, spread):
    rig = make(_BEFORE)
    return rig if spread else replace(rig, spread=Spread())


def design_1(*, spread=True):
    return _with(twin.design_1, spread)


def design_2(*, spread=True):
    return _with(twin.design_2, spread)


def design_3(*, spread=True):
    return _with(twin.design_3, spread)


def printed_gripper(*, spread=True):
    return _with(twin.gripper, spread)


THREE = replace(printed_gripper(), fingers=(*printed_gripper().fingers, design_1().finger))


def differing(rig, runs, seed=0):
    """Return a rig a run, whose parameters lie within a fifth of those given."""
    chance = np.random.default_rng(seed)

    def spread(part, leave=()):
        own = {one.name: getattr(part, one.name) for one in fields(part) if one.name not in leave}
        return replace(part, **{name: near(value) for name, value in own.items()})

    def near(value):
        return (
            tuple(map(near, value))
            if isinstance(value, tuple)
            else value * chance.uniform(0.8, 1.2)
        )

    def one():
        return replace(
            rig,
            fingers=tuple(spread(finger) for finger in rig.fingers),
            pump=replace(spread(rig.pump), backlash=chance.choice([0.0, 5e-4])),
            gas=spread(rig.gas),
            sensors=spread(rig.sensors, leave=("bits", "high_count")),
            spread=spread(rig.spread),
        )

    return [one() for _ in range(runs)]


def commands(periods, runs, seed=1):
    """Return motor speeds that change each few periods, shape (runs, periods)."""
    speeds = np.random.default_rng(seed).choice([-5.0, 5.0, 0.0, 2.0], (runs, periods // 4 + 1))
    return np.repeat(speeds * REV, 4, axis=1)[:, :periods]
