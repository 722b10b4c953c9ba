"""Recomputation of the numbers that Chapter 2 prints of the contact force."""

from itertools import combinations

from softgrip.ledger.verdict import simulated
from softgrip.rig.force_layer_study import weighed_objects
from softgrip.tactile.force import SET, WEIGHTS, table_2_2
from softgrip.units import GRAM_FORCE


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
