"""The rigs that values describe, one or many: three designs, four sections, and the gripper.

Designs bear Chapter 3's names. What is not named here is the same in all of them.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace

from softgrip.actuator.printed import section, table_3_2
from softgrip.arrays import Number
from softgrip.simulator.parameters import (
    FingerParameters,
    GasParameters,
    PumpParameters,
    RigParameters,
    SensorParameters,
    Spread,
)
from softgrip.simulator.scaled_section import with_section
from softgrip.simulator.statics import FULL_PRESSURE
from softgrip.units import DEG, ML

SYRINGE = 150 * ML
"""Of the gripper's pump (Section 6.3), m^3."""

Row = Mapping[str, Number]
"""The values of one rig, or those of many: arrays of shape (rigs,), and so are the parameters."""
Make = Callable[[Row], RigParameters]


def _finger(row: Row) -> FingerParameters:
    """Return the finger of Design 1; the rubber is Dragon Skin 20.

    Its stiffness is the torque that holds 1 rad, its frequency and damping ratio are those of small
    motions about 1 rad, without the memory.
    """
    n, full = row["rubber.power"], row["finger.torque_per_pressure"] * FULL_PRESSURE
    stiffness = full / (row["finger.full_angle"] * DEG) ** n
    inertia = n * stiffness / row["finger.frequency"] ** 2
    return FingerParameters(
        stiffness=stiffness,
        fractional_power=n,
        inertia=inertia,
        damping=2 * row["finger.damping_ratio"] * row["finger.frequency"] * inertia,
        torque_per_pressure=row["finger.torque_per_pressure"],
        rest_volume=row["finger.rest_volume"],
        ballooning=row["finger.ballooning"],
        memory=(row["rubber.memory_fast"], row["rubber.memory_slow"]),
        memory_time=(row["rubber.time_fast"], row["rubber.time_slow"]),
        friction=row["rubber.friction"] * stiffness,
    )


def _scaled(rig: RigParameters, row: Row, name: str) -> RigParameters:
    """Return a rig with a finger of so many times torque, stiffness, inertia and damping."""
    fields = ("torque_per_pressure", "stiffness", "inertia", "damping")
    own = {field: getattr(rig.finger, field) * row[f"{name}.{field}"] for field in fields}
    return replace(rig, fingers=(replace(rig.finger, **own),))


def design_1(row: Row) -> RigParameters:
    """Return the rig with Design 1, of Dragon Skin 20."""
    return RigParameters(
        (_finger(row),),
        pump=PumpParameters(acceleration_limit=row["pump.acceleration_limit"]),
        gas=GasParameters(dead_volume=row["gas.dead_volume"], leakage=row["gas.leakage"]),
        sensors=SensorParameters(
            pressure_noise=row["sensors.pressure_noise"],
            pressure_lag=row["sensors.pressure_lag"],
            angle_noise=row["sensors.angle_noise"],
            angle_lag=row["sensors.angle_lag"],
        ),
        spread=Spread(row["spread.stiffness"], row["spread.damping"], row["spread.leakage"]),
    )


def design_2(row: Row) -> RigParameters:
    """Return the rig with Design 2, which is narrower: by Chapter 3's laws, times free ratios."""
    own, known = section("Variance 1"), section("Opt. parameters")
    return _scaled(with_section(design_1(row), own, known), row, "narrow")


def design_3(row: Row) -> RigParameters:
    """Return the rig with Design 3, of Dragon Skin FX-Pro: Design 1 times free ratios.

    The ratio of the stiffnesses is that of the torques at 1 rad, as their powers differ.
    """
    rig = _scaled(design_1(row), row, "soft")
    finger = replace(rig.finger, fractional_power=row["soft.power"])
    spread = replace(rig.spread, stiffness=row["spread.soft_stiffness"])
    return replace(rig, fingers=(finger,), spread=spread)


def table_3_2_row(number: int) -> Make:
    """Return what makes the rig with the section of a row of Table 3.2, 1 to 4."""
    own, known = table_3_2()[number - 1].section, section("Opt. parameters")
    return lambda row: with_section(design_1(row), own, known)


def gripper(row: Row) -> RigParameters:
    """Return the gripper of Section 6.4, left finger first: Design 1 times free ratios."""
    rig = design_1(row)
    return replace(
        rig,
        fingers=tuple(_scaled(rig, row, side).finger for side in ("left", "right")),
        pump=replace(rig.pump, area=row["gripper.area"], syringe_volume=SYRINGE),
        spread=replace(
            rig.spread,
            stiffness=row["spread.gripper_stiffness"],
            damping=row["spread.gripper_damping"],
        ),
    )
