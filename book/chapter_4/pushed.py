"""The pressure models of Section 4.3 against a push, with what the text leaves open of them."""

from dataclasses import replace
from pathlib import Path

from book.companion.choices import choice
from softgrip.logs.pushes import PressureComparison, compare
from softgrip.pump.elastance import NoiseLevels

ASSUMED = NoiseLevels(pressure_step=0.1479, elastance_step=9.72e7, sensor=532.5)
"""What the fitted factor of the filter multiplies the elastance's noise of: levels of largest
likelihood on a push of the rig before the fit."""


def pushed(path: Path | str, noise: NoiseLevels | None = None) -> PressureComparison:
    """Hold the three models against a log of a push, as `compare`, with the fitted choices.

    Args:
        path: Of the log.
        noise: Levels of the filter; None for `filter_noise`.
    """
    return compare(path, noise=noise or filter_noise(), below=choice("capacity_below"))


def filter_noise() -> NoiseLevels:
    """Return the noise levels of the filter, its factor fitted."""
    return replace(ASSUMED, elastance_step=choice("filter_factor") * ASSUMED.elastance_step)
