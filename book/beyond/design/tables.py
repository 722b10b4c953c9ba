"""Tables of the page *Design yours*."""

import numpy as np
import pandas as pd

from book.beyond.design.lighter import CASES, PRINTED, saved
from book.beyond.design.lighter import KEPT as LIGHTER
from book.beyond.design.pump import pump_for, pump_words
from softgrip.actuator.front import KEPT, Point, Question
from softgrip.materials.table import table_5_1
from softgrip.units import DEG, ML, MM

SHOWN = {"chambers": 6, "pressure": 60e3, "largest_mass": 0.030}
"""The question that the table of points answers for each rubber."""


def chosen_points() -> list[Point]:
    """Return the answers to the question of the table, a rubber each."""
    known = {row.question: row for row in KEPT.read()}
    return [known[Question(name, **SHOWN)] for name in table_5_1()]  # type: ignore[arg-type]


def points_table() -> pd.DataFrame:
    """Tabulate the best finger of each rubber for one question, with its pump."""
    return pd.DataFrame(_row(point) for point in chosen_points())


def _row(point: Point) -> dict[str, str]:
    found = point.answer
    row = {"rubber": point.question.material}
    names = ("a, b, w, t (mm)", "torque (N m)", "angle (deg)", "rad/s", "rubber (g)", "air (mL)")
    if not found.feasible:
        return row | dict.fromkeys(names, "") | {"pump": "no section, proved"}
    sides = (found.top, found.bottom, found.width, found.wall)
    values = (
        ", ".join(f"{side / MM:.2f}" for side in sides),
        f"{found.torque:.4f}",
        f"{found.angle / DEG:.0f}",
        f"{found.frequency:.2f}",
        f"{1e3 * found.mass:.1f}",
        f"{found.air / ML:.1f}",
    )
    return row | dict(zip(names, values, strict=True)) | {"pump": pump_words(pump_for(point))}


def percent(share: float) -> str:
    """Return a share in percent; what rounds to nothing has no sign.

    >>> percent(-1e-5), percent(0.0312)
    ('0.0', '3.1')
    """
    return f"{round(100 * share, 1) + 0.0:.1f}"


def saved_table() -> pd.DataFrame:
    """Tabulate the lightest fingers that do as much as Design 1."""
    rows = []
    for case in CASES:
        printed, by_draw = saved(case)
        low, high = map(percent, np.percentile(by_draw, [2.5, 97.5]))
        one = next(x for x in LIGHTER.read() if x.case == case and x.draw == PRINTED)
        sides = (one.top, one.bottom, one.width, one.wall)
        rows.append(
            {
                "what is kept": case,
                "a, b, w, t (mm)": ", ".join(f"{side / MM:.2f}" for side in sides),
                "rubber (g)": f"{1e3 * one.mass:.1f}",
                "saved as printed": f"{percent(printed)} %",
                "saved as tested": f"{low} to {high} %",
            }
        )
    return pd.DataFrame(rows)


def rubber_table() -> pd.DataFrame:
    """Tabulate E and n of each rubber: as printed, and what its test leaves open of them."""
    from softgrip.materials.draws import draws

    rows = []
    for name, rubber in table_5_1().items():
        E, n = np.percentile(draws()[name], [2.5, 97.5], axis=0).T
        rows.append(
            {
                "rubber": name,
                "E printed (MPa)": f"{rubber.young_modulus / 1e6:.2f}",
                "E of the test": f"{E[0] / 1e6:.3f} to {E[1] / 1e6:.3f}",
                "n printed": f"{rubber.fractional_power:.3f}",
                "n of the test": f"{n[0]:.2f} to {n[1]:.2f}",
            }
        )
    return pd.DataFrame(rows)
