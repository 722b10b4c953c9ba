"""The experiments by name: what each measures on a laboratory, in the units of the print."""

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType

from book.twin import (
    finger_loops,
    gripper_tests,
    pad_tests,
    pump_tests,
    static_tests,
    step_tests,
)
from book.twin.laboratory import Laboratory
from book.twin.step_tests import Measures
from softgrip.arrays import Floats
from softgrip.errors import UnknownNameError

Recipe = Callable[[Laboratory], Measures]
FAST: Mapping[str, Recipe] = MappingProxyType(
    static_tests.FAST
    | step_tests.FAST
    | pump_tests.FAST
    | finger_loops.FAST
    | gripper_tests.FAST
    | pad_tests.FAST
)
"""Some seconds for one rig, and little more for several."""
SLOW: Mapping[str, Recipe] = MappingProxyType(step_tests.SLOW | pad_tests.SLOW)
"""Up to some seconds for each rig."""
ALL: Mapping[str, Recipe] = MappingProxyType({**FAST, **SLOW})


def measured(lab: Laboratory, experiments: Iterable[str] = FAST) -> dict[tuple[str, str], Floats]:
    """Run experiments on a laboratory.

    Args:
        lab: Its rigs and choices.
        experiments: Names in `ALL`.

    Returns:
        dict: By experiment and quantity, shape (rigs,).

    Raises:
        UnknownNameError: If there is no such experiment.
    """
    found: dict[tuple[str, str], Floats] = {}
    for name in experiments:
        if name not in ALL:
            raise UnknownNameError("experiment", name, list(ALL))
        found |= {(name, quantity): values for quantity, values in ALL[name](lab).items()}
    return found
