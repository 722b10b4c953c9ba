"""What finite elements give for Table 3.1, kept: ``python -m softgrip.actuator.fem_results``.

The columns hold SI units, per pascal where the result is proportional to the pressure.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import starmap
from types import MappingProxyType

from softgrip.actuator.elasticity import Elastic
from softgrip.actuator.fem import solve, tip_response
from softgrip.actuator.finger_mesh import FingerShape, finger_mesh
from softgrip.actuator.printed import table_3_1
from softgrip.errors import UnknownNameError
from softgrip.kept import Kept

OPTIMUM = "Opt. parameters"
DESIGNS = (OPTIMUM, *(f"Variance {k}" for k in range(1, 7)))
"""The rows of Table 3.1."""

SIZE = 0.002
"""Element size of Table 3.1's rows, m; ``convergence`` shows what a finer one changes."""

SWEEP_SIZE = 0.003
BEAM, CHAMBERS = 1, 6
"""Number of chambers: Figure 3.1 draws a beam, Section 6.3 counts six."""

COLUMNS = (
    "design",
    "chambers",
    "groove_floor [m]",
    "size [m]",
    "unknowns",
    "torque [N m/Pa]",
    "scale_torque [N m/Pa]",
    "angle [rad/Pa]",
    "bending_stiffness [N m^2]",
    "neutral_height [m]",
)


@dataclass(frozen=True)
class FemResult:
    """One finger, solved. See `fem.TipResponse` for the results.

    Attributes:
        design: Row of Table 3.1.
        chambers, groove_floor: As in `FingerShape`; m.
        size: Longest edge of an element, m.
        unknowns: Displacements of the half finger.
        torque, scale_torque: Held straight, and by Eq. (3.24), N m/Pa.
        angle: rad/Pa.
        bending_stiffness: N m^2.
        neutral_height: m.
    """

    design: str
    chambers: int
    groove_floor: float
    size: float
    unknowns: int
    torque: float
    scale_torque: float
    angle: float
    bending_stiffness: float
    neutral_height: float


def compute(design: str, chambers: int, groove_floor: float, size: float) -> FemResult:
    """Solve one finger of Table 3.1."""
    shape = FingerShape(table_3_1()[design], chambers, groove_floor=groove_floor)
    solution = solve(finger_mesh(shape, size), Elastic())
    r = tip_response(solution)
    return FemResult(
        design,
        chambers,
        groove_floor,
        size,
        solution.load.size,
        r.torque,
        r.scale_torque,
        r.angle,
        r.bending_stiffness,
        r.neutral_height,
    )


_SIZES = (0.006, 0.004, 0.003, SIZE, 0.0015)
_FLOORS = (0.0, 0.003, 0.006, 0.009, 0.012, 0.015)

TABLES: Mapping[str, Sequence[tuple[str, int, float, float]]] = MappingProxyType(
    {
        "table_3_1": [(name, n, 0.0, SIZE) for n in (BEAM, CHAMBERS) for name in DESIGNS],
        "convergence": [(OPTIMUM, n, 0.0, size) for n in (BEAM, CHAMBERS) for size in _SIZES],
        "groove_floor": [(OPTIMUM, CHAMBERS, floor, SWEEP_SIZE) for floor in _FLOORS],
    }
)
"""The kept files and the arguments of `compute` for their rows."""

KEPT = {
    table: Kept(
        f"fem/{table}.csv",
        FemResult,
        partial(starmap, compute, cases),
        "python -m softgrip.actuator.fem_results",
        columns=COLUMNS,
    )
    for table, cases in TABLES.items()
}


def read(table: str) -> tuple[FemResult, ...]:
    """Read a kept file of ``data/fem/``.

    Args:
        table: "table_3_1", "convergence" or "groove_floor".

    Raises:
        UnknownNameError: If it is none of these.
    """
    if table not in TABLES:
        raise UnknownNameError("table", table, list(TABLES))
    return KEPT[table].read()


if __name__ == "__main__":
    for kept in KEPT.values():
        kept.main()
