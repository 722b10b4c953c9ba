"""Tables of Chapter 4."""

import pandas as pd

from softgrip.figures.exhibit import table
from softgrip.provenance import Provenance
from softgrip.pump.finger import Finger
from softgrip.pump.flow import TABLE_4_1, Pump, flow
from softgrip.pump.sizing import sizings
from softgrip.rig.calibration_table import read
from softgrip.units import ML, MM, REV, MPa

CALIBRATION = "calibration/simulated_rig.csv"
FINGER = Finger(
    gauge_pressure=0.15 * MPa,
    volume_at_rest=26.6 * ML,
    volume_at_pressure=32.7 * ML,
    dead_volume=2 * ML,
    rise_time=4.0,
)
"""The finger of the simulated rig, and a rise time to ask for."""


@table(
    "4.1",
    caption="The two values of each design parameter of the pump, with the air flow of Eq. (4.2) "
    "when the others are at their first value.",
    provenance=Provenance.PRINTED,
)
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


@table(
    "4.A",
    caption="Syringes, leads and motors for the finger of the simulated rig, to 0.15 MPa within "
    "4 s, best first. The torque is that at the end of the stroke, at the speed which the rise "
    "time asks for; motors are typical ones of the NEMA 17 frame at 24 V.",
    provenance=Provenance.PRINTED,
)
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
            "can do it": "yes" if s.feasible else "; ".join(s.reasons),
        }
        for s in sizings(FINGER)
    )


@table(
    "4.B",
    caption="What the simulated rig is tuned to, what was only checked, and what is assumed. What "
    "it was calibrated to is never claimed as found.",
    provenance=Provenance.SIMULATED,
    data=(CALIBRATION,),
)
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
        for entry in read()
    )
