"""Figures and tables on the contact force: what they draw is what the science says."""

import numpy as np
import pytest

from book.chapter_2 import figures_force as chapter_2_force
from book.chapter_2.figures_force import figure_2_9, figure_2_h
from book.chapter_2.forces import weight_bandwidth, weight_points
from book.chapter_2.sliders import bandwidth, bandwidth_plot
from book.companion.exhibit import EXHIBITS
from book.companion.save import make, numbers
from softgrip.provenance import Provenance
from softgrip.tactile.nadaraya_watson import NadarayaWatson
from softgrip.units import GRAM_FORCE
from tests.book.explore.page_laws import title

OURS = [item for item in EXHIBITS.values() if item.make.__module__ == chapter_2_force.__name__]


def test_all_are_there():
    titles = {item.title for item in OURS}
    assert titles == {"Figure 2.8", "Figure 2.9", "Figure 2.G", "Figure 2.H",
                      "Table 2.2", "Table 2.H", "Table 2.I"}  # fmt: skip


@pytest.mark.parametrize("item", OURS, ids=lambda item: item.title)
def test_simulated_is_called_so(item):
    if item.provenance is Provenance.SIMULATED:
        assert "simulated" in item.caption
    assert item.caption.endswith(".")


def test_table_beside_ours_has_the_printed_strings():
    rows = make(next(i for i in OURS if i.title == "Table 2.2")).shown.set_index("object")
    assert rows.loc["egg", "printed"] == "61.76 ± 4.41"
    assert rows["accuracy"].tolist() == ["96.0", "98.9", "91.8", "94.9", "95.3"]


def test_figure_2_9_draws_what_the_regressor_says():
    rows = numbers(figure_2_9())
    drawn = rows[rows["series"] == "Nadaraya-Watson"]
    voltage, force = weight_points()
    model = NadarayaWatson().fit(voltage[:, None], force)
    expected = model.predict(drawn["x"].to_numpy()[:, None]) / GRAM_FORCE
    np.testing.assert_allclose(drawn["y"], expected, atol=1e-9)


def test_best_of_figure_2_h_is_the_lowest_point_of_its_curve():
    rows = numbers(figure_2_h())
    for what, whole in (("a weight at a time", True), ("a point at a time", False)):
        curve, best = rows[rows["series"] == what], rows[rows["series"] == f"best, {what}"]
        assert best["x"].item() == weight_bandwidth(whole)
        assert best["y"].item() == pytest.approx(curve["y"].min(), rel=1e-12)


def test_slider_says_the_error_of_what_is_left_out():
    narrow, wide = (title(bandwidth_plot(), bandwidth(sigma)) for sigma in (0.01, 1.0))
    assert narrow != wide
    assert "points" in narrow
    assert "weights" in narrow
