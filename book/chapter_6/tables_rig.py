"""Tables of Chapter 6 on the experiments: controllers side by side, identification, settling."""

import numpy as np
import pandas as pd

from book.chapter_6 import speed as gripper_speed
from book.chapter_6.comparison import CRITERIA, ENTRIES, RIGS, judged, robustness_margin
from book.chapter_6.results import (
    bounds,
    desired,
    ends,
    identified,
    identified_without_noise,
    largest_weight,
    recovery,
)
from book.companion.exhibit import table
from softgrip.arrays import Floats
from softgrip.provenance import Provenance
from softgrip.units import DEG, REV


def middle_and_ends(values: Floats, scale: float = 1.0, digits: int = 1) -> str:
    """Return the median with the 5 and 95 % points, such as ``2.3 [1.9, 2.8]``.

    A run that never settles is infinite, so the points are runs and not between them.
    """
    points = np.percentile(values, (50, 5, 95), method="nearest") / scale
    middle, low, high = (f"{x:.{digits}f}" if np.isfinite(x) else "never" for x in points)
    return f"{middle} [{low}, {high}]"


@table(
    "6.H",
    caption="Controllers on the same *simulated* gripper, all cut at 5 rev/s, every 100 ms, with "
    "the sensor's noise: median of 50 runs and 5 to 95 %. Settled: within 2 deg of the fingers' "
    "own ends, s. Out of step: the largest difference of the shares of their ways, deg. Error: of "
    "the ends from what one pump can reach of 45 deg for both, deg. Peak: of the motor, rev/s. "
    "Tolerated: the largest error of each finger's response, of any kind, under which small "
    "motions stay stable; a command sequence has no loop that could swing. The "
    "model is the one that the logs in open loop identify; with *on (6.26)* the poles are those "
    "printed.",
    provenance=Provenance.SIMULATED,
)
def table_6_h() -> pd.DataFrame:
    """Tabulate the controllers."""
    rows = []
    for name in ENTRIES:
        found, margin = judged(name), robustness_margin(name)
        _, _, other = name.partition(", ")
        rows.append(
            {
                "controller": f"same, {other}" if other else name,
                "settled": middle_and_ends(found.settling["2 deg"]),
                "overshoot (%)": middle_and_ends(found.overshoot, 0.01, 0),
                "out of step": middle_and_ends(found.synchronization, DEG),
                "error": middle_and_ends(found.error, DEG),
                "peak": middle_and_ends(found.peak, REV),
                "tolerated": "any" if margin is None else f"{margin:.0%}",
            }
        )
    return pd.DataFrame(rows)


@table(
    "6.I",
    caption="What the seven steps in open loop of the *simulated* gripper identify. It is "
    "calibrated so that a step without noise identifies Eq. (6.26), and its spread so that seven "
    "runs have about the printed deviations: what the sensor's noise adds to them is the finding. "
    "Last line: half a second of a fifth of the air's torque, with the filter for 2/s, median of "
    "50 runs.",
    provenance=Provenance.SIMULATED,
)
def table_6_i() -> pd.DataFrame:
    """Tabulate what is identified beside what is printed."""
    found, quiet = identified("open"), identified_without_noise()
    means = np.array([[(f.damping, f.stiffness) for f in runs] for runs in found]).mean(axis=1)
    noisy, bare = 100 * bounds(found), 100 * bounds(quiet)
    rows = [
        ("damping by mass (1/s)", "2.45 and 2.66", means[:, 0], "{:.2f}"),
        ("stiffness by mass (1/s^2)", "3.06 and 3.61", means[:, 1], "{:.2f}"),
        ("largest deviation of the damping (%)", "14.3", noisy[:, 0], "{:.1f}"),
        ("the same without sensor noise (%)", "", bare[:, 0], "{:.1f}"),
        ("largest deviation of the stiffness (%)", "5.9", noisy[:, 1], "{:.1f}"),
        ("the same without sensor noise (%)", "", bare[:, 1], "{:.1f}"),
        ("angle at rest (deg)", "50 and 39.5", ends("open") / DEG, "{:.1f}"),
        ("reachable of 45 deg (deg)", "48.24 and 40.86", desired() / DEG, "{:.2f}"),
        ("back within 1 deg after a push on the left finger (s)", "", recovery(), "{:.1f}"),
    ]
    return pd.DataFrame(
        {"": what, "printed": text, "left": form.format(v[0]), "right": form.format(v[1])}
        for what, text, v, form in rows
    )


@table(
    "6.J",
    caption="Time in s after which both fingers of the *simulated* gripper stay within a band "
    "about their own ends, median of 50 runs, and the overshoot; and what it would be without the "
    "motor's limit of 5 rev/s, without the noise of the flex sensors, without both. The text has "
    "0.7 s with the filter for 4.8/s and 1.1 s with that for 2/s, and no criterion.",
    provenance=Provenance.SIMULATED,
)
def table_6_j() -> pd.DataFrame:
    """Tabulate settling times by criterion."""
    rows = []
    for name in ("H for 4.8/s", "H for 2/s"):
        for rig in RIGS:
            found = judged(name, rig)
            times = {key: float(np.median(found.settling[key])) for key in CRITERIA}
            rows.append(
                {
                    "filter": name,
                    "gripper": rig,
                    **{k: f"{t:.1f}" if np.isfinite(t) else "never" for k, t in times.items()},
                    "overshoot (%)": f"{100 * np.median(found.overshoot):.0f}",
                }
            )
    return pd.DataFrame(rows)


@table(
    "6.K",
    caption="Standard deviation of where the left finger of the *simulated* gripper comes to rest, "
    "over 200 runs, deg, by the motor speed of one push; printed are 1.14 deg at a higher and "
    "2.41 deg at a lower speed, neither of which is given. Last column: the largest weight W_T, of "
    "second order, fitted by Eq. (6.18) to the models that seven runs identify without noise; a "
    "push that is slower than the finger identifies none.",
    provenance=Provenance.SIMULATED,
)
def table_6_k() -> pd.DataFrame:
    """Tabulate the spread over the speed."""
    return pd.DataFrame(
        {
            "speed (rev/s)": f"{spread.speed:g}",
            "true": f"{spread.true.std(ddof=1):.2f}",
            "measured": f"{spread.measured.std(ddof=1):.2f}",
            "weight (%)": _percent(largest_weight(spread.speed * REV)),
        }
        for spread in gripper_speed.kept_errors()
    )


def _percent(share: float | None) -> str:
    return "none" if share is None else f"{100 * share:.1f}"
