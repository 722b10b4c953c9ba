"""Recomputation of the numbers that Chapter 2 prints of the kind of a contact."""

from softgrip.ledger.verdict import simulated
from softgrip.rig.kind_study import kept, right_on_objects
from softgrip.tactile.contact_kind import bagged_neighbours, nearest_neighbours
from softgrip.tactile.kind_evaluation import accuracy

OBJECTS = {
    "egg": "point",
    "cherry tomato": "point",
    "sponge": "surface",
    "tofu": "surface",
    "small carrot": "line",
    "sliced cucumber": "line",
    "sliced banana": "line",
    "hot dog": "line",
}
"""Section 2.4: the objects that the pad was tested with, and the kind that each is taken for."""

SINGLE, BAGGED = "k-nearest neighbours", "bagged neighbours"


def object_contacts(times: int = 10) -> float:
    """Return the contacts of Section 2.4: objects, each so many times."""
    return float(len(OBJECTS) * times)


@simulated
def split_accuracy(classifier: str, part: str) -> float:
    """Return the mean accuracy over 20 splits, %; `part` is "cross_validated" or "tested"."""
    found = kept("classifiers")
    found = found[found["classifier"] == classifier]
    total = {"cross_validated": "trained", "tested": "tested_of"}[part]
    return float(100 * (found[part] / found[total]).mean())


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
