"""Figures and tables of Section 2.2: the sensing elements under load, as printed and recomputed."""

from functools import cache
from math import pi, sqrt
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from book.companion.claims import printed
from book.companion.exhibit import figure, table
from book.companion.style import BLUE, GREEN, GREY, ORANGE, PRINTED, WIDTH, sheet
from softgrip.actuator.elasticity import Elastic
from softgrip.arrays import Floats
from softgrip.provenance import Provenance
from softgrip.tactile import element_results
from softgrip.tactile.element import (
    SHAPES,
    STATED_MODULUS,
    TABLE_MODULUS,
    Element,
    Shape,
    compliance,
    shortening,
)
from softgrip.tactile.element_fem import middle_section, solve
from softgrip.tactile.element_results import (
    STATED_CYLINDER,
    cut_for,
    fem_deformation,
    finest,
    largest_for,
    read,
)
from softgrip.tactile.element_sensitivity import (
    AT_REST,
    CEILING,
    least_force,
    relative_compliance,
    resistance_under,
)
from softgrip.tactile.element_table import ASSUMED, FORCES, PrintedRow, table_2_1
from softgrip.tactile.hertz import hertz_approach
from softgrip.units import MM, MPa

COLOURS = {"cylinder": BLUE, "hemisphere": ORANGE, "pyramid": GREEN}
DASHES = {"cylinder": "-", "hemisphere": "--", "pyramid": "-."}
DIVISIONS = {"cylinder": 16, "hemisphere": 16, "pyramid": 4}
"""Of the pictures, coarse: `element_convergence.csv` says what they leave out."""

LOAD, MOST_LOAD = 0.1, 0.4
"""N: of Figure 2.5, and the largest one of Figure 2.3 above."""

FINITE_ELEMENTS = Elastic(TABLE_MODULUS, 0.49)
"""The rubber of Figure 2.5."""


def printed_least(shape: Shape) -> float:
    """Return the least force that a shape feels as Section 2.2 prints it, N."""
    return printed(f"2.2-least-force-{shape}")


@figure("2.3", Provenance.SIMULATED)
def figure_2_3() -> Figure:
    """Draw resistance over load, and where it can be read."""
    drawn, (upper, lower) = sheet(6.0, 2, 1)
    # The amplifier's gain is not printed: the pyramid anchors what change of resistance is felt.
    threshold = float(resistance_under(ASSUMED["pyramid"], printed_least("pyramid"))) - AT_REST
    for shape, element in ASSUMED.items():
        look: dict[str, Any] = {"color": COLOURS[shape], "ls": DASHES[shape]}
        load = np.linspace(0, MOST_LOAD, 201)
        upper.plot(load, resistance_under(element, load) / 1e6, **look, label=shape)
        load = np.geomspace(2e-3, 0.5, 101)
        change = resistance_under(element, load) - AT_REST
        rising = change < CEILING - AT_REST
        lower.plot(load[rising], change[rising] / 1e3, **look, label=shape)
        lower.plot([least_force(element, threshold)], [threshold / 1e3], "s", ms=5,
                   color=COLOURS[shape], label=f"{shape}, least")  # fmt: skip
        lower.plot([printed_least(shape)], [threshold / 1e3], "o", ms=11, mfc="none",
                   color=COLOURS[shape], label=f"{shape}, printed")  # fmt: skip
    lower.axhline(threshold / 1e3, color=GREY, ls=":")
    upper.set(xlabel="load (N)", ylabel="resistance (MOhm)", title="(b) simulated")
    upper.legend(loc="lower right", bbox_to_anchor=(1.0, 0.12))
    lower.set(xlabel="load (N)", ylabel="change (kOhm)", xscale="log", yscale="log",
              title="the change alone, both axes logarithmic")  # fmt: skip
    return drawn


@cache
def loaded_section(shape: Shape) -> tuple[Floats, Floats]:
    """Return points of a section at rest, and how far `LOAD` moves them, m, shape (2, n, m)."""
    solved = solve(ASSUMED[shape], DIVISIONS[shape], FINITE_ELEMENTS)
    at, per_force = middle_section(solved)
    return at, LOAD * per_force


