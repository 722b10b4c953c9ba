"""The tests of the pad in Chapter 2 on many pads: kinds of contact, weights, lift forces.

The pads of one seed differ in their parameters alone.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from sklearn.model_selection import StratifiedKFold

from book.twin.laboratory import Laboratory
from book.twin.rigs import Row
from book.twin.space import rows
from book.twin.step_tests import Measures
from softgrip.arrays import Floats
from softgrip.simulator.chance import SEED, streams
from softgrip.simulator.force_layer import ForceLayer
from softgrip.simulator.force_tests import put_down, weight_forces
from softgrip.simulator.pad import convert, make_pad, to_volts, voltages
from softgrip.simulator.pad_contact import bed_points, element_forces, spring_stiffness
from softgrip.simulator.pad_hand import FULL
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_range import NOISES
from softgrip.simulator.pad_surface import gap
from softgrip.simulator.pad_tests import BETWEEN, PAD_SEED, PAD_TESTS, PadTest, draw_contacts
from softgrip.tactile.contact_kind import bagged_neighbours, classifiers, nearest_neighbours
from softgrip.tactile.contact_pose import place_errors
from softgrip.tactile.contacts import ELEMENTS, Contacts
from softgrip.tactile.element import Element
from softgrip.tactile.element_sensitivity import AT_REST, CEILING
from softgrip.tactile.force import table_2_2
from softgrip.tactile.friction import lift_force, printed_grasps
from softgrip.tactile.kind_evaluation import (
    FOLDS,
    accuracy,
    right_on_new,
    split_score,
    train_and_test,
)
from softgrip.tactile.nadaraya_watson import FINEST, STEPS
from softgrip.units import GRAM_FORCE

NEIGHBOURS = range(1, 11)
SINGLE, BAGGED = "k-nearest neighbours", "bagged neighbours"
FIELDS = ("young_modulus", "cover", "spread", "rest_spread", "gain_spread", "stiffness_spread",
          "height_spread", "repeatability", "noise", "tilt")  # fmt: skip
TIMES = 10
"""Measurements of each object of Table 2.2."""


def pad_of(row: Row) -> PadParameters:
    """Return the pad of a set of values."""
    own: dict[str, Any] = {name: row[f"pad.{name}"] for name in FIELDS}
    return replace(PadParameters(), element=Element("pyramid", cut=row["pad.cut"]), **own)


def layer_of(row: Row) -> ForceLayer:
    """Return the force layer of a set of values."""
    return ForceLayer(
        soft_force=row["layer.soft_force"],
        memory=(row["layer.memory_fast"], row["layer.memory_slow"]),
        voltage_noise=row["layer.voltage_noise"],
        seating=row["layer.seating"],
        object_seating=row["layer.object_seating"],
    )


def felt(test: PadTest, parameters: PadParameters) -> Contacts:
    """Return the contacts of a test as a pad feels them, normalised as those of a log are."""
    pad = make_pad(parameters, PAD_SEED)
    laid, noise = streams(test.seed, 0)
    count = 0

    def read(forces: Floats) -> Floats:
        nonlocal count
        count += 1
        counts = convert(voltages(pad, forces, BETWEEN * count, noise), parameters)
        return to_volts(counts, parameters)

    rest = read(np.zeros(ELEMENTS))[:ELEMENTS]
    full = np.array([read(FULL * one)[k] for k, one in enumerate(np.eye(ELEMENTS))])
    points, drawn, gaps = bed_points(parameters), [], []
    for item, pose, force in draw_contacts(test, parameters.tilt, laid):
        drawn.append((item, pose, force))
        gaps.append(gap(item, pose, points, laid) - pad.height[:, None])
    # As `simulator.pad.press`, of all contacts at once.
    springs = np.array([spring_stiffness(parameters, item.softness) for item, _, _ in drawn])
    shares = np.array([force for _, _, force in drawn])
    volts, times = [], []
    for forces in element_forces(np.array(gaps), springs, pad.compliance, shares):
        volts.append(read(forces))
        times.append(BETWEEN * count)
    seen = np.array(volts)
    return Contacts(
        responses=np.clip((seen[:, :ELEMENTS] - rest) / (full - rest), 0, 1),
        layer=seen[:, ELEMENTS],
        times=np.array(times),
        kinds=np.array([item.kind for item, _, _ in drawn]),
        objects=np.array([item.name for item, _, _ in drawn]),
        places=np.array([pose.place for _, pose, _ in drawn]),
        angles=np.array([p.angle if item.kind == "line" else np.nan for item, p, _ in drawn]),
        forces=shares,
    )


def _columns(lab: Laboratory, measure: Callable[[Row], dict[str, float]]) -> Measures:
    """Measure each pad by itself, and those that are alike once."""
    own = {name: lab[name] for name in lab.values if name.startswith("pad.")}
    pads, which = np.unique(np.stack([*own.values()], axis=1), axis=0, return_inverse=True)
    found = [measure(row) for row in rows(dict(zip(own, pads.T, strict=True)))]
    return {name: np.array([one[name] for one in found])[which] for name in found[0]}


def elements(lab: Laboratory) -> Measures:
    """Return the forces at which a pyramid begins to feel, and reaches its ceiling, N.

    `simulator.pad_range` in closed form: the resistance grows as a thinner film's does.
    """
    pad = PadParameters()
    area = pad.element.base_area * lab["pad.cut"]
    step = np.maximum(lab["pad.noise"], pad.supply / pad.levels)
    ohms = NOISES * step * pad.gain_resistor / pad.reference
    stiff = lab["pad.young_modulus"] * area
    return {"least": stiff * ohms / (AT_REST + ohms), "ceiling": stiff * (1 - AT_REST / CEILING)}


def lifts(lab: Laboratory) -> Measures:
    """Return the estimated lift forces at rest, Eq. (2.9), N.

    The controller brings the measured force to the desired one, so that these are printed ones
    times the friction.
    """
    per_friction = {name: lift_force(float(g.contact), 1.0) for name, g in printed_grasps().items()}
    return {name: lab["choice.friction"] * one for name, one in per_friction.items()}


def weights(lab: Laboratory) -> Measures:
    """Return Table 2.2: mean and deviation of ten measurements of each object, gf.

    And the mean of the deviations, N. The regressor of Section 2.3 is fitted to the 69 points.
    """
    layer = layer_of({name: lab[name][:, None] for name in lab.values if name.startswith("layer.")})
    known = put_down(weight_forces(), seed=SEED, run=0, layer=layer)
    width = best_bandwidths(known.voltage, known.force)
    objects = table_2_2()
    forces = np.repeat([weighed.true for weighed in objects.values()], TIMES)
    made = put_down(forces, seed=SEED, run=2, layer=layer, seating=layer.object_seating)
    far = (made.voltage[..., None] - known.voltage[:, None]) ** 2
    found = average(far, width, known.force).reshape(lab.count, -1, TIMES) / GRAM_FORCE
    mean, deviation = found.mean(axis=2).T, found.std(axis=2, ddof=1).T
    return {
        **dict(zip(objects, mean, strict=True)),
        **dict(zip((f"deviation-{name}" for name in objects), deviation, strict=True)),
        "deviation": deviation.mean(axis=0) * GRAM_FORCE,
    }


def average(squares: Floats, bandwidth: Floats, targets: Floats) -> Floats:
    """Return the averages of Eq. (2.6), shape (rigs, queries).

    Args:
        squares: Of distances, shape (rigs, queries, points).
        bandwidth: Of each rig, same unit, shape (rigs,).
        targets: Shape (points,).
    """
    weights = _weights(squares, bandwidth)
    return np.asarray(weights @ targets / weights.sum(axis=-1))


def _weights(squares: Floats, bandwidth: Floats) -> Floats:
    # By that of the nearest point, as `tactile.kernel_average.gaussian`.
    beyond = squares - squares.min(axis=-1, keepdims=True)
    return np.asarray(np.exp(beyond * (-0.5 / bandwidth[:, None, None] ** 2)))


RIGS = 8
"""Whose weights the processor's cache holds at a time."""


