"""What a reader hands over by hand: a number that is none is refused by name, wherever it goes in.

Each public function that takes measured numbers stands in `CALLS` with a call that works. Each of
its arguments is damaged in turn, and what comes must be an error of ours; where a damaged one has a
meaning, it is listed as taken.
"""

from contextlib import nullcontext
from functools import partial

import numpy as np
import pytest

from softgrip.board.calibration import SensorLine, fit_sensor
from softgrip.control import step_metrics
from softgrip.control.differentiator import PolynomialDifferentiator, RobustDifferentiator
from softgrip.control.pid import PID, Gains
from softgrip.control.state_feedback import ObserverFeedback, StateFeedback
from softgrip.control.step_fit import best_step_fit, fit_step
from softgrip.control.ziegler_nichols import (
    ReactionCurve,
    integrating_reaction_curve,
    reaction_curve,
    ziegler_nichols,
)
from softgrip.dynamics.identify import identify
from softgrip.dynamics.ludwick import LudwickFinger, pressure_response
from softgrip.dynamics.ludwick_fit import fit_finger
from softgrip.dynamics.second_order import SecondOrder, response
from softgrip.errors import SoftgripError
from softgrip.logs.gaps import find_gaps, intervals
from softgrip.logs.staircase import lag, mean_edge
from softgrip.logs.steps import judge_step, smoothed
from softgrip.materials import hooke, ludwick, yeoh
from softgrip.materials.bootstrap import block_bootstrap
from softgrip.materials.elasticity import elasticity
from softgrip.materials.first_loading import first_loading
from softgrip.materials.fitting import Fitting
from softgrip.materials.fitting import fit as fit_test
from softgrip.materials.least_squares import normal_equations, prediction_interval
from softgrip.materials.powerlaw import predict_power
from softgrip.materials.tensile import TensileTest
from softgrip.pump.capacity import estimate
from softgrip.pump.elastance import ElastanceModel, NoiseLevels, Prior, transitions
from softgrip.pump.noise import estimate_noise
from softgrip.pump.printed_filter import open_loop_capacity, printed_filter, run_printed
from softgrip.quantities import convert
from softgrip.tactile.creep import Creep, fitted_creep
from softgrip.tactile.drift import LinearDrift
from softgrip.tactile.drift_curve import Curve, KnownWeight
from softgrip.tactile.drift_filter import DriftFilter
from softgrip.tactile.drift_law import Bridge
from softgrip.tactile.drift_model import DriftSize
from softgrip.tactile.drift_track import track_drift
from softgrip.tactile.force import Weighing
from softgrip.tactile.kind_evaluation import cross_validated, train_and_test
from softgrip.tactile.own_pad import PadReadings
from softgrip.tactile.pad_model import ForceSettings, KindSettings, PadModel
from softgrip.tactile.rest_moments import RestFinder, noise_of

T = np.arange(0, 5, 0.05)
STEP = 1 - np.exp(-np.maximum(T - 0.5, 0)) * (1 + np.maximum(T - 0.5, 0))
LONG = 4 * T
RISE = 1 - np.exp(-LONG) * (1 + LONG)
PUSHED = 1e4 * np.minimum(1, 2 * T)
MOVED = response(SecondOrder(2.86, 0.7, 2.4e-5), T, PUSHED, initial_pressure=0.0)
BENT = pressure_response(LudwickFinger(0.1, 0.3, 0.2, 2.5), T, PUSHED, force_per_pressure=2e-5)
NOISY = 1e-4 * np.sin(40 * T)
E = np.linspace(0, 3, 40)
S = 1e5 * E**1.6
TEST = TensileTest("rubber", E, S, np.log1p(E), S * (1 + E))
HELD = np.repeat([0.0, 1.0, 0.0, 1.0], 25)
NOISE = NoiseLevels(pressure_step=40.0, elastance_step=1e5, sensor=150.0)
MODEL = ElastanceModel(0.05, NOISE, Prior(0.0, 200.0, 1e9, 3e8))
FINGER = SecondOrder(2.86, 0.7)
VOLTS = np.random.default_rng(0).uniform(0, 4, (40, 3))
KINDS = np.repeat(["point", "line"], 20)
CREEP = Creep((0.1,), (2.0,))
WEIGHED = PadReadings(("layer",), [[0.1], [1.0], [2.0]], [0.0, 0.2, 0.6])
CURVE = Curve.of(WEIGHED)


def measured(record):
    """Return a filter's measurement, as one call."""
    return lambda measurement: record().update(measurement)