@figure("2.5", Provenance.SIMULATED)
def figure_2_5() -> Figure:
    """Draw the three deformed sections."""
    drawn = Figure(figsize=(WIDTH, 6.2))
    for axes, shape in zip(drawn.subplots(3, 1), SHAPES, strict=True):
        at, moved = loaded_section(shape)
        shown = _draw_section(axes, at / MM, moved / MM)
        drawn.colorbar(shown, ax=axes, label="mm", shrink=0.6, aspect=10)
        axes.set(title=f"{shape}: top moves {-moved[1, -1].min() / MM:.3f} mm", aspect="equal",
                 xlim=(-5.6, 5.6), ylim=(-0.2, 3.3), xlabel="mm", ylabel="mm")  # fmt: skip
    return drawn


def _draw_section(axes: Any, at: Floats, moved: Floats) -> Any:
    """Draw both halves of a section: colour by displacement, and the outline after; mm."""
    size = np.hypot(*moved)
    for side in (-1, 1):
        shown = axes.pcolormesh(side * at[0], at[1], size, shading="gouraud", cmap="viridis",
                                vmin=0, vmax=size.max(), rasterized=True)  # fmt: skip
        x, z = at + moved
        axes.plot(side * np.r_[x[:, -1], x[-1, ::-1]], np.r_[z[:, -1], z[-1, ::-1]], color="black",
                  lw=1.0)  # fmt: skip
    return shown


@figure("2.A", Provenance.SIMULATED)
def figure_2_a() -> Figure:
    """Draw mesh convergence."""
    drawn = Figure(figsize=(WIDTH, 6.4))
    looks = {"largest": ("-o", BLUE), "mean": ("--s", ORANGE), "plate": ("-.^", GREEN)}
    kept = element_results.read("convergence")
    for axes, (shape, element) in zip(drawn.subplots(3, 1), ASSUMED.items(), strict=True):
        last = finest(element)
        rows = [r for r in kept if r.element == last.element]
        for name, (look, colour) in looks.items():
            parts = [getattr(r.top, name) / getattr(last.top, name) for r in rows]
            axes.plot([r.unknowns for r in rows], parts, look, color=colour, label=name, ms=4)
        axes.set(title=shape, xscale="log", xlabel="unknowns", ylabel="part")
    drawn.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return drawn


@figure("2.B", Provenance.SIMULATED)
def figure_2_b() -> Figure:
    """Draw compliance over the cut."""
    drawn, axes = sheet(4.2)
    cuts = np.linspace(0.05, 1, 96)
    kept = element_results.read("cut")
    for shape in SHAPES:
        colour = COLOURS[shape]
        rows = [r for r in kept if r.element.shape == shape]
        if shape == "cylinder":
            axes.axhline(compliance(STATED_CYLINDER) / MM, color=colour, label=f"{shape}, (2.1)")
            axes.axhline(rows[0].top.largest / MM, color=colour, ls=":", label=f"{shape}, FEM")
            continue
        soft = [compliance(Element(shape, cut=float(cut))) / MM for cut in cuts]
        axes.plot(cuts, soft, color=colour, label=f"{shape}, (2.1)")
        axes.plot([r.element.cut for r in rows], [r.top.largest / MM for r in rows], ":o", ms=4,
                  color=colour, label=f"{shape}, FEM")  # fmt: skip
        axes.axvline(ASSUMED[shape].cut, color=PRINTED, lw=0.8)
    axes.set(xlabel="width of the top (parts of the base's)", ylabel="mm per N", yscale="log")
    axes.legend(ncols=1)
    return drawn


def deformation(row: PrintedRow, force: float, modulus: float, element: Element) -> float:
    """Return what a row's method gives for a force, N, and a modulus, Pa; in m."""
    if row.method == "Hertzian":
        return float(hertz_approach(force, young_modulus=modulus))
    if row.method == "FEM":
        return fem_deformation(element, force, modulus)
    return float(shortening(element, force, modulus))


def _cells(row: PrintedRow, modulus: float, element: Element) -> str:
    return " / ".join(f"{deformation(row, f, modulus, element) / MM:.3f}" for f in FORCES)


