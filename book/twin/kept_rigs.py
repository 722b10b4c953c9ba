"""The best rig in the form of a reader's own: what the book simulates with, with its intervals.

Files below ``data/calibration/``: three fingers and the gripper by `rig_file`, the pad with its
force layer, and what the experiments leave open.
"""

import csv
from collections.abc import Iterable, Mapping
from io import StringIO
from pathlib import Path

import numpy as np

from book.companion import choices
from book.twin import rigs
from book.twin.fitted import BEST, ENSEMBLE, best_rig, ensemble
from book.twin.space import Parameter, space
from softgrip.arrays import Floats
from softgrip.control.pid import PERIOD
from softgrip.gripper.internal_model import PERIOD as GRIPPER_PERIOD
from softgrip.kept import write_data
from softgrip.provenance import Provenance, data_folder
from softgrip.simulator import fitted_rigs
from softgrip.simulator.free_parameters import parameter_values
from softgrip.simulator.rig_file import COLUMNS, FittedRig, Line, Status, write_rig

SOURCE = "python -m book.twin rigs"
CENTRAL = (5, 95)
"""Percentiles of the ensemble between which a parameter lies."""
TOLD = 0.5
"""A parameter is told where its interval is less than this share of that of its declared range."""
RIGS: Mapping[str, tuple[rigs.Make, float]] = {
    fitted_rigs.DESIGN_1: (rigs.design_1, PERIOD),
    fitted_rigs.DESIGN_2: (rigs.design_2, PERIOD),
    fitted_rigs.DESIGN_3: (rigs.design_3, PERIOD),
    fitted_rigs.GRIPPER: (rigs.gripper, GRIPPER_PERIOD),
}
"""What makes the rig of each file, and the period of its logs, s."""


def _rows(table: Floats) -> list[dict[str, float]]:
    return [dict(zip(space(), row, strict=True)) for row in table.tolist()]


def _evenly(count: int) -> Floats:
    """Return rigs all over the declared space, as a prior's, shape (rigs, parameters)."""
    shares = np.random.default_rng(0).random((count, len(space())))
    return np.stack([one.at(own) for one, own in zip(space().values(), shares.T, strict=True)], 1)


def _status(own: Floats, prior: Floats) -> Status:
    width, whole = (float(np.ptp(np.percentile(x, CENTRAL))) for x in (own, prior))
    if not whole:
        return "given"
    return "told" if width < TOLD * whole else "not told"


def rig_lines(make: rigs.Make) -> tuple[Line, ...]:
    """Return the parameters of the best rig with the ensemble's intervals."""
    best, several, prior = (
        [parameter_values(make(row)) for row in _rows(table)]
        for table in (best_rig()[None], ensemble(), _evenly(len(ensemble())))
    )
    lines = []
    for name, value in best[0].items():
        own, before = (np.array([one[name] for one in many]) for many in (several, prior))
        status = _status(own, before)
        low, high = (float(f"{end:.6g}") for end in np.percentile(own, CENTRAL))
        if status == "given":
            lines.append(Line(name, value, None, None, status))
        else:
            # The best rig need not lie where most do.
            lines.append(Line(name, value, min(low, value), max(high, value), status))
    return tuple(lines)


def _table(parameters: Iterable[Parameter], prefix: str = "") -> str:
    """Return lines of the space's own parameters, in the columns of a rig's file."""
    text, names = StringIO(), [*space()]
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    for one in parameters:
        k = names.index(one.name)
        value, own = float(best_rig()[k]), ensemble()[:, k]
        status = _status(one.share(own), np.array([0.0, 1.0])) if one.status == "free" else "given"
        low, high = (float(f"{end:.6g}") for end in np.percentile(own, CENTRAL))
        ends = (f"{min(low, value)!r}", f"{max(high, value)!r}") if status != "given" else ("", "")
        table.writerow(
            [f"{one.name.removeprefix(prefix)} [{one.unit or 1}]", repr(value), *ends, status]
        )
    return text.getvalue()


def write() -> list[Path]:
    """Write all files, and return their paths."""
    logs = (f"data/{BEST}", f"data/{ENSEMBLE}")
    paths = []
    for file, (make, period) in RIGS.items():
        rig = make(_rows(best_rig()[None])[0])
        kept = FittedRig(rig, period, Provenance.SIMULATED, logs, rig_lines(make))
        paths.append(write_rig(kept, data_folder() / file, source=SOURCE))
    pad = [one for one in space().values() if one.name.startswith(("pad.", "layer."))]
    open_ones = [one for one in space().values() if one.name.startswith("choice.")]
    for file, own, prefix in ((fitted_rigs.PAD, pad, ""), (choices.FILE, open_ones, "choice.")):
        text = _table(own, prefix)
        paths.append(write_data(data_folder() / file, text, source=SOURCE))
    return paths
