"""Ziegler and Nichols' rule: P, PI and PID gains from the reaction curve of a process."""

from typing import Literal, get_args

import numpy as np

from softgrip.arrays import check_positive
from softgrip.control.pid import Gains
from softgrip.control.reaction_curve import ReactionCurve
from softgrip.errors import InvalidInputError

Kind = Literal["P", "PI", "PID"]

RULE: dict[Kind, tuple[float, float, float]] = {
    "P": (1.0, np.inf, 0.0),
    "PI": (0.9, 10 / 3, 0.0),
    "PID": (1.2, 2.0, 0.5),
}
"""By kind: kp R L, integral time by L, derivative time by L (Ziegler and Nichols, 1942)."""

FILTER_RATIO = 10.0
"""Derivative time by the time constant of its filter; the rule itself has no filter."""


def ziegler_nichols(
    curve: ReactionCurve, kind: Kind = "PID", *, filter_ratio: float = FILTER_RATIO
) -> Gains:
    """Return the gains of Ziegler and Nichols for a reaction curve.

    Parameters
    ----------
    curve
        Delay and slope; the rule uses no other.
    kind
        "P", "PI" or "PID".
    filter_ratio
        Derivative time by filter time constant, > 0.

    Raises
    ------
    InvalidInputError
        If the kind is unknown.

    Examples
    --------
    >>> ziegler_nichols(ReactionCurve(delay=0.5, slope=2.0), filter_ratio=10)
    Gains(kp=1.2, ki=1.2, kd=0.3, derivative_filter=0.025)
    """
    if kind not in get_args(Kind):
        raise InvalidInputError("kind", expected=f"one of {get_args(Kind)}", got=kind)
    check_positive(delay=curve.delay, filter_ratio=filter_ratio)
    factor, integral, derivative = RULE[kind]
    kp = factor / (curve.slope * curve.delay)
    # A filter is asked for even where no derivative uses it.
    tau = (derivative or RULE["PID"][2]) * curve.delay / filter_ratio
    return Gains(kp, kp / (integral * curve.delay), kp * derivative * curve.delay, tau)
