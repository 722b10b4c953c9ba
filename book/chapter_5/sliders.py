"""What the sliders of Chapter 5 draw."""

from matplotlib.figure import Figure

from book.chapter_5.figures_materials import draw_curves
from book.companion.style import LUDWICK, MEASURED, still, style
from softgrip.materials.facts import facts
from softgrip.materials.powerlaw import predict_power
from softgrip.materials.table import table_5_1
from softgrip.units import MPa


def draw_new_material(E: float, MV: float, TS: float) -> Figure:
    """Draw the predicted n of a new material among the ten known ones.

    Args:
        E, TS: Young's modulus (100 % modulus) and tensile strength, MPa.
        MV: Mixed viscosity, Pa s.
    """
    found = predict_power(E * MPa, MV, TS * MPa)
    power = found.power
    with style():
        drawn, axes = still(3.0, left=0.34)
        axes.axvspan(power.low, power.high, color=LUDWICK, alpha=0.15, lw=0)
        axes.axvline(power.value, color=LUDWICK, lw=2.4)
        ranked = sorted(table_5_1().values(), key=lambda m: m.fractional_power)
        axes.scatter([m.fractional_power for m in ranked], range(10), color=MEASURED, zorder=3)
        axes.set_yticks(range(10), [m.name for m in ranked], fontsize=8.5)
        title = f"n = {power.value:.2f}, 95 %: {power.low:.2f} to {power.high:.2f}"
        if found.extrapolates:
            title += "  (extrapolated)"
        axes.set(xlim=(0, 4), xlabel="fractional power n", title=title)
    return drawn


def draw_law(material: str, n: float) -> Figure:
    """Draw Ludwick's law with a chosen n over the curve of a material."""
    chosen = table_5_1()[material]
    known = facts()[material]
    with style():
        drawn, axes = still(3.2)
        draw_curves(axes, chosen, n)
        axes.get_lines()[-1].set_label(f"Ludwick, n = {n:.2f}")
        axes.set(
            xlabel="engineering strain",
            ylabel="true stress (MPa)",
            title=f"{material}, printed n = {chosen.fractional_power:.3f}",
            ylim=(0, 1.15 * (1 + known.peak_strain) * known.peak_stress / MPa),
        )
        axes.legend(loc="upper left")
    return drawn
