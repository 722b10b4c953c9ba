"""Computed numbers in the prose of Chapter 2."""

from collections.abc import Iterable
from math import ceil, floor
from typing import Any

import numpy as np
import pandas as pd

from book.chapter_2 import figures_element as elements
from book.chapter_2 import figures_pad as pad
from book.chapter_2.figures_force import CORRECTIONS, LINEAR_BELOW, SHOWN_START
from book.chapter_2.figures_grasp import ENDS, FRICTION
from book.chapter_2.figures_kind import printed_accuracies, printed_gain, printed_right
from book.chapter_2.force_logs import CYCLE_FORCES, HOLD, LONG_WEIGHTS, RAMP
from book.chapter_2.forces import (
    HOURS,
    SEEDS,
    WHOLE,
    kept_comparison,
    weight_bandwidth,
    weight_points,
)
from book.chapter_2.grasps import RUNS, friction, held_share, study, summary
from book.chapter_2.kinds import (
    DRAWS,
    NEIGHBOURS,
    SPLITS,
    kept,
    kept_neighbours,
    right_on_objects,
    split_shares,
    without_tested_objects,
)
from book.chapter_2.logs import OBJECTS, TRAINING, contacts, errors
from book.chapter_2.numbers import BAGGED, SINGLE
from book.chapter_2.tasks import WIDER_TOP, by_halving, poses, sure_lift, top_for
from book.companion.claims import printed
from book.companion.drawn import drawn
from softgrip.arrays import Floats
from softgrip.simulator.fitted_rigs import fitted_layer
from softgrip.simulator.force_layer import layer_voltage
from softgrip.simulator.force_tests import PERIOD
from softgrip.simulator.pad_gripper import GraspGripper
from softgrip.simulator.pad_objects import pad_object
from softgrip.tactile.accuracy import CONFIDENCE, overlaps
from softgrip.tactile.contact_kind import NEIGHBOURS as CHOSEN
from softgrip.tactile.contact_kind import bagged_neighbours, nearest_neighbours
from softgrip.tactile.contact_pose import FELT, angle_between, line_angle
from softgrip.tactile.element import STATED_MODULUS, TABLE_MODULUS, Shape, shortening
from softgrip.tactile.element_results import STATED_CYLINDER, fem_deformation
from softgrip.tactile.element_sensitivity import equal_cut
from softgrip.tactile.element_table import ASSUMED
from softgrip.tactile.force import Weighing, table_2_2
from softgrip.tactile.friction import (
    Interval,
    common_friction,
    contact_force,
    holding_probability,
    printed_grasps,
)
from softgrip.tactile.hertz import hertz_approach
from softgrip.tactile.kind_evaluation import FOLDS
from softgrip.tactile.nadaraya_watson import left_out_error
from softgrip.tactile.pad_layout import THREE_TWO_THREE
from softgrip.units import DEG, GRAM_FORCE, MM, MPa

CUT: tuple[Shape, Shape] = ("hemisphere", "pyramid")
ROW, OTHER_ROW = THREE_TWO_THREE.places[0], THREE_TWO_THREE.places[3]
"""Neighbouring elements of two rows."""


def _listed(values: Iterable[float], form: str = "g") -> str:
    *first, last = (f"{value:{form}}" for value in values)
    return f"{', '.join(first)} and {last}"


def _span(values: Any, form: str = ".0f") -> str:
    return f"{np.min(values):{form}} to {np.max(values):{form}}"


def _bounds(interval: Interval | None) -> str:
    assert interval, "printed numbers that no coefficient joins"
    return _span((interval.low, interval.high), ".2f")


def _times_printed(shape: Shape) -> float:
    """Return how many times as far as printed a top sinks in by finite elements."""
    found = fem_deformation(ASSUMED[shape], elements.LOAD, TABLE_MODULUS) / MM
    return found / printed(f"table-2.1-{shape}-fem-0-1-n")


def _sunk(shape: Shape) -> float:
    return float(-elements.loaded_section(shape)[1][1, -1].min() / MM)


def _reached(shape: Shape) -> float:
    """Return the load at which the drawn resistance has reached its largest value, N."""
    load, resistance = drawn("Figure 2.3", shape, "(b)")
    return float(load[resistance.argmax()])


