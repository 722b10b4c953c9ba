"""Sliders over a figure: live where a kernel serves the reader, frames drawn ahead in a page."""

from softgrip.explore.explorer import explore
from softgrip.explore.sliders import Slider, slider

__all__ = ["Slider", "explore", "slider"]
