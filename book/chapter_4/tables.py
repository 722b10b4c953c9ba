"""Tables of Chapter 4."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from book.chapter_4.controllers import own_step
from book.companion.choices import choice
from book.companion.exhibit import table
from book.companion.own_logs import in_place
from softgrip.logs.reader import read_log
from softgrip.logs.steps import judge_step_log
from softgrip.provenance import Provenance, data_file
from softgrip.pump.finger import Finger
from softgrip.pump.flow import TABLE_4_1, Pump, flow
from softgrip.pump.sizing import Sizing, sizings
from softgrip.simulator.fitted_rigs import DESIGN_1, design_1
from softgrip.simulator.free_parameters import unit_of
from softgrip.simulator.laws import finger_volume
from softgrip.simulator.rig_file import Line, read_rig
from softgrip.simulator.statics import FULL_PRESSURE, settled_angle
from softgrip.units import DEG, ML, MM, REV

LEAST_MARGIN = 1.5


def finger_to_drive() -> Finger:
    """Return the finger of the simulated rig, at the end of Figure 3.10, and a rise time to ask."""
    rig = design_1()
    angle = settled_angle(rig.finger, FULL_PRESSURE)
    return Finger(
        gauge_pressure=FULL_PRESSURE,
        volume_at_rest=rig.finger.rest_volume,
        volume_at_pressure=finger_volume(angle, FULL_PRESSURE, rig.finger),
        dead_volume=rig.gas.dead_volume,
        rise_time=4.0,
    )


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
                "A (cm²)": f"{1e4 * area:.2f}",
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
            "syringe (mL)": f"{s.syringe.volume / ML:.0f}",
            "lead (mm)": f"{s.screw.lead / MM:g}",
            "motor (mm)": s.motor.name.removeprefix("NEMA 17, ").removesuffix(" mm"),
            "stroke (mm)": f"{s.stroke / MM:.0f}",
            "rev/s": f"{s.motor_speed / REV:.1f}",
            "thrust (N)": f"{s.thrust:.0f}",
            "torque over need": f"{s.margin:.2f}",
            "can do it": "yes" if s.feasible else f"no: {_lacking(s)}",
        }
        for s in sizings(finger_to_drive(), least_margin=LEAST_MARGIN)
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
    """Tabulate the parameters of the simulated rig, with what the prints leave to them."""
    return pd.DataFrame(
        {
            "parameter": line.name,
            "unit": unit_of(line.name),
            "value": f"{line.value:.4g}",
            "90 % interval": _interval(line),
            "by the prints": line.status,
        }
        for line in read_rig(data_file(DESIGN_1).path).lines
    )


def _interval(line: Line) -> str:
    return "" if line.low is None else f"{line.low:.3g} to {line.high:.3g}"


@table("4.C", Provenance.SIMULATED)
def table_4_c(logs: tuple[Path | str, ...] = ()) -> pd.DataFrame:
    """Tabulate settling times of both controllers under each criterion; ``logs`` gives others."""
    paths = in_place(logs, ("pid-actuator", "pid-full"))
    rows = []
    names = {"actuator": "finger alone (4.14)", "full": "finger and pump (4.15)"}
    for (design, words), path in zip(names.items(), paths, strict=False):
        rig = f"{read_log(path).header.provenance} rig"
        judged = judge_step_log(path, band=choice("pid_band"))
        for place, response in (("own model", own_step(design)), (rig, judged)):
            rows.append(
                {
                    "designed on": words,
                    "run on": place,
                    "2 %": _seconds(response.settled_2_percent),
                    "5 %": _seconds(response.settled_5_percent),
                    "2 deg": _seconds(response.settled_2_deg),
                    "5 deg": _seconds(response.settled_5_deg),
                    "fitted band": _seconds(response.settled),
                    "error (deg)": f"{float(response.steady_state_error) / DEG:+.1f}",
                }
            )
    return pd.DataFrame(rows)


def _seconds(time: Any) -> str:
    return f"{float(time):.2f}" if np.isfinite(time) else "never"
