"""Recomputation of the numbers printed in Chapter 2."""

from collections.abc import Mapping, Sequence
from itertools import combinations
from math import prod

import numpy as np

from book.chapter_2.forces import weighed_objects
from book.chapter_2.grasps import desired_force, friction, study, summary
from book.chapter_2.kinds import kept, split_shares
from book.chapter_2.logs import OBJECTS, contacts, errors
from book.companion.relations import mean, nearest_share
from book.companion.verdict import simulated
from softgrip.materials import yeoh
from softgrip.materials.facts import facts
from softgrip.simulator.fitted_rigs import fitted_pad
from softgrip.tactile.element import STATED_MODULUS, Element, Shape, cut_sphere, shortening
from softgrip.tactile.element_results import fem_deformation, largest_for
from softgrip.tactile.element_sensitivity import least_force
from softgrip.tactile.force import Weighing
from softgrip.tactile.friction import contact_force, lift_force
from softgrip.tactile.hertz import hertz_approach
from softgrip.units import GRAM_FORCE, MM, MPa


def secant_modulus(material: str, strain: float, stress: str = "engineering") -> float:
    """Return stress over strain in the public tensile test, by Yeoh's law, MPa.

    Args:
        material: As Table 5.1 names it.
        strain: Engineering strain, > 0.
        stress: "engineering" or "true".
    """
    engineering = float(yeoh.stress(1 + strain, facts()[material].yeoh))
    # Rubber keeps its volume: what it is stretched by, its cross-section shrinks by.
    shrunk = 1 + strain if stress == "true" else 1.0
    return engineering * shrunk / strain / MPa


def cylinder_by_equation(force: float, modulus: float, width: float, height: float) -> float:
    """Return the deformation of a cylinder, evenly stressed, mm; N, MPa, sizes in mm."""
    element = Element("cylinder", width * MM, height * MM)
    return shortening(element, force, modulus * MPa) / MM


def hemisphere_by_equation(force: float, modulus: float, width: float, cut: float) -> float:
    """Return the same of a sphere's half that is cut flat."""
    return shortening(cut_sphere(cut, width * MM / 2), force, modulus * MPa) / MM


def pyramid_by_equation(
    force: float, modulus: float, width: float, height: float, cut: float
) -> float:
    """Return the same of a pyramid that is cut flat."""
    element = Element("pyramid", width * MM, height * MM, cut)
    return shortening(element, force, modulus * MPa) / MM


def hertzian(force: float, modulus: float, poisson_ratio: float, width: float) -> float:
    """Return Hertz's approach of a hemisphere, with the exponent 2/3 that the print lacks, mm."""
    found = hertz_approach(force, width * MM / 2, modulus * MPa, poisson_ratio)
    return found / MM


def cylinder_by_finite_elements(
    force: float, modulus: float, width: float, of: str = "largest"
) -> float:
    """Return the displacement of a cylinder's top, 3 mm high, by finite elements, mm.

    Args:
        force: On the top, N.
        modulus: MPa.
        width: 6 or 10 mm, for which results are kept.
        of: The "mean" or the "largest" displacement, or that of a rigid "plate".
    """
    element = Element("cylinder", width * MM)
    return fem_deformation(element, force, modulus * MPa, of) / MM


def cut_by_finite_elements(force: float, shape: Shape, modulus: float, cut: float) -> float:
    """Return the largest displacement of the top of an element 6 mm wide and cut flat, mm."""
    by_force = largest_for(shape, cut) * STATED_MODULUS / (modulus * MPa)
    return by_force * force / MM


def least_force_by_deformation(
    pyramid_feels: float, pyramid: float, shape: float, threshold: float
) -> float:
    """Return the least force that a shape feels, N, if deformation rises in proportion to force.

    Args:
        pyramid_feels: The least force that the pyramid feels, N.
        pyramid, shape: Deformations of the two under one load.
        threshold: Deformation from which the shape is felt, as a part of that of the pyramid.
    """
    return pyramid_feels * pyramid / shape * threshold


@simulated
def ceiling_force(least: float, largest: float) -> float:
    """Return the force at which an element of the fitted pad has reached its largest resistance, N.

    Args:
        least, largest: Resistance without load, and under the largest force that is felt, MOhm.
    """
    pad = fitted_pad()
    return least_force(pad.element, (largest - least) * 1e6, pad.young_modulus)