def _left_out(shape: Shape, of: str) -> float:
    """Return what the coarsest mesh leaves out of the finest mesh's displacement, %."""
    return float(100 * (1 - drawn("Figure 2.A", of, shape)[1][0]))


def _signed(text: str) -> str:
    return text.replace("-", "minus ")


def _few(count: int) -> str:
    return f"{count}" if count else "none"


def _gain(name: str) -> "pd.Series[int]":
    """Return how many more contacts of the foods bagging tells, by seed of its draws."""
    return kept("draws")[name] - kept("draws")["single"]


def _fewer(model: Any) -> int:
    """Return how many contacts of the foods are told less if no food was felt before."""
    known, new = (right_on_objects(model, felt) for felt in (None, without_tested_objects()))
    return int(known.sum() - new.sum())


def _p_of_objects() -> float:
    """Return the least p of the two classifiers on the objects that the printed counts leave."""
    single, bagged = printed_right(-1)
    return min(test.p_value for test in overlaps(single, bagged, printed_accuracies()[-1][1]))


def _tested(classifier: str) -> float:
    return 100 * float(split_shares(classifier, "tested").mean())


def _of_objects(kind: str) -> str:
    """Return the accuracies on objects of a kind, felt before or not, %."""
    rows = kept("objects").groupby("kind").get_group(kind)
    return _span(100 * rows[["single_known", "single_new"]].div(rows["contacts"], axis=0))


def _voltages(weight: float) -> Floats:
    """Return the voltages of a weight of the calibration, gf, in their order."""
    voltage, force = weight_points()
    found: Floats = voltage[np.isclose(force, weight * GRAM_FORCE)]
    return found


def _slope() -> float:
    """Return the slope of the layer at the end of its range, counts a gram-force."""
    layer, step = fitted_layer(), np.array([-0.5, 0.5]) * GRAM_FORCE
    change = np.diff(layer_voltage(printed("2.2-range") + step, 0.0, layer))[0]
    return float(change / layer.supply * layer.largest_count)


def _opens(peak: float) -> float:
    """Return by how much the drawn loop of a force opens in its last cycle, V."""
    force, voltage = drawn("Figure 2.8", f"{peak:g} N, cycle 3", "(c)")
    top = int(force.argmax())
    loading = np.interp(force[top:][::-1], force[: top + 1], voltage[: top + 1])
    return float(np.max(voltage[top:][::-1] - loading))


def _tail(peak: float) -> float:
    """Return the voltage just after a drawn force was taken off, less that before it, V."""
    time, voltage = drawn("Figure 2.8", f"{peak:g} N, cycle 1", "(b)")
    return float(voltage[np.searchsorted(time, 2 * RAMP + HOLD + PERIOD)] - voltage[0])


def _missed() -> float:
    """Return the most by which the drawn line of least squares misses a point, gf."""
    grid, line = drawn("Figure 2.9", "ordinary least squares")
    voltage, force = drawn("Figure 2.9", "weights", "ordinary")
    return float(np.abs(np.interp(voltage, grid, line) - force).max())


def _place(kind: str) -> float:
    return float(np.nanmedian(errors(TRAINING).place[contacts(TRAINING).kinds == kind]) / MM)


def _askew() -> float:
    """Return the largest angle between a drawn line contact and its estimate, deg."""
    lines = [grasp for grasp in pad.GRASPS if grasp.item.kind == "line"]
    told = [line_angle(grasp.responses, THREE_TWO_THREE) for grasp in lines]
    return float(angle_between(told, [grasp.pose.angle for grasp in lines]).max() / DEG)


def _peak(rod: str) -> str:
    return f"{np.abs(drawn('Figure 2.D', rod)[1]).max():.0f}"


def _drift(correction: str, panel: str) -> Floats:
    return drawn("Figure 2.G", CORRECTIONS[correction][0], panel)[1]


def _beside(panel: str) -> float:
    """Return by how much the true force of the drawn grasp ends beside the measured one, %."""
    true, measured = (drawn("Figure 2.14", name, panel)[1] for name in ("true", "measured"))
    return float(100 * abs(true[-1] / measured[-1] - 1))


