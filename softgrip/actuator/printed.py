"""The sections and frequencies that Tables 3.1 to 3.3 print, in SI."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from softgrip.actuator.design import SCRIPT_BOUNDS, DesignProblem, FrequencyBand
from softgrip.actuator.section import Section
from softgrip.errors import UnknownNameError
from softgrip.provenance import data_rows
from softgrip.reads import remembered
from softgrip.units import MM, MPa

FREQUENCY_POWER = 1.045
"""n with which Eq. (3.16) gives the 2.62 rad/s of Table 3.3, M in kilograms; none is printed."""

WEIGHT_POWER = 2.07
"""n with which it does with M as the weight in newtons that the table prints."""

ANGLE_POWER = 1.56
"""n with which Eq. (3.10) gives the 290 deg of Section 3.4."""

SUM_POWER = 2.08
"""n with which Eq. (3.20) gives the sums 2.36 and 2.30 of Section 3.4."""

FREQUENCY_MASS = 0.35
"""M for `FREQUENCY_POWER`, kg: the number that Table 3.3 gives in newtons."""


@dataclass(frozen=True)
class BandRow:
    """A row of Table 3.2: a band (rad/s), the measured frequency (rad/s) and the section."""

    low: float
    high: float
    measured: float
    section: Section

    def problem(self) -> DesignProblem:
        """Return the design problem for the row, with the inputs of the author's script."""
        return DesignProblem(bounds=SCRIPT_BOUNDS, band=FrequencyBand(self.low, self.high))


@dataclass(frozen=True)
class FrequencyRow:
    """A row of Table 3.3.

    Attributes:
        young_modulus: E, Pa.
        weight, length: M and L as printed: 0.35 "N" and 0.94 "m".
        section: Of the design.
        measured, deviation, estimated: rad/s.
        error: Of the estimate, percent.
    """

    name: str
    young_modulus: float
    weight: float
    length: float
    section: Section
    measured: float
    deviation: float
    estimated: float
    error: float


def _section(row: Mapping[str, str]) -> Section:
    # Rounded, since 14.4 times 0.001 is not 0.0144 in binary.
    def length(name: str) -> float:
        return round(float(row[name]) * MM, 7)

    return Section(length("top"), length("bottom"), length("width"), length("wall"))


@remembered
def table_3_1() -> Mapping[str, Section]:
    """Read Table 3.1: a read-only mapping from name to section, in the printed order.

    >>> table_3_1()["Variance 1"].width
    0.029
    """
    rows = data_rows("actuator/table_3_1.csv")
    return MappingProxyType({row["name"]: _section(row) for row in rows})


def section(name: str) -> Section:
    """Return a section of Table 3.1; UnknownNameError lists those that it has."""
    known = table_3_1()
    if name not in known:
        raise UnknownNameError("section", name, list(known))
    return known[name]


@remembered
def table_3_2() -> tuple[BandRow, ...]:
    """Read Table 3.2, in the printed order."""
    return tuple(
        BandRow(float(row["low"]), float(row["high"]), float(row["measured"]), _section(row))
        for row in data_rows("actuator/table_3_2.csv")
    )


@remembered
def table_3_3() -> Mapping[str, FrequencyRow]:
    """Read Table 3.3: a read-only mapping from the design's name to its row."""
    optimum = section("Opt. parameters")
    return MappingProxyType(
        {
            row["name"]: FrequencyRow(
                name=row["name"],
                young_modulus=round(float(row["young_modulus"]) * MPa),
                weight=float(row["weight"]),
                length=float(row["length"]),
                section=Section(
                    optimum.top, optimum.bottom, round(float(row["width"]) * MM, 6), optimum.wall
                ),
                measured=float(row["measured"]),
                deviation=float(row["deviation"]),
                estimated=float(row["estimated"]),
                error=float(row["error"]),
            )
            for row in data_rows("actuator/table_3_3.csv")
        }
    )


def table_3_4() -> list[dict[str, str]]:
    """Read Table 3.4, cells as printed; all but the first row are of other literature."""
    return data_rows("actuator/table_3_4.csv")
