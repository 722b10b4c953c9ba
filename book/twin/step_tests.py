"""The step tests in open loop of Chapters 3 and 5 on many rigs, and what they identify."""

from itertools import count

import numpy as np

from book.chapter_5.step_models import TORQUE_PER_PRESSURE
from book.twin import rigs
from book.twin.experiments import Records
from book.twin.identification import (
    SecondOrders,
    fit_ludwick,
    identify_second_order,
    ludwick_responses,
    second_order_responses,
)
from book.twin.laboratory import Laboratory
from book.twin.least_squares import Which, differences, fit
from softgrip.arrays import Floats
from softgrip.logs.steps import END
from softgrip.units import DEG, MM

Measures = dict[str, Floats]
"""By name, in the unit of the print, shape (rigs,)."""

ANGLES = (60, 90)
"""Set points of Section 5.4, deg."""
DESIGNS = {"design-1": (rigs.design_1, 2.365), "design-2": (rigs.design_3, 1.727)}
"""Chapter 5's fingers, with the estimated power of Table 5.2."""
FORCE_PER_PRESSURE = TORQUE_PER_PRESSURE / (94 * MM)
"""N/Pa; it scales mass, damping and stiffness alike, and no response."""


TRUE = ("true_pressure", "true_angle")


def _each(test: Records, mean: SecondOrders) -> SecondOrders:
    """Identify each run of a test, of known mean, without the sensors; shape (rigs, runs)."""
    start = SecondOrders(*(values[:, None] for values in vars(mean).values()))
    return identify_second_order(
        test.time, test.true_pressure, test.true_angle[:, :, 0], start=start
    )


def frequencies(lab: Laboratory) -> Measures:
    """Return what steps without sensors identify, Tables 3.2 and 3.3, rad/s.

    The frequency of the mean of seven runs, and the deviation of those of the single runs.
    """
    makers: dict[str, rigs.Make] = {f"row-{k}": rigs.table_3_2_row(k) for k in (1, 2, 3, 4)}
    makers |= {"design-2": rigs.design_2, "design-3": rigs.design_3}
    found: Measures = {}
    for name, make in makers.items():
        test = lab.step_test(make, lab["choice.frequency_step"] * DEG, keep=TRUE)
        mean = identify_second_order(
            test.time, test.true_pressure.mean(axis=1), test.true_angle[:, :, 0].mean(axis=1)
        )
        found[name] = mean.natural_frequency
        if not name.startswith("row") or name == "row-1":
            found[f"deviation-{name}"] = _each(test, mean).natural_frequency.std(axis=1, ddof=1)
    return found


def damping(lab: Laboratory) -> Measures:
    """Return the damping ratio of the first step test, and its deviation over the runs."""
    return {
        "mean": lab.finger.damping_ratio,
        "deviation": _each(lab.first_step, lab.finger).damping_ratio.std(axis=1, ddof=1),
    }


def models(lab: Laboratory) -> Measures:
    """Return the RMS errors of Section 5.4, deg, the mean fit, %, and the runs' own deviation, deg.

    Both models are identified at 60 deg, on what is measured; a choice says how far the gain of the
    linear one is then matched to where each test ends. The deviation is that of the single
    runs from their mean, without the sensors, over both tests of both fingers.
    """
    found: Measures = {}
    fits, own = [], []
    for design, (make, power) in DESIGNS.items():
        first = design == "design-1"
        tests = [
            lab.first_step if first and at == 60 else lab.step_test(make, _set_point(lab, at))
            for at in ANGLES
        ]
        means = [(t.pressure.mean(axis=1), t.angle[:, :, 0].mean(axis=1)) for t in tests]
        time, period = tests[0].time, float(tests[0].time[1] - tests[0].time[0])
        line = identify_second_order(time, *means[0], offset=False)
        bent = fit_ludwick(time, *means[0], power, FORCE_PER_PRESSURE)
        for at, (pressure, angle) in zip(ANGLES, means, strict=True):
            frequency, ratio = line.natural_frequency, line.damping_ratio
            unit = second_order_responses(pressure, period, frequency, ratio)
            linear = line.gain[:, None] * unit
            ends = [x[:, time >= time[-1] - END].mean(axis=1) for x in (angle, linear)]
            matched = (ends[0] / ends[1]) ** lab["choice.linear_matched"]
            made = {
                "linear": matched[:, None] * linear,
                "ludwick": ludwick_responses(bent, time, pressure, FORCE_PER_PRESSURE),
            }
            for kind, model in made.items():
                error = np.sqrt(np.mean((model - angle) ** 2, axis=1))
                found[f"{design}-{at}-{kind}"] = error / DEG
                if kind == "ludwick" and at == 60:
                    fits.append(100 * (1 - error / angle.std(axis=1)))
        true = [t.true_angle[:, :, 0] for t in tests]
        own += [(t - t.mean(axis=1, keepdims=True)).std(axis=(1, 2)) / DEG for t in true]
    return {**found, "fit": np.mean(fits, axis=0), "runs": np.mean(own, axis=0)}


