"""Computed numbers in the prose of Chapter 3."""

from math import sqrt

from book.chapter_3.diagrams import CHAMBER_ENLARGED
from book.chapter_3.figures import (
    BENT_TO,
    FX_PRO,
    PUSHED_TO,
    SIDE_VIEWS,
    STATED,
    bent,
    bent_on_rig,
    judges,
    optimum,
    over_grooves,
    parts_of_finest,
)
from book.chapter_3.figures_control import (
    BANDS,
    FASTER,
    RUNS,
    SHARE,
    STEPS,
    criteria,
    least_time,
    settled_step,
    step_size,
)
from book.chapter_3.numbers import lqr_settling_on_rig
from book.chapter_3.numbers import optimum as best
from book.chapter_3.stepped import frequency_step, identified_row, small_motions
from book.chapter_3.tasks import (
    BOTTOM,
    FIRST_STEP,
    LARGEST_RATE,
    LEAST_BOTTOM,
    TOP,
    frequency_of,
    least_time_on_the_explorer,
    settling_time,
    torque_of,
    weight_by_the_pole,
    weight_on_the_explorer,
)
from book.chapter_3.torque_and_bending import DESIGNS, blocked_torque
from book.companion.choices import choice
from book.companion.claims import printed
from book.companion.verdict import recomputed
from softgrip.actuator.bending import Finger, free_bending
from softgrip.actuator.certificate import TOLERANCE
from softgrip.actuator.design import (
    SCRIPT_BOUNDS,
    SCRIPT_MASS,
    SCRIPT_POWER,
    DesignProblem,
    objective,
)
from softgrip.actuator.elasticity import Elastic
from softgrip.actuator.fem_results import BEAM, CHAMBERS, read
from softgrip.actuator.frequency import natural_frequency
from softgrip.actuator.optimize import optimal_design
from softgrip.actuator.printed import (
    ANGLE_POWER,
    FREQUENCY_POWER,
    SUM_POWER,
    WEIGHT_POWER,
    table_3_1,
    table_3_2,
)
from softgrip.actuator.section import torque
from softgrip.control.lqr import FINGER, Weights, linear_settling_time
from softgrip.control.lqr_bound import settling_at_the_bound
from softgrip.control.pid import PERIOD
from softgrip.dynamics.identify import CONFIDENCE
from softgrip.logs.steps import END
from softgrip.materials.table import material
from softgrip.units import DEG, MM, MPa


def _top(row: int) -> float:
    """Return a of the best section for the band of a row of Table 3.2, mm."""
    band = table_3_2()[row - 1]
    return best("top", (band.low, band.high))


def _pushed() -> list[float]:
    """Return the torques of Table 3.1, N m, where their lines end."""
    return [float(torque(section, PUSHED_TO)) for section in table_3_1().values()]


def _pushed_on_rig(design: str) -> float:
    return float(blocked_torque(DESIGNS[design]().finger, PUSHED_TO))


def _bent() -> list[float]:
    """Return the angles of Table 3.1, deg, where their curves end."""
    return [float(bent(section)) for section in table_3_1().values()]


def _judged(floor: int) -> float:
    """Return the torque of a finger by finite elements, N m: 0 is that with one chamber."""
    return judges()[floor][1].torque * PUSHED_TO


def _finger(power: float) -> Finger:
    return Finger(optimum(), fractional_power=power)


def _angle(power: float) -> float:
    return float(free_bending(_finger(power), BENT_TO)) / DEG


def _sum(power: float) -> float:
    return float(objective(DesignProblem(fractional_power=power), optimum()))


def _traded() -> dict[str, float]:
    """Return the section of Design 1's height whose b is at the printed limit, mm."""
    bottom = printed("3.3-range-top-largest")
    return {"top": TOP + BOTTOM - bottom, "bottom": bottom}


def _off(chambers: int) -> float:
    """Return by how many percent a coarser mesh is off the finest, at most."""
    parts = [x for name in ("torque", "angle") for x in parts_of_finest(chambers, name)[1]]
    return 100 * max(abs(part - 1) for part in parts)


def _scale_factors() -> list[float]:
    """Return torque by the scale over torque, for each depth of the grooves."""
    return [found.scale_torque / found.torque for found in read("groove_floor")]


def _least_times(step: int) -> list[float]:
    return sorted(least_time(step, band) for band in BANDS.values())


