"""Figures and tables of Chapter 2 on the kind of a contact; two draw a reader's own pad as well."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from numpy.typing import ArrayLike
from sklearn.base import clone
from sklearn.metrics import confusion_matrix

from book.chapter_2.kinds import (
    TOTALS,
    kept,
    kept_neighbours,
    right_on_objects,
    split_shares,
    without_tested_objects,
)
from book.chapter_2.logs import OBJECTS, TRAINING, contacts
from book.companion.claims import printed, printed_text
from book.companion.exhibit import figure, table
from book.companion.style import BLUE, GREY, ORANGE, PRINTED, VERMILION, WIDTH, sheet
from softgrip.provenance import Provenance
from softgrip.tactile.accuracy import Accuracy, counts_behind, mcnemar, overlaps
from softgrip.tactile.contact_kind import NEIGHBOURS, bagged_neighbours, nearest_neighbours
from softgrip.tactile.contacts import KINDS
from softgrip.tactile.kind_evaluation import SplitScore, accuracy


def printed_accuracies() -> list[tuple[str, int, str, str]]:
    """Return where, contacts, accuracy of the single and of the bagging classifier, percent."""
    shares = {"cross-validation": "training", "testing": "testing"}
    collected = printed("2.3-contacts")
    found = [
        (
            where,
            round(collected * printed(f"2.3-share-{part}") / 100),
            printed_text(f"2.3-single-{part}"),
            printed_text(f"2.3-bagged-{part}"),
        )
        for where, part in shares.items()
    ]
    both = printed_text("2.4-objects-single"), printed_text("2.4-objects-bagged")
    return [*found, ("objects", round(printed("2.4-objects-contacts")), *both)]


def printed_right(place: int) -> tuple[int, int]:
    """Return right answers of both behind a row of `printed_accuracies`: one number each."""
    _, total, single, bagged = printed_accuracies()[place]
    return counts_behind(single, total)[0], counts_behind(bagged, total)[0]


def draw_neighbours(scores: Mapping[int, Sequence[SplitScore]]) -> Figure:
    """Draw training and testing accuracy over k: the mean over the splits, and their range.

    Args:
        scores: By k, one for each split, such as from `kind_evaluation.split_score`.
    """
    drawn, axes = sheet(3.2)
    ks = sorted(scores)
    for name, colour, dash in (("training", BLUE, "-"), ("testing", ORANGE, "--")):
        part = "cross_validated" if name == "training" else "tested"
        shares = 100 * np.array([[getattr(s, part).share for s in scores[k]] for k in ks])
        axes.fill_between(ks, shares.min(axis=1), shares.max(axis=1), color=colour, alpha=0.2, lw=0)
        axes.plot(ks, shares.mean(axis=1), dash, marker="o", color=colour, label=name)
    axes.set(xlabel="k, neighbours that vote", ylabel="accuracy (%)", xticks=ks)
    drawn.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return drawn


def draw_confusions(truth: ArrayLike, told: Mapping[str, ArrayLike]) -> Figure:
    """Draw a confusion matrix for each classifier, side by side; counts, and shares of a row.

    Args:
        truth: Kinds of the contacts, shape (N,).
        told: What each classifier said, by its name, shape (N,) each.
    """
    drawn = Figure(figsize=(WIDTH, 3.0))
    every = drawn.subplots(1, len(told), sharey=True, squeeze=False)[0]
    present = {str(kind) for each in (truth, *told.values()) for kind in np.asarray(each)}
    kinds = [k for k in KINDS if k in present] + sorted(present - set(KINDS))
    for axes, (name, said) in zip(every, told.items(), strict=True):
        counts = confusion_matrix(truth, said, labels=kinds)
        shares = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)
        axes.imshow(shares, cmap="Blues", vmin=0, vmax=1.6)  # light enough for black text
        for row, column in np.ndindex(counts.shape):
            count, share = counts[row, column], shares[row, column]
            # The point carries the count into the figure's table of numbers.
            axes.scatter(column, row, s=0, label=f"{kinds[row]} told as {kinds[column]}: {count}")
            axes.text(column, row, f"{count}\n{100 * share:.0f} %", ha="center", va="center",
                      fontsize=9.5)  # fmt: skip
        right = Accuracy(int(np.trace(counts)), int(counts.sum()))
        axes.set(title=f"{name}\n{right.correct} of {right.total}, {100 * right.share:.2f} %",
                 xlabel="told", xticks=range(len(kinds)), yticks=range(len(kinds)))  # fmt: skip
        axes.set_xticklabels(kinds, fontsize=9.5)
        axes.set_yticklabels(kinds, fontsize=9.5)
        axes.grid(False)
    every[0].set_ylabel("true")
    return drawn


@figure("2.7", Provenance.SIMULATED)
def figure_2_7() -> Figure:
    """Draw training and testing accuracy against k."""
    drawn = draw_neighbours(kept_neighbours())
    axes = drawn.axes[0]
    for name, (_, _, single, _), fill in zip(
        ("training", "testing"), printed_accuracies(), (PRINTED, "none"), strict=False
    ):
        axes.plot([NEIGHBOURS], [float(single)], "s", mec=PRINTED, mfc=fill,
                  label=f"{name}, printed")  # fmt: skip
    drawn.legends[0].remove()
    drawn.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return drawn


@figure("2.11", Provenance.SIMULATED)
def figure_2_11() -> Figure:
    """Draw the confusion matrices of the single and of the bagging classifier."""
    felt, new = contacts(TRAINING), contacts(OBJECTS)
    models = {"(a) single": nearest_neighbours(), "(b) bagging": bagged_neighbours()}
    told = {
        name: clone(model).fit(felt.responses, felt.kinds).predict(new.responses)
        for name, model in models.items()
    }
    return draw_confusions(new.kinds, told)


def printed_gain() -> int:
    """Return how many more objects' contacts bagging has right, as printed."""
    single, bagged = printed_right(-1)
    return bagged - single