def _set_point(lab: Laboratory, degrees: float) -> Floats:
    return np.full(lab.count, degrees * DEG)


LEVEL, LEVELS = 10, 14
"""Distance of the steps that `linear_range` tries, deg, and their number."""
WEIGHINGS = 30
"""Of the tests, until the largest error of one model for all is least."""
GAP = 0.005
"""Share by which it may be above the least."""


def linear_range(lab: Laboratory) -> Measures:
    """Return up to which step one linear model stays within a bound, deg.

    Steps of 10, 20, ... deg, without sensors. The linear model is the one whose largest RMS error
    over the steps up to this one is least.
    """
    bound = lab["choice.linear_bound"]
    return {name: reached(errors, bound) for name, errors in linear_errors(lab, bound).items()}


def linear_errors(lab: Laboratory, bound: Floats) -> Measures:
    """Return the errors of the linear models for all steps of 0, 10, 20, ... deg and less, deg.

    By design, shape (steps, rigs): up to where all pass their bound, deg, shape (rigs,). Rising: a
    larger step makes no error smaller.
    """
    found: Measures = {}
    for design, (make, _) in DESIGNS.items():
        tests: list[Records] = []
        errors = [np.zeros(lab.count)]
        for level in count(1):
            tests.append(lab.step_test(make, _set_point(lab, LEVEL * level), keep=TRUE))
            errors.append(least_largest_error(tests) / DEG)
            if level == LEVELS or (errors[-1] > bound).all():
                break
        found[design] = np.maximum.accumulate(errors, axis=0)
    return found


def reached(errors: Floats, bound: Floats) -> Floats:
    """Return the steps at which `linear_errors` pass bounds, deg, shape (rigs,).

    Where they do not it is the largest that was tried.
    """
    levels = LEVEL * np.arange(len(errors))
    return np.array([np.interp(b, e, levels) for b, e in zip(bound, errors.T, strict=True)])


def least_largest_error(tests: list[Records]) -> Floats:
    """Return the largest RMS error over tests of the linear model that keeps it least, rad.

    By Lawson's weights: each test counts by what was its error, until the largest ones are alike.
    """
    time = tests[0].time
    pressure = np.stack([t.true_pressure.mean(axis=1) for t in tests], axis=1)
    angle = np.stack([t.true_angle[:, :, 0].mean(axis=1) for t in tests], axis=1)
    size, period = angle.shape[1], float(time[1] - time[0])
    first = identify_second_order(time, pressure[:, -1], angle[:, -1])
    x = np.log([first.natural_frequency, first.damping_ratio, first.gain]).T
    weights = np.full(angle.shape[:2], 1 / size)

    def residual(x: Floats, which: Which) -> Floats:
        own = left[which]
        w, z, k = np.repeat(np.exp(x), size, axis=0).T
        made = second_order_responses(pressure[own].reshape(len(w), -1), period, w, z) * k[:, None]
        off = made.reshape(len(x), size, -1) - angle[own]
        return np.asarray((np.sqrt(weights[own])[..., None] * off).reshape(len(x), -1))

    left, best = np.arange(len(x)), np.full(len(x), np.inf)
    for _ in range(WEIGHINGS):
        x[left] = fit(differences(residual), x[left], most=10)
        off = residual(x[left], np.arange(left.size)).reshape(left.size, size, -1)
        squares = np.sum(off**2, axis=-1) / off.shape[-1]
        errors = np.sqrt(squares / weights[left])
        best[left] = np.minimum(best[left], errors.max(axis=1))
        weights[left] *= errors
        weights[left] /= weights[left].sum(axis=1, keepdims=True)
        # No model has a smaller largest error than this one's mean by the weights.
        left = left[best[left] > (1 + GAP) * np.sqrt(squares.sum(axis=1))]
        if not left.size:
            break
    return best


FAST = {"frequencies": frequencies, "damping": damping, "models": models}
SLOW = {"linear range": linear_range}
