"""The simulated pad: from the forces on its elements to the counts of its converter."""

from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Floats
from softgrip.simulator.chance import streams
from softgrip.simulator.fitted_rigs import fitted_pad
from softgrip.simulator.pad_contact import bed_points, element_forces, spring_stiffness
from softgrip.simulator.pad_objects import PadObject, pad_object
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_surface import Pose, gap
from softgrip.simulator.sensors import Counts
from softgrip.tactile.element import compliance
from softgrip.tactile.element_sensitivity import AT_REST, resistance


@dataclass(frozen=True, eq=False)
class Pad:
    """One pad, with what sets its elements apart.

    Attributes:
        parameters: Of all pads.
        at_rest: Resistance at rest, Ohm, shape (elements,).
        gain: Multiple of the relative change of the resistance, shape (elements,).
        compliance: m/N, shape (elements,).
        height: How far each stands above the others, m, shape (elements,).
        drift: Relative change of the resistance at rest, 1/s, shape (elements,).
    """

    parameters: PadParameters
    at_rest: Floats
    gain: Floats
    compliance: Floats
    height: Floats
    drift: Floats


def make_pad(parameters: PadParameters, seed: int | None = None) -> Pad:
    """Return a pad: one drawn by a seed, or without one the ideal pad, all elements alike."""
    n = parameters.layout.elements
    drawn = np.zeros((5, n)) if seed is None else streams(seed, 0)[0].standard_normal((5, n))
    soft = compliance(parameters.element, parameters.young_modulus)
    return Pad(
        parameters,
        at_rest=AT_REST * np.exp(parameters.rest_spread * drawn[0]),
        gain=np.exp(parameters.gain_spread * drawn[1]),
        compliance=soft * np.exp(parameters.stiffness_spread * drawn[2]),
        height=parameters.height_spread * drawn[3],
        drift=parameters.drift * drawn[4],
    )


def press(
    pad: Pad, item: PadObject, pose: Pose, force: float, chance: np.random.Generator | None = None
) -> Floats:
    """Return the forces on the elements, N, shape (elements,), when an object is pressed.

    Args:
        pad: The pad.
        item, pose: What is pressed, and how it is laid.
        force: Contact force, N.
        chance: Gives its rough surface; without it the object is smooth.

    Raises:
        InvalidInputError: If the object lies beside all elements.
    """
    gaps = gap(item, pose, bed_points(pad.parameters), chance) - pad.height[:, None]
    k = np.array([spring_stiffness(pad.parameters, item.softness)])
    shared: Floats = element_forces(gaps[None], k, pad.compliance, np.array([force]))[0]
    return shared


def voltages(
    pad: Pad, forces: Floats, time: float = 0.0, chance: np.random.Generator | None = None
) -> Floats:
    """Return the voltages of the elements and of the force layer, V, shape (elements + 1,).

    Args:
        pad: The pad.
        forces: On its elements, N, shape (elements,).
        time: Since the start of the log, s; the resistances drift with it.
        chance: Gives noise and repeatability; without it there is none.
    """
    own, n = pad.parameters, pad.parameters.layout.elements
    drawn = np.zeros(2 * n + 1) if chance is None else chance.standard_normal(2 * n + 1)
    nominal = resistance(pad.compliance * forces, own.element.height) / AT_REST
    change = pad.gain * (1 + own.repeatability * drawn[:n]) * (nominal - 1)
    amplified = own.reference * (
        1 + pad.at_rest * (1 + change + pad.drift * time) / own.gain_resistor
    )
    # Half a Wheatstone bridge whose Velostat has 1 / (1 + x) of its resistance at rest.
    x = forces.sum() / own.layer_force
    layer = own.layer_gain * own.supply * x / (2 * (2 + x))
    return np.append(amplified, layer) + own.noise * drawn[n:]


def convert(volts: Floats, parameters: PadParameters) -> Counts:
    """Return the counts of the converter for voltages in V, cut to its range."""
    counts = np.rint(volts * (parameters.levels / parameters.supply))
    return np.clip(counts, 0, parameters.levels - 1).astype(np.int64)


def to_volts(counts: Counts, parameters: PadParameters) -> Floats:
    """Return the voltages that counts stand for, V."""
    return counts.astype(np.float64) * (parameters.supply / parameters.levels)


def responses_to(pad: Pad, forces: Floats) -> Floats:
    """Return the normalised responses, without noise, to forces on the elements, N, shape (8,)."""
    n, full = pad.parameters.layout.elements, 1.0  # a newton: beyond the range of any element
    rest, most, now = (voltages(pad, f)[:n] for f in (np.zeros(n), np.full(n, full), forces))
    found: Floats = np.clip((now - rest) / (most - rest), 0, 1)
    return found


def ideal_responses(name: str, pose: Pose, force: float) -> Floats:
    """Return what the fitted pad, all its elements alike, says of a smooth object, shape (8,)."""
    pad = make_pad(fitted_pad())
    return responses_to(pad, press(pad, pad_object(name), pose, force))
