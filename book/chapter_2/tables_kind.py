"""Tables of Chapter 2 on the kind of a contact."""

import pandas as pd

from book.chapter_2.kinds import (
    OBJECTS,
    TRAINING,
    kept,
    right_on_objects,
    without_tested_objects,
)
from book.companion.exhibit import table
from softgrip.provenance import Provenance
from softgrip.tactile.accuracy import Accuracy, counts_behind, mcnemar, overlaps
from softgrip.tactile.contact_kind import bagged_neighbours, nearest_neighbours
from softgrip.tactile.kind_evaluation import accuracy

PRINTED = (
    ("cross-validation", 504, "96.43", "94.84"),
    ("testing", 126, "96.83", "95.24"),
    ("objects", 80, "92.5", "96.25"),
)
"""Where, contacts, accuracy of the single and of the bagging classifier, percent."""

PRINTED_OF = {
    "k-nearest neighbours": ("96.43", "96.83", "92.5"),
    "bagged neighbours": ("94.84", "95.24", "96.25"),
}
"""Printed training and testing accuracy, and that on the objects, percent."""
UNDER = ("< 90", "< 90", "")
"""What is printed of the other classifiers."""


def _percent(found: Accuracy) -> str:
    low, high = found.interval()
    return f"{100 * found.share:.1f} ({100 * low:.1f} to {100 * high:.1f})"


@table(
    "2.E",
    caption="Accuracy (%) of the text's classifiers on the *simulated* pad, with scikit-learn's "
    "settings where the text has none: in 5-fold cross-validation on 504 contacts and on the other "
    "126, means over 20 splits and their range; and on the 80 contacts of eight objects, for the "
    "first seed, with its 95 % interval. In brackets what is printed.",
    provenance=Provenance.SIMULATED,
    data=("tactile/kind_classifiers.csv",),
)
def table_2_e() -> pd.DataFrame:
    """Tabulate the classifiers' accuracies beside the printed ones."""
    rows = []
    for name, found in kept("classifiers").groupby("classifier", sort=False):
        printed = PRINTED_OF.get(str(name), UNDER)
        row = {"classifier": name}
        for words, part, of, print_ in (
            ("training", "cross_validated", "trained", printed[0]),
            ("testing", "tested", "tested_of", printed[1]),
        ):
            shares = 100 * found[part] / found[of]
            row[words] = f"{shares.mean():.1f} ({shares.min():.1f} to {shares.max():.1f})"
            row[words] += f" [{print_}]"
        first = found.iloc[0]
        on_objects = _percent(Accuracy(int(first["objects"]), int(first["objects_of"])))
        row["objects"] = on_objects + (f" [{printed[2]}]" if printed[2] else "")
        rows.append(row)
    return pd.DataFrame(rows)


@table(
    "2.F",
    caption="The printed accuracies as counts: the only number of right answers that rounds to "
    "each percentage, its 95 % interval (Clopper and Pearson, contacts taken as independent), and "
    "whether the two classifiers differ: McNemar's exact test over all that the counts leave open, "
    "from none to as many as possible that both get wrong.",
    provenance=Provenance.PRINTED,
)
def table_2_f() -> pd.DataFrame:
    """Tabulate counts, intervals and tests of the printed accuracies."""
    rows = []
    for where, total, *percents in PRINTED:
        single, bagged = (Accuracy(counts_behind(percent, total)[0], total) for percent in percents)
        p = [test.p_value for test in overlaps(single.correct, bagged.correct, total)]
        rows.append(
            {
                "contacts": f"{where}, {total}",
                "single": f"{percents[0]} %: {single.correct}",
                "single, interval": "{:.1%} to {:.1%}".format(*single.interval()),
                "bagging": f"{percents[1]} %: {bagged.correct}",
                "bagging, interval": "{:.1%} to {:.1%}".format(*bagged.interval()),
                "p": f"{min(p):.3f} to {max(p):.3f}",
            }
        )
    return pd.DataFrame(rows)


@table(
    "2.G",
    caption="Does it know what it never felt? Accuracy (%) with its 95 % interval on the "
    "*simulated* pad: contacts left out at random, and whole objects left out; then on the eight "
    "objects, with and without those of them that are in the training log. Last, McNemar's exact "
    "test between the two classifiers.",
    provenance=Provenance.SIMULATED,
    data=(TRAINING, OBJECTS, "tactile/kind_objects.csv"),
)
def table_2_g() -> pd.DataFrame:
    """Tabulate accuracies on contacts and on objects that were left out."""
    found = kept("objects")
    total = int(found["contacts"].sum())
    rows = [
        {
            "tested on": words,
            "single": _percent(Accuracy(int(found[f"single_{part}"].sum()), total)),
            "bagging": _percent(Accuracy(int(found[f"bagged_{part}"].sum()), total)),
            "p": "",
        }
        for words, part in (
            ("training log, contacts left out", "known"),
            ("training log, objects left out", "new"),
        )
    ]
    for words, training in (
        ("eight objects, trained on all", None),
        ("eight objects, none of them in the training", without_tested_objects()),
    ):
        single, bagged = (
            right_on_objects(model, training)
            for model in (nearest_neighbours(), bagged_neighbours())
        )
        rows.append(
            {
                "tested on": words,
                "single": _percent(accuracy(single)),
                "bagging": _percent(accuracy(bagged)),
                "p": f"{mcnemar(single, bagged).p_value:.2f}",
            }
        )
    return pd.DataFrame(rows)
