"""Tables of Chapter 5 on the dynamic model: consistency, identified parameters, errors."""

import numpy as np
import pandas as pd

from book.chapter_5 import step_protocols as step_test_protocols
from book.chapter_5.figures_dynamics import WORDS
from book.chapter_5.numbers import PRINTED_RMS
from book.chapter_5.step_models import FINGERS, KINDS, identified_at
from book.chapter_5.step_protocols import SIZE
from book.companion.exhibit import table
from softgrip.dynamics import linear, ludwick
from softgrip.dynamics.consistency import agreements
from softgrip.dynamics.identify import Estimate
from softgrip.materials.table import material
from softgrip.provenance import Provenance

SHORT = ("at 60", "n of 5.2", "n of 5.1", "each", "at 30", "step", "stated K")
"""Names of `step_protocols.PROTOCOLS` that fit above a column."""


@table(
    "5.C",
    caption="Do the equations agree where they should? The ratio is 1 where they do; n = 2.365 "
    "where no other is named.",
    provenance=Provenance.PRINTED,
)
def table_5_c() -> pd.DataFrame:
    """Tabulate what reduces to what."""
    return pd.DataFrame(
        {"of what to what": a.what, "ratio": f"{a.ratio:.3f}", "agree": "yes" if a.holds else "no"}
        for a in agreements()
    )


def _interval(found: Estimate) -> str:
    return f"{found.value:.3g} ± {(found.high - found.low) / 2:.1g}"


@table(
    "5.D",
    caption="What the 60 deg test of the *simulated* rig identifies, with 95 % intervals that "
    "suppose the model true: mass (N s^2), damping (N s), stiffness (N), all for the force by "
    "pressure of Figure 3.9; the fit in percent; and the stiffness by Eq. (5.10) or (5.13).",
    provenance=Provenance.SIMULATED,
)
def table_5_d() -> pd.DataFrame:
    """Tabulate the identified parameters beside the stiffness that the text states."""
    rows = []
    for design, finger in FINGERS.items():
        modulus = material(finger.material).young_modulus
        for kind in KINDS:
            found = identified_at(design, kind)
            stated = (
                linear.spring_constant(modulus, **SIZE)
                if kind == "linear"
                else ludwick.spring_constant(modulus, finger.estimated, **SIZE)
            )
            rows.append(
                {
                    "finger": design,
                    "model": WORDS[kind],
                    "mass": _interval(found.mass),
                    "damping": _interval(found.damping),
                    "stiffness": _interval(found.stiffness),
                    "fit": f"{found.fit_percent:.1f}",
                    "stated stiffness": f"{stated:.3g}",
                }
            )
    return pd.DataFrame(rows)


@table(
    "5.E",
    caption="RMS errors in deg: printed, and on the *simulated* rig by what is not printed. At 60: "
    "both models identified there, as in Figures 5.6 and 5.7. Then the same with n of Table 5.2's "
    "true column, or of Table 5.1. Each: identified at each test itself. At 30: identified at a "
    "step to 30 deg. Step: driven by a step of the force that holds the set point in the place of "
    "the measured pressure. Stated K: stiffness by Eq. (5.10) and (5.13).",
    provenance=Provenance.SIMULATED,
)
def table_5_e() -> pd.DataFrame:
    """Tabulate the eight errors under each protocol."""
    kept = step_test_protocols.kept_errors()
    return pd.DataFrame(
        {
            "test": f"{design}, {angle} deg",
            "model": kind.capitalize(),
            "printed": f"{printed:.2f}",
            **{
                short: _degrees(errors[design, angle, kind])
                for short, errors in zip(SHORT, kept.values(), strict=True)
            },
        }
        for (design, angle, kind), printed in PRINTED_RMS.items()
    )


def _degrees(error: float) -> str:
    return "no fit" if np.isnan(error) else f"{error:.2f}" if error < 100 else f"{error:.0f}"
