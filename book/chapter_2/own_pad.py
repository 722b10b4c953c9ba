"""The plots of Chapter 2 on the contact kind, for the readings of a pad of one's own."""

from IPython.display import SVG

from book.chapter_2.figures_kind import draw_confusions, draw_neighbours
from book.companion.save import svg
from book.companion.style import style
from softgrip.tactile.contact_kind import nearest_neighbours
from softgrip.tactile.kind_evaluation import split_score, train_and_test
from softgrip.tactile.own_pad import PadReadings
from softgrip.tactile.pad_model import KindSettings, PadModel


def show_neighbours(readings: PadReadings, *, splits: int = 3) -> SVG:
    """Draw Figure 2.7 for readings with kinds: accuracy over k from 1 to 10, on random splits."""
    scores = {
        k: [
            split_score(nearest_neighbours(k), readings.voltages, readings.labels, seed=seed)
            for seed in range(splits)
        ]
        for k in range(1, 11)
    }
    with style():
        return SVG(svg(draw_neighbours(scores)))  # type: ignore[no-untyped-call]


def show_confusions(readings: PadReadings, *, seed: int = 0) -> SVG:
    """Draw Figure 2.11 for readings with kinds: what two classifiers say of a fifth left out."""
    train, test = train_and_test(readings.labels, seed=seed)
    settings = {"single": KindSettings(estimators=0), "bagging": KindSettings()}
    told = {
        name: PadModel(one).fit(readings.take(train)).predict(readings.voltages[test])
        for name, one in settings.items()
    }
    with style():
        return SVG(svg(draw_confusions(readings.labels[test], told)))  # type: ignore[no-untyped-call]