def tracked(controller):
    return lambda reference, measurement: controller().update(reference, measurement)


def small_pad(voltages):
    model = PadModel(ForceSettings(1.0)).fit(PadReadings(("a",), [[0.1], [0.5]], [0.0, 1.0]))
    return model.predict(voltages)


FILTER = {"capacity": 1e-9, "capacity_std": 1e-10, "capacity_step": 1e-12,
          "angle_std": 0.1, "angle_step": 0.01, "sensor": 0.02}  # fmt: skip
CALLS = {
    "fit_sensor": (fit_sensor, {"counts": [100, 200, 400, 500], "known": [1.0, 2.0, 4.0, 5.0],
                                "curve": "line", "top": 1023}),
    "SensorLine.value": (SensorLine(1.0, 0.0, 0.0, 0.0, 1.0).value, {"counts": [1.0, 2.0]}),
    "estimate": (partial(estimate, model=MODEL), {
        "pressure": PUSHED, "flow": 1e-6 + 0 * T, "angle": 0.1 * T, "time": T}),
    "estimate_noise": (partial(estimate_noise, model=MODEL), {
        "pressure": PUSHED + 150 * np.random.default_rng(0).normal(size=T.size),
        "flow": 1e-6 + 0 * T, "angle": 0.1 * T, "time": T}),
    "transitions": (transitions, {"flow": [1e-6, 2e-6], "time_step": 0.05}),
    "NoiseLevels": (NoiseLevels, {"pressure_step": 1.0, "elastance_step": 1.0, "sensor": 1.0}),
    "Prior": (Prior, {"pressure": 0.0, "pressure_std": 1.0, "elastance": 1.0,
                      "elastance_std": 1.0}),
    "ElastanceModel": (partial(ElastanceModel, noise=NOISE, prior=MODEL.prior),
                       {"time_step": 0.1, "angle_gain": 0.0}),
    "printed_filter": (printed_filter, {"gain": 1e-9, **FILTER}),
    "run_printed": (lambda angle: run_printed(printed_filter(1e-9, **FILTER), angle),
                    {"angle": [0.1, 0.2, 0.3]}),
    "open_loop_capacity": (open_loop_capacity, {"angle": [1.0, 2.0], "gain": 1.0,
                                                "capacity": 1e-9}),
    "fit_step": (fit_step, {"time": T, "output": STEP, "name": "second order"}),
    "best_step_fit": (best_step_fit, {"time": T, "output": STEP}),
    "reaction_curve": (reaction_curve, {"time": LONG, "output": RISE, "step": 1.0,
                                        "step_time": 0.0}),
    "reaction_curve, window": (reaction_curve, {"time": LONG, "output": RISE, "window": 3}),
    "integrating_reaction_curve": (integrating_reaction_curve, {
        "time": T, "output": np.maximum(T - 0.4, 0), "step": 2.0, "step_time": 0.0, "tail": 0.25}),
    "ziegler_nichols": (lambda delay, slope, kind, filter_ratio: ziegler_nichols(
        ReactionCurve(delay, slope), kind, filter_ratio=filter_ratio),
        {"delay": 0.5, "slope": 2.0, "kind": "PID", "filter_ratio": 10.0}),
    "RobustDifferentiator": (RobustDifferentiator, {"jerk": 5.0, "period": 0.025}),
    "RobustDifferentiator.update": (measured(lambda: RobustDifferentiator(5.0)),
                                    {"measurement": 0.5}),
    "PolynomialDifferentiator": (PolynomialDifferentiator, {"window": 5, "order": 2,
                                                            "period": 0.025}),
    "PolynomialDifferentiator.update": (measured(lambda: PolynomialDifferentiator(5)),
                                        {"measurement": 0.5}),
    "Gains": (Gains, {"kp": 1.0, "ki": 1.0, "kd": 1.0, "derivative_filter": 0.1}),
    "PID": (partial(PID, Gains(1.0)), {"period": 0.025, "derivative_on": "error",
                                       "limits": (-1.0, 1.0)}),
    "PID.update": (tracked(lambda: PID(Gains(1.0, 1.0, 1.0))),
                   {"reference": 1.0, "measurement": 0.5}),
    "StateFeedback": (lambda gain, input_gain, set_speed: StateFeedback(
        gain, input_gain, RobustDifferentiator(5.0), set_speed=set_speed),
        {"gain": [2.0, 0.0, 0.0], "input_gain": 4.0, "set_speed": 10.0}),
    "StateFeedback.update": (
        tracked(lambda: StateFeedback([2.0, 0.0, 0.0], 4.0, RobustDifferentiator(5.0))),
        {"reference": 1.0, "measurement": 0.5}),
    "ObserverFeedback": (partial(ObserverFeedback, finger=FINGER), {
        "gain": [2.0, 0.0, 0.0], "input_gain": 4.0, "noise": 0.01, "disturbance": 1.0,
        "limit": 30.0, "set_speed": 30.0, "period": 0.025}),
    "ObserverFeedback.update": (tracked(lambda: ObserverFeedback([2.0, 0.0, 0.0], FINGER, 4.0)),
                                {"reference": 1.0, "measurement": 0.5}),
    "settling_time": (step_metrics.settling_time, {"time": T, "output": STEP, "final": 1.0,
                                                   "initial": 0.0, "band": 0.05}),
    "overshoot": (step_metrics.overshoot, {"output": STEP, "target": 1.0, "initial": 0.0}),
    "rise_time": (step_metrics.rise_time, {"time": T, "output": STEP, "target": 1.0,
                                           "initial": 0.0, "start": 0.1, "end": 0.9}),
    "final_value": (step_metrics.final_value, {"time": T, "output": STEP, "window": 0.5}),
    "identify": (identify, {"time": T, "input": PUSHED, "output": MOVED + NOISY,
                            "initial_input": 0.0, "hold": "linear", "dead_time": 0.0}),
    "fit_finger": (fit_finger, {
        "time": T, "pressure": PUSHED, "angle": BENT + NOISY, "force_per_pressure": 2e-5,
        "fractional_power": 2.5, "stiffness": 0.2}),
    "PadReadings": (partial(PadReadings, ("a", "b", "c")), {
        "voltages": VOLTS, "labels": np.arange(40.0)}),
    "PadModel.predict": (small_pad, {"voltages": [[0.2], [0.3]]}),
    "KindSettings": (KindSettings, {"estimators": 25, "neighbours": 3, "samples": 0.85,
                                    "seed": 0}),
    "ForceSettings": (ForceSettings, {"bandwidth": 1.0}),
    "cross_validated": (lambda responses, seed: cross_validated(
        KindSettings(0).build(PadReadings(("a", "b", "c"), VOLTS, KINDS)), responses, KINDS,
        seed=seed), {"responses": VOLTS, "seed": 0}),
    "train_and_test": (partial(train_and_test, KINDS), {"seed": 0, "test": 0.2}),
    "LinearDrift": (LinearDrift.from_weights, {"calibrated": [0.1, 0.2, 0.3],
                                               "now": [0.1, 0.2, 0.4]}),
    "Creep": (Creep, {"parts": [0.1, 0.2], "lags": [1.0, 20.0]}),
    "Creep.felt": (CREEP.felt, {"time": T, "force": STEP}),
    "Creep.undone": (CREEP.undone, {"time": T, "felt": STEP}),
    "fitted_creep": (fitted_creep, {"time": T, "force": HELD, "voltage": CREEP.felt(T, HELD)}),
    "Bridge": (Bridge, {"scale": 25.0, "balance": 0.05}),
    "DriftSize": (DriftSize, {"gain_rate": 0.01, "offset_rate": 0.01, "gain_wander": 0.01,
                              "offset_wander": 0.01, "return_time": 2.0}),
    "noise_of": (noise_of, {"voltage": STEP}),
    "RestFinder": (RestFinder, {"noise": 0.01, "rate": 0.1, "wander": 0.1, "length": 10.0}),
    "RestFinder.push": (lambda time, voltage: RestFinder(0.01).push(time, voltage),
                        {"time": 1.0, "voltage": 0.1}),
    "KnownWeight": (KnownWeight, {"time": 1.0, "force": 0.2, "voltage": 1.0}),
    "DriftFilter.rest": (lambda time, voltage: DriftFilter(CURVE).rest(time, voltage),
                         {"time": 1.0, "voltage": 0.1}),
    "DriftFilter.weigh": (lambda time, voltage, force: DriftFilter(CURVE).weigh(
        time, voltage, force), {"time": 1.0, "voltage": 1.0, "force": 0.2}),
    "DriftFilter.step": (lambda time, voltage: DriftFilter(CURVE).step(time, voltage),
                         {"time": 1.0, "voltage": 0.1}),
    "track_drift": (partial(track_drift, calibration=WEIGHED), {
        "time": T, "voltage": STEP, "calibrated_at": 0.0, "noise": 0.01}),
    "Weighing": (Weighing, {"measured": 13.8, "deviation": 0.4, "true": 14.0, "times": 10}),
    "fitting.fit": (lambda young_modulus: fit_test(
        TEST, Fitting("engineering"), young_modulus=young_modulus), {"young_modulus": 1e5}),
    "TensileTest": (partial(TensileTest, "rubber"), {
        "strain": E, "stress": S, "true_strain": np.log1p(E), "true_stress": S}),
    "elasticity": (partial(elasticity, TEST), {
        "young_modulus": 1e5, "preload_error": 1.0, "confidence": 0.95, "resamples": 20,
        "seed": 0}),
    "ludwick.stress": (ludwick.stress, {"strain": E, "young_modulus": 1e5,
                                        "fractional_power": 1.6}),
    "ludwick.fit": (ludwick.fit, {"strain": E, "stress": S, "young_modulus": 1e5,
                                  "loss": "stress"}),
    "yeoh.fit": (yeoh.fit, {"strain": E, "engineering_stress": S}),
    "yeoh.stress": (yeoh.stress, {"stretch": 1 + E, "coefficients": [1e5, 1e3, 1.0]}),
    "hooke.stress": (hooke.stress, {"strain": E, "young_modulus": 1e5}),
    "first_loading": (first_loading, {"strain": E, "stress": S, "zero": "file"}),
    "block_bootstrap": (lambda **given: block_bootstrap(
        estimate=lambda e, s: (float(s.max()),), **given), {
        "strain": E, "stress": S, "confidence": 0.9, "resamples": 20, "seed": 0, "offset": 1.0}),
    "normal_equations": (normal_equations, {"A": [[1.0, 0.0], [0.0, 2.0], [0.0, 0.0]],
                                            "y": [3.0, 4.0, 5.0]}),
    "prediction_interval": (prediction_interval, {
        "A": [[1.0], [1.0], [1.0]], "y": [1.0, 2.0, 3.0], "a": [1.0], "confidence": 0.5}),
    "predict_power": (predict_power, {"young_modulus": 1e5, "mixed_viscosity": 10.0,
                                      "tensile_strength": 2e6, "confidence": 0.95}),
    "convert": (partial(convert, wanted="Pa"), {"values": [1.0, 2.0], "unit": "psi"}),
    "intervals": (intervals, {"time": T, "period": 0.05}),
    "find_gaps": (find_gaps, {"time": T, "period": 0.05}),
    "lag": (lag, {"reference": HELD, "angle": np.roll(HELD, 3), "period": 0.05, "longest": 1.0}),
    "mean_edge": (mean_edge, {"time": T, "reference": HELD, "angle": np.roll(HELD, 3)}),
    "smoothed": (smoothed, {"angle": STEP, "period": 0.05, "window": 0.5}),
    "judge_step": (judge_step, {"time": T, "angle": STEP, "target": 1.0, "initial": 0.0,
                                "about": "reference", "window": 0.5, "band": 0.05}),
}  # fmt: skip
"""A call that works for each function, by keyword."""


