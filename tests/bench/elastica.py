"""Step responses of one finger: ours against PyElastica, a library of Cosserat rods.

The finger is Design 1 as a solid rectangle with n = 1, and a force across its tip is switched on.
PyElastica's rods are round: the radius is the one that gives the rectangle's ``E I``. Its first
frequency is to be the finger's, which no rubber of that size has, so the uniform rod is given the
density that brings it out. That makes waves slow and steps long, to PyElastica's advantage; what a
rod of rubber's own density with a mass at its tip takes is said beside it.

PyElastica is fetched by uv into an environment of its own, and is no dependency of the package.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from softgrip.actuator.cantilever import bend, tip_force_angle
from softgrip.actuator.frequency import spring_constant
from softgrip.dynamics import ludwick, second_order
from softgrip.dynamics.integrate import step_for
from tests.bench.elastica_runs import (
    COURANT,
    DAMPING_RATIO,
    FINGER,
    FREQUENCY,
    RADIUS,
    RUBBER,
    SAMPLES,
    SECONDS,
    SMALL,
    TIPPED,
    UNIFORM,
    VERSION,
    Elastica,
    elastica,
)
from tests.bench.entry import Entry, entry, spread, timed

WANTED = 100
MODERATE = 0.5
"""A tip angle by Eq. (3.13), rad."""
CALLS = 20
"""Of a single run of ours in a row: one alone is over before the processor has settled."""


def closed_form(times: np.ndarray) -> np.ndarray:
    """Return our step response, exact for n = 1, rad."""
    return SMALL * second_order.step_response(times, FREQUENCY, DAMPING_RATIO)


def integrated(times: np.ndarray, step: float, runs: int) -> np.ndarray:
    """Return the same by the integration of Eq. (5.16) that serves any n, rad, (N, runs)."""
    K = spring_constant(FINGER)
    mass = K / FREQUENCY**2
    finger = ludwick.LudwickFinger(mass, 2 * DAMPING_RATIO * FREQUENCY * mass, K, 1.0)
    parts = ludwick.step_responses(finger, SMALL * K, times, step, runs=runs)
    return np.concatenate([angle for _, angle in parts], axis=1)


def entries(
    *, elements: Sequence[int] = (20, 40), runs: int = 1000, repetitions: int = 11
) -> list[Entry]:
    """Return times and tip angles, ours and PyElastica's; ours alone without `elements`."""
    times = np.linspace(0, SECONDS, SAMPLES)
    choice = step_for(1e-3 * SMALL, lambda step: integrated(times, step, 1), first=0.4)
    ours = {
        "closed form": lambda: [closed_form(times) for _ in range(CALLS)],
        "Ludwick": lambda: [integrated(times, choice.step, 1) for _ in range(CALLS)],
        f"Ludwick, one of {runs:,}": lambda: integrated(times, choice.step, runs),
    }
    shares = np.array([CALLS, CALLS, runs])

    def turn() -> np.ndarray:
        return np.array([timed(function) for function in ours.values()]) / shares

    how = (
        f"{SECONDS:g} s of Design 1, n = 1, {SAMPLES} angles; single runs {CALLS} in a row;"
        f" Runge-Kutta step {1e3 * choice.step:g} ms, error {choice.error:.1g} rad of {SMALL:g}."
    )
    if not elements:
        return _alone(list(ours), np.array([turn() for _ in range(repetitions)]), how)
    with elastica() as started:
        if isinstance(started, str):
            reason = f"{how} PyElastica {VERSION} could not be run: {started}"
            return _alone(list(ours), np.array([turn() for _ in range(repetitions)]), reason)
        found = []
        for count in elements:
            # They take turns, so that a machine that slows down slows all of them.
            turns = [
                [started.run(UNIFORM, count)["seconds"], *turn()] for _ in range(repetitions + 1)
            ]
            found += _against(started, count, list(ours), np.array(turns[1:]), how)
        return found


