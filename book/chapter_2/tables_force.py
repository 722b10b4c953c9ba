"""Tables of Chapter 2 on the contact force."""

import pandas as pd

from book.chapter_2.force_logs import file_of
from book.chapter_2.forces import (
    COMPARISON,
    RANDOM,
    WHOLE,
    kept_comparison,
    weighed_objects,
)
from book.companion.exhibit import table
from softgrip.provenance import Provenance
from softgrip.tactile.force import TABLE_2_2, Weighing, table_2_2
from softgrip.units import GRAM_FORCE


def _measured(weighing: Weighing) -> str:
    return f"{weighing.measured / GRAM_FORCE:.2f} ± {weighing.deviation / GRAM_FORCE:.2f}"


@table(
    "2.2",
    caption="Weights of five objects (gf), mean and deviation of ten measurements, as printed and "
    "by the *simulated* layer, with the accuracy (%) of the mean. The simulated deviations follow "
    "from a spread of seating that is calibrated to the printed ones; all simulated objects are "
    "rigid. Bandwidth by leaving out whole weights.",
    provenance=Provenance.SIMULATED,
    data=(TABLE_2_2, file_of("weights"), file_of("objects")),
)
def table_2_2_beside_ours() -> pd.DataFrame:
    """Tabulate Table 2.2 beside the simulated layer."""
    ours = weighed_objects()
    return pd.DataFrame(
        {
            "object": name,
            "true": f"{row.true / GRAM_FORCE:.0f}",
            "printed": _measured(row),
            "accuracy": f"{100 * row.accuracy:.1f}",
            "simulated": _measured(ours[name]),
            "simulated accuracy": f"{100 * ours[name].accuracy:.1f}",
        }
        for name, row in table_2_2().items()
    )


@table(
    "2.H",
    caption="What Table 2.2 says beyond its accuracies: the 95 % interval of each mean (gf), the p "
    "of Student's test that the mean is the true weight, the accuracy (%) of the mean as printed "
    "and that of one measurement, if ten scatter normally, and the deviation in newtons, of which "
    "Section 2.2 says 0.015 N on average.",
    provenance=Provenance.PRINTED,
    data=(TABLE_2_2,),
)
def table_2_h() -> pd.DataFrame:
    """Tabulate intervals and tests of Table 2.2."""
    rows = []
    for name, row in table_2_2().items():
        low, high = (limit / GRAM_FORCE for limit in row.interval())
        rows.append(
            {
                "object": name,
                "true": f"{row.true / GRAM_FORCE:.0f}",
                "mean, 95 %": f"{low:.2f} to {high:.2f}",
                "p of the bias": f"{row.bias_p:.3f}",
                "accuracy of the mean": f"{100 * row.accuracy:.1f}",
                "of one": f"{100 * row.accuracy_of_one:.1f}",
                "deviation (N)": f"{row.deviation:.4f}",
            }
        )
    every = table_2_2().values()
    count = len(every)
    rows.append(
        {
            "object": "mean",
            "true": "",
            "mean, 95 %": "",
            "p of the bias": "",
            "accuracy of the mean": f"{100 * sum(r.accuracy for r in every) / count:.1f}",
            "of one": f"{100 * sum(r.accuracy_of_one for r in every) / count:.1f}",
            "deviation (N)": f"{sum(r.deviation for r in every) / count:.4f}",
        }
    )
    return pd.DataFrame(rows)


@table(
    "2.I",
    caption="Root mean square errors (gf) of regressors on points of the *simulated* layer that "
    "were left out of the training: a fifth at random (mean of 20 draws), and all points of one "
    'weight at a time. "Wide" has the bandwidth that is best for the latter, chosen on the same '
    "points; isotonic regression is ours, and has no setting.",
    provenance=Provenance.SIMULATED,
    data=(COMPARISON,),
)
def table_2_i() -> pd.DataFrame:
    """Tabulate the comparison of regressors."""
    return pd.DataFrame(
        {
            "regressor": name,
            "a fifth at random": f"{row[RANDOM]:.2f}",
            "a weight at a time": f"{row[WHOLE]:.2f}",
        }
        for name, row in (kept_comparison() / GRAM_FORCE).iterrows()
    )
