"""What the text leaves open about its experiments, as fitted with the rig.

The sizes of steps, the bands of settling times, and what trial and error put on gains are printed
nowhere. ``data/calibration/choices.csv`` has those with which the best rig comes nearest to the
print, and the interval that the prints leave to each; ``space.csv`` has their ranges and reasons.
"""

from softgrip.errors import UnknownNameError
from softgrip.provenance import data_rows
from softgrip.reads import remembered
from softgrip.units import DEG, MM, REV, MPa

FILE = "calibration/choices.csv"
UNITS = {
    "1": 1.0, "deg": DEG, "%": 0.01, "s": 1.0, "MPa": MPa, "mm": MM, "rev/s": REV, "rad/s^3": 1.0,
}  # fmt: skip


@remembered
def _choices() -> dict[str, float]:
    found = {}
    for row in data_rows(FILE):
        name, _, unit = row["parameter [unit]"].removesuffix("]").partition(" [")
        found[name] = float(row["value"]) * UNITS[unit]
    return found


def choice(name: str) -> float:
    """Return a choice of an experiment, SI.

    Raises:
        UnknownNameError: If there is no such choice.

    >>> 0 < choice("lqr_step") < 90 * DEG
    True
    """
    known = _choices()
    if name not in known:
        raise UnknownNameError("choice", name, [*known])
    return known[name]
