"""Chapter 5, figures and tables: ten elastomers and how their fractional powers are predicted."""

from math import inf
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator
from scipy.stats import spearmanr

from book.companion.exhibit import figure, table
from book.companion.style import GREY, LUDWICK, MEASURED, OTHER, PRINTED, VERMILION, WIDTH, sheet
from book.companion.verdict import ledger
from softgrip.arrays import Floats
from softgrip.materials import ludwick, tensile, yeoh
from softgrip.materials.facts import facts
from softgrip.materials.fitting import (
    LONGEST_STRAINS,
    Fitting,
    bootstrap_interval,
    comes_out,
    fractional_power,
    kept,
    ranking,
)
from softgrip.materials.leave_out import RIVALS, leave_k_out
from softgrip.materials.table import HELD_OUT, Material, fractional_powers, properties, table_5_1
from softgrip.provenance import Provenance
from softgrip.reads import remembered
from softgrip.units import MPa

TABLE = "materials/table_5_1.csv"
FITS = "materials/ludwick_fits.csv"
FACTS = "materials/tensile_facts.csv"
TESTS = (
    "ten tensile tests, where they are at hand (public, each checked against its sha256 in "
    "softgrip.materials.database)"
)
BEST = Fitting()


@remembered
def measured_curve(name: str) -> tuple[Floats, Floats] | None:
    """Return strain and true stress up to the largest force, or None where no test is at hand."""
    if not tensile.available():
        return None
    test = tensile.up_to_peak(tensile.load(name))
    return test.strain, test.stress * (1 + test.strain)


def draw_curves(axes: Any, material: Material, power: float) -> None:
    """Draw true stress over engineering strain: measured, Yeoh, Ludwick with a given n."""
    known = facts()[material.name]
    strain = np.linspace(0, known.peak_strain, 60)
    if measured := measured_curve(material.name):
        axes.plot(measured[0], measured[1] / MPa, color=MEASURED, label="measured", lw=3.2)
    hyperelastic = (1 + strain) * yeoh.stress(1 + strain, known.yeoh)
    axes.plot(strain, hyperelastic / MPa, color=OTHER, lw=1.2, label="Yeoh, fitted")
    law = ludwick.stress(strain, material.young_modulus, power)
    axes.plot(strain, law / MPa, color=LUDWICK, ls="--", label="Ludwick, printed n")


@figure("5.1", Provenance.PUBLIC, sources=TESTS)
def figure_5_1() -> Figure:
    """Draw the stress-strain curves of the ten elastomers against Ludwick's law."""
    drawn, panels = sheet(8.2, 5, 2)
    for axes, material in zip(panels.flat, table_5_1().values(), strict=True):
        known = facts()[material.name]
        draw_curves(axes, material, material.fractional_power)
        axes.set_title(material.name, fontsize=9.5)
        axes.text(0.05, 0.84, f"n = {material.fractional_power:.3f}", transform=axes.transAxes)
        axes.set_ylim(0, 1.1 * (1 + known.peak_strain) * known.peak_stress / MPa)
        axes.set_ylabel("MPa")
    for axes in panels[-1]:
        axes.set_xlabel("engineering strain")
    handles = panels[0, 0].get_legend_handles_labels()
    drawn.legend(*handles, loc="outside upper center", ncols=3, columnspacing=1.2)
    return drawn


@figure("5.2", Provenance.PRINTED)
def figure_5_2() -> Figure:
    """Draw n over Young's modulus, mixed viscosity and tensile strength."""
    drawn = Figure(figsize=(WIDTH, 3.0))
    materials = list(table_5_1().values())
    values, n = properties(materials), fractional_powers(materials)
    held = np.array([m.name in HELD_OUT for m in materials])
    labels = ("E (MPa)", "viscosity (Pa s)", "strength (MPa)")
    for axes, x, scale, label in zip(
        drawn.subplots(1, 3, sharey=True), values.T, (MPa, 1, MPa), labels, strict=True
    ):
        axes.scatter(x[~held] / scale, n[~held], color=LUDWICK, label="fitted to")
        axes.scatter(
            x[held] / scale, n[held], facecolors="white", edgecolors=LUDWICK, label="held out"
        )
        rank = spearmanr(x, n).statistic
        axes.set(xlabel=label, ylabel="fractional power n", title=f"$\\rho$ = {rank:.2f}")
        axes.set_xlim(0, 1.15 * x.max() / scale)
        axes.label_outer()
    return drawn


def fits(name: str) -> tuple[Floats, Floats]:
    """Return strains up to which a curve is used, and the n that is fitted so."""
    peak = facts()[name].peak_strain
    used = np.minimum(LONGEST_STRAINS, peak)
    return used, np.array([kept()[name, Fitting(longest_strain=x)] for x in LONGEST_STRAINS])


def meets(name: str) -> Floats:
    """Return strains up to which a fit gives the printed n, to the decimals of 1/n, rising."""
    used, n = fits(name)
    strain = np.linspace(used[0], used[-1], 1001)
    printed = table_5_1()[name].fractional_power
    found: Floats = strain[[comes_out(x, printed) for x in np.interp(strain, used, n)]]
    return found


