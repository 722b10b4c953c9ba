"""The plots and the table of Chapter 2 on contacts, for a pad of one's own."""

import numpy as np
import pandas as pd
from IPython.display import SVG

from book.chapter_2.figures_kind import draw_confusions, draw_neighbours
from book.companion.save import svg
from book.companion.style import style
from softgrip.tactile.contact_kind import nearest_neighbours
from softgrip.tactile.contact_pose import place_errors
from softgrip.tactile.contacts import Contacts
from softgrip.tactile.estimate import Estimate
from softgrip.tactile.kind_evaluation import split_score, train_and_test
from softgrip.tactile.own_pad import PadReadings
from softgrip.tactile.pad_layout import THREE_TWO_THREE
from softgrip.tactile.pad_model import KindSettings, PadModel
from softgrip.units import DEG, MM


def show_neighbours(readings: PadReadings, *, splits: int = 3) -> SVG:
    """Draw Figure 2.7 for readings with kinds: accuracy over k from 1 to 10, on random splits."""
    scores = {
        k: [
            split_score(
                nearest_neighbours(k),
                readings.voltages,
                readings.labels,
                seed=seed,
                groups=readings.groups,
            )
            for seed in range(splits)
        ]
        for k in range(1, 11)
    }
    with style():
        return SVG(svg(draw_neighbours(scores)))  # type: ignore[no-untyped-call]


def show_confusions(readings: PadReadings, *, seed: int = 0) -> SVG:
    """Draw Figure 2.11 for readings with kinds: what two classifiers say of a fifth left out."""
    train, test = train_and_test(readings.labels, seed=seed, groups=readings.groups)
    settings = {"single": KindSettings(estimators=0), "bagging": KindSettings()}
    told = {
        name: PadModel(one).fit(readings.take(train)).predict(readings.voltages[test])
        for name, one in settings.items()
    }
    with style():
        return SVG(svg(draw_confusions(readings.labels[test], told)))  # type: ignore[no-untyped-call]


def contact_table(contacts: Contacts, told: Estimate) -> pd.DataFrame:
    """Tabulate what is told of contacts; errors too where their truth is known, as simulated."""
    (x, y), off = told.places.T / MM, place_errors(contacts, THREE_TWO_THREE)
    columns = {
        "time (s)": contacts.times.round(1),
        "object": contacts.objects,
        "kind": told.kinds,
        "x (mm)": x.round(1),
        "y (mm)": y.round(1),
        "angle (deg)": (told.angles / DEG).round(),
        "force (N)": told.forces.round(3),
    }
    if np.isfinite(contacts.forces).all():
        columns |= {
            "is": contacts.kinds,
            "place off (mm)": (off.place / MM).round(1),
            "angle off (deg)": (off.angle / DEG).round(),
            "force off (N)": (told.forces - contacts.forces).round(3),
        }
    return pd.DataFrame(columns)