def _alone(names: Sequence[str], times: np.ndarray, note: str) -> list[Entry]:
    return [
        entry(f"step response, {name}", float(value), "s", None, "", None, note)
        for name, value in zip(names, np.median(times, axis=0), strict=True)
    ]


def _against(
    started: Elastica, count: int, names: Sequence[str], times: np.ndarray, how: str
) -> list[Entry]:
    theirs, *ours = (float(value) for value in np.median(times, axis=0))
    unstable = started.run(UNIFORM, count, courant=1.0)["angles"][-1]
    tipped = started.run(TIPPED, count)
    note = (
        f"{how} Baseline: PyElastica {VERSION}, {count} elements, uniform round rod of equal E I"
        f" (radius {1e3 * RADIUS:.2f} mm) and first frequency (density {UNIFORM.density:,.0f}"
        f" kg/m^3), step {1e3 * UNIFORM.step(count):.2g} ms (at 1/{COURANT:g} of it the rod"
        f" blows up, and ends at {unstable:.2g} rad), rates damped by 2 zeta omega; import,"
        f" compilation and set-up not counted; {spread(times[:, 0])}. A rod of rubber"
        f" ({RUBBER:g} kg/m^3) with {TIPPED.tip_mass:.2g} kg at its tip takes"
        f" {tipped['seconds']:.2g} s, in one run."
    )
    found = [
        entry(
            f"step response, {name}, PyElastica {count}", value, "s", theirs,
            f"ratio >= {WANTED}", theirs / value >= WANTED,
            note if name == names[0] else "As above.",
        )
        for name, value in zip(names, ours, strict=True)
    ]  # fmt: skip
    return [*found, *_accuracy(started, count, tipped)]


def _accuracy(started: Elastica, count: int, tipped: dict[str, Any]) -> list[Entry]:
    found = []
    for angle in (SMALL, MODERATE):
        run = started.run(UNIFORM, count, angle)
        force = angle * spring_constant(FINGER)
        true, last = bend(FINGER, force=force).tip_angle, run["angles"][-1]
        deviations = []
        for kind, response in (("uniform", run), ("tip mass", tipped)):
            if kind == "uniform" or angle == SMALL:
                mine = closed_form(np.array(response["times"])) * angle / SMALL
                gap = np.abs(np.array(response["angles"]) - mine).max() / angle
                deviations.append(f"{100 * gap:.1f} % ({kind})")
        settled = float(closed_form(np.array(run["times"]))[-1]) * angle / SMALL
        found.append(
            entry(
                f"tip angle at {SECONDS:g} s, {angle:g} rad, PyElastica {count}",
                last, "rad", true, "", None,
                f"Baseline: the exact static shape. F L^2/(2 E I) = "
                f"{tip_force_angle(FINGER, force):.4g} rad, from which PyElastica is off by"
                f" {100 * (last / angle - 1):+.1f} %, the exact shape by"
                f" {100 * (true / angle - 1):+.1f} % and our model by"
                f" {100 * (settled / angle - 1):+.1f} %. The clamp takes PyElastica's whole first"
                f" element: 1/{count} too little. Largest difference from our response over"
                f" {SECONDS:g} s: {', '.join(deviations)}; 11 % of the uniform rod's tip angle"
                " comes from higher modes, which ours has not.",
            )
        )  # fmt: skip
    value = started.frequency(UNIFORM, count)
    note = (
        "Without damping, fitted over 12 s at a tenth of the force. Baseline: the finger's, which"
        " is Euler and Bernoulli's first of this rod. Of so thick a rod, shear and rotary inertia"
        f" take 5 %, and the clamp's whole element makes it shorter. With the mass at the tip"
        f" {started.frequency(TIPPED, count):.3f} rad/s. Rubber alone, without that mass:"
        f" {FREQUENCY * (UNIFORM.density / RUBBER) ** 0.5:.0f} rad/s."
    )
    name = f"first frequency, PyElastica {count}"
    return [*found, entry(name, value, "rad/s", FREQUENCY, "", None, note)]