@figure("5.A", Provenance.PUBLIC)
def figure_5_a() -> Figure:
    """Draw n over the longest strain of the fit."""
    drawn, panels = sheet(8.2, 5, 2, sharex=True)
    for axes, material in zip(panels.flat, table_5_1().values(), strict=True):
        axes.plot(*fits(material.name), "o-", color=LUDWICK, label="fitted")
        printed = 1 / round(1 / material.fractional_power, 2)
        m, across = 1 / printed, [0, 18]
        low, high = 1 / (m + 0.005), 1 / (m - 0.005)
        label = "printed, rounded"
        axes.fill_between(across, low, high, color=PRINTED, alpha=0.25, lw=0, label=label)
        axes.plot(across, [printed, printed], color=PRINTED, ls="--", label="printed")
        axes.set_xlim(across)
        axes.set_title(material.name, fontsize=9.5)
        axes.set_ylim(material.fractional_power - 0.7, material.fractional_power + 0.7)
        axes.set_ylabel("n")
    for axes in panels[-1]:
        axes.set_xlabel("strain used up to")
        axes.xaxis.set_major_locator(MultipleLocator(4))
    drawn.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return drawn


@figure("5.B", Provenance.PRINTED)
def figure_5_b() -> Figure:
    """Draw leave-one-out predictions over the printed values."""
    drawn, axes = sheet(4.0)
    axes.plot([0.8, 2.8], [0.8, 2.8], color=GREY, lw=1, label="exact")
    styles = (("Eq. (5.8)", LUDWICK, "o"), ("mean of the others", VERMILION, "_"))
    for name, colour, marker in styles:
        found = leave_k_out(1, model=RIVALS[name]()).predictions
        x, y = np.array([(p.printed, p.predicted) for p in found]).T
        axes.scatter(x, y, color=colour, marker=marker, s=60, label=name)
    worst = leave_k_out(1).worst
    at = (worst.printed, worst.predicted)
    axes.annotate(worst.name, at, (6, -4), textcoords="offset points", fontsize=9.5)
    axes.set(xlabel="printed n", ylabel="predicted n", xlim=(1.4, 2.65), ylim=(0.7, 2.75))
    axes.legend(loc="lower right")
    return drawn


@table("5.1", Provenance.PUBLIC, sources=TESTS)
def table_5_1_beside_tests() -> pd.DataFrame:
    """Tabulate the ten materials beside what their tensile tests give."""
    rows = []
    for material in table_5_1().values():
        known, fitted = facts()[material.name], fractional_power(material.name, BEST)
        interval = "no test"
        if tensile.available():
            low, high = bootstrap_interval(tensile.load(material.name), BEST)
            interval = f"{low:.2f} to {high:.2f}"
        rows.append(
            {
                "material": material.name,
                "n printed": f"{material.fractional_power:.3f}",
                "n fitted": f"{fitted:.3f}",
                "95 %": interval,
                "comes out": "yes" if comes_out(fitted, material.fractional_power) else "no",
                "E": f"{material.young_modulus / MPa:.2f}",
                "at 100 %": f"{known.hundred_percent_modulus / MPa:.3f}",
                "viscosity": f"{material.mixed_viscosity:g}",
                "strength": f"{material.tensile_strength / MPa:.2f}",
                "largest": f"{known.peak_stress / MPa:.2f}",
            }
        )
    return pd.DataFrame(rows)


@table("5.2", Provenance.PRINTED)
def table_5_2() -> pd.DataFrame:
    """Tabulate what is printed of the two held-out materials, and what comes of it."""
    return pd.DataFrame(
        {
            "what": entry.claim.what,
            "printed": f"{'' if entry.claim.relation == '=' else '< '}{entry.claim.printed}",
            "recomputed": f"{spread.value:.4g}",
            "rounding": f"{spread.low:.4g} to {spread.high:.4g}",
            "outcome": entry.outcome,
        }
        for entry in ledger(5, ["Table 5.2", "Section 5.5"])
        if (spread := entry.spread)
    )


@table("5.A", Provenance.PUBLIC)
def table_5_a() -> pd.DataFrame:
    """Tabulate the best ways of fitting and their neighbours."""
    scores = ranking()
    neighbours = [
        Fitting(stress="engineering"),
        Fitting(loss="log"),
        Fitting(longest_strain=inf),
        Fitting(modulus="free"),
    ]
    chosen = scores[:5] + [s for s in scores if s.fitting in neighbours and s not in scores[:5]]
    return pd.DataFrame(
        {
            "stress": s.fitting.stress,
            "least squares of": s.fitting.loss,
            "strains up to": "peak"
            if s.fitting.longest_strain == inf
            else f"{s.fitting.longest_strain:.0%}",
            "E": s.fitting.modulus,
            "come out": s.come_out,
            "within 2 %": s.within_2_percent,
            "within 5 %": s.within_5_percent,
            "median error": f"{s.median_error:.1%}" if s.median_error < inf else "no fit",
        }
        for s in chosen
    )


@table("5.B", Provenance.PRINTED)
def table_5_b() -> pd.DataFrame:
    """Tabulate leave-one-out and leave-two-out errors of three models."""
    rows = []
    for name, model in RIVALS.items():
        for k in (1, 2):
            found = leave_k_out(k, model=model())
            errors = {p: abs(p.error / p.printed) for p in found.predictions}
            worst = max(errors, key=lambda p: errors[p])
            rows.append(
                {
                    "model": name,
                    "held out": k,
                    "RMS error of n": f"{found.rms_error:.3f}",
                    "within 10 %": f"{np.mean(np.array([*errors.values()]) < 0.1):.0%}",
                    "worst": f"{errors[worst]:.0%} ({worst.name})",
                }
            )
    return pd.DataFrame(rows)
