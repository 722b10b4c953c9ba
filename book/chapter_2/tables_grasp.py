"""Tables of Chapter 2 on the grasp: what the printed forces imply, and the simulated grasps."""

import pandas as pd

from book.chapter_2.figures_grasp import DATA
from book.chapter_2.grasps import (
    FRICTION,
    OBJECTS,
    at_rest,
    desired_force,
    held_share,
    position_study,
    squeezes,
    study,
    summary,
)
from book.companion.exhibit import table
from softgrip.provenance import Provenance
from softgrip.tactile.force import TABLE_2_2, table_2_2
from softgrip.tactile.friction import (
    Interval,
    common_friction,
    contact_force,
    holding_probability,
    lift_force,
    printed_grasps,
)

WEIGHED = {"egg": "egg", "tofu": "tofu", "carrot": "sliced carrot"}
"""The row of Table 2.2 for each object; the text calls the carrot sliced, then small."""
DEVIATION = 0.015
"""Of a measured force, N: Section 2.2."""


def _text(interval: Interval | None, digits: int = 2) -> str:
    return (
        "none" if interval is None else f"{interval.low:.{digits}f} to {interval.high:.{digits}f}"
    )


def _ripple(name: str, factor: float = 1.0) -> str:
    return f"{1e3 * summary(study(name, factor)).ripple:.1f}"


@table(
    "2.J",
    caption="What the printed forces of Section 2.4 imply. The friction coefficient is that of Eq. "
    "(2.9), in the bounds that rounding leaves, with the measured force taken to be the desired "
    "one; the last rows take it to be 1, which is between the bounds common to all three. The last "
    "row supposes that a measured force deviates by 0.015 N, as Section 2.2 prints on average.",
    provenance=Provenance.PRINTED,
    data=(DATA[0], TABLE_2_2),
)
def table_2_j() -> pd.DataFrame:
    """Tabulate the friction that printed forces imply, and what is then lifted."""
    columns = {}
    for name, given in printed_grasps().items():
        contact, lift, weight = (float(s) for s in (given.contact, given.lift, given.weight))
        probable = holding_probability(lift, weight, FRICTION, DEVIATION)
        columns[name] = {
            "desired force F_c (N), printed": given.contact,
            "estimated lift force F_est (N), printed": given.lift,
            "weight (N), printed": given.weight,
            "weight (N), Table 2.2": f"{table_2_2()[WEIGHED[name]].true:.3f}",
            "F_est over the printed weight": f"{lift / weight - 1:+.0%}",
            "F_est over that of Table 2.2": f"{lift / table_2_2()[WEIGHED[name]].true - 1:+.0%}",
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


@table(
    "2.K",
    caption="The *simulated* grasps, 200 of each object, 10 s from the open gripper: command as a "
    "change of position. Desired forces and weights are the printed ones; the friction coefficient "
    "is 1, or at the ends of what the print leaves. Held: the true lift force of the last second "
    "bears the printed weight. Last: the force that is missing if the command is a position.",
    provenance=Provenance.SIMULATED,
    data=DATA,
)
def table_2_k() -> pd.DataFrame:
    """Tabulate how the simulated force comes to rest, and whether the object is held."""
    columns = {}
    common = common_friction() or Interval(FRICTION, FRICTION)
    for name in OBJECTS:
        made, wanted = study(name), desired_force(name)
        found, position = summary(made), position_study(name)
        missing = 1 - at_rest(position, position.measured).mean() / wanted
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
            "lift force by the pad (N)": f"{lift_force(wanted - found.steady_error, FRICTION):.3f}",
            "printed weight (N)": printed_grasps()[name].weight,
            f"held, friction {common.low:.3f} (%)": f"{100 * held_share(name, common.low):.0f}",
            f"held, friction {FRICTION:.3f} (%)": f"{100 * held_share(name):.0f}",
            f"held, friction {common.high:.3f} (%)": f"{100 * held_share(name, common.high):.0f}",
            "missing, command as position (%)": f"{100 * missing:.0f}",
        }
    return pd.DataFrame(columns).rename_axis("quantity").reset_index()
