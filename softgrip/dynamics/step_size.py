"""The fixed step of an integration, chosen from a measured error."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class StepChoice:
    """A step, and what halving it changed.

    Attributes
    ----------
    step
        s.
    error
        Largest measured error of the output at this step, in the unit of the output.
    """

    step: float
    error: float


def step_for(
    error: float, solve: Callable[[float], Floats], *, first: float, smallest: float = 1e-5
) -> StepChoice:
    """Choose the step by halving it until halving it further changes too little to matter.

    A step is judged against its half and its quarter, and the error taken as twice the larger
    change, which holds for any order from 1 up. One halving alone can mislead: where a run crosses
    a kink, the error depends on where in a step it crosses, and two steps may be off by the same.
    It stays an estimate.

    Parameters
    ----------
    error
        Allowed error of the output, in its unit, > 0.
    solve
        Gives the output for a step; a few runs that stand for the batch are enough.
    first
        Longest step to try, s.
    smallest
        Where to give up, s.

    Raises
    ------
    InvalidInputError
        If no step down to `smallest` is good enough.
    """
    step, seen = first, np.inf
    coarse, fine = solve(step), solve(step / 2)
    while step > smallest:
        finest = solve(step / 4)
        changes = (np.max(np.abs(other - coarse)) for other in (fine, finest))
        seen = 2 * float(max(changes))
        if seen <= error:
            return StepChoice(step, seen)
        step, coarse, fine = step / 2, fine, finest
    raise InvalidInputError(
        "error",
        expected=f"one that a step >= {smallest:g} s reaches (at best {seen:.2g})",
        got=error,
    )
