"""Recomputation of the numbers printed in Chapter 4."""

from itertools import product

from softgrip.ledger.verdict import simulated
from softgrip.provenance import data_folder
from softgrip.pump.flow import TABLE_4_1, Pump, PumpRun, parameter_set
from softgrip.rig.pressure_models import compare
from softgrip.units import REV

SETTLING = {"simulated": (5.0, 2.5), "measured": (3.95, 2.38)}
"""Settling times in s that Sections 4.3 and 4.4 print: actuator's model alone, full model."""


def fastest(name: str) -> float:
    """Return a parameter of the set of Table 4.1 with the largest pressure rate, Eq. (4.5)."""
    runs = [
        PumpRun(Pump(area, lead), speed)
        for area, lead, speed in product(
            TABLE_4_1["area"], TABLE_4_1["lead"], TABLE_4_1["motor_speed"]
        )
    ]
    best = max(runs, key=lambda run: run.flow)
    found = {
        "area": best.pump.area,
        "lead": best.pump.lead,
        "motor_speed": best.motor_speed / REV,
    }
    return found[name]


def rate_ratio() -> float:
    """Divide the rate with small lead and large area by that with large lead and small area."""
    areas, leads = TABLE_4_1["area"], TABLE_4_1["lead"]
    speed = TABLE_4_1["motor_speed"][0]
    first = PumpRun(Pump(areas[1], leads[1]), speed).flow
    return first / PumpRun(Pump(areas[0], leads[0]), speed).flow


def lead_time_ratio() -> float:
    """Divide the time to a pressure with the smaller lead by that with the larger one."""
    return parameter_set("default").flow / parameter_set("smaller lead").flow


def settling_reduction(kind: str) -> float:
    """Return by how much the full model's settling time is shorter, in percent."""
    alone, full = SETTLING[kind]
    return 100 * (1 - full / alone)


@simulated
def model_error(model: str, log: str = "push-a") -> float:
    """Return the largest error of a pressure model above 0.10 MPa on a simulated push, in percent.

    ``model`` is "constant", "modified" or "filtered".
    """
    found = compare(data_folder() / "simulated" / f"{log}.csv")
    return abs(100 * found.error(getattr(found, model)))