def best_bandwidths(points: Floats, targets: Floats) -> Floats:
    """Return what `tactile.nadaraya_watson.best_bandwidth` chooses for each rig, shape (rigs,).

    A point's group are those of its target. Bandwidths are in equal ratios, so that the weights of
    one are the tenth powers of those of another, half a decade above.

    Args:
        points: Of one feature, shape (rigs, points).
        targets: Shape (points,).
    """
    found = []
    others = np.where(targets[:, None] == targets, np.inf, 0.0)
    for own in np.array_split(points, range(RIGS, len(points), RIGS)):
        tried = np.ptp(own, axis=1) * np.geomspace(FINEST, 1, STEPS)[:, None]
        squares = (own[:, :, None] - own[:, None]) ** 2 + others
        errors = np.empty(tried.shape)
        for first in range(HALF_DECADE):
            for k in range(STEPS - 1 - first, -1, -HALF_DECADE):
                if k == STEPS - 1 - first:
                    weights = _weights(squares, tried[k])
                else:
                    half = weights * weights
                    half *= half
                    half *= weights
                    weights = half * half
                off = weights @ targets / weights.sum(axis=-1) - targets
                errors[k] = np.einsum("rp,rp->r", off, off)
        found.append(tried[np.argmin(errors, axis=0), np.arange(len(own))])
    return np.concatenate(found)