@figure("2.E", Provenance.SIMULATED)
def figure_2_e() -> Figure:
    """Draw the distribution of the gain by bagging."""
    drawn, axes = sheet(2.8)
    found = kept("draws")
    for name, label, colour, side in (
        ("bagged", "with replacement", BLUE, -0.2),
        ("bagged_without_replacement", "without", ORANGE, 0.2),
    ):
        gain, count = np.unique(found[name] - found["single"], return_counts=True)
        axes.bar(gain + side, count, width=0.4, color=colour, label=label)
    axes.axvline(printed_gain(), color=PRINTED, ls="--", label="printed")
    axes.axvline(0, color=GREY, lw=0.8)
    axes.set(xlabel="bagging right, minus single right (of 80)", ylabel="seeds (of 200)")
    drawn.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return drawn


@figure("2.F", Provenance.SIMULATED)
def figure_2_f() -> Figure:
    """Draw the accuracy on objects that were felt before and that were not."""
    found = kept("objects")
    drawn = Figure(figsize=(WIDTH, 1.2 + 0.24 * len(found)))
    axes: Any = drawn.subplots()
    place = np.arange(len(found))[::-1]
    new = [Accuracy(*pair) for pair in zip(found["single_new"], found["contacts"], strict=True)]
    ends = 100 * np.array([each.interval() for each in new])
    axes.hlines(place, *ends.T, color=VERMILION, lw=1.0)
    axes.plot([100 * each.share for each in new], place, "D", color=VERMILION, label="never felt")
    axes.plot(100 * found["single_known"] / found["contacts"], place, "o", color=BLUE, mfc="none",
              label="felt before")  # fmt: skip
    axes.set_yticks(place, [f"{o} ({k})" for o, k in zip(found["object"], found["kind"],
                                                         strict=True)])  # fmt: skip
    axes.set(xlabel="accuracy (%)", ylabel="object", xlim=(-3, 103))
    drawn.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return drawn


def _printed_of(classifier: str) -> tuple[str, ...]:
    """Return what is printed of a classifier: in cross-validation, in testing, on objects."""
    named = ("k-nearest neighbours", "bagged neighbours")
    if classifier in named:
        return tuple(row[2:][named.index(classifier)] for row in printed_accuracies())
    parts = ("cross-validated", "tested")
    return (*(f"< {printed_text(f'2.3-others-{part}')}" for part in parts), "")


def _percent(found: Accuracy) -> str:
    low, high = found.interval()
    return f"{100 * found.share:.1f} ({100 * low:.1f} to {100 * high:.1f})"


@table("2.E", Provenance.SIMULATED)
def table_2_e() -> pd.DataFrame:
    """Tabulate the classifiers' accuracies beside the printed ones."""
    rows = []
    for name, found in kept("classifiers").groupby("classifier", sort=False):
        told = _printed_of(str(name))
        row = {"classifier": name}
        parts = zip(("training", "testing"), TOTALS, told, strict=False)
        for words, part, print_ in parts:
            share = 100 * split_shares(str(name), part)
            row[words] = f"{share.mean():.1f} ({share.min():.1f} to {share.max():.1f}) [{print_}]"
        first = found.iloc[0]
        on_objects = _percent(Accuracy(int(first["objects"]), int(first["objects_of"])))
        row["objects"] = on_objects + (f" [{told[2]}]" if told[2] else "")
        rows.append(row)
    return pd.DataFrame(rows)


@table("2.F", Provenance.PRINTED)
def table_2_f() -> pd.DataFrame:
    """Tabulate counts, intervals and tests of the printed accuracies."""
    rows = []
    for place, (where, total, *percents) in enumerate(printed_accuracies()):
        single, bagged = (Accuracy(right, total) for right in printed_right(place))
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


@table("2.G", Provenance.SIMULATED)
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
