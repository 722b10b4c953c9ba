"""Pictures of the page *Design yours*."""

from math import inf

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from book.beyond.design.lighter import CASES, saved
from book.companion.style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, WIDTH, sheet
from book.twin.pictures import show as show
from softgrip.actuator.front import CHAMBERS, KEPT, MASSES, PRESSURES, Point, undominated
from softgrip.materials.table import table_5_1

FAMILIES = {"Dragon": BLUE, "Ecoflex": ORANGE, "Mold": GREEN, "SORTA-Clear": BLACK}
"""Colours, by the first word of a rubber's name."""
MARKERS = "osD^osDs^D"
"""Of the rubbers, in the order of the table: no two of one family are the same."""
FLOOR = 0.004
"""Where what is infeasible is marked, N m, and by how much its marks are apart, a rubber each."""
SHAPES = {4: "o", 6: "s", 8: "D"}
"""By the number of chambers."""


def looks() -> dict[str, tuple[str, str]]:
    """Return colour and marker of each rubber."""
    names = [*table_5_1()]
    return {
        name: (next(c for first, c in FAMILIES.items() if name.startswith(first)), marker)
        for name, marker in zip(names, MARKERS, strict=True)
    }


def answers(**asked: float) -> list[tuple[Point, bool]]:
    """Return the points whose question has these numbers, and whether nothing beats each."""
    rows = KEPT.read()
    return [
        (row, bool(best))
        for row, best in zip(rows, undominated(rows), strict=True)
        if all(getattr(row.question, name) == value for name, value in asked.items())
    ]


PLAIN = {"largest_envelope": inf, "largest_air": inf, "least_frequency": 0.0}
"""Of questions with no limit but that of the mass."""


def draw_trade() -> Figure:
    """Draw the largest torque over the mass that is allowed, for six chambers."""
    drawn, axes = sheet(5.0)
    known = looks()
    found = answers(chambers=CHAMBERS[1], pressure=PRESSURES[1], **PLAIN)
    for place, (name, (colour, marker)) in enumerate(known.items()):
        rows = [p for p, _ in found if p.question.material == name]
        rows = sorted(rows, key=lambda p: p.question.largest_mass)
        rows = [p for p in rows if p.question.largest_mass < inf]
        mass = np.array([1e3 * p.question.largest_mass for p in rows])
        torque = np.array([p.answer.torque for p in rows])
        axes.plot(mass, torque, color=colour, marker=marker, ms=4.5, lw=1, label=name,
                  ls=("-", "--", ":", "-.")[place % 4])  # fmt: skip
        none = np.isnan(torque)
        height = FLOOR * 1.13 ** (-place)
        axes.plot(mass[none], np.full(none.sum(), height), "x", color=colour, ms=3.5)
    axes.set(yscale="log", xlabel="rubber allowed (g)", ylabel="torque (N m)", ylim=(0.001, 0.15))
    axes.text(15, FLOOR * 1.2, "no section, proved:", fontsize=9)
    drawn.legend(loc="outside lower center", ncols=3, fontsize=8, handlelength=2.6)
    return drawn


def draw_chambers() -> Figure:
    """Draw the torque of each rubber by chambers, by pressure; full where nothing beats it."""
    drawn = Figure(figsize=(WIDTH, 6.6))
    panels = drawn.subplots(len(PRESSURES), 1, sharex=True)
    names = [*table_5_1()]
    for axes, pressure in zip(panels, PRESSURES, strict=True):
        for row, best in answers(pressure=pressure, largest_mass=max(MASSES), **PLAIN):
            colour, _ = looks()[row.question.material]
            place = names.index(row.question.material)
            shift = 0.25 * (row.question.chambers - 6) / 2
            if row.answer.feasible:
                axes.plot(
                    row.answer.torque, place + shift, SHAPES[row.question.chambers], color=colour,
                    ms=4.5, mfc=colour if best else "none", label=row.question.material,
                )  # fmt: skip
        axes.set_yticks(range(len(names)), names, fontsize=8)
        axes.set(xlim=(0, 0.35), ylim=(len(names) - 0.4, -0.6))
        axes.set_title(f"{pressure / 1e3:.0f} kPa")
    panels[-1].set_xlabel("torque (N m)")
    keys = [
        Line2D([], [], color=GREY, marker=shape, ls="", label=f"{chambers} chambers")
        for chambers, shape in SHAPES.items()
    ]
    drawn.legend(handles=keys, loc="outside lower center", ncols=3)
    return drawn


def draw_saved() -> Figure:
    """Draw how much rubber can be saved, by what must be kept."""
    drawn, axes = sheet(2.6)
    for row, case in enumerate(CASES):
        printed, by_draw = saved(case)
        low, high = 100 * np.percentile(by_draw, [2.5, 97.5])
        axes.plot([low, high], [row, row], color=BLUE, lw=4, solid_capstyle="projecting",
                  label="draws of the test")  # fmt: skip
        axes.plot(100 * printed, row, "o", color=VERMILION, ms=5, label="as printed")
    axes.set_yticks(range(len(CASES)), [case.replace(", angle", ",\nangle") for case in CASES])
    axes.set(xlabel="rubber saved (%)", ylim=(len(CASES) - 0.5, -0.5), xlim=(-0.5, 17))
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[:2], labels[:2], loc="upper right")
    return drawn
