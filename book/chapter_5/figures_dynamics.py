"""Figures of Chapter 5 on the step tests: two models against seven runs."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from book.chapter_5 import step_sweep
from book.chapter_5.step_models import ANGLES, FINGERS, KINDS, compare, rms_error
from book.companion.exhibit import figure
from book.companion.style import GREY, LINEAR, LUDWICK, MEASURED, OTHER, VERMILION, WIDTH
from softgrip.errors import InvalidInputError
from softgrip.provenance import Provenance, data_folder
from softgrip.units import DEG

COLOURS = {"linear": (LINEAR, "-."), "ludwick": (LUDWICK, "--")}
WORDS = {"linear": "linear (5.17)", "ludwick": "Ludwick (5.16)"}
BOUND = 3.0
"""deg: the upper end of what Section 5.4 puts down to the material itself."""


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
    drawn = Figure(figsize=(WIDTH, 5.6))
    titles = ("(a) 60 deg, fitted to", "(b) 90 deg, predicted")
    for axes, test, title in zip(drawn.subplots(2, 1, sharex=True), tests, titles, strict=True):
        for k, run in enumerate(test.angles):
            axes.plot(test.time, run / DEG, color=GREY, lw=0.4, alpha=0.6,
                      label="" if k else "runs")  # fmt: skip
        axes.plot(test.time, test.angle / DEG, color=MEASURED, label="their mean")
        errors = []
        for kind in KINDS:
            model = models[kind].response(test.time, test.pressure)
            colour, dash = COLOURS[kind]
            axes.plot(test.time, model / DEG, color=colour, ls=dash, label=WORDS[kind])
            errors.append(f"{rms_error(model, test) / DEG:.1f}")
        axes.set(title=f"{title}: RMS {' and '.join(errors)} deg", ylabel="angle (deg)")
    axes.set_xlabel("time (s)")
    handles, labels = axes.get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside upper center", ncols=2)
    return drawn


WAY = (
    "Both models are fitted to the mean of (a) alone, Ludwick's with the estimated power of "
    "{numref}`tab-5-2`; driven by the measured pressure they then predict (b). RMS of the linear "
    "model first. The rig's spring is itself one of Ludwick's law."
)


@figure(
    "5.6",
    caption="Step tests of Design 1, Dragon Skin 20: seven runs of the *simulated* rig, their "
    f"mean, and the two models. {WAY}",
    alt="Two panels of angle over time. At 60 degrees both models lie on the mean of the runs. At "
    "90 degrees Ludwick's model still does, while the linear one, fitted at 60, climbs to about "
    "160 degrees.",
    provenance=Provenance.SIMULATED,
)
def figure_5_6(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw the tests of Design 1; ``logs`` gives other runs, those of the fitted test first."""
    return _draw("Design 1", logs)


@figure(
    "5.7",
    caption="Step tests of Design 2, Dragon Skin FX-Pro, on the *simulated* rig, as "
    f"{{numref}}`fig-5-6`. {WAY}",
    alt="Two panels of angle over time. At 60 degrees both models lie on the mean of the runs. At "
    "90 degrees Ludwick's model ends a few degrees below it, the linear one some twenty above.",
    provenance=Provenance.SIMULATED,
)
def figure_5_7(logs: tuple[Path | str, ...] = ()) -> Figure:
    """Draw the tests of Design 2; ``logs`` as for `figure_5_6`."""
    return _draw("Design 2", logs)


@figure(
    "5.C",
    caption="RMS error against the mean of seven *simulated* runs over the size of the step. "
    "Identified at 60 deg: the models of Figures 5.6 and 5.7. One for all: the one linear model "
    "that keeps the largest error of all steps up to this one least. Anew: identified at each "
    "step. Dotted: 3 deg; and 60 and 80 deg, up to which the text calls the linear model valid.",
    alt="Two panels with errors on a logarithmic scale. The linear model identified at 60 degrees "
    "has a sharp dip there and is above three degrees on both sides. One linear model for all "
    "steps passes three degrees at a step of about 40. Identified anew at each step, the linear "
    "model stays below three degrees beyond 120.",
    provenance=Provenance.SIMULATED,
)
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
            errors = [getattr(point, name) for point in points]
            axes.plot(angles, errors, marks, color=colour, ms=4, label=label)
        axes.axhline(BOUND, color=GREY, ls=":")
        for limit in (60, 80):
            axes.axvline(limit, color=GREY, ls=":")
        axes.set(yscale="log", ylim=(0.1, 100), ylabel="RMS error (deg)",
                 title=f"{design}, {FINGERS[design].material}")  # fmt: skip
    axes.set_xlabel("size of the step (deg)")
    handles, labels = axes.get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside upper center", ncols=1)
    return drawn
