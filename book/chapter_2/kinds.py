"""How well the kind of contact is told on the simulated pad: ``python -m book.chapter_2.kinds``.

The training log stands for the 630 responses of Section 2.3, the other log for the 80 contacts of
Section 2.4. Right answers are kept as counts, so that intervals can be put on them.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from book.chapter_2.logs import OBJECTS, TRAINING, contacts
from softgrip.kept import write_data
from softgrip.provenance import data_file, data_folder
from softgrip.tactile.accuracy import Accuracy
from softgrip.tactile.contact_kind import bagged_neighbours, classifiers, nearest_neighbours
from softgrip.tactile.contacts import Contacts
from softgrip.tactile.kind_evaluation import (
    Right,
    SplitScore,
    cross_validated,
    cross_validated_by_object,
    right_on_new,
    split_score,
)

NEIGHBOURS = range(1, 11)
TOTALS = {"cross_validated": "trained", "tested": "tested_of"}
"""Column of the contacts for each column of right answers."""
SPLITS, DRAWS = 20, 200
"""Seeds of splits in training and testing, and of the bagging classifier's draws."""


def right_on_objects(model: Any, training: Contacts | None = None) -> Right:
    """Tell which contacts of the test log are right after training on the other log."""
    felt, new = training or contacts(TRAINING), contacts(OBJECTS)
    return right_on_new(model, felt.responses, felt.kinds, new.responses, new.kinds)


def without_tested_objects() -> Contacts:
    """Return the training log without the objects that are in the test log too."""
    felt = contacts(TRAINING)
    return felt.take(~np.isin(felt.objects, contacts(OBJECTS).objects))


def _row(model: Any, seed: int) -> dict[str, int]:
    felt = contacts(TRAINING)
    found = split_score(model, felt.responses, felt.kinds, seed=seed)
    return {
        "cross_validated": found.cross_validated.correct,
        "trained": found.cross_validated.total,
        "tested": found.tested.correct,
        "tested_of": found.tested.total,
    }


def over_neighbours() -> pd.DataFrame:
    """Count right answers of the single classifier over k and the seed of the split."""
    return pd.DataFrame(
        {"seed": seed, "k": k, **_row(nearest_neighbours(k), seed)}
        for seed in range(SPLITS)
        for k in NEIGHBOURS
    )


def over_classifiers() -> pd.DataFrame:
    """Count right answers of each classifier over the seed of the split, and on the objects."""
    return pd.DataFrame(
        {
            "seed": seed,
            "classifier": name,
            **_row(model, seed),
            "objects": int(right_on_objects(model).sum()),
            "objects_of": len(contacts(OBJECTS)),
        }
        for seed in range(SPLITS)
        for name, model in classifiers(seed).items()
    )


def over_draws() -> pd.DataFrame:
    """Count right answers on the objects over the seed of the bagging classifier's draws."""
    single = int(right_on_objects(nearest_neighbours()).sum())
    return pd.DataFrame(
        {
            "seed": seed,
            "single": single,
            "bagged": int(right_on_objects(bagged_neighbours(seed=seed)).sum()),
            "bagged_without_replacement": int(
                right_on_objects(bagged_neighbours(seed=seed, replacement=False)).sum()
            ),
            "objects_of": len(contacts(OBJECTS)),
        }
        for seed in range(DRAWS)
    )


def over_objects() -> pd.DataFrame:
    """Count right answers on each object of the training log: known before, and never felt."""
    felt = contacts(TRAINING)
    x, y = felt.responses, felt.kinds
    found = pd.DataFrame({"object": felt.objects, "kind": y, "contacts": 1})
    for name, model in (("single", nearest_neighbours()), ("bagged", bagged_neighbours())):
        found[f"{name}_known"] = cross_validated(model, x, y, seed=0).astype(int)
        found[f"{name}_new"] = cross_validated_by_object(model, x, y, felt.objects).astype(int)
    return found.groupby(["kind", "object"], as_index=False).sum()


STUDIES = {
    "neighbours": over_neighbours,
    "classifiers": over_classifiers,
    "draws": over_draws,
    "objects": over_objects,
}
"""The kept files, ``data/tactile/kind_*.csv``, and what makes them."""


def kept(study: str) -> pd.DataFrame:
    """Read a kept file; `study` is a key of `STUDIES`."""
    return pd.read_csv(data_file(f"tactile/kind_{study}.csv").path, comment="#")


def split_shares(classifier: str, part: str) -> "pd.Series[float]":
    """Return right answers of a classifier by contacts, one for each split.

    Args:
        classifier: A key of `classifiers`.
        part: "cross_validated" or "tested".
    """
    rows = kept("classifiers")
    rows = rows[rows["classifier"] == classifier]
    return rows[part] / rows[TOTALS[part]]


def kept_neighbours() -> dict[int, list[SplitScore]]:
    """Return the kept scores of the single classifier by k, one for each split."""
    return {
        int(k): [
            SplitScore(
                Accuracy(row.cross_validated, row.trained), Accuracy(row.tested, row.tested_of)
            )
            for row in rows.itertuples()
        ]
        for k, rows in kept("neighbours").groupby("k")
    }


def write() -> Iterator[Path]:
    """Make all files anew; yields each one when it is done (half a minute in all)."""
    for study, make in STUDIES.items():
        path = data_folder() / f"tactile/kind_{study}.csv"
        yield write_data(path, make().to_csv(index=False), source="python -m book.chapter_2.kinds")


if __name__ == "__main__":
    for written in write():
        print(written, flush=True)
