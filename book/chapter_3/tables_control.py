"""Tables of Chapter 3 on control: settling times, and the steps that can settle in time."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from book.chapter_3.figures_control import BANDS, FASTER, LOGS, PRINTED_TIME
from book.chapter_3.regulators import FILE as GAINS
from book.chapter_3.regulators import designed_on, regulator
from book.chapter_4.identified_model import identified_model
from book.companion.exhibit import table
from softgrip.control.limited_lqr import limited_loop
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.lqr import FINGER, Weights, linear_settling_time, lqr_gain
from softgrip.control.lqr_bound import settling_at_the_bound, settling_floor
from softgrip.control.minimum_time import largest_step, minimum_settling_time
from softgrip.dynamics.second_order import full_state_space
from softgrip.logs.reader import kept_log, read_log
from softgrip.logs.steps import StepFigures, step_figures, step_log_figures
from softgrip.provenance import Provenance
from softgrip.simulator.calibration import design_1
from softgrip.simulator.chance import SEED
from softgrip.simulator.closed_loop import run_on_rig
from softgrip.simulator.closed_loop_log import STEP, STEP_DURATION
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG

RUNS = 100


@table(
    "3.C",
    caption="Settling of a step to 60 deg in s, within 2 % and 5 % of the step and within 5 deg, "
    "and the error of the last 2 s in deg. The dissertation prints 0.8 s and an almost negligible "
    "error, and names neither step nor criterion. The rig is the *simulated* one; of its 100 runs "
    "the median is given, and between which values 90 % of them lie.",
    provenance=Provenance.SIMULATED,
    data=(*(f"simulated/{name}.csv" for name in LOGS), GAINS),
)
def table_3_c(logs: tuple[Path | str, ...] = ()) -> pd.DataFrame:
    """Tabulate settling times under each criterion; ``logs`` gives two of another rig."""
    bands = (0.02, 0.05, 5 * DEG / STEP)
    model = identified_model()
    full = full_state_space(model.finger, model.pump_gain)
    limits = [settling_at_the_bound(Weights(), band) for band in bands]
    rows = [
        ("printed weights", "linear", *_linear(Weights(), bands)),
        ("p to infinity", "linear", *(f"{x:.2f}" for x in limits), "0"),
        (
            "any p, proved", "linear",
            *(f"above {settling_floor(FINGER, Weights(), band):.2f}" for band in bands), "0",
        ),
        ("p = 3e4, q2 = 0.03", "linear", *_linear(FASTER, bands)),
        (
            "any controller", "5 rev/s",
            *(
                f"{minimum_settling_time(full, STEP, SPEED_LIMIT, band=band * STEP):.2f}"
                for band in bands
            ), "0",
        ),
    ]  # fmt: skip
    paths = logs or tuple(kept_log(name) for name in LOGS)
    names = (("printed weights", "printed"), ("faster design", "fast"))
    for path, (words, design) in zip(paths, names, strict=True):
        finger, weights = designed_on(design, model)
        own = limited_loop(
            finger, model.pump_gain, lqr_gain(finger, weights), STEP, duration=STEP_DURATION
        )
        rig = f"{read_log(path).header.provenance} rig"
        rows += [
            (words, "5 rev/s", *_told(step_figures(own.time, own.measured, STEP, window=0))),
            (words, rig, *_told(step_log_figures(path))),
            (words, f"simulated, {RUNS} runs", *_told(_runs(design))),
        ]
    return pd.DataFrame(rows, columns=["design", "run on", "2 %", "5 %", "5 deg", "error (deg)"])


def _linear(weights: Weights, bands: tuple[float, ...]) -> list[str]:
    return [*(f"{linear_settling_time(FINGER, weights, band):.2f}" for band in bands), "0"]


def _runs(design: str) -> StepFigures:
    rig = Simulation(design_1(), runs=RUNS, seed=SEED)
    loop = run_on_rig(rig, regulator(design), STEP, duration=STEP_DURATION)
    return step_figures(loop.result.time, loop.result.measured, STEP)


def _told(found: StepFigures) -> list[str]:
    times = (found.settled_2_percent, found.settled_5_percent, found.settled_5_deg)
    return [
        *(_spread(time, "{:.2f}") for time in times),
        _spread(found.steady_state_error / DEG, "{:+.1f}"),
    ]


def _spread(values: Any, form: str) -> str:
    # Nearest: between a time and never there is nothing to interpolate.
    low, middle, high = (
        form.format(x) if np.isfinite(x) else "never"
        for x in np.percentile(values, [5, 50, 95], method="nearest")
    )
    return middle if np.size(values) == 1 else f"{middle} ({low} to {high})"


@table(
    "3.D",
    caption="The largest step in deg that *any* controller settles in 0.8 s within 5 rev/s, by "
    "criterion: on the model that is identified from the *simulated* rig's logs, and with the "
    "printed frequency and damping ratio in it, its static gain kept.",
    provenance=Provenance.SIMULATED,
    data=("simulated/push-a.csv",),
)
def table_3_d() -> pd.DataFrame:
    """Tabulate the largest step that can settle in the printed time."""
    model = identified_model()
    columns = {"identified": model.finger, "as printed": designed_on("printed", model)[0]}
    return pd.DataFrame(
        {"within": name}
        | {
            words: f"{_largest(full_state_space(finger, model.pump_gain), band) / DEG:.1f}"
            for words, finger in columns.items()
        }
        for name, band in BANDS.items()
    )


def _largest(system: Any, band: float) -> float:
    return largest_step(system, SPEED_LIMIT, PRINTED_TIME, band=band)