WORDS = {
    "chamber_enlarged": lambda: f"{CHAMBER_ENLARGED:g}",
    # What n and M are, by reading.
    "n_script": lambda: f"{SCRIPT_POWER}",
    "m_script": lambda: f"{SCRIPT_MASS}",
    "n_kilograms": lambda: f"{FREQUENCY_POWER}",
    "n_newtons": lambda: f"{WEIGHT_POWER}",
    "n_angle": lambda: f"{ANGLE_POWER}",
    "n_sum": lambda: f"{SUM_POWER}",
    # What the page says of them.
    "newtons_bend": lambda: f"{_angle(WEIGHT_POWER):.0f}",
    "script_bends": lambda: f"{_angle(SCRIPT_POWER):.0f}",
    "script_swings": lambda: f"{natural_frequency(_finger(SCRIPT_POWER), SCRIPT_MASS):.2f}",
    "script_sum": lambda: f"{_sum(SCRIPT_POWER):.2f}",
    "rubber_sum": lambda: f"{_sum(material('Dragon Skin 20').fractional_power):.2f}",
    "added": lambda: f"{recomputed(3, '3.4-half-newton-metre').value:.2f}",
    "tube": lambda: f"{100 * (1 - 2 * Elastic().poisson_ratio):.0f}",
    # Table 3.2.
    "top_2": lambda: f"{_top(2):.2f}",
    "top_3": lambda: f"{_top(3):.2f}",
    "top_3_below": lambda: f"{best('top', [table_3_2()[2].low] * 2):.2f}",
    "top_4": lambda: f"{_top(4):.2f}",
    "confidence": lambda: f"{100 * CONFIDENCE:g}",
    "frequency_step": lambda: f"{frequency_step() / DEG:.0f}",
    "stepped": lambda: f"{identified_row(1).natural_frequency.value:.2f}",
    "small_motions": lambda: f"{small_motions():.1f}",
    # Figures 3.5 and 3.9.
    "pushed_least": lambda: f"{min(_pushed()):.2f}",
    "pushed": lambda: f"{max(_pushed()):.2f}",
    "one_chamber_pushes": lambda: f"{_judged(0):.2f}",
    "deep_pushes": lambda: f"{_judged(1):.2f}",
    "middle_pushes": lambda: f"{_judged(2):.2f}",
    "shallow_pushes": lambda: f"{_judged(3):.2f}",
    "rig_pushes": lambda: f"{_pushed_on_rig('Design 1(E1)'):.2f}",
    "soft_pushes": lambda: f"{_pushed_on_rig('Design 3(E2)'):.2f}",
    # Figures 3.6, 3.10 and 3.11.
    "bent_least": lambda: f"{min(_bent()):.0f}",
    "bent": lambda: f"{max(_bent()):.0f}",
    "bent_softer": lambda: f"{bent(optimum(), modulus=FX_PRO):.0f}",
    "one_chamber_bends": lambda: f"{judges()[0][1].angle * BENT_TO / DEG:.0f}",
    "rig_bends": lambda: f"{bent_on_rig('Design 1(E1)')[0]:.0f}",
    "bent_on_rig": lambda: "{:.0f}, {:.0f} and {:.0f}".format(
        *(bent_on_rig(design)[0] for design in DESIGNS)
    ),
    "side_view": lambda: f"{BENT_TO / MPa / (SIDE_VIEWS - 1):.2f}",
    # Table 3.A and Figure 3.B.
    "script_bottom": lambda: f"{SCRIPT_BOUNDS.bottom[1] / MM:g}",
    "script_height": lambda: f"{SCRIPT_BOUNDS.height[1] / MM:g}",
    "proved": lambda: f"{100 * TOLERANCE:g}",
    "stated_top": lambda: "{:g} to {:g}".format(*(x / MM for x in STATED.bounds.top)),
    "stated_bottom": lambda: "{:g} to {:g}".format(*(x / MM for x in STATED.bounds.bottom)),
    "stated_height": lambda: f"{STATED.bounds.height[1] / MM:g}",
    "stated_width": lambda: f"{STATED.bounds.width[1] / MM:g}",
    "stated_wall": lambda: f"{STATED.bounds.wall[0] / MM:g}",
    "best_top": lambda: f"{optimal_design(STATED).section.top / MM:.0f}",
    "best_bottom": lambda: f"{optimal_design(STATED).section.bottom / MM:.0f}",
    # The regulator: Figures 3.12 and 3.C, Table 3.C.
    "step": lambda: f"{step_size() / DEG:.0f}",
    "criteria": lambda: " and ".join(f"{100 * share:g} %" for share in criteria()[:2]),
    "criterion": lambda: f"{choice('lqr_band') / DEG:.1f}",
    "two_percent": lambda: f"{100 * criteria()[0]:g}",
    "five_percent": lambda: f"{100 * criteria()[1]:g}",
    "end": lambda: f"{END:g}",
    "runs": lambda: f"{RUNS}",
    "share": lambda: f"{SHARE[1] - SHARE[0]}",
    "printed_on_rig": lambda: f"{lqr_settling_on_rig('printed'):.1f}",
    "fast_on_rig": lambda: f"{lqr_settling_on_rig('fast'):.1f}",
    "settles": lambda: f"{linear_settling_time(FINGER, Weights(), criteria()[0]):.1f}",
    "faster_p": lambda: f"{FASTER.p:g}",
    "faster_rate": lambda: f"{FASTER.q[1]:g}",
    "printed_rate": lambda: f"{Weights().q[1]:g}",
    "faster_settles": lambda: f"{linear_settling_time(FINGER, FASTER, criteria()[0]):.2f}",
    "any_settles": lambda: f"{least_time(step_size() / DEG, criteria()[1]):.1f}",
    "pole_bound": lambda: f"{sqrt(Weights().q[0] / Weights().q[1]):.2f}",
    "level": lambda: "{:.1f}, {:.1f} and {:.1f}".format(
        *(settling_at_the_bound(Weights(), band) for band in BANDS.values())
    ),
    # Figure 3.D.
    "bands": lambda: "{:g}, {:g} and {:g}".format(*(100 * band for band in BANDS.values())),
    "period": lambda: f"{1e3 * PERIOD:g}",
    "first_step": lambda: f"{STEPS[0]}",
    "last_step": lambda: f"{STEPS[-1]}",
    "first_time": lambda: f"{_least_times(STEPS[0])[1]:.1f}",
    "last_time_least": lambda: f"{_least_times(STEPS[-1])[0]:.1f}",
    "last_time": lambda: f"{_least_times(STEPS[-1])[2]:.1f}",
    "narrow_step": lambda: f"{settled_step(min(BANDS.values())):.0f}",
    "wide_step": lambda: f"{settled_step(max(BANDS.values())):.0f}",
    # Figure 3.E.
    "six_off": lambda: f"{_off(CHAMBERS):.0f}",
    "one_off": lambda: f"{_off(BEAM):.0f}",
    "deep_torque": lambda: f"{over_grooves()[1][0]:.2f}",
    "most_torque": lambda: f"{max(over_grooves()[1]):.2f}",
    "shallow_torque": lambda: f"{over_grooves()[1][-1]:.2f}",
    "most_angle": lambda: f"{max(over_grooves()[2]):.0f}",
    "shallow_angle": lambda: f"{over_grooves()[2][-1]:.0f}",
    # Questions before explorers: N m, s.
    "more_bottom": lambda: f"{torque_of(bottom=BOTTOM + 1) - torque_of():.3f}",
    "more_top": lambda: f"{torque_of(top=TOP + 1) - torque_of():.3f}",
    "largest_p_settles": lambda: f"{settling_time(LARGEST_RATE, FIRST_STEP):.1f}",
    # Tasks: mm, N m, rad/s; weights, deg, s.
    "no_torque": lambda: f"{LEAST_BOTTOM:g}",
    "torque_there": lambda: f"{torque_of(bottom=LEAST_BOTTOM, wall=LEAST_BOTTOM):g}",
    "traded_top": lambda: f"{_traded()['top']:g}",
    "traded_torque": lambda: f"{torque_of(**_traded()):.3f}",
    "start_torque": lambda: f"{torque_of():.3f}",
    "traded_frequency": lambda: f"{frequency_of(**_traded()):.2f}",
    "pole_rate": lambda: f"{weight_by_the_pole():.3f}",
    "slider_rate": lambda: f"{weight_on_the_explorer():.3f}",
    "task_step": lambda: f"{FIRST_STEP:g}",
    "task_time": lambda: f"{least_time_on_the_explorer():.2f}",
    "scale_factor": lambda: f"{min(_scale_factors()):.1f} to {max(_scale_factors()):.1f}",
}
