"""Tables of Chapter 6 on the linear model."""

from collections.abc import Iterable

import numpy as np
import pandas as pd

from book.chapter_6.figures import COMPARED
from book.companion.exhibit import table
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.step_metrics import settling_time
from softgrip.gripper.gripper_loop import run_gripper
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.loop_shaping import fit_roll_off, magnitude_gap
from softgrip.gripper.plant import PRINTED as GRIPPER
from softgrip.gripper.printed_loop import FILTERS, FINE, crossover, equal_targets, run_printed
from softgrip.gripper.reach import project
from softgrip.gripper.robustness import (
    box,
    continuous_stability,
    sampled_stability,
    structured_gain,
)
from softgrip.gripper.shaping_filter import (
    bandwidth,
    filter_state_space,
    plant_inside,
    rounding_margin,
)
from softgrip.gripper.uncertainty import deviation, finger_response
from softgrip.provenance import Provenance
from softgrip.units import DEG, REV

CRITERIA = {"2 %": 0.02, "5 %": 0.05, "10 %": 0.1, "1 deg": DEG}
"""Half widths of the settling band: shares of the target, or an angle."""


@table(
    "6.A",
    caption="Equal angles for both fingers split by Eq. (6.24)-(6.25), in units of pi rad; the "
    "print has 0.303 and 0.357 (once 0.35) with residuals 0.030 and -0.024, then 0.227 and 0.268 "
    "with 0.023 and -0.018.",
    provenance=Provenance.PRINTED,
)
def table_6_a() -> pd.DataFrame:
    """Tabulate projections and residuals."""
    rows = []
    for words, angle in (("π/3", np.pi / 3), ("0.333 π", 0.333 * np.pi), ("π/4", np.pi / 4)):
        found = project(GRIPPER, [angle, angle])
        row = {"both fingers": words}
        for k in (0, 1):
            row[f"proj, SPA {k + 1}"] = f"{found.reached[k] / np.pi:.4f}"
            row[f"residual, SPA {k + 1}"] = f"{found.residual[k] / np.pi:.4f}"
            row[f"deg, SPA {k + 1}"] = f"{found.reached[k] / DEG:.2f}"
        rows.append(row)
    return pd.DataFrame(rows)


@table(
    "6.B",
    caption="The printed filters H(s), what can be read from them, and how near Glover and "
    "McFarlane's design for the same target loop comes up to 100 rad/s, its roll-off fitted. "
    "The plant inside is that of the factor of denominator less numerator, with what rounding the "
    "coefficients to four digits can do; the mean finger has 2.555 and 3.335.",
    provenance=Provenance.PRINTED,
)
def table_6_b() -> pd.DataFrame:
    """Tabulate the filters."""
    columns = {}
    for name, printed in FILTERS.items():
        low_pass = filter_state_space(*printed)
        (damping, stiffness), slack = plant_inside(*printed), rounding_margin(*printed)
        s = 1e-4j
        loop = low_pass(s).item() / (1 - low_pass(s).item())
        roll_off, ours = fit_roll_off(crossover(name), low_pass, COMPARED)
        gap = np.abs(magnitude_gap(ours.complementary, low_pass, COMPARED))
        inside = gap[bandwidth(low_pass) > COMPARED]
        columns[name] = {
            "gain at 0": f"{low_pass(0).item().real:.4f}",
            "bandwidth (rad/s)": f"{bandwidth(low_pass):.2f}",
            "largest gain": f"{np.abs(low_pass(1j * COMPARED)).max():.3f}",
            "fastest pole (rad/s)": f"{np.abs(low_pass.poles()).max():.0f}",
            "relative degree": f"{len(printed[1]) - len(printed[0])}",
            "loop at low frequency": f"{abs(loop * s):.3f}/s",
            "plant inside, 1/s": f"{damping:.3f} ± {slack[0]:.3f}",
            "plant inside, 1/s²": f"{stiffness:.3f} ± {slack[1]:.3f}",
            "ours: roll-off (rad/s)": f"{roll_off:.1f}",
            "ours: least gamma": f"{ours.gamma:.2f}",
            "ours: bandwidth (rad/s)": f"{bandwidth(ours.complementary):.2f}",
            "ours: largest gap of the gain (%)": f"{100 * gap.max():.0f}",
            "ours: the same within the bandwidth (%)": f"{100 * inside.max():.0f}",
        }
    return pd.DataFrame(columns).rename_axis("for the target loop").reset_index()