def _times_stated(row: str, found: float) -> str:
    """Return how many times as far as its row prints an element of the stated inputs gives way."""
    return f"{found / MM / printed(f'table-2.1-{row}-0-1-n'):.2f}"


def _apart() -> float:
    """Return the most by which the drawn finite elements of both shapes with a cut differ."""
    one, other = (drawn("Figure 2.B", f"{shape}, FEM")[1] for shape in CUT)
    return float((one / other).max())


def _by_the_prints(*status: str) -> int:
    """Return how many parameters of the simulated pad have a status."""
    return int(pad.table_2_d()["by the prints"].isin(status).sum())


def _regressor(name: str, left_out: str) -> str:
    return f"{kept_comparison().loc[name, left_out] / GRAM_FORCE:.1f}"


def _point_error_there() -> float:
    """Return the error on points, gf, at the bandwidth that is best for whole weights."""
    voltage, force = weight_points()
    return left_out_error(voltage[:, None], force, weight_bandwidth()) / GRAM_FORCE


def _slips(name: str) -> str:
    """Return the probability, %, that a printed grasp slips, as in Table 2.J."""
    grasp = printed_grasps()[name]
    holds = holding_probability(
        float(grasp.lift), float(grasp.weight), FRICTION, printed("2.2-deviation")
    )
    return f"{100 * (1 - holds):.2g}"


def _weighed() -> Iterable[Weighing]:
    return table_2_2().values()


def _common() -> Interval:
    common = common_friction()
    assert common, "printed forces that no coefficient joins"
    return common


def _top() -> float:
    """Return the top of the pyramid of Table 2.1 with the stated modulus, a part of its base."""
    return top_for(printed("table-2.1-pyramid-analytics-0-1-n") * MM, printed("2.2-load-0-1-n"))


def _step_share() -> float:
    """Return by how much the slider's positions beside `_top` differ, % of the printed row."""
    step = 0.01
    below = floor(_top() / step) * step
    return float(100 * (_top() / below - _top() / (below + step)))


def _sure(name: str) -> str:
    weight = float(printed_grasps()[name].weight)
    return f"{sure_lift(weight, SURE, FRICTION, printed('2.2-deviation')):.3f}"


def _each(values: Iterable[float]) -> str:
    """Return values, each once and in order, in words."""
    every = [_signed(f"{value:g}") for value in sorted(set(values))]
    return " and ".join(every)


CARROT = "small carrot"
SURE = 0.99
"""Probability of a firm grip."""

WITH, WITHOUT = "bagged", "bagged_without_replacement"