def first(value, new):
    """Return numbers with another first one, of any type."""
    found = np.array(value, dtype=object)
    found.flat[0] = new
    return found.tolist()


OF_ANY = {
    "words": lambda value: "twelve",
    "none": lambda value: None,
    "nothing": lambda value: [],
    "a mapping": lambda value: {"a": 1},
    "imaginary": lambda value: np.asarray(value) * 1j,
    "dates": lambda value: np.full(np.shape(value), np.datetime64("2024-01-01")),
    "NaN": lambda value: first(value, np.nan) if np.ndim(value) else np.nan,
    "infinity": lambda value: first(value, np.inf) if np.ndim(value) else np.inf,
}
OF_ARRAYS = OF_ANY | {
    "a number": lambda value: 1.0,
    "a word among numbers": lambda value: first(value, "twelve"),
    "a gap": lambda value: first(value, None),
    "ragged": lambda value: [*np.asarray(value).tolist(), [1.0, 2.0]],
    "one more": lambda value: [*np.asarray(value).tolist(), np.asarray(value).tolist()[-1]],
    "stacked": lambda value: [np.asarray(value).tolist()] * 2,
    "a mask": lambda value: np.asarray(value) == np.asarray(value).flat[0],
}
OF_NUMBERS = OF_ANY | {
    "several": lambda value: [value] * 7,
}


