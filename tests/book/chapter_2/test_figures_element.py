"""Section 2.2's exhibits: what they claim in words, and that they are drawn anew the same."""

from io import BytesIO

import numpy as np
import pytest

from book.chapter_2 import figures_element as figures
from book.chapter_2 import sliders
from softgrip.tactile.element import SHAPES, Element, shortening
from softgrip.tactile.element_fem import solve
from softgrip.tactile.element_results import finest
from softgrip.tactile.element_table import ASSUMED
from softgrip.units import MM
from tests.book.explore.page_laws import title


def test_pictures_are_within_one_per_cent_of_the_finest_mesh():
    for shape, element in ASSUMED.items():
        coarse = solve(element, figures.DIVISIONS[shape]).top.largest
        assert coarse == pytest.approx(finest(element).top.largest, rel=0.01)


@pytest.mark.parametrize("name", ["figure_2_3", "figure_2_a", "figure_2_b"])
def test_figures_are_drawn_the_same_twice(name):
    def picture():
        stream = BytesIO()
        getattr(figures, name)().savefig(stream, format="png", dpi=40)
        return stream.getvalue()

    assert picture() == picture()


def test_table_2_1_stands_beside_the_printed_one():
    found = figures.table_2_1_recomputed().set_index(["shape", "method"])
    assumed = found["E = 0.1, assumed element"]
    for key in found.index:
        assert (assumed[key] == found["printed"][key]) == (key[1] != "FEM")


def test_inputs_that_rows_ask_for():
    """Solved here in closed form, there from the elements: the same numbers."""
    found = figures.table_2_a()
    asked = found[found["E"] == "0.1"].set_index("input")["asked for"]
    spans = {name: [float(x) for x in span.split(" to ")] for name, span in asked.items()}
    for words, value in (
        ("radius of the cylinder", 5.0),
        ("(2.1), flat top of the hemisphere", 1e3 * ASSUMED["hemisphere"].cut * 6e-3),
        ("(2.1), flat top of the pyramid", 0.72),
        ("radius of the hemisphere", 3.0),
    ):
        span = next(span for name, span in spans.items() if words in name)
        assert span[0] - 5e-4 <= value <= span[-1] + 5e-4


def test_table_2_b_has_a_row_for_each_cut():
    assert len(figures.table_2_b()) == 6


@pytest.mark.parametrize("shape", SHAPES)
def test_outline_sinks_by_the_shortening_and_keeps_its_volume_at_small_loads(shape):
    made, found = (
        Element(shape, cut=1.0 if shape == "cylinder" else 0.3),
        sliders.element(shape, 1e-4, 0.3),
    )
    before, after = found["height"], found["height_under"]
    sunk = (before[-1] - after[-1]) * MM
    # Trapezoids on 401 slices.
    assert sunk == pytest.approx(shortening(made, 1e-4), rel=1e-3)
    assert found["moved"] * MM == pytest.approx(shortening(made, 1e-4), rel=1e-12)
    halves = found["half_width"], found["half_width_under"]
    volumes = [np.trapezoid(w**2, h) for w, h in zip(halves, (before, after), strict=True)]
    # nu = 0.49 leaves 2 % of the shortening as a change of volume.
    strain = sunk / made.height
    assert 1 - volumes[1] / volumes[0] < 0.1 * strain


def test_explorer_shows_every_shape():
    for shape in SHAPES:
        found = sliders.element(shape, load=0.1, cut=0.1)
        assert all(np.isfinite(values).all() for values in found.values())
        assert title(sliders.ELEMENT_PLOT, found).startswith("shorter by ")
