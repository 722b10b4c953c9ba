"""Tables of the page *One rig for all numbers*."""

from collections.abc import Sequence
from typing import get_args

import numpy as np
import pandas as pd

from book.companion.claims import printed_text
from book.twin import outcomes, study
from book.twin.bounds import BOUNDS, excludes
from book.twin.interval import coverage, widening
from book.twin.misfit import chosen
from book.twin.prediction import CHAPTERS, Prediction
from book.twin.problem import error_of
from book.twin.recipes import ALL
from book.twin.recovery import Recovered, Way
from book.twin.targets import Target
from book.twin.tension import Pull

SIGNS = {"=": "", "~": "about ", "<": "below ", ">": "above "}


def _number(value: float) -> str:
    return f"{value:.3g}"


def outcome_table(word: str) -> pd.DataFrame:
    """Tabulate the targets of a word: printed, before, best rig, ensemble, nearest.

    Args:
        word: One of `outcomes.Word`.
    """
    rows = [
        {
            "where": target.section,
            "what": target.what,
            "unit": target.unit,
            "printed": SIGNS[target.relation] + printed_text(target.id),
            "before": _number(one.before),
            "best rig": _number(one.best),
            "ensemble": f"{_number(one.low)} to {_number(one.high)}",
            "nearest": _number(one.nearest),
            "why not": why_not(one, target),
        }
        for one, target in zip(outcomes.KEPT.read(), chosen(ALL), strict=True)
        if one.word == word
    ]
    return pd.DataFrame(rows)


NEAR = 0.1
"""Share of a print within which a value counts as near it."""


def why_not(one: outcomes.Outcome, target: Target) -> str:
    """Say in a line why the best rig does not come near a print; nothing where it does."""
    if not target.value or abs(one.best / target.value - 1) <= NEAR:
        return ""
    if one.id in BOUNDS and excludes(BOUNDS[one.id](), target):
        return "a [bound](#bounds) excludes it"
    if one.word == "together":
        share = error_of(target) * target.tolerance / abs(target.value)
        return f"within its error, {100 * share:.0f} %"
    what = {known.id: f"{known.what} ({known.section})" for known in chosen(ALL)}
    pulls = {pull.id: pull.against.split() for pull in study.TABLES["tension"].read()}
    if against := pulls.get(one.id):
        return f"against: {what[against[0]]}"
    if one.word == "alone":
        return "alone only; no step from the best rig shows what it would cost"
    return "no rig that was tried comes to it"


def tension_table() -> pd.DataFrame:
    """Tabulate what is given up in the smallest set, and what stands against it."""
    what = {target.id: f"{target.what} ({target.section})" for target in chosen(ALL)}
    pulls: tuple[Pull, ...] = study.TABLES["tension"].read()
    return pd.DataFrame(
        {
            "given up": what[one.id],
            "still off, errors": f"{one.really:.1f}",
            "against it": "; ".join(what[name] for name in one.against.split()),
            "at an end": ", ".join(one.ranges.split()),
        }
        for one in pulls
    )


def found(way: Way, kind: str) -> list[Recovered]:
    """Return what a way says of the known rigs: "parameter", "told" of these, or "target"."""
    rows: tuple[Recovered, ...] = study.TABLES["recovery"].read()
    return [
        one for one in rows
        if one.way == way and (one.told if kind == "told" else one.kind == kind)
    ]  # fmt: skip


def ways_table() -> pd.DataFrame:
    """Tabulate how often the intervals of both ways hold on known rigs, and what they lack."""
    kinds = {"parameter": "parameters", "told": "told parameters", "target": "numbers"}
    columns: dict[str, dict[str, str]] = {}
    for way in get_args(Way):
        column = columns[way] = {}
        for kind, what in kinds.items():
            own = [one.interval for one in found(way, kind)]
            column[f"{what} of all known rigs"] = f"{len(own)}"
            column[f"{what} held"] = f"{coverage(own):.0f} %" if own else "none"
            times = f"{widening(own):.2f}" if own else "none"
            column[f"{what}: sides that would hold nine of ten, times"] = times
    return pd.DataFrame(columns).reset_index(names="")


def prediction_table() -> pd.DataFrame:
    """Tabulate how many of the hidden numbers their intervals hold: of the print, of known rigs."""
    columns = {}
    for name, chapters in CHAPTERS.items():
        rows = [one for one in study.TABLES["predictions"].read() if one.predicted == name]
        of_rigs = [one.interval for one in study.TABLES["held"].read() if one.predicted == name]
        of_print = [one.interval for one in rows]
        narrowed = [one.interval for one in rows if one.share < NARROWED]
        columns["Chapter " + ", ".join(map(str, chapters))] = {
            "numbers": f"{len(rows)}",
            "width of the intervals over that before, median": f"{_middle_share(rows):.0f} %",
            "prints held": f"{sum(one.holds for one in of_print)} ({coverage(of_print):.0f} %)",
            "sides that would hold nine of ten, times": f"{widening(of_print):.2f}",
            "intervals of less than half the width before": f"{len(narrowed)}",
            "prints that these hold": f"{sum(one.holds for one in narrowed)}",
            "numbers of known rigs": f"{len(of_rigs)}",
            "of these held": f"{coverage(of_rigs):.0f} %",
            "sides that would hold nine of ten of them, times": f"{widening(of_rigs):.2f}",
        }
    return pd.DataFrame(columns).reset_index(names="hidden")


NARROWED = 0.5
"""Width of a prediction over that before any target was looked at, below which it says much."""


def _middle_share(rows: Sequence[Prediction]) -> float:
    return 100 * float(np.median([one.share for one in rows]))


def bound_table() -> pd.DataFrame:
    """Tabulate the bounds, what random rigs and the search came to, and what they exclude."""
    pairs = zip(chosen(ALL), outcomes.KEPT.read(), strict=True)
    known = {target.id: (target, one.nearest) for target, one in pairs}
    rows = []
    for row in study.TABLES["bounds"].read():
        (target, nearest), bound = known[row.id], BOUNDS[row.id]()
        rows.append(
            {
                "what": f"{target.what} ({target.section})",
                "unit": target.unit,
                "printed": SIGNS[target.relation] + printed_text(target.id),
                "every rig": f"{bound.side} {_number(bound.value)}",
                "random rigs": _number(row.nearest),
                "sought": _number(nearest),
                "print excluded": "yes" if excludes(bound, target) else "no",
                "why": f"{bound.reason}; {bound.holds}" if bound.holds else bound.reason,
            }
        )
    return pd.DataFrame(rows)