@table("2.1", Provenance.PRINTED)
def table_2_1_recomputed() -> pd.DataFrame:
    """Tabulate Table 2.1 beside ours."""
    rows = []
    for (shape, method), row in table_2_1().items():
        defined = shape == "cylinder" or method == "Hertzian"
        rows.append(
            {
                "shape": shape,
                "method": method,
                "printed": " / ".join(row.cells),
                "as stated": _cells(row, STATED_MODULUS, STATED_CYLINDER) if defined else "∞",
                "E = 0.1, assumed element": _cells(row, TABLE_MODULUS, ASSUMED[shape]),
                "E = 0.125, assumed element": _cells(row, STATED_MODULUS, ASSUMED[shape]),
            }
        )
    return pd.DataFrame(rows)


@table("2.A", Provenance.PRINTED)
def table_2_a() -> pd.DataFrame:
    """Tabulate inputs that rows ask for."""
    rows = []
    for modulus in (STATED_MODULUS, TABLE_MODULUS):
        for name, unit, least, largest in _asked(modulus):
            span = f"{least:.3f}" if f"{least:.3f}" == f"{largest:.3f}" else (
                f"{least:.3f} to {largest:.3f}"
            )  # fmt: skip
            rows.append({"E": f"{modulus / MPa:g}", "input": f"{name} ({unit})", "asked for": span})
    return pd.DataFrame(rows)


def _asked(modulus: float) -> list[tuple[str, str, float, float]]:
    """Return name, unit and range of what each row asks for at a modulus, Pa."""
    printed, found = table_2_1(), []
    block = 3 * MM / modulus  # L / E; times F and divided by an area it is a deformation

    def soft(shape: str, method: str, exponent: float = 1.0) -> np.ndarray:
        low, high = printed[shape, method].coefficient(exponent)  # type: ignore[index]
        return np.array([high, low]) * MM

    radius = np.sqrt(block / soft("cylinder", "Analytics") / np.pi)
    found.append(("Eq. (2.1), radius of the cylinder", "mm", *(radius / MM)))
    # A sphere cut at the part x of its radius: F artanh(x) / (pi E R).
    turned = soft("hemisphere", "Analytics") * modulus * 3 * MM
    found.append(
        ("Eq. (2.1), flat top of the hemisphere", "mm", *(6 / np.cosh(np.pi * turned))),
    )
    found.append(
        ("the same without the factor pi in A(y)", "mm", *(6 / np.cosh(turned))),
    )
    top = block / soft("pyramid", "Analytics") / (6 * MM)
    found.append(("Eq. (2.1), flat top of the pyramid", "mm", *(top / MM)))
    root = 0.75 * (1 - 0.49**2) / (modulus * soft("hemisphere", "Hertzian", 2 / 3) ** 1.5)
    found.append(("Eq. (2.2), radius of the hemisphere", "mm", *(root**2 / MM)))
    for shape in ("hemisphere", "pyramid"):
        cell = float(printed[shape, "FEM"].cells[2]) * MM / 0.3
        cut = 6 * cut_for(shape, cell, modulus)
        found.append((f"finite elements, flat top of the {shape}", "mm", cut, cut))
    return found


@table("2.B", Provenance.SIMULATED)
def table_2_b() -> pd.DataFrame:
    """Tabulate which shape gives way most, over the cut."""
    kept = {(r.element.shape, r.element.cut): r.top for r in read("cut")}
    block = kept["cylinder", 1.0]
    rows = []
    for cut in (0.06, 0.12, 0.2, 0.4, 0.6, 0.8):
        row = {"cut": f"{cut:g}"}
        for shape in ("hemisphere", "pyramid"):
            # A hemisphere that is as wide as the cylinder has its base area too.
            for equal in ("width", "area", "volume")[shape == "hemisphere" :]:
                part = relative_compliance(shape, cut, equal)
                row[f"{shape}, equal {equal}"] = f"{part:.2f}"
            top = kept[shape, cut]
            parts = top.largest / block.largest, top.mean / block.mean
            row[f"{shape}, FEM"] = " / ".join(f"{part:.2f}" for part in parts)
        square = largest_for("pyramid", cut * sqrt(pi / 4))
        row["pyramid by hemisphere, FEM"] = f"{square / kept['hemisphere', cut].largest:.2f}"
        rows.append(row)
    return pd.DataFrame(rows)
