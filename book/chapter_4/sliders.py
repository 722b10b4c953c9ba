"""What the sliders of Chapter 4 move."""

from itertools import product
from typing import Any

import control
import numpy as np

from book.chapter_4.identified_model import IdentifiedModel, identified_model
from book.chapter_4.pid_gains import pid_gains
from book.chapter_4.pushed import pushed
from book.companion.choices import choice
from book.companion.style import LINEAR, LUDWICK, MEASURED, PRINTED, VERMILION
from book.explore.finger_picture import finger
from book.explore.plot import Band, Bars, Level, Line, Panel, Plot
from book.explore.scan import Numbers, scan
from book.explore.settled import entered
from book.explore.small_matrices import array, times
from softgrip.arrays import Floats, Number, chosen
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.pid import PERIOD, Gains, pid_step
from softgrip.dynamics.second_order import full_state_space
from softgrip.logs.gaps import period_of
from softgrip.logs.pump import pump_of
from softgrip.logs.pushes import HIGH, prior, reference_noise
from softgrip.logs.reader import kept_log, read_log
from softgrip.pump.elastance import ElastanceModel, elastance_filter
from softgrip.pump.finger import Finger
from softgrip.pump.flow import TABLE_4_1, Pump, flow
from softgrip.pump.gas import ATMOSPHERE, capacity, closed_volume_pressure
from softgrip.pump.parts import MOTORS, SCREWS, SYRINGES
from softgrip.pump.pressure import pressure
from softgrip.pump.sizing import loads
from softgrip.reads import remembered
from softgrip.units import DEG, ML, MM, REV, MPa

VOLUMES = {"60 mL": 60 * ML, "200 mL": 200 * ML}
BESIDE = 30 * ML
"""Air in finger and tube, beside that of the full syringe; assumed."""
AREAS = dict(zip(("60 mL", "200 mL"), TABLE_4_1["area"], strict=True))


def pump(syringe: str, lead: Number, speed: Number) -> dict[str, Any]:
    """Return the pressure of a full syringe by Eq. (4.5) and by the exact gas law.

    Args:
        syringe: "60 mL" or "200 mL".
        lead: mm.
        speed: Motor speed, rev/s.
    """
    air = flow(speed * REV, Pump(AREAS[syringe], lead * MM))
    full = VOLUMES[syringe]
    gas = full + BESIDE
    time = np.linspace(0, 1, 80) * np.minimum(20.0, 0.92 * full / air)
    linear = pressure(time, air, capacity(ATMOSPHERE, gas))
    exact = closed_volume_pressure(air * time, gas) - ATMOSPHERE
    return {"time": time, "gas": exact / MPa, "constant": linear / MPa, "flow": air / ML}


PUMP_PLOT = Plot(
    [
        Panel(
            [
                Level(0.15, label="0.15 MPa"),
                Line("time", "gas", f"gas law, syringe and {BESIDE / ML:.0f} mL closed",
                     colour=MEASURED),
                Line("time", "constant", "Eq. (4.5), C constant", colour=LINEAR, dash="6 3"),
            ],
            x=(0, 20), y=(0, 0.2), x_label="time (s)", y_label="pressure (MPa)",
        )
    ],
    title="{syringe}: {flow:.1f} mL/s",
)  # fmt: skip


@remembered
def _push() -> tuple[Floats, Floats, ElastanceModel, float]:
    """Return time and rows of the kept push, and the filter's model and the capacity fitted to it.

    The columns: air that came in since the row before, m^3, and whether there was one; measured
    pressure, Pa; air that comes in until the next row. The push has no gaps.
    """
    path = kept_log("push-a")
    log, found = read_log(path), pushed(path)
    model = ElastanceModel(period_of(log), reference_noise(), prior(found.capacity))
    ahead = pump_of(path, log).displacement * log["command"] * model.time_step
    behind = np.concatenate([[0.0], ahead[:-1]])
    after = np.arange(len(ahead)) > 0
    rows = np.column_stack([behind, after, found.measured, ahead])
    return found.time, rows, model, found.capacity


def capacity_filter(noise: Number) -> dict[str, Any]:
    """Return what the filter holds of a simulated push, with its capacity noise scaled.

    It is `softgrip.pump.capacity.estimate` a sample at a time, with the same filter.

    Args:
        noise: Factor on the estimated noise of the elastance.
    """
    time, rows, model, constant = _push()
    known, begin = model.noise, model.prior
    kalman = elastance_filter(model)
    kalman.inv = lambda variance: 1 / variance  # of one number, which may be a symbol

    def sample(state: Numbers, row: Numbers, given: Numbers) -> tuple[Numbers, Numbers]:
        pressure, elastance, *spread, predicted, worst = state
        (behind, after, measured, ahead), (elastance_step,) = row, given
        kalman.x, kalman.P = array([[pressure], [elastance]]), array([spread[:2], spread[2:]])
        # Before the first row nothing moves, and there is no noise.
        noises = [after * known.pressure_step**2, 0.0], [0.0, after * elastance_step**2]
        kalman.predict(u=np.zeros((1, 1)), F=array([[1.0, behind], [0.0, 1.0]]), Q=array(noises))
        kalman.update(array([[measured]]))
        pressure, elastance = kalman.x.ravel().tolist()
        spread = kalman.P.ravel().tolist()
        held = chosen(elastance > 0, 1 / elastance, np.nan)
        error = (predicted - measured) / measured
        larger = (measured > HIGH) * (np.abs(error) > np.abs(worst))
        worst = chosen(larger, error, worst)
        out = held, np.sqrt(spread[3]) * held**2, worst
        return (pressure, elastance, *spread, predicted + ahead * elastance, worst), out

    first = (begin.pressure, begin.elastance, begin.pressure_std**2, 0.0, 0.0,
             begin.elastance_std**2, rows[0, 2], 0.0)  # fmt: skip
    held, std, worst = scan(sample, first, rows, (noise * known.elastance_step,))
    unit = ML / MPa
    return {
        "time": time,
        "low": (held - 2 * std) / unit,
        "capacity": held / unit,
        "high": (held + 2 * std) / unit,
        "constant": constant / unit,
        "error": 100 * worst[-1],
    }


