"""Tables of Chapter 2 on the pad: errors of place and angle, and what is assumed."""

from typing import Any

import numpy as np
import pandas as pd

from book.chapter_2.figures_pad import CALIBRATION, LOGS, contacts, errors
from book.companion.exhibit import table
from softgrip.provenance import Provenance
from softgrip.simulator.pad_calibration_table import KEPT
from softgrip.tactile.contacts import KINDS
from softgrip.units import DEG, MM


def _row(name: str, log: str, chosen: Any) -> dict[str, object]:
    """Return errors of some contacts of a log."""
    off = errors(log)
    at, angle = off.place[chosen] / MM, off.angle[chosen] / DEG
    felt, told = at[np.isfinite(at)], angle[np.isfinite(angle)]
    return {
        "contacts": name,
        "number": int(at.size),
        "elements felt": f"{off.elements[chosen].mean():.1f}",
        "place: median (mm)": f"{np.median(felt):.1f}",
        "place: 90 % (mm)": f"{np.percentile(felt, 90):.1f}",
        "nothing felt": int(at.size - felt.size),
        "angle: median (deg)": f"{np.median(told):.0f}" if told.size else "",
        "angle: 90 % (deg)": f"{np.percentile(told, 90):.0f}" if told.size else "",
    }


@table(
    "2.C",
    caption="Errors of place and angle on the *simulated* pad: half and nine tenths of the "
    "contacts are within them. To a line the place is counted square to it. A line's angle is said "
    "where two elements or more are felt; by two, it can only be that of their connection.",
    provenance=Provenance.SIMULATED,
    data=LOGS,
)
def table_2_c() -> pd.DataFrame:
    """Tabulate the errors by kind, by number of elements, and by food."""
    learned, tested = (contacts(name) for name in LOGS)
    rows = [_row(f"training, {kind}", LOGS[0], learned.kinds == kind) for kind in KINDS]
    counts = errors(LOGS[0]).elements
    for least, most, words in ((2, 2, "two"), (3, 3, "three"), (4, 8, "four and more")):
        chosen = (learned.kinds == "line") & (counts >= least) & (counts <= most)
        rows.append(_row(f"training, line felt by {words}", LOGS[0], chosen))
    foods = dict.fromkeys(tested.objects.tolist())
    rows += [_row(food, LOGS[1], tested.objects == food) for food in sorted(foods)]
    return pd.DataFrame(rows)


@table(
    "2.D",
    caption="What is assumed of the simulated pad: nothing is printed that could calibrate it. The "
    "first two lines are printed numbers beside what it gives; no parameter was set by them.",
    provenance=Provenance.SIMULATED,
    data=(CALIBRATION,),
)
def table_2_d() -> pd.DataFrame:
    """Tabulate the assumptions of the simulated pad."""
    return pd.DataFrame(
        {
            "use": line.use,
            "quantity": line.quantity,
            "printed": line.printed,
            "pad": f"{line.rig:.3g}",
            "unit": line.unit,
        }
        for line in KEPT.read()
    )