@table(
    "6.C",
    caption="Settling times of the two fingers on the linear model, in s, SPA 1 and SPA 2, by "
    "criterion; printed are 0.6 (simulated), 0.7 and 1.1 (measured).",
    provenance=Provenance.PRINTED,
)
def table_6_c() -> pd.DataFrame:
    """Tabulate settling times by criterion."""
    rows = []
    for name, angle, printed in (
        ("4.8/s", np.pi / 3, "0.6"),
        ("4.8/s", np.pi / 4, "0.7"),
        ("2/s", np.pi / 4, "1.1"),
    ):
        for period in (FINE, 0.1):
            found = run_printed(name, period=period, angle=angle)
            row = {"H": name, "step": f"{angle / DEG:.0f} deg", "period (s)": f"{period:g}"}
            for words, band in CRITERIA.items():
                settled = settling_time(
                    found.time,
                    found.angles,
                    final=equal_targets(angle),
                    band=band,
                    absolute="deg" in words,
                )
                row[words] = f"{settled[0]:.2f}, {settled[1]:.2f}"
            rows.append(row | {"printed": printed})
    return pd.DataFrame(rows)


@table(
    "6.D",
    caption="The step to π/3 at 100 ms and the motor's 5 rev/s. The unit of U is not printed: with "
    "the printed gain of 7.831 the pump must move by 0.44 units times s. Given for both readings "
    "of the unit: peak of the command over the limit, and where the fingers end, over their "
    "targets, when the command is cut at the limit and the model inside knows that, or not.",
    provenance=Provenance.PRINTED,
)
def table_6_d() -> pd.DataFrame:
    """Tabulate what the motor's limit does."""
    rows = []
    for name, printed in FILTERS.items():
        free = run_printed(name, duration=8.0)
        for unit, limit in (("rad/s", SPEED_LIMIT), ("rev/s", SPEED_LIMIT / REV)):
            row = {
                "H": name,
                "unit": unit,
                "peak of u": f"{np.abs(free.commands).max():.1f}",
                "integral of u": f"{free.commands.sum() * 0.1:.3f}",
                "peak over limit": f"{np.abs(free.commands).max() / limit:.2f}",
            }
            for words, known in (("model knows", limit), ("model does not", np.inf)):
                controller = InternalModelController(
                    GRIPPER,
                    equal_targets(),
                    mean_inverse(GRIPPER),
                    filter_state_space(*printed),
                    limit=known,
                )
                found = run_gripper(GRIPPER, controller, duration=8.0, limit=limit, points=1)
                row[f"end, {words}"] = f"{found.angles[0, -1] / equal_targets()[0]:.2f}"
            rows.append(row)
    return pd.DataFrame(rows)


@table(
    "6.G",
    caption="Robust stability over 14.3 % of C_n and 5.9 % of K_n of each finger: the largest "
    "structured gain (1 is the limit), the largest uniform uncertainty that is tolerated, and the "
    "worst decay rate or margin of the loop's poles over the corners of that box.",
    provenance=Provenance.PRINTED,
)
def table_6_g() -> pd.DataFrame:
    """Tabulate robust stability."""
    around, inverse = box(GRIPPER, points=2), mean_inverse(GRIPPER)
    weights = np.array(
        [
            deviation(
                [finger_response(g.fingers[k], COMPARED) for g in around],
                finger_response(nominal, COMPARED),
            )
            for k, nominal in enumerate(GRIPPER.fingers)
        ]
    )
    rows, even = [], np.ones((2, 1))
    for name, printed in FILTERS.items():
        low_pass = filter_state_space(*printed)
        at = (GRIPPER, inverse, low_pass)
        matrices = controller_matrices(*at)
        rows.append(
            {
                "H": name,
                "largest weight": f"{weights.max():.3f}",
                "structured gain": f"{structured_gain(*at, weights, COMPARED).max():.3f}",
                "tolerated weight": f"{1 / structured_gain(*at, even, COMPARED).max():.2f}",
                "decay rate, continuous (1/s)": _worst(
                    continuous_stability(GRIPPER, real, inverse, low_pass).margin for real in around
                ),
                **{
                    f"margin at 100 ms, {delay} late": _worst(
                        sampled_stability(matrices, real, delay_samples=delay).margin
                        for real in around
                    )
                    for delay in (0, 1, 2)
                },
            }
        )
    return pd.DataFrame(rows)


def _worst(margins: Iterable[float]) -> str:
    return f"{min(margins):.3f}"