WORDS = {
    "confidence": lambda: f"{100 * CONFIDENCE:.0f}",
    "modulus": lambda: f"{STATED_MODULUS / MPa:g}",
    "table_modulus": lambda: f"{TABLE_MODULUS / MPa:g}",
    # The elements that Table 2.1 asks for: mm, and tops as parts of the base.
    "cylinder": lambda: f"{ASSUMED['cylinder'].width / MM:g}",
    "tops": lambda: _listed((ASSUMED[x].width * ASSUMED[x].cut / MM for x in CUT), ".2f"),
    "cuts": lambda: _listed((ASSUMED[x].cut for x in CUT), ".2g"),
    "pyramid_cut": lambda: f"{ASSUMED['pyramid'].cut:g}",
    "stated_cylinder": lambda: _times_stated(
        "cylinder-analytics", shortening(STATED_CYLINDER, elements.LOAD)
    ),
    "stated_hertz": lambda: _times_stated("hemisphere-hertzian", hertz_approach(elements.LOAD)),
    # Figure 2.3, N
    "most_load": lambda: f"{elements.MOST_LOAD:g}",
    "ceiling_pyramid": lambda: f"{_reached('pyramid'):.2f}",
    "ceiling_hemisphere": lambda: f"{_reached('hemisphere'):.2f}",
    "felt_hemisphere": lambda: f"{drawn('Figure 2.3', 'hemisphere, least')[0][0]:.3f}",
    "felt_cylinder": lambda: f"{drawn('Figure 2.3', 'cylinder, least')[0][0]:.2f}",
    # Figures 2.5 and 2.A: N, mm, and what a coarse mesh leaves out, %
    "load": lambda: f"{elements.LOAD:g}",
    "poisson_ratio": lambda: f"{elements.FINITE_ELEMENTS.poisson_ratio:g}",
    "rim": lambda: f"{np.hypot(*elements.loaded_section('cylinder')[1]).max() / MM:.2f}",
    "sunk_hemisphere": lambda: f"{_sunk('hemisphere'):.1f}",
    "sunk_pyramid": lambda: f"{_sunk('pyramid'):.1f}",
    "times_printed": lambda: _listed(map(_times_printed, CUT), ".1f"),
    "left_out_largest": lambda: f"{_left_out('hemisphere', 'largest'):.0f}",
    "left_out_mean": lambda: f"{_left_out('hemisphere', 'mean'):.0f}",
    "left_out_plate": lambda: f"{_left_out('hemisphere', 'plate'):.0f}",
    "left_out_pyramid": lambda: _span([_left_out("pyramid", x) for x in ("largest", "plate")]),
    "left_out_cylinder": lambda: f"{_left_out('cylinder', 'largest'):.0f}",
    # Figure 2.B and Table 2.B: mm, and mm/N at the sharpest and the flattest top
    "width": lambda: f"{STATED_CYLINDER.width / MM:g}",
    "height": lambda: f"{STATED_CYLINDER.height / MM:g}",
    "sharpest": lambda: _listed((drawn("Figure 2.B", f"{x}, (2.1)")[1][0] for x in CUT), ".0f"),
    "flattest": lambda: _listed((drawn("Figure 2.B", f"{x}, (2.1)")[1][-1] for x in CUT), ".1f"),
    "sharpest_solved": lambda: f"{drawn('Figure 2.B', 'hemisphere, FEM')[1][0]:.0f}",
    "cut": lambda: f"{equal_cut():.2f}",
    "apart": lambda: f"{_apart():.1f}",
    # Table 2.D
    "told": lambda: f"{_by_the_prints('told')}",
    "fitted": lambda: f"{_by_the_prints('told', 'not told')}",
    # Figures 2.7 and 2.11, Table 2.E
    "folds": lambda: f"{FOLDS}",
    "trained": lambda: f"{kept_neighbours()[CHOSEN][0].cross_validated.total}",
    "tested": lambda: f"{kept_neighbours()[CHOSEN][0].tested.total}",
    "collected": lambda: f"{len(contacts(TRAINING))}",
    "of_foods": lambda: f"{len(contacts(OBJECTS))}",
    "splits": lambda: f"{SPLITS}",
    "chosen": lambda: f"{CHOSEN}",
    "neighbours": lambda: _span(NEIGHBOURS),
    "training_first": lambda: f"{drawn('Figure 2.7', 'training')[1][0]:.0f}",
    "training_most": lambda: f"{drawn('Figure 2.7', 'training')[1].max():.0f}",
    "training_best": lambda: f"{1 + drawn('Figure 2.7', 'training')[1].argmax()}",
    "training_last": lambda: f"{drawn('Figure 2.7', 'training')[1][-1]:.0f}",
    "printed_right": lambda: _listed(printed_right(-1)),
    "right_single": lambda: f"{kept('draws')['single'][0]}",
    "right_bagged": lambda: f"{kept('draws')[WITH][0]}",
    "simulated": lambda: f"{_tested(SINGLE):.1f}",
    "bagged": lambda: f"{_tested(BAGGED):.1f}",
    # Table 2.F
    "usual_p": lambda: f"{1 - CONFIDENCE:.2f}",
    "objects_p": lambda: f"{_p_of_objects():.2f}",
    # Figure 2.E
    "draws": lambda: f"{DRAWS}",
    "gain": lambda: f"{printed_gain()}",
    "gains": lambda: _signed(_span([*_gain(WITH), *_gain(WITHOUT)])),
    "middle_with": lambda: _signed(f"{_gain(WITH).median():.0f}"),
    "middle_without": lambda: _signed(f"{_gain(WITHOUT).median():.0f}"),
    "better_with": lambda: f"{(_gain(WITH) > 0).sum()}",
    "worse_with": lambda: f"{(_gain(WITH) < 0).sum()}",
    "better_without": lambda: f"{(_gain(WITHOUT) > 0).sum()}",
    "as_printed": lambda: _few(max(sum(_gain(x) >= printed_gain()) for x in (WITH, WITHOUT))),
    "worse_without": lambda: f"{(_gain(WITHOUT) < 0).sum()}",
    # Figure 2.F and Table 2.G
    "surfaces": lambda: _of_objects("surface"),
    "points": lambda: _of_objects("point"),
    "lines": lambda: _of_objects("line"),
    "fewer_single": lambda: f"{_fewer(nearest_neighbours())}",
    "fewer_bagged": lambda: f"{_fewer(bagged_neighbours())}",
    # Figures 2.8 and 2.9: counts, V, N, gf
    "weighings": lambda: f"{len(weight_points()[0])}",
    "slope": lambda: f"{_slope():.0f}",
    "zero_after": lambda: f"{_voltages(0)[1:].mean():.2f}",
    "full": lambda: f"{_voltages(printed('2.3-weight-70')).mean():.1f}",
    "cycle_forces": lambda: _listed(CYCLE_FORCES),
    "memory": lambda: f"{100 * sum(fitted_layer().memory):.0f}",
    "opens": lambda: f"{max(map(_opens, CYCLE_FORCES)):.2f}",
    "tail": lambda: f"{max(map(_tail, CYCLE_FORCES)):.2f}",
    "plateaus": lambda: _listed(
        (drawn("Figure 2.8", f"{x:g} N, cycle 1", "(b)")[1].max() for x in CYCLE_FORCES), ".1f"
    ),
    "regressor_splits": lambda: f"{SEEDS}",
    "missed": lambda: f"{_missed():.0f}",
    # Figures 2.13, 2.C and 2.D: N, mm, deg
    "felt": lambda: f"{FELT:g}",
    "tofu_share": lambda: f"{pad.GRASPS[1].force / THREE_TWO_THREE.elements:.2f}",
    "askew": lambda: f"{_askew():.0f}",
    "ball": lambda: f"{2 * pad_object(pad.BALL).radii[0] / MM:g}",
    "rod": lambda: f"{2 * pad_object(pad.ROD).radii[1] / MM:g}",
    "force": lambda: f"{pad.FORCE:g}",
    "place_line": lambda: f"{_place('line'):.1f}",
    "place_point": lambda: f"{_place('point'):.1f}",
    "place_surface": lambda: f"{_place('surface'):.0f}",
    "beside": lambda: f"{pad.BESIDE:g}",
    "peak": lambda: _peak("through the middle"),
    "peak_beside": lambda: _peak(f"{pad.BESIDE:g} mm beside"),
    "line_contacts": lambda: f"{(contacts(TRAINING).kinds == 'line').sum()}",
    "angle": lambda: f"{np.nanmedian(errors(TRAINING).angle) / DEG:.0f}",
    "angle_most": lambda: f"{np.nanpercentile(errors(TRAINING).angle, 90) / DEG:.0f}",
    "angle_far": lambda: f"{np.nanmax(errors(TRAINING).angle) / DEG:.0f}",
    "diagonal": lambda: f"{np.degrees(np.arctan2(*np.abs(ROW - OTHER_ROW)[::-1])):.0f}",
    # Figure 2.G: gf, h
    "drift_weights": lambda: _span(LONG_WEIGHTS),
    "hours": lambda: f"{HOURS}",
    "start": lambda: f"{SHOWN_START:g}",
    "hour_as_read": lambda: f"{floor(_drift('without', '(a)').min())}",
    "hour_at_start": lambda: _span(_drift("repaired", "(a)"), ".1f"),
    "hour_between": lambda: f"{_drift('between', '(a)').mean():.1f}",
    "hours_as_read": lambda: _span(_drift("without", "(b)")),
    "hours_at_start": lambda: f"{_drift('repaired', '(b)').mean():.0f}",
    "hours_between": lambda: f"{ceil(_drift('between', '(b)').max())}",
    # Figure 2.H: gf, V
    "point_error": lambda: f"{drawn('Figure 2.H', 'best, a point at a time')[1][0]:.1f}",
    "linear_below": lambda: f"{LINEAR_BELOW:g}",
    "point_width": lambda: f"{drawn('Figure 2.H', 'best, a point at a time')[0][0]:.3f}",
    "weight_error": lambda: f"{drawn('Figure 2.H', 'best, a weight at a time')[1][0]:.1f}",
    "weight_width": lambda: f"{drawn('Figure 2.H', 'best, a weight at a time')[0][0]:.2f}",
    "point_error_there": lambda: f"{_point_error_there():.1f}",
    # Tables 2.H and 2.I: gf, %, N
    "kernel_whole": lambda: _regressor("Nadaraya-Watson", WHOLE),
    "network_whole": lambda: _regressor("neural network", WHOLE),
    "isotonic_whole": lambda: _regressor("isotonic regression", WHOLE),
    "accuracy_of_one": lambda: f"{100 * np.mean([r.accuracy_of_one for r in _weighed()]):.1f}",
    "mean_deviation": lambda: f"{np.mean([r.deviation for r in _weighed()]):.4f}",
    # Figures 2.14, 2.I and 2.J, Table 2.K
    "opening": lambda: f"{GraspGripper().opening / MM:g}",
    "ends": lambda: _span(ENDS),
    "runs": lambda: f"{RUNS}",
    "record": lambda: f"{study('egg').time[-1]:.0f}",
    "friction": lambda: f"{FRICTION:g}",
    "fitted_friction": lambda: f"{friction():.2f}",
    "bears_egg": lambda: f"{contact_force(printed('2.4-weight-egg'), friction()):.2f}",
    "settled_egg": lambda: f"{summary(study('egg')).settling_time:.1f}",
    "settled_tofu": lambda: f"{summary(study('tofu')).settling_time:.1f}",
    "settled_carrot": lambda: f"{summary(study('carrot')).settling_time:.1f}",
    "true_beside": lambda: f"{max(_beside(panel) for panel in ('(a)', '(b)', '(c)')):.0f}",
    "slip_egg": lambda: _slips("egg"),
    "slip_tofu": lambda: _slips("tofu"),
    "slip_carrot": lambda: _slips("carrot"),
    "held_egg": lambda: f"{100 * held_share('egg', friction()):.0f}",
    "held_egg_least": lambda: f"{100 * held_share('egg', _common().low):.0f}",
    "friction_egg": lambda: _bounds(printed_grasps()["egg"].friction),
    "friction_tofu": lambda: _bounds(printed_grasps()["tofu"].friction),
    "friction_carrot": lambda: _bounds(printed_grasps()["carrot"].friction),
    "friction_common": lambda: _bounds(common_friction()),
    "friction_egg_least": lambda: _bounds(printed_grasps()["egg"].least_friction),
    "kept_share": lambda: f"{100 * (1 - drawn('Figure 2.J', 'egg', '(b)')[1][0]):.0f}",
    "missing_least": lambda: f"{drawn('Figure 2.J', 'series 1', '(b)')[1][-1]:.2f}",
    "missing_egg": lambda: f"{drawn('Figure 2.J', 'egg', '(b)')[1][0]:.2f}",
    "missing_tofu": lambda: f"{drawn('Figure 2.J', 'tofu', '(b)')[1][0]:.2f}",
    "missing_carrot": lambda: f"{drawn('Figure 2.J', 'carrot', '(b)')[1][0]:.2f}",
    # The tasks: parts of the base, mm, times, %; mm, deg; N
    "top": lambda: f"{_top():.3f}",
    "top_width": lambda: f"{_top() * STATED_CYLINDER.width / MM:.2f}",
    "step_share": lambda: f"{_step_share():.0f}",
    "wider_top": lambda: f"{WIDER_TOP:g}",
    "halved_pyramid": lambda: f"{by_halving('pyramid'):.2g}",
    "halved_hemisphere": lambda: f"{by_halving('hemisphere'):.2g}",
    "egg_places": lambda: _each(pose.place for pose in poses("egg", "line")),
    "egg_elements": lambda: _each(pose.elements for pose in poses("egg", "line")),
    "carrot_angles": lambda: _each(pose.angle for pose in poses(CARROT, "surface")),
    "carrot_elements": lambda: _each(pose.elements for pose in poses(CARROT, "surface")),
    "sure": lambda: f"{100 * SURE:.0f}",
    "sure_egg": lambda: _sure("egg"),
    "sure_tofu": lambda: _sure("tofu"),
}