HALF_DECADE = round((STEPS - 1) / np.log10(1 / FINEST) / 2)
"""Bandwidths in it: 10."""


def kinds(lab: Laboratory) -> Measures:
    """Return the accuracies of Sections 2.3 and 2.4, %, the best k, and the elements of a line."""
    return _columns(lab, lambda row: _kinds(pad_of(row), lab.splits))


def _kinds(parameters: PadParameters, splits: int) -> dict[str, float]:
    training, objects = (
        felt(PAD_TESTS[name], parameters) for name in ("pad-training", "pad-objects")
    )
    x, y = training.responses, training.kinds

    def on_objects(model: Any) -> float:
        right = right_on_new(model, x, y, objects.responses, objects.kinds)
        return 100 * accuracy(right).share

    by_name = {name: _scores(training, _named(name), splits) for name in classifiers()}
    by_k = np.mean([right_by_k(training, seed) for seed in range(splits)], axis=0)
    others = [found for name, found in by_name.items() if name not in (SINGLE, BAGGED)]
    accuracies = {"single": by_name[SINGLE], "bagged": by_name[BAGGED]}
    accuracies["others"] = tuple(np.max(others, axis=0).tolist())
    line = place_errors(objects, parameters.layout).elements[objects.kinds == "line"]
    # Of whole numbers, the one that is reached, none between two of them.
    least, most = np.quantile(line, (0.1, 0.9), method="inverted_cdf")
    return {
        "best-k": float(NEIGHBOURS[int(np.argmax(by_k))]),
        **{f"{name}-training": trained for name, (trained, _) in accuracies.items()},
        **{f"{name}-testing": tested for name, (_, tested) in accuracies.items()},
        "objects-single": on_objects(nearest_neighbours()),
        "objects-bagged": on_objects(bagged_neighbours()),
        "line-least": float(least),
        "line-most": float(most),
    }


def _named(name: str) -> Callable[[int], Any]:
    return lambda seed: classifiers(seed)[name]


def right_by_k(felt: Contacts, seed: int) -> Floats:
    """Return `kind_evaluation.split_score`'s share cross-validated, for each of `NEIGHBOURS`.

    The neighbours of the largest k are sought once: the first of them are those of the others.
    """
    train, _ = train_and_test(felt.kinds, seed=seed)
    x, labels = felt.responses[train], felt.kinds[train]
    codes = labels[:, None] == np.unique(labels)
    right = np.empty((labels.size, len(NEIGHBOURS)))
    for known, left in StratifiedKFold(FOLDS, shuffle=True, random_state=seed).split(x, labels):
        model = nearest_neighbours(NEIGHBOURS[-1]).fit(x[known], labels[known])
        near = model[-1].kneighbors(model[:-1].transform(x[left]), return_distance=False)
        told = np.cumsum(codes[known][near], axis=1).argmax(axis=2)
        right[left] = told == codes[left].argmax(axis=1)[:, None]
    return np.asarray(right.mean(axis=0))


def _scores(felt: Contacts, make: Callable[[int], Any], splits: int) -> tuple[float, ...]:
    """Return the mean accuracies over the splits, cross-validated and tested, %."""
    found = [split_score(make(k), felt.responses, felt.kinds, seed=k) for k in range(splits)]
    both = [(one.cross_validated.share, one.tested.share) for one in found]
    return tuple((100 * np.mean(both, axis=0)).tolist())


FAST = {"pad elements": elements, "lifts": lifts, "weights": weights}
SLOW = {"kinds": kinds}
