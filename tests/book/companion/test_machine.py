"""Drawings: to scale where they say so, readable, and the same from run to run."""

from itertools import combinations

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patches import Polygon

from book.companion import machine
from book.companion.claims import printed
from book.companion.exhibit import exhibits
from book.companion.finger_drawing import draw_finger, six_chambers
from book.companion.save import make, svg
from softgrip.pump.flow import TABLE_4_1
from softgrip.pump.parts import SCREWS, SYRINGES

DRAWINGS = [item for item in exhibits() if item.drawing]


def polygons(axes, colour):
    """Return the corners of the shapes of a colour."""
    return [
        patch.get_path().vertices
        for patch in axes.patches
        if isinstance(patch, Polygon) and patch.get_facecolor() == colour
    ]


def size(shapes):
    return np.ptp(np.concatenate(shapes), axis=0)


@pytest.fixture
def axes():
    return machine.canvas((-20, 320), (-120, 120))[1]


@pytest.mark.parametrize("which", [0, 1])
def test_syringe_has_the_printed_bore_and_volume(axes, which):
    for pushed in (0.0, 1.0):
        machine.syringe(axes, 0j, SYRINGES[which], pushed)
    face = [p.get_path().vertices for p in axes.patches if p.get_facecolor()[:3] == (
        118 / 255, 118 / 255, 118 / 255)]  # fmt: skip
    bore, stroke = size(face[:1])[1], face[1][:, 0].max() - face[0][:, 0].max()
    assert np.pi / 4 * bore**2 == pytest.approx(1e6 * TABLE_4_1["area"][which])
    volume = printed("4.4-syringe" if which == 0 else "4.4-larger-syringe")
    assert np.pi / 4 * bore**2 * stroke / 1000 == pytest.approx(volume)


def test_screw_has_the_printed_lead(axes):
    machine.screw(axes, 0j, 100, SCREWS[0])
    starts = [line.get_xdata()[0] for line in axes.lines]
    assert np.diff(starts) == pytest.approx(printed("4.4-lead"))


def test_pad_has_the_printed_size(axes):
    machine.pad(axes, 3 + 4j)
    whole = size([patch.get_path().vertices for patch in axes.patches])
    assert whole == pytest.approx([printed("2.2-pad-length"), printed("2.2-pad-height")])
    elements = [v for v in (p.get_path().vertices for p in axes.patches) if v[0, 1] != v[2, 1]
                and abs(v[1, 0] - v[0, 0]) < 3 and np.ptp(v[:, 0]) == pytest.approx(6)]  # fmt: skip
    assert len(elements) == 3
    for element in elements:
        assert np.ptp(element[:, 1]) == pytest.approx(printed("2.2-element-height"))


@pytest.mark.parametrize("angle", [0.0, 1.2])
def test_finger_has_the_printed_length_and_turns_by_its_angle(axes, angle):
    tip = draw_finger(axes, six_chambers(), angle)
    rubber = axes.patches[0].get_path().vertices
    length = printed("3.4-length")
    if angle == 0:
        assert size([rubber]) == pytest.approx([length, printed("3.4-height")])
    # The chord of an arc of that length.
    chord = length * np.sinc(angle / 2 / np.pi)
    assert (abs(tip), np.angle(tip)) == pytest.approx((chord, -angle / 2), abs=1e-9)


def test_mirrored_finger_bends_to_the_other_side(axes):
    one, other = (
        draw_finger(axes, six_chambers(), 0.8, heading=-1j, mirrored=side) for side in (True, False)
    )
    assert one == pytest.approx(-other.conjugate())
    assert one.real > 0 > one.imag


def test_dimension_line_is_as_long_as_what_it_measures(axes):
    machine.dimension(axes, 2 + 3j, 42 + 3j, "L", aside=5)
    arrow = axes.texts[0]
    assert (arrow.xyann, arrow.xy) == ((2, 8), (42, 8))
    assert axes.texts[1].get_text() == "L"
    assert axes.texts[1].get_position()[1] > 8


@pytest.mark.parametrize("item", DRAWINGS, ids=lambda item: item.title)
def test_words_are_large_enough_whole_and_apart(item):
    drawn = make(item).shown
    renderer = FigureCanvasAgg(drawn).get_renderer()
    drawn.draw(renderer)
    texts = [text for axes in drawn.axes for text in axes.texts if text.get_text().strip()]
    places = {text: text.get_window_extent(renderer) for text in texts}
    paper = drawn.bbox.padded(1)
    for text, place in places.items():
        assert text.get_fontsize() >= 9, text.get_text()
        assert paper.containsx(place.x0), text.get_text()
        assert paper.containsx(place.x1), text.get_text()
    for one, other in combinations(texts, 2):
        a, b = places[one].padded(-1), places[other].padded(-1)
        assert not a.overlaps(b), (one.get_text(), other.get_text())


@pytest.mark.parametrize("item", DRAWINGS, ids=lambda item: item.title)
def test_a_drawing_is_the_same_to_the_bit(item):
    assert svg(make(item).shown) == svg(make(item).shown)
