"""Recomputation of the numbers printed in Chapter 2."""

from itertools import combinations

import numpy as np

from book.chapter_2.forces import weighed_objects
from book.chapter_2.grasps import FRICTION, desired_force, study, summary
from book.chapter_2.kinds import kept, right_on_objects, split_shares
from book.chapter_2.logs import OBJECTS, contacts, errors
from book.companion.verdict import simulated
from softgrip.simulator.pad_objects import FOODS
from softgrip.tactile.contact_kind import bagged_neighbours, nearest_neighbours
from softgrip.tactile.element import STATED_MODULUS, Element, Shape, cut_sphere, shortening
from softgrip.tactile.element_results import fem_deformation
from softgrip.tactile.element_sensitivity import AT_REST, least_force, resistance_under
from softgrip.tactile.element_table import ASSUMED
from softgrip.tactile.force import SET, WEIGHTS, table_2_2
from softgrip.tactile.friction import contact_force, lift_force, printed_grasps
from softgrip.tactile.hertz import hertz_approach
from softgrip.tactile.kind_evaluation import accuracy
from softgrip.units import GRAM_FORCE, MM, MPa


def cylinder_by_equation(force: str, modulus: float = 0.125, width: float = 6.0) -> float:
    """Return the deformation of a cylinder 3 mm high, evenly stressed, mm; width in mm."""
    return shortening(Element("cylinder", width * MM), _newtons(force), modulus * MPa) / MM


def hemisphere_by_equation(force: str, modulus: float, cut: float) -> float:
    """Return the same of a sphere's half, 3 mm in radius and cut flat, mm."""
    return shortening(cut_sphere(cut), _newtons(force), modulus * MPa) / MM


def pyramid_by_equation(force: str, modulus: float, cut: float) -> float:
    """Return the same of a pyramid, 6 mm wide, 3 mm high and cut flat, mm."""
    return shortening(Element("pyramid", cut=cut), _newtons(force), modulus * MPa) / MM


def hertzian(force: str, modulus: float = 0.125, corrected: bool = False) -> float:
    """Return Hertz's right side for a radius of 3 mm; corrected, a length in mm.

    As printed, without the exponent 2/3, it is no length: the number then stands for 1e-3 m^1.5.
    """
    exponent = 2 / 3 if corrected else 1.0
    found = hertz_approach(_newtons(force), young_modulus=modulus * MPa, exponent=exponent)
    return found / MM


def by_finite_elements(
    force: str, shape: Shape, modulus: float = 0.125, assumed: bool = False, of: str = "largest"
) -> float:
    """Return the displacement of the top by finite elements, mm.

    Assumed: the element that the analytic row asks for; else 6 mm wide, 3 mm high and not cut, of
    which only the cylinder has a top to be loaded.
    """
    element = ASSUMED[shape] if assumed else Element(shape)
    return fem_deformation(element, _newtons(force), modulus * MPa, of) / MM


@simulated
def least_force_felt(shape: Shape) -> float:
    """Return the force whose resistance change is that of the pyramid at 0.01 N, N.

    The deformation is that of Eq. (2.1), the law of the skin our own.
    """
    return least_force(ASSUMED[shape], read_threshold(), STATED_MODULUS)


@simulated
def ceiling_force(modulus: float = 0.125) -> float:
    """Return the force at which the pyramid's resistance has reached 1.5 MOhm, N."""
    return least_force(ASSUMED["pyramid"], 0.5e6, modulus * MPa)


def read_threshold() -> float:
    """Return the change of resistance that a pyramid shows at 0.01 N, Ohm."""
    return float(resistance_under(ASSUMED["pyramid"], 0.01, STATED_MODULUS)) - AT_REST


def _newtons(force: str) -> float:
    return float(force.removesuffix(" N"))


def converter_rate(clock: float = 16e6, divider: float = 128, cycles: float = 13) -> float:
    """Return the rate of a converter that takes some cycles of a divided clock (Hz), kHz."""
    return clock / divider / cycles / 1e3


@simulated
def elements_of_a_line(share: float) -> float:
    """Return how many elements feel a line at most in a share of the simulated eight-food log."""
    felt = errors(OBJECTS).elements[contacts(OBJECTS).kinds == "line"]
    # Of whole numbers, the one that is reached, none between two of them.
    return float(np.quantile(felt, share, method="inverted_cdf"))


