"""Figures of Chapter 6 on the linear model: what one pump can reach, and how the loop does it."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from book.companion.exhibit import figure
from book.companion.style import BLUE, GREEN, GREY, ORANGE, PRINTED, PURPLE, VERMILION, sheet
from softgrip.gripper.internal_model import controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.loop_shaping import fit_roll_off
from softgrip.gripper.plant import PRINTED as GRIPPER
from softgrip.gripper.printed_loop import FILTERS, FINE, crossover, equal_targets, run_printed
from softgrip.gripper.reach import outside_share
from softgrip.gripper.robustness import box, sampled_stability
from softgrip.gripper.shaping_filter import FAST, filter_state_space
from softgrip.gripper.synchronization import synchronization_error
from softgrip.provenance import Provenance
from softgrip.units import DEG

SPA = (BLUE, GREEN)
"""Colours of the two fingers: the text draws the first one blue, the second one green."""

COMPARED = np.geomspace(0.1, 100, 200)
"""Frequencies at which filters are compared, rad/s."""

PUSH, PUSHED = 0.2, (1.4, 2.4)
"""Push on the left finger [rad] and from when to when [s]; only the start is printed."""


def push(time: float) -> tuple[float, float]:
    """Return what pushes the fingers, rad."""
    return (PUSH if PUSHED[0] <= time < PUSHED[1] else 0.0), 0.0


@figure(
    "6.6",
    caption="The printed controller on the printed model, Eq. (6.26), without a limit of the "
    "command: (a) continuous in all but name (5 ms); (b) at the stated 100 ms with a noise of 2 "
    "deg RMS in each sample; (c) with the left finger held by a force that would bend it by 0.2 "
    "rad more, from 1.4 to 2.4 s (size and length are ours). Dashed: proj(Y_d).",
    alt="Three panels of two angles over time. The first finger rises past its target of 55 "
    "degrees within half a second and comes back in about two seconds, the second one reaches 65 "
    "degrees. Noise adds a ripple of about a degree. While the left finger is pushed it drifts "
    "five degrees up and the right one five degrees down; after that both come back.",
    provenance=Provenance.PRINTED,
)
def figure_6_6() -> Figure:
    """Draw the step, the step with noise, and the step with a push."""
    drawn, panels = sheet(6.0, 3, 1, sharex=True, sharey=True)
    runs = {
        "(a) nominal": run_printed(period=FINE),
        "(b) sensor noise": run_printed(noise=2 * DEG),
        "(c) push on the left finger": run_printed(push=push),
    }
    for axes, (title, found) in zip(panels, runs.items(), strict=True):
        for k, goal in enumerate(equal_targets()):
            axes.plot(found.time, found.angles[k] / DEG, color=SPA[k], label=f"SPA {k + 1}")
            axes.axhline(goal / DEG, color=PRINTED, ls="--", lw=1)
        axes.set(title=title, ylabel="angle (deg)", xlim=(0, 5), ylim=(0, 80))
    panels[2].axvspan(*PUSHED, color=GREY, alpha=0.15, lw=0)
    panels[2].set_xlabel("time (s)")
    panels[0].legend(loc="lower right", ncols=2)
    return drawn


@figure(
    "6.A",
    caption="What the projection at rest leaves out. (a) The share of a target that no input can "
    "produce, over frequency: of equal angles for both fingers, and of proj(Y_d), which can be "
    "reached at rest alone. (b) How far the fingers of Figure 6.6 (a) are apart on their way, with "
    "both printed filters; dotted, the 2 deg that Section 6.4 reports for 45 deg.",
    alt="Two panels. Above, one curve falls from 8 percent to nothing beyond 3 rad/s while the "
    "other rises from nothing to 8 percent. Below, the difference of the fingers peaks at seven "
    "degrees with the fast filter and at four to five with the slow one.",
    provenance=Provenance.PRINTED,
)
def figure_6_a() -> Figure:
    """Draw the unreachable share over frequency and the synchronization error over time."""
    drawn, (upper, lower) = sheet(4.8, 2, 1)
    frequency = np.geomspace(0.05, 100, 300)
    for goal, words, colour, dash in (
        (np.ones(2), "equal angles", VERMILION, "-"),
        (equal_targets(), "proj(Y_d)", BLUE, "--"),
    ):
        share = 100 * outside_share(GRIPPER, goal, frequency)
        upper.semilogx(frequency, share, color=colour, ls=dash, label=words)
    upper.set(title="(a)", xlabel="frequency (rad/s)", ylabel="outside Im P (%)", ylim=(0, 10))
    upper.legend(loc="center left")
    for name, colour in zip(FILTERS, (BLUE, ORANGE), strict=True):
        found = run_printed(name, period=FINE)
        apart = synchronization_error(found.angles, equal_targets()) / DEG
        lower.plot(found.time, apart, color=colour, label=f"H for {name}")
    lower.axhline(2, color=GREY, ls=":")
    lower.set(title="(b)", xlabel="time (s)", ylabel="apart (deg)", xlim=(0, 4), ylim=(0, None))
    lower.legend(loc="upper right")
    return drawn


@figure(
    "6.B",
    caption="The printed filters H(s) and those that Glover and McFarlane's loop shaping gives for "
    "the same target loops. The pole pair that the target loop must be given beyond its crossover "
    "is not printed; here it is fitted to the printed filter.",
    alt="Gain over frequency of four filters, in two pairs. All are one at low frequencies and "
    "fall off steeply; the printed ones keep a higher gain up to the corner than the others.",
    provenance=Provenance.PRINTED,
)
def figure_6_b() -> Figure:
    """Draw the gain of the printed and the re-derived filters."""
    drawn, axes = sheet(3.4)
    for (name, printed), colour in zip(FILTERS.items(), (BLUE, ORANGE), strict=True):
        low_pass = filter_state_space(*printed)
        _, ours = fit_roll_off(crossover(name), low_pass, COMPARED)
        for system, dash, whose in ((low_pass, "-", "printed"), (ours.complementary, "--", "ours")):
            gain = np.abs(system(1j * COMPARED)).ravel()
            axes.loglog(COMPARED, gain, color=colour, ls=dash, label=f"{name}, {whose}")
    axes.set(xlabel="frequency (rad/s)", ylabel="|H|", ylim=(1e-4, 2))
    axes.legend(loc="lower left")
    return drawn


@figure(
    "6.C",
    caption="How far the loop with the filter for 4.8/s is from instability, over the sampling "
    "period: one less the largest modulus of its poles, the worst of the corners of a box of "
    "14.3 % in C_n and 5.9 % in K_n of each finger. Solid: H P-dagger made discrete by the "
    "bilinear rule; dashed: as if its input were held. The command comes 0, 1 or 2 periods late, "
    "which the model inside does not know. Dotted: the 100 ms of Section 6.4.",
    alt="Curves of the stability margin over the period. With the bilinear rule and no delay it "
    "stays positive throughout; with one period of delay it turns negative above 0.22 seconds and "
    "with two above 0.14 seconds. With a held input it is negative from 0.05 seconds on.",
    provenance=Provenance.PRINTED,
)
def figure_6_c() -> Figure:
    """Draw the stability margin over the period, by discretisation and delay."""
    drawn, axes = sheet(3.4)
    periods = np.linspace(0.01, 0.3, 30)
    corners = box(GRIPPER, points=2)
    for delay, colour in enumerate((BLUE, ORANGE, PURPLE)):
        for method, dash in (("bilinear", "-"), ("zoh", "--")):
            margins = [_margin(float(h), method, delay, corners) for h in periods]
            label = f"{delay} late" if method == "bilinear" else None
            axes.plot(periods, margins, color=colour, ls=dash, label=label)
    axes.axhline(0, color=GREY, lw=1)
    axes.axvline(0.1, color=GREY, ls=":")
    axes.set(xlabel="period (s)", ylabel="margin", xlim=(0, 0.3), ylim=(-0.3, 0.2))
    axes.legend(loc="lower left")
    return drawn


def _margin(period: float, method: Any, delay: int, corners: Any) -> float:
    matrices = controller_matrices(
        GRIPPER, mean_inverse(GRIPPER), filter_state_space(*FAST), period=period, method=method
    )
    return min(sampled_stability(matrices, real, delay_samples=delay).margin for real in corners)
