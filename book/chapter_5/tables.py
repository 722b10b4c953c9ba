"""Tables of Chapter 5."""

from math import inf

import numpy as np
import pandas as pd

from book.chapter_5.figures import TESTS
from book.companion.exhibit import table
from book.companion.verdict import ledger, verdict_of
from softgrip.materials import tensile
from softgrip.materials.facts import facts
from softgrip.materials.fitting import Fitting, bootstrap_interval, fractional_power, ranking
from softgrip.materials.leave_out import RIVALS, leave_k_out
from softgrip.materials.table import table_5_1
from softgrip.provenance import Provenance
from softgrip.units import MPa

BEST = Fitting()


@table(
    "5.1",
    caption="The ten elastomers: the fractional power n as printed and as fitted to the public "
    "tensile tests (true stress, strains up to 600 %, E held); modulus E (MPa) as printed beside "
    "the tests' stress at 100 % strain; viscosity (Pa s); strength (MPa) as printed beside the "
    "tests' largest stress.",
    provenance=Provenance.PUBLIC,
    sources=TESTS,
)
def table_5_1_beside_tests() -> pd.DataFrame:
    """Tabulate the ten materials beside what their tensile tests give."""
    rows = []
    for material in table_5_1().values():
        known = facts()[material.name]
        interval = "no test"
        if tensile.available():
            low, high = bootstrap_interval(tensile.load(material.name), BEST)
            interval = f"{low:.2f} to {high:.2f}"
        rows.append(
            {
                "material": material.name,
                "n printed": f"{material.fractional_power:.3f}",
                "n fitted": f"{fractional_power(material.name, BEST):.3f}",
                "95 %": interval,
                "verdict": verdict_of(5, "table-5.1-n-{key}", material.name),
                "E": f"{material.young_modulus / MPa:.2f}",
                "at 100 %": f"{known.hundred_percent_modulus / MPa:.3f}",
                "viscosity": f"{material.mixed_viscosity:g}",
                "strength": f"{material.tensile_strength / MPa:.2f}",
                "largest": f"{known.peak_stress / MPa:.2f}",
            }
        )
    return pd.DataFrame(rows)


@table(
    "5.2",
    caption="The two held-out materials: true and estimated fractional power, and the error that "
    "the summary states. The recomputed true value is that of Table 5.1.",
    provenance=Provenance.PRINTED,
)
def table_5_2() -> pd.DataFrame:
    """Tabulate what is printed of the two held-out materials, and what comes of it."""
    return pd.DataFrame(
        {
            "what": entry.claim.what,
            "printed": f"{'' if entry.claim.relation == '=' else '< '}{entry.claim.printed}",
            "recomputed": f"{entry.recomputed:.4g}",
            "verdict": entry.verdict,
        }
        for entry in ledger(5, ["Table 5.2", "Section 5.5"])
    )


@table(
    "5.A",
    caption="Ways to read n from a curve, held against the printed column: the five best of 96, "
    "and the same choices as the best with one of them changed.",
    provenance=Provenance.PUBLIC,
)
def table_5_a() -> pd.DataFrame:
    """Tabulate the best ways of fitting and their neighbours."""
    scores = ranking()
    neighbours = [
        Fitting(stress="engineering"),
        Fitting(loss="log"),
        Fitting(longest_strain=inf),
        Fitting(modulus="free"),
    ]
    chosen = scores[:5] + [s for s in scores if s.fitting in neighbours and s not in scores[:5]]
    return pd.DataFrame(
        {
            "stress": s.fitting.stress,
            "least squares of": s.fitting.loss,
            "strains up to": "peak" if s.fitting.longest_strain == inf
            else f"{s.fitting.longest_strain:.0%}",
            "E": s.fitting.modulus,
            "come out": s.come_out,
            "within 2 %": s.within_2_percent,
            "within 5 %": s.within_5_percent,
            "median error": f"{s.median_error:.1%}" if s.median_error < inf else "no fit",
        }
        for s in chosen
    )  # fmt: skip


@table(
    "5.B",
    caption="Errors of n when materials are predicted that the fit has not seen: each one, and "
    "each two, of the ten held out in turn.",
    provenance=Provenance.PRINTED,
)
def table_5_b() -> pd.DataFrame:
    """Tabulate leave-one-out and leave-two-out errors of three models."""
    rows = []
    for name, model in RIVALS.items():
        for k in (1, 2):
            found = leave_k_out(k, model=model())
            errors = {p: abs(p.error / p.printed) for p in found.predictions}
            worst = max(errors, key=lambda p: errors[p])
            rows.append(
                {
                    "model": name,
                    "held out": k,
                    "RMS error of n": f"{found.rms_error:.3f}",
                    "within 10 %": f"{np.mean(np.array([*errors.values()]) < 0.1):.0%}",
                    "worst": f"{errors[worst]:.0%} ({worst.name})",
                }
            )
    return pd.DataFrame(rows)