def covered(count: float, element: Sequence[float], pad: Sequence[float]) -> float:
    """Return the area of elements over that of the pad that they lie in, both by their sides.

    >>> covered(2, element=[1.0, 1.0], pad=[2.0, 4.0])
    0.25
    """
    return count * prod(element) / prod(pad)


def converter_rate(clock: float = 16e6, divider: float = 128, cycles: float = 13) -> float:
    """Return the rate of a converter that takes some cycles of a divided clock (Hz), kHz."""
    return clock / divider / cycles / 1e3


def conversion_time(pins: Sequence[float], rate: float) -> float:
    """Return the time, ms, in which a converter (kHz) reads every pin of some groups once.

    >>> conversion_time([1, 8], rate=9.0)
    1.0
    """
    return sum(pins) / rate


@simulated
def elements_of_a_line(share: float) -> float:
    """Return how many elements feel a line at most in a share of the simulated eight-food log."""
    felt = errors(OBJECTS).elements[contacts(OBJECTS).kinds == "line"]
    # Of whole numbers, the one that is reached, none between two of them.
    return float(np.quantile(felt, share, method="inverted_cdf"))


SINGLE, BAGGED = "k-nearest neighbours", "bagged neighbours"


def all_contacts(objects: Sequence[str], times: float) -> float:
    """Return the contacts of objects, each so many times."""
    return len(objects) * times


def share_of_a_count(percent: float, contacts: float, part: float = 100.0) -> float:
    """Return the share of a whole number of contacts that comes nearest to a printed one, %.

    Args:
        percent: The printed share.
        contacts: Contacts in all.
        part: Those of them that were judged, %.
    """
    return nearest_share(percent, round(part / 100 * contacts))


@simulated
def best_of_the_others(part: str) -> float:
    """Return the best mean accuracy of a classifier that has nothing to do with neighbours, %.

    `part` is "cross_validated" or "tested"; the mean is that over 20 splits.
    """
    others = set(kept("classifiers")["classifier"]) - {SINGLE, BAGGED}
    return float(max(100 * split_shares(name, part).mean() for name in others))


@simulated
def best_k(part: str = "cross_validated") -> float:
    """Return the k with the highest accuracy, mean over 20 splits."""
    return float(kept("neighbours").groupby("k")[part].mean().idxmax())


def accuracy_of(measured: float, true: float) -> float:
    """Return the accuracy of a measured weight, %."""
    return 100 * Weighing(measured, deviation=0.0, true=true).accuracy


def newtons(weight: float, deviation: float = 0.0, times: float = 0.0) -> float:
    """Return a weight in gram-force, or what is some deviations from it, in N."""
    return (weight + times * deviation) * GRAM_FORCE


def mean_deviation(deviations: Mapping[str, float], without: str = "none") -> float:
    """Return the mean of deviations by object, gf, in N; one object may be left out."""
    return newtons(mean([value for name, value in deviations.items() if name != without]))


def points(weights: float, others: Sequence[float], times: float) -> float:
    """Return the data points: a number of weights and those that are listed, so many times each."""
    return (weights + len(others)) * times


def nearest_weight(
    weight: float,
    pieces: Sequence[float],
    together: Sequence[float],
    twice: Sequence[float] = (),
) -> float:
    """Return what pieces of a set make that is nearest to a weight, gf.

    Args:
        weight: That is wanted, gf.
        pieces: Of the set, each once, gf.
        together: Fewest and most pieces that are put together.
        twice: Pieces of which the set holds a second one.
    """
    held, (fewest, most) = (*pieces, *twice), map(int, together)
    made = {
        sum(chosen) for count in range(fewest, most + 1) for chosen in combinations(held, count)
    }
    return min(sorted(made), key=lambda each: abs(each - weight))


@simulated
def weighed(item: str) -> float:
    """Return the mean of ten readings of an object by the simulated layer, gf."""
    return weighed_objects()[item].measured / GRAM_FORCE


def pressed(lift: float, other_lift: float, other_contact: float) -> float:
    """Return the contact force, N, that an object's lift force needs, Eq. (2.8).

    The friction is that of another object: between its lift and contact force, Eq. (2.9).
    """
    friction = other_lift / lift_force(other_contact, friction=1.0)
    return contact_force(lift, friction)


@simulated
def simulated_lift(name: str) -> float:
    """Return the estimated lift force, N, of the simulated grasps at rest."""
    measured = desired_force(name) - summary(study(name)).steady_error
    return lift_force(measured, friction())
