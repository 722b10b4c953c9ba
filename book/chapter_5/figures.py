"""Figures of Chapter 5."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator
from scipy.stats import spearmanr

from book.companion.exhibit import figure
from book.companion.style import GREY, LUDWICK, MEASURED, OTHER, PRINTED, VERMILION, WIDTH, sheet
from softgrip.arrays import Floats
from softgrip.materials import ludwick, tensile, yeoh
from softgrip.materials.facts import facts
from softgrip.materials.fitting import LONGEST_STRAINS, Fitting, kept
from softgrip.materials.leave_out import RIVALS, leave_k_out
from softgrip.materials.table import HELD_OUT, Material, fractional_powers, properties, table_5_1
from softgrip.provenance import Provenance
from softgrip.reads import remembered
from softgrip.units import MPa

TESTS = "ten tensile tests (public, each checked against its sha256 in softgrip.materials.database)"
BEST = Fitting()


@remembered
def _measured(name: str) -> tuple[Floats, Floats] | None:
    """Return strain and true stress up to the largest force, or None where no test is at hand."""
    if not tensile.available():
        return None
    test = tensile.up_to_peak(tensile.load(name))
    return test.strain, test.stress * (1 + test.strain)


def draw_curves(axes: Any, material: Material, power: float) -> None:
    """Draw true stress over engineering strain: measured, Yeoh, Ludwick with a given n."""
    known = facts()[material.name]
    strain = np.linspace(0, known.peak_strain, 60)
    if measured := _measured(material.name):
        axes.plot(measured[0], measured[1] / MPa, color=MEASURED, label="measured", lw=3.2)
    hyperelastic = (1 + strain) * yeoh.stress(1 + strain, known.yeoh)
    axes.plot(strain, hyperelastic / MPa, color=OTHER, lw=1.2, label="Yeoh, fitted")
    law = ludwick.stress(strain, material.young_modulus, power)
    axes.plot(strain, law / MPa, color=LUDWICK, ls="--", label="Ludwick, printed n")


@figure(
    "5.1",
    caption="True stress over engineering strain of the ten elastomers, up to the largest force: "
    "measured {cite:p}`marechal2020`; Ludwick's law with the printed E and n; and, for comparison, "
    "Yeoh's hyperelastic law fitted to the whole curve.",
    alt="Ten small panels, one an elastomer. The measured true stress rises ever more steeply with "
    "strain, and Yeoh's law follows it throughout. Ludwick's law with the printed exponent stays "
    "on it for Mold Star 16 FAST and 20T, leaves it upwards for the three stiffer Dragon Skins and "
    "SORTA-Clear 40, and stays far below it at large strains for FX Pro and the three Ecoflexes.",
    provenance=Provenance.PUBLIC,
    sources=TESTS,
)
def figure_5_1() -> Figure:
    """Draw the stress-strain curves of the ten elastomers against Ludwick's law."""
    drawn, panels = sheet(8.2, 5, 2)
    for axes, material in zip(panels.flat, table_5_1().values(), strict=True):
        draw_curves(axes, material, material.fractional_power)
        axes.set_title(material.name, fontsize=9.5)
        axes.text(0.05, 0.84, f"n = {material.fractional_power:.3f}", transform=axes.transAxes)
        axes.set_ylim(0, 1.1 * (1 + facts()[material.name].peak_strain)
                      * facts()[material.name].peak_stress / MPa)  # fmt: skip
        axes.set_ylabel("MPa")
    for axes in panels[-1]:
        axes.set_xlabel("engineering strain")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside upper center", ncols=3, columnspacing=1.2)
    return drawn


@figure(
    "5.2",
    caption="The fractional power n of Table 5.1 over the three properties that are to predict it, "
    "with Spearman's rank correlation. The two held-out materials are drawn hollow.",
    alt="Three scatter plots of ten points. n rises with Young's modulus and, most clearly, with "
    "tensile strength; with mixed viscosity it rises too, but loosely.",
    provenance=Provenance.PRINTED,
)
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


@figure(
    "5.A",
    caption="The fractional power that a fit gives, over the strain up to which the curve is used "
    "(true stress, E held, least squares of the stress). Dashed: the printed n, with the band of "
    "values whose 1/n rounds to the same two decimals.",
    alt="Ten small panels. In seven of them the fitted exponent meets the printed one where "
    "strains up to about six are used; for Dragon Skin 20, Dragon Skin 30 and SORTA-Clear 40 only "
    "where the fit stops at a strain of two or three.",
    provenance=Provenance.PUBLIC,
)
def figure_5_a() -> Figure:
    """Draw n over the longest strain of the fit."""
    drawn, panels = sheet(8.2, 5, 2, sharex=True)
    for axes, material in zip(panels.flat, table_5_1().values(), strict=True):
        peak = facts()[material.name].peak_strain
        used = [min(limit, peak) for limit in LONGEST_STRAINS]
        n = [kept()[material.name, Fitting(longest_strain=limit)] for limit in LONGEST_STRAINS]
        axes.plot(used, n, "o-", color=LUDWICK, label="fitted")
        printed = 1 / round(1 / material.fractional_power, 2)
        m = 1 / printed
        across = [0, 18]
        axes.fill_between(
            across, 1 / (m + 0.005), 1 / (m - 0.005), color=PRINTED, alpha=0.25, lw=0,
            label="printed, rounded",
        )  # fmt: skip
        axes.plot(across, [printed, printed], color=PRINTED, ls="--", label="printed")
        axes.set_xlim(across)
        axes.set_title(material.name, fontsize=9.5)
        axes.set_ylim(material.fractional_power - 0.7, material.fractional_power + 0.7)
        axes.set_ylabel("n")
    for axes in panels[-1]:
        axes.set_xlabel("strain used up to")
        axes.xaxis.set_major_locator(MultipleLocator(4))
    handles, labels = panels[0, 0].get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside upper center", ncols=3)
    return drawn


@figure(
    "5.B",
    caption="Each of the ten materials predicted by Eq. (5.8) fitted to the other nine, and by the "
    "mean of the nine: what a reader with a new material can expect.",
    alt="Predicted over printed exponent. The points of Eq. (5.8) scatter about the diagonal; "
    "Ecoflex 00-10 is predicted far too low. The means lie on a nearly flat line.",
    provenance=Provenance.PRINTED,
)
def figure_5_b() -> Figure:
    """Draw leave-one-out predictions over the printed values."""
    drawn, axes = sheet(4.0)
    axes.plot([0.8, 2.8], [0.8, 2.8], color=GREY, lw=1, label="exact")
    styles = (("Eq. (5.8)", LUDWICK, "o"), ("mean of the others", VERMILION, "_"))
    for name, colour, marker in styles:
        found = leave_k_out(1, model=RIVALS[name]()).predictions
        axes.scatter([p.printed for p in found], [p.predicted for p in found], color=colour,
                     marker=marker, s=60, label=name)  # fmt: skip
    worst = leave_k_out(1).worst
    axes.annotate(worst.name, (worst.printed, worst.predicted), (6, -4),
                  textcoords="offset points", fontsize=9.5)  # fmt: skip
    axes.set(xlabel="printed n", ylabel="predicted n", xlim=(1.4, 2.65), ylim=(0.7, 2.75))
    axes.legend(loc="lower right")
    return drawn
