"""Chapter 5, figures and tables: the dynamic model, its two laws against seven runs, its limits."""

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from book.chapter_5 import step_protocols, step_sweep
from book.chapter_5.numbers import BOUND, printed_rms
from book.chapter_5.step_models import (
    ANGLES,
    FINGERS,
    KINDS,
    answer,
    compare,
    identified_at,
    rms_error,
)
from book.chapter_5.step_protocols import stated_stiffness
from book.companion.band import LABEL, shade
from book.companion.exhibit import figure, table
from book.companion.style import (
    BLUE,
    GREEN,
    GREY,
    LINEAR,
    LUDWICK,
    MEASURED,
    ORANGE,
    OTHER,
    PURPLE,
    VERMILION,
    WIDTH,
    sheet,
)
from softgrip.actuator.cantilever import angle_limit, closed_form_error
from softgrip.dynamics.consistency import agreements
from softgrip.dynamics.identify import Estimate
from softgrip.errors import InvalidInputError
from softgrip.provenance import Provenance, data_folder
from softgrip.units import DEG

COLOURS = {"linear": (LINEAR, "-."), "ludwick": (LUDWICK, "--")}
WORDS = {"linear": "linear (5.17)", "ludwick": "Ludwick (5.16)"}
STATED_LIMITS = (60, 80, 90)
"""deg: up to which Sections 5.5, 6.3 and 7.1, and 3.4 call the linear model valid."""
SHORT = ("at 60", "matched", "n of 5.2", "n of 5.1", "each", "at 30", "step", "stated K")
"""Names of `step_protocols.PROTOCOLS` that fit above a column."""
LIMITS = (0.05, 0.10)
"""Errors of the closed form that Figure 5.D marks."""
POWERS = {
    1.0: (ORANGE, "-"),
    1.05: (VERMILION, (0, (1, 1))),
    1.538: (GREEN, "--"),
    2.0: (PURPLE, "-."),
    2.5: (BLUE, (0, (5, 1, 1, 1, 1, 1))),
}
"""Fractional powers of Figure 5.D, and how each is drawn."""


def logs_of(design: str) -> tuple[str, ...]:
    """Return the names below ``data/`` of a finger's fourteen logs."""
    return tuple(path for angle in ANGLES for path in FINGERS[design].paths(angle))


def _draw(design: str, logs: tuple[Path | str, ...]) -> Figure:
    """Draw both tests of a finger; the first half of the logs is the test that is fitted to."""
    paths = logs or tuple(data_folder() / name for name in logs_of(design))
    if len(paths) < 2:
        raise InvalidInputError("logs", expected="runs of two tests, one half each", got=len(paths))
    half = len(paths) // 2
    tests, models = compare(design, (paths[:half], paths[half:]))
    drawn = Figure(figsize=(WIDTH, 5.8))
    titles = (f"(a) {ANGLES[0]} deg, fitted to", f"(b) {ANGLES[1]} deg")
    panels = drawn.subplots(2, 1, sharex=True)
    for axes, test, title, angle in zip(panels, tests, titles, ANGLES, strict=True):
        if not logs:
            shade(axes, f"{FINGERS[design].logs}-{angle}", MEASURED, label=LABEL)
        for k, run in enumerate(test.angles):
            label = "" if k else "runs"
            axes.plot(test.time, run / DEG, color=GREY, lw=0.4, alpha=0.6, label=label)
        axes.plot(test.time, test.angle / DEG, color=MEASURED, label="their mean")
        unmatched = models["linear"].response(test.time, test.pressure)
        axes.plot(
            test.time, unmatched / DEG, color=LINEAR, ls=":", lw=1, label="linear, gain of (a)"
        )
        errors = []
        for kind in KINDS:
            model = answer(kind, models[kind], test)
            colour, dash = COLOURS[kind]
            axes.plot(test.time, model / DEG, color=colour, ls=dash, label=WORDS[kind])
            errors.append(f"{rms_error(model, test) / DEG:.1f}")
        axes.set(title=f"{title}: RMS {' and '.join(errors)} deg", ylabel="angle (deg)")
    axes.set_xlabel("time (s)")
    drawn.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return drawn


