"""What the sliders of Chapter 2 draw."""

from functools import cache

from matplotlib.figure import Figure

from book.chapter_2.sliders_element import draw_element
from book.chapter_2.sliders_force import draw_bandwidth
from book.chapter_2.sliders_pad import draw_pad
from softgrip.arrays import Floats
from softgrip.logs.contacts import read_contacts
from softgrip.provenance import data_file
from softgrip.tactile.contact_kind import bagged_neighbours
from softgrip.tactile.fast_kind import FastKind

__all__ = ["draw_bandwidth", "draw_element", "draw_touch"]


@cache
def _classifier() -> FastKind:
    training = read_contacts(data_file("simulated/pad-training.csv").path)
    return FastKind.from_fitted(bagged_neighbours().fit(training.responses, training.kinds))


def _kind(responses: Floats) -> str:
    return _classifier().predict(responses)


def draw_touch(item: str, x: float, angle: float) -> Figure:
    """Draw an object on the simulated pad, and what the bagging classifier says; see `draw_pad`.

    Parameters
    ----------
    item
        Name of an object of `pad_objects`.
    x
        Place of its middle along the pad, mm.
    angle
        Of its length, deg.
    """
    return draw_pad(item, x, angle, _kind)
