"""Tables of the page on drift."""

import pandas as pd

from book.beyond.drift.kept import LAYERS, kept, row
from book.beyond.drift.study import DRAWN, FITTED, MEMORY, SETTINGS, SPREADS, Outcome
from softgrip.units import GRAM_FORCE


def _three(one: Outcome, name: str, unit: float, digits: int) -> str:
    middle, low, high = (
        f"{getattr(one, name + end) / unit:.{digits}f}" for end in ("", "_low", "_high")
    )
    return f"{middle} ({low} to {high})"


def _line(one: Outcome) -> dict[str, object]:
    return {
        "weights": one.weights,
        "error (gf)": _three(one, "error", GRAM_FORCE, 1),
        "accuracy (%)": _three(one, "accuracy", 1, 1),
        "reach the print (%)": _three(one, "reached", 0.01, 0),
        "better than the text (%)": _three(one, "better", 0.01, 0),
    }


def comparison(layers: str, setting: str = "wandering") -> pd.DataFrame:
    """Tabulate all methods of a setting."""
    rows = [one for one in kept() if (one.layers, one.setting) == (layers, setting)]
    return pd.DataFrame({"method": one.method, **_line(one)} for one in rows)


def steady_table() -> pd.DataFrame:
    """Tabulate how many sessions reach the printed accuracy, by number of weights and by drift."""
    found = []
    for setting in ("wandering", "steady"):
        for layers, label in LAYERS.items():
            shares = {
                f"{count}": _three(row(SPREADS[count], layers, setting), "reached", 0.01, 0)
                for count in (0, 1, 2, 4)
            }
            found.append({"drift": setting, "layers": label, **shares})
    return pd.DataFrame(found)


def memory_table() -> pd.DataFrame:
    """Tabulate what undoing the memory changes."""
    rows = [
        row(name, DRAWN, "memory") for name in (SPREADS[4], MEMORY[0], "drift known", MEMORY[1])
    ]
    return pd.DataFrame({"method": one.method, **_line(one)} for one in rows)


def settings_table() -> pd.DataFrame:
    """Tabulate the error, gf, in all settings: median, and 95 % of the sessions."""
    columns = {"text": "text: a line, 4 at the start", **{
        f"{count} weight{'s' * (count != 1)}": SPREADS[count] for count in (0, 1, 2, 4)
    }}  # fmt: skip
    return pd.DataFrame(
        {
            "setting": name,
            **{
                label: _three(row(method, FITTED, name), "error", GRAM_FORCE, 1)
                for label, method in columns.items()
            },
        }
        for name in SETTINGS
        if name != "memory"
    )
