"""What is kept of each tensile test: a few numbers, never the measurements.

They let the pages be built, and the ledger be judged, where the tests cannot be had.
"""

import csv
from collections.abc import Mapping
from dataclasses import astuple, dataclass, fields
from functools import cache
from types import MappingProxyType

from softgrip.materials import tensile, yeoh
from softgrip.materials.table import table_5_1
from softgrip.materials.tensile import TensileTest
from softgrip.provenance import data_file

FACTS = "materials/tensile_facts.csv"


@dataclass(frozen=True)
class TensileFacts:
    """A tensile test in numbers.

    Attributes
    ----------
    name
        Material.
    hundred_percent_modulus
        Engineering stress at strain 1, Pa.
    peak_stress, peak_strain
        Largest engineering stress [Pa], and the engineering strain there.
    yeoh_1, yeoh_2, yeoh_3
        Coefficients of Yeoh's law fitted up to the peak, Pa.
    yeoh_rms
        Its RMS misfit in engineering stress, Pa.
    """

    name: str
    hundred_percent_modulus: float
    peak_stress: float
    peak_strain: float
    yeoh_1: float
    yeoh_2: float
    yeoh_3: float
    yeoh_rms: float

    @property
    def yeoh(self) -> tuple[float, float, float]:
        """The three coefficients of Yeoh's law, Pa."""
        return self.yeoh_1, self.yeoh_2, self.yeoh_3


def measure_facts(test: TensileTest) -> TensileFacts:
    """Take the facts from a test."""
    pulled = tensile.up_to_peak(test)
    stretched = pulled.strain >= 0
    law = yeoh.fit(pulled.strain[stretched], pulled.stress[stretched])
    first, second, third = law.coefficients
    return TensileFacts(
        test.name,
        tensile.hundred_percent_modulus(test),
        peak_stress=float(pulled.stress[-1]),
        peak_strain=float(pulled.strain[-1]),
        yeoh_1=first,
        yeoh_2=second,
        yeoh_3=third,
        yeoh_rms=law.rms_stress,
    )


@cache
def facts() -> Mapping[str, TensileFacts]:
    """Read the kept facts of the ten materials, by name."""
    with data_file(FACTS).path.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    return MappingProxyType(
        {
            row["name"]: TensileFacts(
                name=row["name"], **{f.name: float(row[f.name]) for f in fields(TensileFacts)[1:]}
            )
            for row in rows
        }
    )


def write() -> None:
    """Keep the facts of all ten tests; ``python -m softgrip.materials`` calls it."""
    path = data_file(FACTS).path
    header = "".join(line for line in path.open(encoding="utf-8") if line.startswith("#"))
    columns = ",".join(f.name for f in fields(TensileFacts))
    rows = []
    for name in table_5_1():
        first, *numbers = astuple(measure_facts(tensile.load(name)))
        rows.append(",".join([first, *(f"{number:.7g}" for number in numbers)]))
    path.write_text(f"{header}{columns}\n" + "\n".join(rows) + "\n", encoding="utf-8")
