"""That the bench runs and writes what it says; no time is judged here."""

import json
import sys
from dataclasses import fields
from importlib import import_module

import numpy as np
import pytest

from softgrip.gripper.predictive import PredictiveController
from tests.bench import delay, elastica, elastica_runs, growth, rig
from tests.bench.__main__ import SUBJECTS
from tests.bench.entry import Entry, entry, interleaved, table, write
from tests.bench.fingers import ALLOWED, batch, choose_step, plain, responses

SMALL = {
    "step_responses": {"runs": 4, "plain_runs": 2, "checked": 2, "repetitions": 1},
    "rig": {"seconds": 0.25, "runs": 3, "experiment": 0.25, "repetitions": 1},
    "growth": {"runs": (2, 4, 8), "repetitions": 1},
    "controller": {"count": 50, "repetitions": 2},
    # Ours alone: PyElastica would have to be fetched.
    "design": {"starts": 2, "rivals": ("SLSQP",)},
    "elastica": {"elements": (), "runs": 3, "repetitions": 1},
    "kernel_regression": {"queries": 500, "other": 20, "repetitions": 1, "plain": 50},
    "board": {"seconds": 0.5, "count": 5, "stops": 2},
    "pad_reading": {"count": 50, "plain": 5, "repetitions": 1},
    "drift": {"count": 50, "repetitions": 1},
    "twin": {"rigs_at_a_time": 2, "experiments": ("statics", "lifts")},
    "delay": {"count": 50, "others": 3},
    "front": {"points": 1, "starts": 1, "whole": 2},
    "grippers": {"pairs": 4, "plain_pairs": 1, "growth": (2, 4, 8), "repetitions": 1},
}
KINDS = {
    "name": str,
    "value": float,
    "unit": str,
    "baseline": (float, type(None)),
    "ratio": (float, type(None)),
    "wanted": str,
    "met": (bool, type(None)),
    "note": str,
}


@pytest.mark.parametrize("subject", SUBJECTS)
def test_subject_gives_entries_that_survive_json(subject, tmp_path):
    found = import_module(f"tests.bench.{subject}").entries(**SMALL[subject])
    write(found, tmp_path / "deep" / "bench.json")
    read = json.loads((tmp_path / "deep" / "bench.json").read_text())
    assert [Entry(**line) for line in read] == found
    for line in read:
        assert list(line) == list(KINDS)
        assert all(isinstance(line[key], kind) for key, kind in KINDS.items())
        assert np.isfinite([line["value"], line["ratio"] or 0.0]).all()
    assert all(one.name in table(found) for one in found)


@pytest.mark.parametrize(("by", "needs"), [(delay.by_ipopt, "casadi"), (delay.by_do_mpc, "do_mpc")])
@pytest.mark.filterwarnings("ignore")
def test_what_the_predictive_step_is_timed_against_solves_the_same_problem(by, needs):
    pytest.importorskip(needs)
    law = delay.problem()
    _, states = delay.states_on_the_way(law, 12)
    other, loop = by(law), PredictiveController(law)
    for state in states:
        g = law.by_state @ state + law.constant
        # Interior-point solvers stop short of a bound by some millionths of the limit.
        assert other(state) == pytest.approx(float(law.limit * loop._one(g)), abs=2e-3)


def test_schema_is_that_of_the_entry():
    assert [field.name for field in fields(Entry)] == list(KINDS)


def test_ratio_is_that_of_baseline_and_value():
    ratios = [entry("a", 2.0, "s", baseline, "", None, "").ratio for baseline in (6.0, None)]
    assert ratios == [3.0, None]


def test_both_sides_solve_the_same_equation():
    few = batch(3, samples=51)
    choice = choose_step(few)
    found = responses(few, choice.step)
    true = plain(few, method="DOP853", rtol=1e-11, atol=1e-13)
    assert found.shape == true.shape == (51, 3)
    assert abs(found - true).max() < ALLOWED


def test_growth_is_measured_at_the_step_that_is_good_enough():
    assert choose_step(batch(1000).take(np.arange(0, 1000, 10))).step == growth.STEP


def test_the_first_round_is_thrown_away():
    calls = []
    times = interleaved(lambda: calls.append("a"), lambda: calls.append("b"), repetitions=2)
    assert times.shape == (2, 2)
    assert calls == ["a", "b"] * 3


def test_exponent_of_a_known_power():
    runs = (100, 1000, 10_000)
    assert growth.exponent(runs, 3e-5 * np.array(runs) ** 0.9) == pytest.approx(0.9)


def test_rig_is_moved_within_its_limits():
    # A plunger at the end of its stroke would make the run easier than a run.
    speeds = rig.commands(10.0)
    parameters = rig.design_1()
    moved = rig.Simulation(parameters, seed=1)
    _, truth = moved.open_loop(speeds)
    assert truth.plunger.max() < parameters.pump.stroke
    assert truth.angle.max() > 0.5
    assert truth.pressure.max() < 0.15e6


def test_our_two_step_responses_are_one():
    times = np.linspace(0, elastica_runs.SECONDS, 31)
    found = elastica.integrated(times, 0.01, 2)
    np.testing.assert_allclose(found.T, [elastica.closed_form(times)] * 2, atol=1e-9)


def test_rods_weigh_what_gives_the_frequency_of_the_finger():
    # The uniform rod by its mode, sampled; the tip mass by its spring, F L^3 / (3 E I).
    k, x = elastica_runs.FIRST_ROOT, np.linspace(0, 1, 20_001)
    ratio = (np.cos(k) + np.cosh(k)) / (np.sin(k) + np.sinh(k))
    mode = np.cosh(k * x) - np.cos(k * x) - ratio * (np.sinh(k * x) - np.sin(k * x))
    curve = k**2 * (np.cosh(k * x) + np.cos(k * x) - ratio * (np.sinh(k * x) + np.sin(k * x)))
    length, uniform, tipped = elastica_runs.LENGTH, elastica_runs.UNIFORM, elastica_runs.TIPPED
    spring = elastica_runs.BENDING / length**3
    mass = uniform.density * elastica_runs.AREA * length
    rayleigh = (spring * np.trapezoid(curve**2, x) / (mass * np.trapezoid(mode**2, x))) ** 0.5
    assert rayleigh == pytest.approx(elastica_runs.FREQUENCY, rel=1e-6)
    assert (3 * spring / tipped.tip_mass) ** 0.5 == pytest.approx(elastica_runs.FREQUENCY, rel=0.01)


def test_frequency_is_read_from_a_swing():
    class Swing(elastica_runs.Elastica):
        def run(self, *given, **more):
            times = np.linspace(0, 12, 301)
            return {"times": times, "angles": 0.01 * (1 - np.cos(2.7 * times))}

    assert Swing(None).frequency(elastica_runs.UNIFORM, 20) == pytest.approx(2.7)


def test_without_pyelastica_ours_is_measured_alone_and_the_reason_is_said(monkeypatch):
    # A Python in the place of uv does not know its command either, and needs no network to say so.
    monkeypatch.setattr(elastica_runs, "find_uv_bin", lambda: sys.executable)
    found = elastica.entries(elements=(5,), runs=2, repetitions=1)
    assert len(found) == 3
    assert all("could not be run: " in one.note and one.ratio is None for one in found)