@figure("5.6", Provenance.SIMULATED)
def figure_5_6(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw the tests of Design 1; ``logs`` gives other runs, those of the fitted test first."""
    return _draw("Design 1", logs)


@figure("5.7", Provenance.SIMULATED)
def figure_5_7(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw the tests of Design 2; ``logs`` as for `figure_5_6`."""
    return _draw("Design 2", logs)


@figure("5.C", Provenance.SIMULATED)
def figure_5_c() -> Figure:
    """Draw the errors of the models over the size of the step."""
    drawn = Figure(figsize=(WIDTH, 6.2))
    lines = (
        ("linear", "linear, identified at 60 deg", LINEAR, "o-"),
        ("linear_range", "linear, one for all up to here", VERMILION, "s-"),
        ("linear_again", "linear, anew at each step", OTHER, "^-"),
        ("ludwick", "Ludwick, identified at 60 deg", LUDWICK, "x--"),
    )
    for axes, design in zip(drawn.subplots(2, 1, sharex=True), FINGERS, strict=True):
        points = [point for point in step_sweep.KEPT.read() if point.design == design]
        angles = np.array([point.angle for point in points])
        for name, label, colour, marks in lines:
            errors = np.array([getattr(point, name) for point in points])
            # A step that tells no model has no error.
            told = np.isfinite(errors)
            axes.plot(angles[told], errors[told], marks, color=colour, ms=4, label=label)
        axes.axhline(BOUND, color=GREY, ls=":")
        for limit in STATED_LIMITS:
            axes.axvline(limit, color=GREY, ls=":")
        axes.set(yscale="log", ylim=(0.02, 400), ylabel="RMS error (deg)")
        axes.set_title(f"{design}, {FINGERS[design].material}")
    axes.set_xlabel("size of the step (deg)")
    drawn.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=1)
    return drawn


@figure(
    "5.D",
    Provenance.PRINTED,
    sources="computed from Eq. (5.12) and the exact integral of the cantilever; nothing measured",
)
def figure_5_d() -> Figure:
    """Draw the relative error of the closed form over the tip angle."""
    drawn, axes = sheet(3.6)
    degrees = np.arange(1.0, 61.0)
    for error in LIMITS:
        axes.plot([0, 60], [100 * error] * 2, color=GREY, lw=0.8)
    for n, (colour, line) in POWERS.items():
        errors = [100 * closed_form_error(angle * DEG, n) for angle in degrees]
        axes.plot(degrees, errors, color=colour, ls=line, label=f"n = {n:g}")
        limits = [angle_limit(error, n) / DEG for error in LIMITS]
        axes.plot(limits, [100 * error for error in LIMITS], "o", color=colour, ms=4)
    axes.set(xlabel="true tip angle (deg)", ylabel="closed form too large by (%)")
    axes.set(xlim=(0, 60), ylim=(0, 25))
    axes.legend(loc="upper left")
    return drawn


@table("5.C", Provenance.PRINTED)
def table_5_c() -> pd.DataFrame:
    """Tabulate what reduces to what."""
    return pd.DataFrame(
        {
            "of what to what": _subscripts(a.what),
            "ratio": f"{a.ratio:.3f}",
            "agree": "yes" if a.holds else "no",
        }
        for a in agreements()
    )


def _subscripts(words: str) -> str:
    return words.replace("_n", "ₙ")


def _interval(found: Estimate) -> str:
    return f"{found.value:.3g} ± {(found.high - found.low) / 2:.1g}"


@table("5.D", Provenance.SIMULATED)
def table_5_d() -> pd.DataFrame:
    """Tabulate the identified parameters beside the stiffness that the text states."""
    rows = []
    for design in FINGERS:
        for kind in KINDS:
            found = identified_at(design, kind)
            rows.append(
                {
                    "finger": design,
                    "model": WORDS[kind],
                    "mass": _interval(found.mass),
                    "damping": _interval(found.damping),
                    "stiffness": _interval(found.stiffness),
                    "fit": f"{found.fit_percent:.1f}",
                    "stated stiffness": f"{stated_stiffness(design, kind):.3g}",
                }
            )
    return pd.DataFrame(rows)


@table("5.E", Provenance.SIMULATED)
def table_5_e() -> pd.DataFrame:
    """Tabulate the eight errors under each protocol."""
    kept = step_protocols.kept_errors()
    return pd.DataFrame(
        {
            "test": f"{design}, {angle} deg",
            "model": kind.capitalize(),
            "printed": f"{printed:.2f}",
            **{
                short: _degrees(errors[design, angle, kind])
                for short, errors in zip(SHORT, kept.values(), strict=True)
            },
        }
        for (design, angle, kind), printed in printed_rms().items()
    )


def _degrees(error: float) -> str:
    return "no fit" if np.isnan(error) else f"{error:.2f}" if error < 100 else f"{error:.0f}"
