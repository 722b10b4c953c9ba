"""Tables of the page *One rig for all numbers*."""

import pandas as pd

from book.companion.claims import printed_text
from book.twin import outcomes, study
from book.twin.misfit import chosen
from book.twin.recipes import ALL
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
        }
        for one, target in zip(outcomes.KEPT.read(), chosen(ALL), strict=True)
        if one.word == word
    ]
    return pd.DataFrame(rows)


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