FILTER_PLOT = Plot(
    [
        Panel(
            [
                Band("low", "high", "time", "two standard deviations", colour=LUDWICK),
                Level("constant", label="constant", colour=LINEAR, dash="6 3", width=2.0),
                Line("time", "capacity", "filter, simulated push", colour=LUDWICK),
            ],
            x=(0, 7), y=(0, 2000), x_label="time (s)", y_label="capacity (mL/MPa)",
        )
    ],
    title=f"largest error above {HIGH / MPa:.2f} MPa: {{error:+.0f}} %",
)  # fmt: skip


PARTS = [*product(SYRINGES, SCREWS, MOTORS)]
NAMES = [
    f"{syringe.name}, {screw.name}, {motor.name.removeprefix('NEMA 17, ')}"
    for syringe, screw, motor in PARTS
]
MARGIN = 1.5


def sizing(pressure: Number, volume: Number, rise: Number) -> dict[str, Any]:
    """Return the torque that each combination of parts has over what it needs.

    Args:
        pressure: Wanted gauge pressure, MPa.
        volume: Of the finger at rest, mL; at pressure it holds a quarter more.
        rise: Rise time, s.
    """
    wanted = Finger(pressure * MPa, volume * ML, 1.25 * volume * ML, 2 * ML, rise)
    margins, fit = [], []
    for syringe, screw, motor in PARTS:
        swept, speed, _, needed, available = loads(wanted, syringe, screw, motor, syringe.volume)
        margins.append(available / needed)
        fit.append(
            1.0
            * (swept <= syringe.volume)
            * (speed <= motor.speed_limit)
            * (available >= MARGIN * needed)
        )
    return {"margin": margins, "fits": fit, "count": sum(fit), "all": float(len(PARTS))}


SIZING_PLOT = Plot(
    [
        Panel(
            [
                Bars("margin", NAMES, "fits", colour=LUDWICK, other=VERMILION,
                     label="can do it; else vermilion"),
                Level(MARGIN, "x", f"{MARGIN:g} times what it needs"),
            ],
            x=(0, 8), y=NAMES, x_label="torque over need", left=168, height=330,
        )
    ],
    title="{count:.0f} of {all:.0f} can do it",
)  # fmt: skip


DURATION = 8.0
BAND = 0.05
"""Of the step, within which it is settled."""


@remembered
def _model() -> IdentifiedModel:
    return identified_model()


def pid(kp: Number, ki: Number, kd: Number) -> dict[str, Any]:
    """Return the step of the (4.15) controller on its model, with scaled gains.

    It is `own_loop` a sample at a time.

    Args:
        kp, ki, kd: Factors on the tuned gains.
    """
    model, tuned, final = _model(), pid_gains("full"), choice("pid_step")
    held = control.sample_system(full_state_space(model.finger, model.pump_gain), PERIOD, "zoh")
    moves = np.hstack([held.A, held.B])

    def sample(state: Numbers, row: Numbers, given: Numbers) -> tuple[Numbers, Numbers]:
        *plant, last, integral, derivative, before, settled = state
        gains = Gains(given[0], given[1], given[2], tuned.derivative_filter)
        error = final - plant[1]
        speed, integral, derivative = pid_step(
            gains, (-SPEED_LIMIT, SPEED_LIMIT), error, error - last, integral, derivative
        )
        excess = np.abs(error) - BAND * final
        settled = entered(row[0], PERIOD, before, excess, settled)
        after = *times(moves, plant, [speed]), error, integral, derivative, excess, settled
        return after, (plant[1] / DEG, settled, excess)

    time = PERIOD * np.arange(round(DURATION / PERIOD) + 1)
    given = kp * tuned.kp, ki * tuned.ki, kd * tuned.kd
    angle, settled, excess = scan(sample, [0.0] * 8, time, given)
    return {
        "time": time,
        "angle": angle,
        "low": (1 - BAND) * final / DEG,
        "high": (1 + BAND) * final / DEG,
        "settled": settled[-1],
        "late": 1.0 * (excess[-1] > 0),
    }


PID_PLOT = Plot(
    [
        Panel(
            [
                Band("low", "high", label=f"within {100 * BAND:g} %", colour=PRINTED),
                Line("time", "angle", "angle", colour=LUDWICK),
            ],
            x=(0, DURATION), y=(0, 160), x_label="time (s)", y_label="angle (deg)", share=0.64,
        ),
        finger("angle", "time"),
    ],
    title=f"within {100 * BAND:g} % after {{settled:.1f}} s",
    cases=[("late", f"not within {100 * BAND:g} % in {DURATION:g} s")],
)  # fmt: skip
