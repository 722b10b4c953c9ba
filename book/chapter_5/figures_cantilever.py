"""Figure 5.D: up to which angle the cantilever's closed form holds."""

import numpy as np
from matplotlib.figure import Figure

from book.companion.exhibit import figure
from book.companion.style import BLUE, GREEN, GREY, ORANGE, PURPLE, VERMILION, sheet
from softgrip.actuator.cantilever import angle_limit, closed_form_error
from softgrip.provenance import Provenance
from softgrip.units import DEG

POWERS = (1.0, 1.05, 1.538, 2.0, 2.5)
LIMITS = (0.05, 0.10)
LINES = ("-", (0, (1, 1)), "--", "-.", (0, (5, 1, 1, 1, 1, 1)))
COLOURS = (ORANGE, VERMILION, GREEN, PURPLE, BLUE)


@figure(
    "5.D",
    caption="By how much Eq. (5.12) says too large a tip angle, over the true tip angle of a "
    "uniform cantilever under a dead load at its tip, for five fractional powers: computed, with "
    "I_n of Eq. (3.8), and for any finger, since its size and the load drop out. Points: where the "
    "error reaches 5 and 10 %.",
    alt="Five curves rise ever more steeply from zero error at zero angle. The linear law reaches "
    "5 percent at about 21 degrees and 10 percent at about 29; the larger the exponent, the later: "
    "with 2.5, at about 34 and 46 degrees.",
    provenance=Provenance.PRINTED,
    sources="computed from Eq. (5.12) and the exact integral of the cantilever; nothing measured",
)
def figure_5_d() -> Figure:
    """Draw the relative error of the closed form over the tip angle."""
    drawn, axes = sheet(3.6)
    degrees = np.arange(1.0, 61.0)
    for error in LIMITS:
        axes.plot([0, 60], [100 * error] * 2, color=GREY, lw=0.8)
    for n, colour, line in zip(POWERS, COLOURS, LINES, strict=True):
        errors = [100 * closed_form_error(angle * DEG, n) for angle in degrees]
        axes.plot(degrees, errors, color=colour, ls=line, label=f"n = {n:g}")
        limits = [angle_limit(error, n) / DEG for error in LIMITS]
        axes.plot(limits, [100 * error for error in LIMITS], "o", color=colour, ms=4)
    axes.set(xlabel="true tip angle (deg)", ylabel="closed form too large by (%)")
    axes.set(xlim=(0, 60), ylim=(0, 25))
    axes.legend(loc="upper left")
    return drawn
