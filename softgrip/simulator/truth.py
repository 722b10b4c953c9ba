"""What happens in the simulated rig, beside what its sensors tell of it."""

from dataclasses import dataclass

from softgrip.arrays import Floats
from softgrip.simulator import laws
from softgrip.simulator.parameters import RigParameters


@dataclass(frozen=True)
class Truth:
    """What the sensors of a real rig would not tell; shapes as in `Measurement`.

    Attributes
    ----------
    time
        s.
    pressure
        Gauge, Pa.
    angle, rate
        rad and rad/s.
    motor_speed
        rad/s.
    plunger
        Travel of the plunger from where it is drawn out, m.
    finger_volume
        Air in the finger, m^3.
    amount
        Air in the rig, mol.
    """

    time: float | Floats
    pressure: Floats
    angle: Floats
    rate: Floats
    motor_speed: Floats
    plunger: Floats
    finger_volume: Floats
    amount: Floats


def truth_of(
    parameters: RigParameters,
    time: float | Floats,
    state: tuple[Floats, Floats, Floats],
    motor_speed: Floats,
    plunger: Floats,
) -> Truth:
    """Return what is true of a state.

    Parameters
    ----------
    parameters
        Of the rig.
    time
        s.
    state
        Air (n R T, J), angle and rate, shape (..., runs) each.
    motor_speed, plunger
        rad/s and m, same shape.
    """
    finger, gas, pump = parameters.finger, parameters.gas, parameters.pump
    amount, angle, rate = state
    syringe = pump.syringe_volume - pump.area * plunger
    free = syringe + gas.dead_volume + laws.finger_volume(angle, 0.0, finger)
    absolute = laws.absolute_pressure(amount, free, finger.ballooning, gas.atmosphere)
    gauge = absolute - gas.atmosphere
    return Truth(
        time,
        gauge,
        angle.copy(),
        rate.copy(),
        motor_speed.copy(),
        plunger.copy(),
        laws.finger_volume(angle, gauge, finger),
        amount / (laws.GAS_CONSTANT * gas.temperature),
    )
