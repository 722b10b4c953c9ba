"""Tables of Chapter 3."""

from math import nan

import pandas as pd

from book.chapter_3.numbers import G, optimum
from book.chapter_3.stepped import identified_row
from book.companion.claims import claim_of
from book.companion.exhibit import table
from book.companion.verdict import judge, outcome_of
from softgrip.actuator import fem_results
from softgrip.actuator.bending import Finger
from softgrip.actuator.certificate import certified_design
from softgrip.actuator.design import (
    SCRIPT_BOUNDS,
    SCRIPT_MASS,
    SCRIPT_POWER,
    Bounds,
    DesignProblem,
    objective,
)
from softgrip.actuator.frequency import natural_frequency
from softgrip.actuator.optimize import manufacturable
from softgrip.actuator.printed import (
    ANGLE_POWER,
    FREQUENCY_MASS,
    FREQUENCY_POWER,
    WEIGHT_POWER,
    FrequencyRow,
    table_3_1,
    table_3_2,
    table_3_3,
)
from softgrip.actuator.printed import table_3_4 as printed_table_3_4
from softgrip.actuator.section import Section
from softgrip.provenance import Provenance
from softgrip.units import MM

SCRIPT = f"n = {SCRIPT_POWER:g}, {SCRIPT_MASS:g} kg"
READINGS = {
    SCRIPT: (SCRIPT_POWER, SCRIPT_MASS),
    f"n = {FREQUENCY_POWER:g}, {FREQUENCY_MASS:g} kg": (FREQUENCY_POWER, FREQUENCY_MASS),
    f"n = {WEIGHT_POWER:g}, {FREQUENCY_MASS:g} N": (WEIGHT_POWER, FREQUENCY_MASS / G),
}
"""n, and M of Design 1 in kg: those of the author's script, and the two that give Table 3.3."""


def _mm(section: Section) -> dict[str, str]:
    names = {"b": "bottom", "a": "top", "w": "width", "t": "wall"}
    return {short: f"{getattr(section, name) / MM:.4g}" for short, name in names.items()}


@table("3.1", Provenance.SIMULATED)
def table_3_1_sums() -> pd.DataFrame:
    """Tabulate the sections of Table 3.1 with the objective."""
    powers = (SCRIPT_POWER, ANGLE_POWER, WEIGHT_POWER)
    problems = [DesignProblem(fractional_power=n) for n in powers]
    judged = {r.design: r for r in fem_results.read("table_3_1") if r.chambers > 1}
    best = judged["Opt. parameters"]
    return pd.DataFrame(
        {
            "section": name,
            **_mm(section),
            **{
                f"sum, n = {problem.fractional_power:g}": f"{objective(problem, section):.3f}"
                for problem in problems
            },
            "FEM torque": f"{judged[name].torque / best.torque:.2f}",
            "FEM angle": f"{judged[name].angle / best.angle:.2f}",
        }
        for name, section in table_3_1().items()
    )


@table("3.2", Provenance.SIMULATED)
def table_3_2_recomputed() -> pd.DataFrame:
    """Tabulate the bands, their best sections and the frequencies of steps."""
    rows = []
    first = identified_row(1).natural_frequency.value
    for k, row in enumerate(table_3_2(), start=1):
        best = {
            reading: f"{optimum('top', (row.low, row.high), power, mass):.2f}"
            for reading, (power, mass) in READINGS.items()
        }
        steps = identified_row(k)
        frequency, (pole, _) = steps.natural_frequency, steps.system.rates
        value, margin = frequency.value, (frequency.high - frequency.low) / 2
        rows.append(
            {
                "band": f"{row.low:.2f} to {row.high:.2f}",
                "a printed": f"{row.section.top / MM:.1f}",
                SCRIPT: best.pop(SCRIPT),
                "outcome": outcome_of(3, "table-3.2-top-{key}", k),
                **best,
                "measured": f"{row.measured:.2f} ({row.measured / table_3_2()[0].measured:.2f})",
                "simulated": f"{value:.2f} ± {margin:.2f} ({value / first:.2f})",
                "poles": f"{-pole.real:.2f} ± {abs(pole.imag):.2f}j",
            }
        )
    return pd.DataFrame(rows)


def _estimated(row: FrequencyRow, power: float, mass: float, length: float = 94 * MM) -> str:
    finger = Finger(row.section, length, row.young_modulus, power)
    return f"{natural_frequency(finger, mass):.2f}"


def _rubber(name: str) -> float:
    spread = judge(claim_of(3, "table-3.3-weight-{key}", name)).spread
    return spread.value if spread else nan


@table("3.3", Provenance.PRINTED)
def table_3_3_recomputed() -> pd.DataFrame:
    """Tabulate the frequencies of Table 3.3."""
    return pd.DataFrame(
        {
            "design": name,
            "measured": f"{row.measured:.2f} ± {row.deviation:.3f}",
            "printed": f"{row.estimated:.2f}",
            "as stated": _estimated(row, 1.0, row.weight / G, row.length),
            f"n = {SCRIPT_POWER:g}, kg": _estimated(row, SCRIPT_POWER, row.weight),
            f"n = {FREQUENCY_POWER:g}, kg": _estimated(row, FREQUENCY_POWER, row.weight),
            f"n = {WEIGHT_POWER:g}, N": _estimated(row, WEIGHT_POWER, row.weight / G),
            "outcome": outcome_of(3, "table-3.3-estimated-{key}", name),
            "weight": f"{row.weight:.2f}",
            "rubber": f"{_rubber(name):.2f}",
        }
        for name, row in table_3_3().items()
    )


@table("3.4", Provenance.PRINTED)
def table_3_4() -> pd.DataFrame:
    """Tabulate the comparison with other designs."""
    rows = printed_table_3_4()
    return pd.DataFrame(
        {
            "approach": f"{row['approach']} {row['reference']}",
            "torque": row["torque"].replace("~", "about"),
            "angle": row["angle"].replace(">", "above"),
            "controllability": row["controllability"] or "not considered",
        }
        for row in rows
    )


@table("3.A", Provenance.PRINTED)
def table_3_a() -> pd.DataFrame:
    """Tabulate certified optima over n and bounds."""
    rows = []
    for limits, bounds in (("stated", Bounds()), ("script", SCRIPT_BOUNDS)):
        for n in (SCRIPT_POWER, ANGLE_POWER, WEIGHT_POWER, 2.5):
            problem = DesignProblem(fractional_power=n, bounds=bounds)
            found = certified_design(problem)
            made = manufacturable(problem).section
            rows.append(
                {
                    "limits": limits,
                    "n": f"{n:g}",
                    **_mm(found.design.section),
                    "sum": f"{found.design.objective:.3f}",
                    "iterations": found.design.iterations,
                    "boxes": found.certificate.boxes,
                    "proved": "yes" if found.certificate.proven else "no",
                    "made": "/".join(_mm(made).values()),
                }
            )
    return pd.DataFrame(rows)
