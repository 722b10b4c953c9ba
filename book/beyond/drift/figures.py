"""Figures of the page on drift, one function each."""

from collections.abc import Callable

import numpy as np
from IPython.display import SVG
from matplotlib.figure import Figure

from book.beyond.drift.kept import LAYERS, row
from book.beyond.drift.methods import SPREAD, Case
from book.beyond.drift.sessions import HOURS, START, bridge_of, session
from book.beyond.drift.study import FITTED, KNOWN, NONE, SETTINGS, SPREADS, TEXT
from book.beyond.drift.tasks import SEED
from book.companion.claims import printed
from book.companion.save import svg
from book.companion.style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, sheet, style
from softgrip.arrays import Floats
from softgrip.simulator.fitted_rigs import fitted_layer
from softgrip.tactile.drift_model import HOUR, DriftSize
from softgrip.tactile.drift_track import TrackedDrift, track_drift
from softgrip.units import GRAM_FORCE

SHOWN = {
    NONE: ("no correction", GREY, ":"),
    TEXT: ("text: 4 weights at the start", ORANGE, "--"),
    SPREADS[0]: ("tracked, no weight", GREEN, "-."),
    SPREADS[2]: ("tracked, 2 weights", BLUE, "-"),
    KNOWN: ("drift known", BLACK, (0, (1, 1))),
}
"""Methods that are drawn: label, colour and dash."""


def show(draw: Callable[[], Figure]) -> SVG:
    """Show a figure in the book's style."""
    with style():
        return SVG(svg(draw()))  # type: ignore[no-untyped-call]


def one_session() -> tuple[Case, TrackedDrift, TrackedDrift]:
    """Return a session of the fitted layer, tracked with pauses alone and with two weights."""
    size = DriftSize()
    case = Case(session(fitted_layer(), size, SEED), size)
    record = case.session.record
    alone, weighed = (
        track_drift(
            record.time[case.at],
            record.voltage[case.at],
            case.model,
            weights=case.spread(count),
            calibrated_at=-START * HOUR,
            size=size,
            law=bridge_of(case.session.layer),
            rests=case.rests,
            noise=case.noise,
        )
        for count in (0, 2)
    )
    return case, alone, weighed


def draw_session() -> Figure:
    """Draw what is tracked in one session: offset and gain, and the true ones."""
    case, alone, weighed = one_session()
    record = case.session.record
    drawn, (upper, lower) = sheet(5.0, 2, 1, sharex=True)
    hours = record.time[case.at] / HOUR
    for axes, name, unit in ((upper, "gain", 100.0), (lower, "offset", 1e3)):
        true: Floats = getattr(record, name)[case.at]
        axes.plot(hours, unit * true, color=BLACK, label="true")
        for found, colour, dash, label in (
            (alone, GREEN, "-.", "pauses alone"),
            (weighed, BLUE, "-", "pauses and 2 weights"),
        ):
            axes.plot(hours, unit * getattr(found, name), color=colour, ls=dash, label=label)
    for weight in case.spread(2):
        for axes in (upper, lower):
            axes.axvline(weight.time / HOUR, color=VERMILION, lw=0.8, ls=":")
    upper.set(title="(a) gain", ylabel="gain (%)")
    lower.set(title="(b) offset", ylabel="offset (mV)", xlabel="time in the session (h)")
    upper.legend(loc="best")
    return drawn


def draw_hours() -> Figure:
    """Draw the error of each hour, by method: the median of the sessions."""
    drawn, panels = sheet(5.6, 2, 1, sharex=True, sharey=True)
    middle = np.arange(HOURS) + 0.5
    for axes, (layers, label) in zip(panels, LAYERS.items(), strict=True):
        for method, (name, colour, dash) in SHOWN.items():
            one = row(method, layers)
            hourly = [getattr(one, f"hour_{k + 1}") / GRAM_FORCE for k in range(HOURS)]
            axes.plot(middle, hourly, color=colour, ls=dash, label=name)
        axes.set(title=label, ylabel="error (gf)")
    # Of both at once, when all is drawn.
    panels[0].set_ylim(0, None)
    panels[-1].set_xlabel("time in the session (h)")
    drawn.legend(
        *panels[0].get_legend_handles_labels(), loc="outside lower center", fontsize=9, ncols=2
    )
    return drawn


def draw_weights() -> Figure:
    """Draw the accuracy over the number of weights of a session."""
    drawn, panels = sheet(5.2, 2, 1, sharex=True)
    places = np.arange(len(SPREAD))
    for axes, (layers, label) in zip(panels, LAYERS.items(), strict=True):
        rows = [row(SPREADS[count], layers) for count in SPREAD]
        middle = np.array([one.accuracy for one in rows])
        low, high = (np.array([getattr(one, f"accuracy_{end}") for one in rows]) for end in
                     ("low", "high"))  # fmt: skip
        axes.errorbar(
            places, middle, (middle - low, high - middle), color=BLUE, marker="o", ls="-",
            capsize=3, label="tracked",
        )  # fmt: skip
        text = row(TEXT, layers)
        at = [SPREAD.index(text.weights) + 0.18]
        axes.errorbar(
            at, [text.accuracy],
            ([text.accuracy - text.accuracy_low], [text.accuracy_high - text.accuracy]),
            color=ORANGE, marker="s", ls="none", capsize=3, label="text",
        )  # fmt: skip
        axes.axhline(printed("2.4-mean-accuracy"), color=GREY, ls="--", label="printed")
        axes.set(title=label, ylabel="accuracy (%)", ylim=(78, 100))
    panels[-1].set_xticks(places, [f"{count}" for count in SPREAD])
    panels[-1].set_xlabel("known weights in eight hours")
    panels[0].legend(loc="lower right", ncols=3)
    return drawn


def draw_settings() -> Figure:
    """Draw the error in each setting: the text's, and tracked by none and by two weights."""
    names = [name for name in SETTINGS if name != "memory"]
    drawn, axes = sheet(0.34 * len(names) + 1.2)
    marks = {TEXT: ("s", ORANGE), SPREADS[0]: ("^", GREEN), SPREADS[2]: ("o", BLUE)}
    for k, (method, (mark, colour)) in enumerate(marks.items()):
        rows = [row(method, FITTED, name) for name in names]
        middle = np.array([one.error for one in rows]) / GRAM_FORCE
        ends = [np.array([getattr(one, end) for one in rows]) / GRAM_FORCE for end in
                ("error_low", "error_high")]  # fmt: skip
        places = np.arange(len(names)) + 0.22 * (k - 1)
        axes.errorbar(
            middle, places, xerr=(middle - ends[0], ends[1] - middle), color=colour, marker=mark,
            ls="none", ms=4, lw=1.2, label=SHOWN[method][0],
        )  # fmt: skip
    axes.set_yticks(range(len(names)), names, fontsize=9)
    axes.set(ylim=(len(names) - 0.5, -0.5), xscale="log", xlabel="error (gf)")
    axes.set_xticks([0.5, 1, 2, 5, 10, 20], ["0.5", "1", "2", "5", "10", "20"])
    axes.minorticks_off()
    drawn.legend(loc="outside lower center", fontsize=9, ncols=2)
    return drawn


ALL = (draw_session, draw_hours, draw_weights, draw_settings)
