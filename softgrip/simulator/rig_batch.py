"""Rigs that differ from run to run: parameters whose numbers are arrays of shape (runs,)."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from softgrip.arrays import Number
from softgrip.errors import InvalidInputError
from softgrip.simulator.parameters import RigParameters


def stacked(rigs: Sequence[RigParameters]) -> RigParameters:
    """Return many rigs as one: a number where all agree, else an array of shape (runs,).

    Args:
        rigs: One a run, >= 1, with as many fingers and branches of memory each.

    >>> from softgrip.simulator.fitted_rigs import design_1, design_2
    >>> both = stacked([design_1(), design_2()])
    >>> both.finger.rest_volume.shape, both.pump.area
    ((2,), 0.000661)
    """
    shapes = {(len(rig.fingers), len(rig.finger.memory)) for rig in rigs}
    if len(shapes) != 1:
        raise InvalidInputError(
            "rigs",
            expected="one or more, all with as many fingers and branches of memory",
            got=sorted(shapes),
        )

    def of_all(*values: Number) -> Number:
        return values[0] if len(set(values)) == 1 else np.array(values)

    joined: RigParameters = _each(of_all, *rigs)
    return joined


def take(rig: RigParameters, part: slice | NDArray[np.intp]) -> RigParameters:
    """Return some of the rigs of a batch, or some again; a rig of all runs stays as it is."""
    taken: RigParameters = _each(lambda value: value[part] if np.ndim(value) else value, rig)
    return taken


def run_count(rig: RigParameters) -> int:
    """Return for how many runs the parameters are; 1 if all are numbers."""
    return max((np.size(value) for _, value in _named(rig)), default=1)


def check_runs(rig: RigParameters, runs: int) -> None:
    """Raise InvalidInputError for the first parameter that is neither a number nor one a run."""
    for name, value in _named(rig):
        if np.shape(value) not in ((), (runs,)):
            raise InvalidInputError(
                name, expected=f"a number, or shape ({runs},): one a run", got=np.shape(value)
            )


def _each(combine: Callable[..., Number], *rigs: Any) -> Any:
    """Return parameters of which each number comes from those of some rigs."""
    first = rigs[0]
    if is_dataclass(first):
        parts = (tuple(getattr(rig, part.name) for rig in rigs) for part in fields(first))
        return type(first)(*(_each(combine, *own) for own in parts))  # type: ignore[misc]
    if isinstance(first, tuple):
        return tuple(_each(combine, *own) for own in zip(*rigs, strict=True))
    return combine(*rigs)


def _named(rig: Any, name: str = "") -> Iterator[tuple[str, Number]]:
    """Yield each number of a rig with its name, such as ``fingers[0].stiffness``."""
    if is_dataclass(rig):
        for part in fields(rig):
            yield from _named(getattr(rig, part.name), f"{name}.{part.name}".lstrip("."))
    elif isinstance(rig, tuple):
        for index, part in enumerate(rig):
            yield from _named(part, f"{name}[{index}]")
    else:
        yield name, rig
