"""The simulated force-measurement layer: Velostat, Wheatstone bridge, amplifier, converter.

It stands for the lower layer of the pad of Chapter 2. What the text gives of it: its resistance
falls with force, strongly nonlinearly; its range is 0.7 N; a bridge and an INA126 bring its
voltage to a converter of 10 bits; it drifts linearly, and shows some hysteresis. Everything else
is assumed, in `ForceLayer`, or fitted to the print: `fitted_rigs.fitted_layer`.
"""

from dataclasses import dataclass

import numpy as np
import scipy

from softgrip.arrays import Floats, Number
from softgrip.simulator.sensors import Counts


@dataclass(frozen=True)
class ForceLayer:
    """The layer's parameters; each with the reason for its default, with which the fit began.

    Attributes:
        rest_resistance: Ohm, unloaded. Assumed: kilohms, as sheets of some cm^2 have.
        pressed_resistance: Ohm, at a very large force. Assumed: a quarter of it.
        bridge_resistance: Ohm, of the arm beside the layer. Assumed: so small that the bridge's
            largest voltage, amplified, leaves a fifth of the converter's scale for drift.
        soft_force: N, over which the conductance closes in on that of a very large force, as 1 -
            exp(-F / soft_force). From the range of 0.7 N: a gram-force moves the voltage there by
            about one count, less than the noise of a reading.
        memory: Parts of the felt force that lag behind, fast and slow. Assumed: a tenth and a
            twentieth, as filled polymers under pressure creep by about that much in a minute.
        lag: s, of the two. Assumed: the fast one shorter than a grasp, the slow one longer.
        supply: V, of bridge and converter: that of the Arduino MEGA.
        amplification: Of the INA126. Assumed: its least, that without a resistor, as none is
            printed.
        voltage_noise: V, at the converter, one deviation. Assumed: about half a count.
        gain_drift: 1/h, of the layer's conductance. Assumed; Section 2.3 says that the drift is
            linear, not how large.
        offset_drift: V/h, of bridge and amplifier. Assumed.
        seating, object_seating: Spread of the part of a calibration weight, and of an object, that
            the layer feels, one deviation. The first assumed: a weight is a little off the middle.
            The second from Table 2.2: the four stiffer objects' deviations are 6.2 % of
            their weights (root mean square).
        largest_count: Of the converter: 10 bits.
    """

    rest_resistance: float = 20e3
    pressed_resistance: float = 5e3
    bridge_resistance: float = 1.5e3
    soft_force: Number = 0.20
    memory: tuple[Number, Number] = (0.10, 0.05)
    lag: tuple[float, float] = (0.5, 20.0)
    supply: float = 5.0
    amplification: float = 5.0
    voltage_noise: Number = 2.5e-3
    gain_drift: Number = 0.03
    offset_drift: Number = 0.02
    seating: Number = 0.02
    object_seating: Number = 0.062
    largest_count: int = 1023


def felt_force(force: Floats, period: float, layer: ForceLayer) -> Floats:
    """Return what the layer feels of a force held from sample to sample, N, same shape.

    Parts of it follow the force with first-order lags, from rest at zero: exact for a force that
    is constant between samples.

    Args:
        force: N, shape (samples,).
        period: s, from sample to sample.
        layer: Its parameters.
    """
    felt = (1 - sum(layer.memory)) * force
    for part, lag in zip(layer.memory, layer.lag, strict=True):
        kept = float(np.exp(-period / lag))
        felt = felt + part * scipy.signal.lfilter([0.0, 1 - kept], [1.0, -kept], force)
    return felt


def conductance(felt: Floats, age: float | Floats, layer: ForceLayer) -> Floats:
    """Return the layer's conductance, 1/Ohm, for a felt force (N) at an age (h)."""
    rest, pressed = 1 / layer.rest_resistance, 1 / layer.pressed_resistance
    loaded: Floats = rest + (pressed - rest) * -np.expm1(-felt / layer.soft_force)
    drifted: Floats = loaded * (1 + layer.gain_drift * age)
    return drifted


def bridge_voltage(conductance: Floats, layer: ForceLayer) -> Floats:
    """Return what the bridge gives, V: its other two arms balance it for the unloaded layer."""
    beside = layer.bridge_resistance
    loaded = beside * conductance / (1 + beside * conductance)
    return layer.supply * (loaded - beside / (beside + layer.rest_resistance))


def layer_voltage(felt: Floats, age: float | Floats, layer: ForceLayer) -> Floats:
    """Return the amplified voltage without noise, V; arguments as of `conductance`."""
    bridge = bridge_voltage(conductance(felt, age, layer), layer)
    amplified: Floats = layer.amplification * bridge + layer.offset_drift * age
    return amplified


def read_counts(voltage: Floats, noise: Floats, layer: ForceLayer) -> Counts:
    """Return the counts of the converter; `noise` is standard normal, shape as the voltage."""
    scaled = (voltage + layer.voltage_noise * noise) * layer.largest_count / layer.supply
    counts: Counts = np.clip(np.rint(scaled), 0, layer.largest_count).astype(np.int64)
    return counts


def volts(counts: Counts, layer: ForceLayer) -> Floats:
    """Return the voltage that counts stand for, V."""
    return counts.astype(np.float64) * (layer.supply / layer.largest_count)