OF_WORDS = {"words": lambda value: "twelve", "another": lambda value: 7, "none": lambda value: None}


def damages(value):
    if isinstance(value, str):
        return OF_WORDS
    return OF_ARRAYS if np.ndim(value) else OF_NUMBERS


OF_EACH = frozenset(OF_ARRAYS) & {
    "nothing", "NaN", "infinity", "a number", "a gap", "one more", "stacked"
}  # fmt: skip
MISSING = {"NaN", "a gap"}
RUNS = {"several"}
TAKEN = {
    # One number after another: what is none comes out as none.
    ("SensorLine.value", "counts"): OF_EACH,
    ("ludwick.stress", "strain"): OF_EACH,
    ("hooke.stress", "strain"): OF_EACH,
    ("convert", "values"): OF_EACH,
    ("smoothed", "angle"): OF_EACH - {"a number"},
    ("yeoh.stress", "stretch"): {"a number", "one more", "stacked"},
    ("transitions", "flow"): {"a number", "one more", "stacked"},
    # Samples may be missing: they are predicted over, or make the result NaN.
    ("estimate", "pressure"): MISSING,
    ("estimate", "angle"): MISSING,
    ("estimate_noise", "pressure"): MISSING,
    ("estimate_noise", "angle"): MISSING,
    ("run_printed", "angle"): MISSING | {"one more"},
    ("settling_time", "output"): MISSING | {"infinity", "stacked"},
    ("final_value", "output"): MISSING | {"infinity", "stacked"},
    ("overshoot", "output"): MISSING | {"a number", "one more", "stacked"},
    ("rise_time", "output"): MISSING | {"stacked"},
    ("judge_step", "angle"): MISSING | {"stacked"},
    ("settling_time", "final"): RUNS | {"NaN"},
    ("settling_time", "initial"): RUNS | {"NaN"},
    ("overshoot", "target"): RUNS | {"NaN"},
    ("overshoot", "initial"): RUNS | {"NaN"},
    ("rise_time", "target"): RUNS | {"NaN"},
    ("rise_time", "initial"): RUNS | {"NaN"},
    # No other argument has as many.
    ("open_loop_capacity", "angle"): {"one more"},
    ("PadModel.predict", "voltages"): {"one more"},
    ("yeoh.stress", "coefficients"): {"one more"},
    ("intervals", "time"): {"nothing", "one more"},
    ("find_gaps", "time"): {"nothing", "one more"},
    # One for each run of a batch.
    ("ziegler_nichols", "delay"): RUNS,
    ("ziegler_nichols", "slope"): RUNS,
    ("RobustDifferentiator", "jerk"): RUNS,
    ("RobustDifferentiator.update", "measurement"): RUNS,
    ("PolynomialDifferentiator.update", "measurement"): RUNS,
    **{("Gains", name): RUNS for name in ("kp", "ki", "kd", "derivative_filter")},
    **{
        (f"{one}.update", name): RUNS
        for one in ("PID", "StateFeedback", "ObserverFeedback")
        for name in ("reference", "measurement")
    },
    # None is told to be found.
    ("reaction_curve", "step_time"): {"none"},
    ("reaction_curve, window", "window"): {"none"},
    ("integrating_reaction_curve", "step_time"): {"none"},
    ("identify", "initial_input"): {"none"},
    ("identify", "dead_time"): {"none"},
    ("fit_finger", "fractional_power"): {"none"},
    ("fit_finger", "stiffness"): {"none"},
    ("ForceSettings", "bandwidth"): {"none"},
    ("fitting.fit", "young_modulus"): {"none"},
    ("elasticity", "young_modulus"): {"none"},
    ("ludwick.fit", "young_modulus"): {"none"},
    ("first_loading", "zero"): {"none"},
    ("fit_sensor", "curve"): {"none"},
    ("track_drift", "calibrated_at"): {"none"},
    ("track_drift", "noise"): {"none"},
    # A wander that never returns; and no other argument has as many.
    ("DriftSize", "return_time"): {"infinity"},
    ("noise_of", "voltage"): {"one more"},
}
"""Damages that have a meaning, by call and argument."""

CASES = [
    pytest.param(call, argument, kind, id=f"{call}-{argument}-{kind}")
    for call, (_, arguments) in CALLS.items()
    for argument, value in arguments.items()
    for kind in damages(value)
]


@pytest.mark.parametrize("call", CALLS)
def test_call_works(call):
    function, arguments = CALLS[call]
    function(**arguments)


@pytest.mark.parametrize(("call", "argument", "kind"), CASES)
def test_damaged_argument_is_refused(call, argument, kind):
    function, arguments = CALLS[call]
    damaged = damages(arguments[argument])[kind](arguments[argument])
    meant = kind in TAKEN.get((call, argument), ())
    with nullcontext() if meant else pytest.raises(SoftgripError):
        function(**arguments | {argument: damaged})