SINGLE, BAGGED = "k-nearest neighbours", "bagged neighbours"


def object_contacts(times: int = 10) -> float:
    """Return the contacts of Section 2.4: objects, each so many times."""
    return float(len(FOODS) * times)


@simulated
def split_accuracy(classifier: str, part: str) -> float:
    """Return the mean accuracy over 20 splits, %; `part` is "cross_validated" or "tested"."""
    return float(100 * split_shares(classifier, part).mean())


@simulated
def best_of_the_others(part: str) -> float:
    """Return the best mean accuracy of a classifier that has nothing to do with neighbours, %."""
    others = set(kept("classifiers")["classifier"]) - {SINGLE, BAGGED}
    return max(split_accuracy(name, part) for name in others)


@simulated
def best_k(part: str = "cross_validated") -> float:
    """Return the k with the highest accuracy, mean over 20 splits."""
    return float(kept("neighbours").groupby("k")[part].mean().idxmax())


@simulated
def accuracy_on_objects(bagged: bool) -> float:
    """Return the accuracy on the eight objects, %; the bagging classifier's for seed 0."""
    model = bagged_neighbours() if bagged else nearest_neighbours()
    return 100 * accuracy(right_on_objects(model)).share


def accuracy_of(item: str) -> float:
    """Return the accuracy of an object of Table 2.2 from its two weights, %."""
    return 100 * table_2_2()[item].accuracy


def mean_accuracy() -> float:
    """Return the mean of the accuracies of Table 2.2, %."""
    every = [accuracy_of(item) for item in table_2_2()]
    return sum(every) / len(every)


def best_accuracy() -> float:
    """Return the best of the accuracies of Table 2.2, %."""
    return max(accuracy_of(item) for item in table_2_2())


def mean_deviation() -> float:
    """Return the mean of the deviations of Table 2.2, N."""
    every = [row.deviation for row in table_2_2().values()]
    return sum(every) / len(every)


def largest_force() -> float:
    """Return the largest weight of the calibration, N."""
    return max(WEIGHTS) * GRAM_FORCE


def weights() -> float:
    """Count the different weights that Section 2.3 lists."""
    return float(len(set(WEIGHTS)))


def points(times: int = 3) -> float:
    """Return the data points: the weights and zero, so many times each."""
    return (weights() + 1) * times


def nearest_weight(weight: str, doubled: bool = False) -> float:
    """Return what at most three pieces of the set make that is nearest to a weight, gf.

    Doubled, a second 2 and a second 20 are in the set.
    """
    pieces = (*SET, 2, 20) if doubled else SET
    made = {float(sum(chosen)) for count in (1, 2, 3) for chosen in combinations(pieces, count)}
    return min(sorted(made), key=lambda each: abs(each - float(weight)))


@simulated
def weighed(item: str) -> float:
    """Return the mean of ten readings of an object by the simulated layer, gf."""
    return weighed_objects()[item].measured / GRAM_FORCE


WEIGHED = {"egg": "egg", "tofu": "tofu", "carrot": "sliced carrot"}
"""The row of Table 2.2 for each object; the text calls the carrot sliced, then small."""


def pressed(name: str, friction: float) -> float:
    """Return the contact force, N, that the printed estimated lift force of an object needs."""
    return contact_force(float(printed_grasps()[name].lift), friction)


def lift_of_desired(name: str, friction: float) -> float:
    """Return the lift force, N, that asks for the printed desired force of an object."""
    return lift_force(desired_force(name), friction)


def printed_lift(name: str) -> float:
    """Return the estimated lift force that Figure 2.13 prints of an object, N."""
    return float(printed_grasps()[name].lift)


def true_weight(name: str) -> float:
    """Return what Table 2.2 prints as the true weight of an object, N."""
    return table_2_2()[WEIGHED[name]].true


@simulated
def simulated_lift(name: str) -> float:
    """Return the estimated lift force, N, of the simulated grasps at rest."""
    measured = desired_force(name) - summary(study(name)).steady_error
    return lift_force(measured, FRICTION)
