"""A fit to logs in words: what they tell of a rig, what not, and which further log would."""

from collections.abc import Sequence
from textwrap import fill

import numpy as np

from softgrip.arrays import Floats
from softgrip.simulator.fit_combinations import told_together
from softgrip.simulator.fit_estimates import Estimate, Inferred
from softgrip.simulator.free_parameters import unit_of
from softgrip.simulator.next_experiment import Expected, expected
from softgrip.simulator.trial import Trial

WIDTH = 90
"""Of a line, characters."""
BAD_MISFIT = 1.3
"""Residuals over the noise from row to row, above which the model does not follow a log."""


def report(found: Inferred) -> str:
    """Return in words what logs tell of a rig, what not, and what would."""
    estimates = found.estimates
    lines = [
        _misfit(one, size) for one, size in zip(found.problem.trials, found.misfit, strict=True)
    ]
    for trial in found.problem.trials:
        lines += [f"  {words}" for words in trial.left_out]
    lines += ["", "told, with its 90 % interval:", *(_row(one) for one in estimates if one.told)]
    if unknown := [one for one in estimates if not one.told]:
        lines += ["", "these logs cannot tell:", *(_row(one) for one in unknown)]
        if combined := told_together(found):
            lines += ["", "but they tell:", *(_row(one) for one in combined)]
        lines += ["", *next_words(list(expected(found)), found.problem.trials[0].period)]
    return "\n".join(lines)


def _misfit(trial: Trial, size: Floats) -> str:
    channels = ["pressure", *(f"angle {k + 1}" for k in range(trial.fingers))]
    told = [f"{name} {s:.2f}" for name, s in zip(channels, size, strict=True) if np.isfinite(s)]
    bad = np.nanmax(size) > BAD_MISFIT
    words = ": the model does not follow it to within its noise" if bad else ""
    return f"{trial.name}: residuals over noise: {', '.join(told)}{words}"


def _row(one: Estimate) -> str:
    parts = one.name.split(" + ")
    unit = unit_of(parts[0]) if "*" not in one.name and "/" not in one.name else "1"
    unit = "" if unit == "1" else f" {unit}"
    return f"  {one.name:32} {one.value:.3g} ({one.low:.3g} to {one.high:.3g}){unit}"


def next_words(found: Sequence[Expected], period: float) -> list[str]:
    """Return what to do next, in lines, from what each experiment is expected to bring.

    Args:
        found: Best first.
        period: Of the rig, s.
    """
    lines = ["what a further log would bring, best first:"]
    for one in found:
        new = ", ".join(one.told) or "nothing new, but narrower intervals"
        lines.append(_wrapped(f"{one.candidate.words}: {new}"))
    best = found[0].candidate
    speeds = ", ".join(f"{speed:.5g}" for speed in best.speeds)
    periods = ", ".join(map(str, best.periods(period)))
    log = f"{best.name}.csv"
    option = "--clamped " if best.clamped else "--weight " if best.torque else ""
    torque = f" {best.torque:.3g}" if best.torque else ""
    return [
        *lines,
        "",
        "to record the best (speeds in rad/s, for so many periods each), from home and at rest:",
        _wrapped(f"commands = np.repeat([{speeds}], [{periods}])"),
        f'  record(rig, commands, len(commands) * rig.period, "{log}")',
        f"and fit again with: {option}{log}{torque}",
    ]


def _wrapped(words: str) -> str:
    return fill(words, WIDTH, initial_indent="  ", subsequent_indent="    ", break_on_hyphens=False)
