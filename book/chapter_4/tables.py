"""Tables of Chapter 4."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from book.chapter_4.controllers import own_step
from book.companion.exhibit import table
from softgrip.logs.reader import kept_log, read_log
from softgrip.logs.steps import judge_step_log
from softgrip.provenance import Provenance
from softgrip.pump.finger import Finger
from softgrip.pump.flow import TABLE_4_1, Pump, flow
from softgrip.pump.sizing import Sizing, sizings
from softgrip.simulator.calibration_table import KEPT
from softgrip.units import DEG, ML, MM, REV, MPa

FINGER = Finger(
    gauge_pressure=0.15 * MPa,
    volume_at_rest=26.6 * ML,
    volume_at_pressure=32.7 * ML,
    dead_volume=2 * ML,
    rise_time=4.0,
)
"""The finger of the simulated rig, and a rise time to ask for."""
LEAST_MARGIN = 1.5


@table("4.1", Provenance.PRINTED)
def table_4_1() -> pd.DataFrame:
    """Tabulate the variants of the pump's parameters, with the flow that each gives."""
    rows = []
    first = {name: values[0] for name, values in TABLE_4_1.items()}
    for index in (0, 1):
        flows = {}
        for name, values in TABLE_4_1.items():
            chosen = first | {name: values[index]}
            run = flow(chosen["motor_speed"], Pump(chosen["area"], chosen["lead"]))
            flows[name] = f"{run / ML:.2f}"
        area, lead, speed = (values[index] for values in TABLE_4_1.values())
        rows.append(
            {
                "parameter": index + 1,
                "A (m²)": f"{area:.3e}",
                "mL/s with A": flows["area"],
                "lead (mm)": f"{lead / MM:g}",
                "mL/s with lead": flows["lead"],
                "speed (rev/s)": f"{speed / REV:.2f}",
                "mL/s with speed": flows["motor_speed"],
            }
        )
    return pd.DataFrame(rows)


@table("4.A", Provenance.SIMULATED)
def table_4_a() -> pd.DataFrame:
    """Tabulate every combination of parts, judged."""
    return pd.DataFrame(
        {
            "syringe": s.syringe.name,
            "lead": s.screw.name,
            "motor": s.motor.name.removeprefix("NEMA 17, "),
            "stroke (mm)": f"{s.stroke / MM:.0f}",
            "rev/s": f"{s.motor_speed / REV:.1f}",
            "thrust (N)": f"{s.thrust:.0f}",
            "torque over need": f"{s.margin:.2f}",
            "can do it": "yes" if s.feasible else f"no: {_lacking(s)}",
        }
        for s in sizings(FINGER, least_margin=LEAST_MARGIN)
    )


def _lacking(judged: Sizing) -> str:
    """Name what a combination lacks; `Sizing.reasons` say by how much."""
    lacks = {
        "air": judged.stroke > judged.syringe.stroke,
        "speed": judged.motor_speed > judged.motor.speed_limit,
        "torque": judged.margin < LEAST_MARGIN,
    }
    return ", ".join(word for word, lacking in lacks.items() if lacking)


@table("4.B", Provenance.SIMULATED)
def table_4_b() -> pd.DataFrame:
    """Tabulate the calibration of the simulated rig."""
    return pd.DataFrame(
        {
            "use": entry.use,
            "place": entry.place,
            "quantity": entry.quantity,
            "printed": entry.printed,
            "rig": f"{entry.rig:.4g}",
            "unit": entry.unit,
            "sets": entry.parameter,
        }
        for entry in KEPT.read()
    )


@table("4.C", Provenance.SIMULATED)
def table_4_c(logs: tuple[Path | str, ...] = ()) -> pd.DataFrame:
    """Tabulate settling times of both controllers under each criterion; ``logs`` gives two."""
    paths = logs or (kept_log("pid-actuator"), kept_log("pid-full"))
    rows = []
    names = {"actuator": "finger alone (4.14)", "full": "finger and pump (4.15)"}
    for (design, words), path in zip(names.items(), paths, strict=True):
        rig = f"{read_log(path).header.provenance} rig"
        for place, response in (("own model", own_step(design)), (rig, judge_step_log(path))):
            rows.append(
                {
                    "designed on": words,
                    "run on": place,
                    "2 %": _seconds(response.settled_2_percent),
                    "5 %": _seconds(response.settled_5_percent),
                    "2 deg": _seconds(response.settled_2_deg),
                    "5 deg": _seconds(response.settled_5_deg),
                    "error (deg)": f"{float(response.steady_state_error) / DEG:+.1f}",
                }
            )
    return pd.DataFrame(rows)


def _seconds(time: Any) -> str:
    return f"{float(time):.2f}" if np.isfinite(time) else "never"
