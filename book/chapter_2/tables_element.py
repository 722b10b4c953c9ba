"""Tables of Section 2.2: deformation of the sensing elements, as printed and recomputed."""

from math import pi, sqrt

import numpy as np
import pandas as pd

from book.companion.exhibit import table
from softgrip.provenance import Provenance
from softgrip.tactile.element import STATED_MODULUS, TABLE_MODULUS, Element, shortening
from softgrip.tactile.element_results import (
    STATED_CYLINDER,
    cut_for,
    fem_deformation,
    largest_for,
    read,
)
from softgrip.tactile.element_sensitivity import equal_cut, relative_compliance
from softgrip.tactile.element_table import ASSUMED, FORCES, PrintedRow, table_2_1
from softgrip.tactile.hertz import hertz_approach
from softgrip.units import MM, MPa

PRINTED_FILE = "tactile/table_2_1.csv"
FEM_FILES = ("tactile/element_convergence.csv", "tactile/element_cut.csv")


def deformation(row: PrintedRow, force: float, modulus: float, element: Element) -> float:
    """Return what a row's method gives for a force, N, and a modulus, Pa; in m."""
    if row.method == "Hertzian":
        return float(hertz_approach(force, young_modulus=modulus))
    if row.method == "FEM":
        return fem_deformation(element, force, modulus)
    return float(shortening(element, force, modulus))


def _cells(row: PrintedRow, modulus: float, element: Element) -> str:
    return " / ".join(f"{deformation(row, f, modulus, element) / MM:.3f}" for f in FORCES)


@table(
    "2.1",
    caption="Deformation in mm at 0.1, 0.2 and 0.3 N: as printed; with E = 0.125 MPa and the sizes "
    "of the text, which leave all but the cylinder and Eq. (2.2) undefined (a sharp top gives "
    "infinity); with E = 0.1 MPa and the elements that the analytic rows ask for (they were chosen "
    "for those rows, which are no finding); and these elements with E = 0.125 MPa. The rows of "
    "finite elements are the largest displacement of the top: they do not come out, not even for "
    "the elements of the row below them. Hertz with the exponent 2/3.",
    provenance=Provenance.PRINTED,
    data=(PRINTED_FILE, FEM_FILES[0]),
)
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


@table(
    "2.A",
    caption="What the rows of Table 2.1 ask for: the input that is not printed, or printed "
    "otherwise, when the others are those of the text, for two moduli (MPa). Each range gives all "
    "three cells of its row to the last digit; finite elements: the top that gives the cell at 0.3 "
    "N as the largest displacement.",
    provenance=Provenance.PRINTED,
    data=(PRINTED_FILE, FEM_FILES[1]),
)
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


@table(
    "2.B",
    caption="Compliance by Eq. (2.1) as a part of that of a cylinder with the same height, modulus "
    "and width of the base, area of the base, or volume; and by finite elements (largest and mean "
    "displacement of the evenly loaded top, the same width of the base). By the equation the "
    "pyramid leads at any cut with one area of the base, and up to a cut of "
    f"{equal_cut():.2f} with one width; by finite elements the hemisphere leads with one width of "
    "the base and of the top. Last column: pyramid by hemisphere, by finite elements, with one "
    "area of the top, which is round for one and square for the other.",
    provenance=Provenance.SIMULATED,
    data=FEM_FILES[1:],
)
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
