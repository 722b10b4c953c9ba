"""What the exhibits on the kind of a contact show is what their data and the text say."""

import numpy as np
import pandas as pd
import pytest

from book.chapter_2 import figures_kind as shown
from book.chapter_2 import kinds as kind_study
from book.chapter_2.kinds import kept
from book.chapter_2.logs import OBJECTS, TRAINING, contacts
from book.companion.save import numbers
from book.companion.style import style
from softgrip.tactile.accuracy import Accuracy, counts_behind
from softgrip.tactile.kind_evaluation import SplitScore


def test_logs_are_as_many_contacts_as_the_text_says():
    assert len(contacts(TRAINING)) == 630
    names, count = np.unique(contacts(OBJECTS).objects, return_counts=True)
    assert (len(names), set(count.tolist())) == (8, {10})


@pytest.mark.parametrize("study", ["neighbours", "classifiers"])
def test_kept_counts_of_the_first_split_come_out_again(study, monkeypatch):
    """A log that was changed without remaking what is kept of it is found here."""
    monkeypatch.setattr(kind_study, "SPLITS", 1)
    again = kind_study.STUDIES[study]()
    pd.testing.assert_frame_equal(again, kept(study)[: len(again)])


def test_kept_counts_of_the_first_draws_come_out_again(monkeypatch):
    monkeypatch.setattr(kind_study, "DRAWS", 3)
    pd.testing.assert_frame_equal(kind_study.over_draws(), kept("draws")[:3])


def test_kept_counts_of_objects_are_those_of_the_log():
    found = kept("objects").set_index("object")
    names, count = np.unique(contacts(TRAINING).objects, return_counts=True)
    assert found["contacts"].to_dict() == dict(zip(names, count, strict=True))
    right = found[[name for name in found if name.endswith(("known", "new"))]]
    assert (right.le(found["contacts"], axis=0) & right.ge(0)).all(axis=None)


def test_single_classifier_on_the_objects_by_distances_in_numpy():
    felt, new = contacts(TRAINING), contacts(OBJECTS)
    low, high = felt.responses.min(axis=0), felt.responses.max(axis=0)
    known, asked = (np.clip((c.responses - low) / (high - low), 0, 1) for c in (felt, new))
    near = np.linalg.norm(asked[:, None] - known, axis=2).argsort(axis=1, kind="stable")[:, :3]
    names = np.unique(felt.kinds)
    votes = (felt.kinds[near][..., None] == names).sum(axis=1)
    right = int((names[votes.argmax(axis=1)] == new.kinds).sum())
    # Of several contacts at one distance another one may vote.
    assert right == pytest.approx(kept("draws")["single"].iloc[0], abs=1)


def test_training_without_the_tested_objects_has_none_of_them():
    left = kind_study.without_tested_objects()
    assert not set(left.objects) & set(contacts(OBJECTS).objects)
    assert set(left.kinds) == {"point", "line", "surface"}


def test_confusions_are_counted_as_by_hand():
    told = {"one": ["point", "line", "line", "surface"], "two": ["point", "point", "line", "line"]}
    with style():
        drawn = shown.draw_confusions(["point", "point", "line", "surface"], told)
    cells = set(numbers(drawn)["series"])
    assert {"point told as line: 1", "line told as line: 1", "surface told as line: 1"} <= cells
    assert [axes.get_title(loc="left").split("\n")[1] for axes in drawn.axes] == [
        "3 of 4, 75.00 %",
        "3 of 4, 75.00 %",
    ]


def test_other_kinds_than_those_of_the_text_can_be_drawn():
    drawn = shown.draw_confusions(["edge", "tip"], {"mine": ["edge", "edge"]})
    assert [label.get_text() for label in drawn.axes[0].get_xticklabels()] == ["edge", "tip"]


def test_curve_is_the_mean_over_the_splits():
    scores = {k: [SplitScore(Accuracy(k, 10), Accuracy(n, 4)) for n in (0, 2)] for k in range(1, 4)}
    frame = numbers(shown.draw_neighbours(scores))
    assert frame.query("series == 'training'")["y"].tolist() == [10, 20, 30]
    assert frame.query("series == 'testing'")["y"].tolist() == [25, 25, 25]


def test_confusions_of_figure_2_11_hold_every_contact_once_each():
    cells = numbers(shown.figure_2_11())
    counts = cells["series"].str.split(": ").str[1].astype(int)
    assert counts.groupby(cells["panel"]).sum().tolist() == [80, 80]


def test_gain_of_figure_2_e_has_every_seed():
    frame = numbers(shown.figure_2_e())
    for name in ("with replacement", "without"):
        assert frame.loc[frame["series"] == name, "y"].sum() == kind_study.DRAWS


def test_printed_accuracies_of_the_table_stand_for_one_count_each():
    for _, total, *percents in shown.printed_accuracies():
        assert [len(counts_behind(percent, total)) for percent in percents] == [1, 1]


def test_table_of_printed_counts_by_hand():
    """Of 80: 0 against 3 gives 2 / 2^3; 6 against 3, twice the chance of 3 or fewer of nine."""
    row = shown.table_2_f().iloc[2]
    assert row["p"] == f"{2 / 2**3:.3f} to {2 * (1 + 9 + 36 + 84) / 2**9:.3f}"
    assert row["single"] == "92.5 %: 74"
