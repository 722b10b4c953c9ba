"""A mould for a finger: two trays and a core, as Figure 3.7 (a) and (b) cast it in two parts.

The upper part, from the neutral surface to the top, is cast upside down: the tray for it has fins
where the grooves are, and the core hangs its chambers and its duct into the rubber from a lid. The
lower part is a slab; the flex sensor is laid into it. Both are bonded at the neutral surface. No
part has an undercut, and each is printed on its flat side without supports.

All parts are in mm, x along the finger from its nozzle, z up as printed.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from softgrip.actuator.section import Section, check_section
from softgrip.actuator.size import Layout, check_layout
from softgrip.actuator.stl import Solid, write_stl
from softgrip.errors import InvalidInputError
from softgrip.plausible import DIMENSION, LENGTH
from softgrip.units import MM

SHELL = 3.0
"""Thickness of the mould's own walls, floors and lid, mm."""
BED = 200.0
"""Side of a printer's bed, mm."""
LEAST_PRINTED = 0.8
"""Thinnest thing to print, mm: two lines of a nozzle of 0.4 mm."""
LEAST_CAST = 1.0
"""Thinnest rubber to cast, mm: thinner, it does not fill and tears when it leaves the mould."""


@dataclass(frozen=True)
class Mould:
    """The parts of a mould, in mm.

    Attributes:
        upper: Tray for the part with the chambers.
        lower: Tray for the slab below the neutral surface.
        core: Lid with chambers and duct; it is turned over onto the upper tray.
        cavity: What both trays hold with the core in place, mm^3.
    """

    upper: Solid
    lower: Solid
    core: Solid
    cavity: float


def mould(section: Section, layout: Layout) -> Mould:
    """Return the mould of a finger.

    Args:
        section: Its section, m.
        layout: What it is along its length, m.

    Raises:
        InvalidInputError: If section or layout are none, or the mould cannot be printed: a part is
            larger than the bed, or something is thinner than can be printed or cast.
    """
    check_section(section)
    for name in ("top", "bottom", "width", "wall"):
        DIMENSION.check(name, getattr(section, name))
    LENGTH.check("length", layout.length)
    check_layout(layout, section)
    _check_printable(section, layout)
    a, b, w, t = (float(x) / MM for x in (section.top, section.bottom, section.width, section.wall))
    long, floor = float(layout.length) / MM, layout.groove_floor / MM
    rows = _chambers(section, layout)
    groove, duct = layout.groove / MM, layout.duct / MM
    fins = [
        # Into walls and floor of the tray, so that they are one with it.
        _box((end + t, -SHELL / 2, -SHELL / 2), (end + t + groove, w + SHELL / 2, a - floor))
        for _, end in rows[:-1]
    ]
    held = _box((0, 0, 0), (long, w, a + SHELL))
    upper = _tray(long, w, a) - (_less(held, fins) if fins else held)
    lower = _tray(long, w, b) - _box((0, 0, 0), (long, w, b + SHELL))
    middle = w / 2
    plugs = [_box((start, t, -SHELL / 2), (end, w - t, a - t)) for start, end in rows]
    # The duct ends at the wall of the tray, through the first cap.
    plugs.append(_box((0, middle - duct / 2, -SHELL / 2), (rows[-1][1], middle + duct / 2, duct)))
    lid = _box((-SHELL, -SHELL, -SHELL), (long + SHELL, w + SHELL, 0))
    core = lid
    for plug in plugs:
        core = core + plug
    outside = (long + 2 * SHELL) * (w + 2 * SHELL) * (a + b + 2 * SHELL)
    cavity = outside - upper.volume() - lower.volume() - (core.volume() - lid.volume())
    return Mould(_solid(upper), _solid(lower), _solid(core), float(cavity))


def write_mould(section: Section, layout: Layout, folder: Path) -> list[Path]:
    """Write the parts of a mould as STL files, in mm, and return their paths; see `mould`."""
    parts = mould(section, layout)
    return [
        write_stl(getattr(parts, name), folder / f"{name}.stl", f"softgrip mould, {name}")
        for name in ("upper", "lower", "core")
    ]


def _chambers(section: Section, layout: Layout) -> list[tuple[float, float]]:
    """Return where each chamber begins and ends along the finger, mm."""
    t = float(section.wall)
    each = float(layout.air_length(t)) / layout.chambers
    pitch = each + float(layout.divider(t))
    starts = layout.cap + pitch * np.arange(layout.chambers)
    return [(start / MM, (start + each) / MM) for start in starts.tolist()]


def _check_printable(section: Section, layout: Layout) -> None:
    """Raise InvalidInputError for what a common printer or rubber cannot do."""
    long = max(layout.length, section.width) / MM + 2 * SHELL
    if long > BED:
        raise InvalidInputError(
            "length", expected=f"a mould within a bed of {BED:g} mm", got=f"{long:.4g} mm"
        )
    printed = {"duct": layout.duct}
    if layout.chambers > 1:
        printed["groove"] = layout.groove
    for name, value in printed.items():
        if value / MM < LEAST_PRINTED:
            raise InvalidInputError(
                name, expected=f"at least {LEAST_PRINTED:g} mm, to be printed", got=value
            )
    cast = {"wall": section.wall, "bottom": section.bottom, "cap": layout.cap}
    for name, value in cast.items():
        if value / MM < LEAST_CAST * (1 - 1e-9):
            raise InvalidInputError(
                name, expected=f"at least {LEAST_CAST:g} mm, to be cast", got=value
            )


def _box(low: tuple[float, ...], high: tuple[float, ...]) -> Any:
    from manifold3d import Manifold

    sides = [float(last - first) for first, last in zip(low, high, strict=True)]
    return Manifold.cube(sides).translate([float(x) for x in low])


def _tray(long: float, wide: float, deep: float) -> Any:
    """Return the block that a tray is cut out of."""
    return _box((-SHELL, -SHELL, -SHELL), (long + SHELL, wide + SHELL, deep))


def _less(body: Any, others: list[Any]) -> Any:
    for other in others:
        body = body - other
    return body


def _solid(body: Any) -> Solid:
    """Return what Manifold made, which is watertight by construction."""
    mesh = body.to_mesh64()
    points = np.asarray(mesh.vert_properties, np.float64)[:, :3]
    return Solid(points, np.asarray(mesh.tri_verts, np.int64))
