"""What is kept of each tensile test: a few numbers, never the measurements.

They let the pages be built, and the ledger be judged, where the tests cannot be had.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from softgrip.kept import Kept
from softgrip.materials import tensile, yeoh
from softgrip.materials.table import table_5_1
from softgrip.materials.tensile import TensileTest
from softgrip.provenance import Provenance
from softgrip.reads import remembered


@dataclass(frozen=True)
class TensileFacts:
    """A tensile test in numbers.

    Attributes:
        name: Material.
        hundred_percent_modulus: Engineering stress at strain 1, Pa.
        peak_stress, peak_strain: Largest engineering stress [Pa], and the engineering strain there.
        yeoh_1, yeoh_2, yeoh_3: Coefficients of Yeoh's law fitted up to the peak, Pa.
        yeoh_rms: Its RMS misfit in engineering stress, Pa.
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


KEPT = Kept(
    "materials/tensile_facts.csv",
    TensileFacts,
    lambda: (measure_facts(tensile.load(name)) for name in table_5_1()),
    "Soft Robotics Materials Database (doi 10.1089/soro.2019.0115), reduced by: "
    "python -m softgrip.materials",
    notes="Stresses and Yeoh coefficients in Pa, engineering stress and strain. "
    "No measurement is contained.",
    number=".7g",
    provenance=Provenance.PUBLIC,
)


@remembered
def facts() -> Mapping[str, TensileFacts]:
    """Read the kept facts of the ten materials, by name."""
    return MappingProxyType({row.name: row for row in KEPT.read()})
