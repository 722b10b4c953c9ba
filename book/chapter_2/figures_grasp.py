"""Figures and tables of Chapter 2 on the grasp: printed forces, and simulated grasps."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from book.chapter_2.grasps import (
    OBJECTS,
    at_rest,
    desired_force,
    friction,
    held_share,
    position_gains,
    position_study,
    squeezes,
    study,
    summary,
)
from book.chapter_2.numbers import simulated_lift
from book.companion.claims import printed
from book.companion.exhibit import figure, table
from book.companion.style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, sheet
from softgrip.provenance import Provenance
from softgrip.simulator.pad_gripper import GraspGripper
from softgrip.tactile.force import table_2_2
from softgrip.tactile.force_control import largest_loop_gain
from softgrip.tactile.friction import (
    Interval,
    common_friction,
    contact_force,
    holding_probability,
    lift_force,
    printed_grasps,
)

ENDS = (5, 95)
"""Of the bands over many grasps, per cent."""
FRICTION = 1.0
"""Coefficient that the printed forces are read with: the round number in what they leave."""


@figure("2.14", Provenance.SIMULATED)
def figure_2_14() -> Figure:
    """Draw desired, measured and true force of the three grasps."""
    drawn, panels = sheet(6.6, 3, 1, sharex=True)
    for axes, letter, name in zip(panels, "abc", OBJECTS, strict=True):
        made = study(name)
        low, high = np.percentile(made.measured, ENDS, axis=0)
        axes.fill_between(made.time, low, high, color=BLUE, alpha=0.25, lw=0)
        least = contact_force(float(printed_grasps()[name].weight), friction())
        axes.axhline(least, color=GREY, ls=(0, (1, 1)), lw=2.4, label="bears the weight")
        axes.axhline(made.desired, color=ORANGE, label="desired")
        axes.plot(made.time, made.force[0], color=BLACK, ls="--", label="true")
        for side in np.percentile(made.force, ENDS, axis=0):
            axes.plot(made.time, side, color=BLACK, ls=":", lw=0.9)
        axes.plot(made.time, made.measured[0], color=BLUE, label="measured")
        axes.set(ylabel="force (N)", title=f"({letter}) {name}, {made.desired:g} N", xlim=(0, 6))
        axes.set(ylim=(0, 1.4 * made.desired))
    panels[0].legend(loc="lower right", ncols=2)
    panels[-1].set(xlabel="time (s)")
    return drawn


@figure("2.I", Provenance.PRINTED)
def figure_2_i() -> Figure:
    """Draw the intervals of the friction coefficient."""
    drawn, axes = sheet(2.9)
    if common := common_friction():
        axes.axvspan(common.low, common.high, color=GREEN, alpha=0.3, lw=0, label="common")
    for row, (name, given) in enumerate(printed_grasps().items()):
        for shift, found, lift, colour, words in (
            (-0.15, given.friction, given.lift, BLUE, "agrees with the lift force"),
            (0.15, given.least_friction, given.weight, GREY, "bears the weight"),
        ):
            axes.plot(
                (found.low, found.high), (row + shift,) * 2, color=colour, lw=5,
                solid_capstyle="butt", label="" if row else words,
            )  # fmt: skip
            axes.plot(contact_force(float(lift), float(given.contact)), row + shift, "o",
                      color=BLACK, ms=4)  # fmt: skip
        axes.text(0.72, row, name, va="center", ha="right")
    axes.set(
        xlabel="friction coefficient",
        ylabel="object",
        yticks=[],
        xlim=(0.55, 1.55),
        ylim=(3.3, -0.5),
    )
    axes.legend(loc="lower right", ncols=1, fontsize=8.5)
    return drawn


def missing_share(name: str) -> float:
    """Return the share of the force that is missing at rest, the command being a position."""
    made = position_study(name)
    return float(1 - at_rest(made, made.measured).mean() / desired_force(name))


@figure("2.J", Provenance.SIMULATED)
def figure_2_j() -> Figure:
    """Draw what each reading of the command makes of a grasp."""
    drawn, (upper, lower) = sheet(5.6, 2, 1)
    gripper = GraspGripper()
    upper.axhline(desired_force("egg"), color=ORANGE, label="desired")
    for made, colour, dash, words in (
        (study("egg"), BLUE, "-", "change"),
        (position_study("egg"), GREEN, "--", "position, from touch"),
        (position_study("egg", gripper.opening), BLACK, ":", "position, 5 mm open"),
    ):
        upper.plot(made.time, made.measured[0], color=colour, ls=dash, label=words)
    upper.set(xlabel="time (s)", ylabel="force (N)", title="(a) egg, measured force", xlim=(0, 3))
    upper.set(ylim=(-0.015, 0.5), xticks=np.arange(4))
    upper.legend(loc="upper right", ncols=2)
    limit = largest_loop_gain(gripper.lag)
    gain = np.linspace(0, limit, 100)
    lower.plot(gain, 1 / (1 + gain), color=GREEN, ls="--")
    lower.axvline(limit, color=VERMILION, ls="-.", label="unstable beyond")
    for name, mark in zip(OBJECTS, "osv", strict=True):
        wanted = desired_force(name)
        gain_here = float(position_gains().kp) * squeezes()[name].stiffness(wanted)
        lower.plot(gain_here, missing_share(name), mark, color=BLUE, ls="none", label=name)
    lower.set(xlabel=r"loop gain $k_p k$", ylabel="missing share", title="(b) as a position")
    lower.set(ylim=(0, 1.05), xlim=(0, 3.2))
    lower.legend(loc="lower right")
    return drawn


WEIGHED = {"egg": "egg", "tofu": "tofu", "carrot": "sliced carrot"}
"""The row of Table 2.2 for each object; the text calls the carrot sliced, then small."""


def _text(interval: Interval | None, digits: int = 2) -> str:
    return (
        "none" if interval is None else f"{interval.low:.{digits}f} to {interval.high:.{digits}f}"
    )


def _ripple(name: str, factor: float = 1.0) -> str:
    return f"{1e3 * summary(study(name, factor)).ripple:.1f}"


@table("2.J", Provenance.PRINTED)
def table_2_j() -> pd.DataFrame:
    """Tabulate the friction that printed forces imply, and what is then lifted."""
    columns, deviation = {}, printed("2.2-deviation")
    for name, given in printed_grasps().items():
        contact, lift, weight = (float(s) for s in (given.contact, given.lift, given.weight))
        probable = holding_probability(lift, weight, FRICTION, deviation)
        true = table_2_2()[WEIGHED[name]].true
        columns[name] = {
            "desired force F_c (N), printed": given.contact,
            "estimated lift force F_est (N), printed": given.lift,
            "weight (N), printed": given.weight,
            "weight (N), Table 2.2": f"{true:.3f}",
            "F_est over the printed weight": f"{lift / weight - 1:+.0%}",
            "F_est over that of Table 2.2": f"{lift / true - 1:+.0%}",
            "friction, as the numbers stand": f"{lift / (2 * contact):.3f}",
            "friction, as rounding allows": _text(given.friction, 3),
            "friction, common to all": _text(common_friction(), 3),
            "friction that just bears the weight": _text(given.least_friction),
            "F_l from F_c, friction 1 (N)": f"{lift_force(contact, FRICTION):.2f}",
            "F_m from F_est, friction 1 (N)": f"{contact_force(lift, FRICTION):.3f}",
            "probability to slip (%)": f"{100 * (1 - probable):.2g}",
        }
    found = pd.DataFrame(columns)
    return found.rename_axis("quantity").reset_index()


@table("2.K", Provenance.SIMULATED)
def table_2_k() -> pd.DataFrame:
    """Tabulate how the simulated force comes to rest, and whether the object is held."""
    columns = {}
    common = common_friction() or Interval(FRICTION, FRICTION)
    coefficients = sorted((common.low, common.high, friction()))
    for name in OBJECTS:
        made, wanted = study(name), desired_force(name)
        found = summary(made)
        columns[name] = {
            "desired force (N)": f"{wanted:g}",
            "stiffness there (N/m)": f"{squeezes()[name].stiffness(wanted):.0f}",
            "overshoot, measured (%)": f"{100 * found.overshoot:.0f}",
            "settled to 10 % (s)": f"{found.settling_time:.1f}",
            "steady error, measured (mN)": f"{1e3 * abs(found.steady_error):.1f}",
            "ripple, measured (mN)": _ripple(name),
            **{f"ripple, gains times {x:g} (mN)": _ripple(name, x) for x in (0.5, 2.0, 4.0)},
            "true force at rest (N)": f"{found.force:.3f} ± {found.force_deviation:.3f}",
            "largest true force (N)": f"{found.peak:.3f}",
            "lift force by the pad (N)": f"{simulated_lift(name):.3f}",
            "printed weight (N)": printed_grasps()[name].weight,
            **{
                f"held, friction {x:.3f} (%)": f"{100 * held_share(name, x):.0f}"
                for x in coefficients
            },
            "missing, command as position (%)": f"{100 * missing_share(name):.0f}",
        }
    return pd.DataFrame(columns).rename_axis("quantity").reset_index()
