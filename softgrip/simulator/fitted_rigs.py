"""The rigs of the dissertation, as fitted to the numbers that it prints.

Nothing of what they were made of is printed. ``data/calibration/`` holds what was fitted, in the
form of a rig of a reader's own (`rig_file`), with the interval that the prints leave to each
parameter. The three fingers bear Chapter 3's names; Chapter 5 calls the third, of FX-Pro, Design 2.
"""

from dataclasses import replace
from typing import Any

from softgrip.provenance import data_file, data_rows
from softgrip.reads import remembered
from softgrip.simulator.force_layer import ForceLayer
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.parameters import RigParameters, Spread
from softgrip.simulator.rig_file import read_rig
from softgrip.tactile.element import Element

DESIGN_1, DESIGN_2, DESIGN_3, GRIPPER, PAD = (
    f"calibration/{name}.csv" for name in ("design-1", "design-2", "design-3", "gripper", "pad")
)
"""Files below ``data/``."""


@remembered
def _rig(file: str) -> RigParameters:
    return read_rig(data_file(file).path).rig


def _with(file: str, spread: bool) -> RigParameters:
    rig = _rig(file)
    return rig if spread else replace(rig, spread=Spread())


def design_1(*, spread: bool = True) -> RigParameters:
    """Return the rig with Design 1, made of Dragon Skin 20; without `spread` runs are alike."""
    return _with(DESIGN_1, spread)


def design_2(*, spread: bool = True) -> RigParameters:
    """Return the rig with Design 2 of Chapter 3, a narrower Design 1."""
    return _with(DESIGN_2, spread)


def design_3(*, spread: bool = True) -> RigParameters:
    """Return the rig with Design 3 of Chapter 3, of Dragon Skin FX-Pro: Chapter 5's Design 2."""
    return _with(DESIGN_3, spread)


def printed_gripper(*, spread: bool = True) -> RigParameters:
    """Return the two-finger gripper of Section 6.4, left finger first; `spread` as `design_1`."""
    return _with(GRIPPER, spread)


@remembered
def _pad(part: str) -> dict[str, float]:
    """Return the fitted parameters of a part of the pad, by name."""
    rows = ((row["parameter [unit]"].partition(" ")[0], row["value"]) for row in data_rows(PAD))
    return {name.removeprefix(part): float(value) for name, value in rows if name.startswith(part)}


def fitted_pad() -> PadParameters:
    """Return the pad of Chapter 2."""
    own: dict[str, Any] = dict(_pad("pad."))
    cut = own.pop("cut")
    return replace(PadParameters(), element=Element("pyramid", cut=cut), **own)


def fitted_layer() -> ForceLayer:
    """Return the force layer below the pad of Chapter 2."""
    own: dict[str, Any] = dict(_pad("layer."))
    memory = (own.pop("memory_fast"), own.pop("memory_slow"))
    return ForceLayer(memory=memory, **own)
