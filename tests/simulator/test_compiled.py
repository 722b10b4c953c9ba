"""The compiled rig against the one on NumPy: the same runs, whatever drives them."""

from dataclasses import fields, replace

import numpy as np
import pytest
from joblib import parallel_config

from softgrip.control.differentiator import PolynomialDifferentiator, RobustDifferentiator
from softgrip.control.pid import PID, Gains
from softgrip.control.pressure_command import PressureAsSpeed, PressureByPlunger
from softgrip.control.rig_controller import CommandSequence, Tracking
from softgrip.control.state_feedback import ObserverFeedback, StateFeedback
from softgrip.dynamics.second_order import SecondOrder
from softgrip.errors import InvalidInputError
from softgrip.gripper.grasp import DiscBetweenFingers, ElasticDisc
from softgrip.gripper.internal_model import InternalModelController, controller_matrices
from softgrip.gripper.inversion import mean_inverse
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.shaping_filter import SLOW, filter_state_space
from softgrip.simulator import kernel
from softgrip.simulator.compiled import QUANTITIES, drive_compiled
from softgrip.simulator.drive import drive
from softgrip.simulator.parts import in_parts
from softgrip.simulator.rig_batch import stacked, take
from softgrip.simulator.sampled_law import sampled_law
from softgrip.simulator.simulation import Simulation
from softgrip.units import DEG, REV
from tests.simulator.rigs import THREE, commands, design_1, differing, printed_gripper

FINGER, GRIPPER = design_1(), printed_gripper()
PUSH = np.array([[1e-3], [0.0], [-1e-3]])
"""N m over three periods."""


FELT = ("felt_pressure", "felt_angle")
"""What `drive` does not give, but a rig of which each period is held by itself."""


class OneARun:
    """A controller of the rig that looks at nothing: commands of each run."""

    def __init__(self, speeds):
        self.left = list(speeds.T)

    def update(self, measured):
        return self.left.pop(0) if self.left else 0.0


def of_numpy(made):
    """Return what `drive` gives by the names and in the shapes of `Trajectories`."""
    true, seen = made.truth, made.measured
    found = {
        "command": made.command, "pressure": seen.pressure, "angle": seen.angle,
        "true_pressure": true.pressure, "true_angle": true.angle, "true_rate": true.rate,
        "motor_speed": true.motor_speed, "plunger": true.plunger, "amount": true.amount,
    }  # fmt: skip
    moved = {name: np.moveaxis(value, 0, -1) for name, value in found.items()}
    return {name: v.swapaxes(0, 1) if v.ndim == 3 else v for name, v in moved.items()}


def agree(found, made):
    """Check all quantities to 1e-9 of their scale.

    The rounding of the two differs by some 1e-15 of it. Neither it nor a push of the kernel's
    arithmetic moves a sensor over the edge of a count in these runs.
    """
    assert {*of_numpy(made), *FELT} == set(QUANTITIES)
    np.testing.assert_array_equal(found.time, made.time)
    for name, expected in of_numpy(made).items():
        scale = abs(expected).max() or 1.0
        np.testing.assert_allclose(
            getattr(found, name), expected, rtol=0, atol=1e-9 * scale, err_msg=name
        )


def both(rig, control, *, duration, runs=3, period=0.025, push=None, reference=None, **options):
    """Run on both paths and check that they agree; `control` makes the controller."""
    simulations = [Simulation(rig, runs=runs, seed=4, period=period) for _ in range(2)]
    found = drive_compiled(
        simulations[0], control(), duration=duration, keep=QUANTITIES,
        push=push, **options,
    )  # fmt: skip
    pushed = (
        None if push is None else lambda t: push[min(round(t / period), len(push) - 1)][:, None]
    )
    made = drive(
        simulations[1], (reference or control)(), duration=duration, push=pushed, **options
    )
    agree(found, made)
    return found


@pytest.mark.parametrize("period", [0.025, 0.1])
@pytest.mark.parametrize("rig", [FINGER, GRIPPER, THREE], ids=["one", "two", "three"])
def test_rigs_that_all_differ_run_as_on_numpy(rig, period):
    rigs = differing(rig, 5)
    speeds = commands(60, 5)
    found = both(
        rigs, lambda: speeds, reference=lambda: OneARun(speeds), runs=5, period=period,
        duration=60 * period, push=np.tile(PUSH, (1, len(rig.fingers))),
    )  # fmt: skip
    assert np.ptp(found.true_angle, axis=0).max() > 10 * DEG


def test_more_runs_than_lanes_are_the_same_runs():
    speeds = commands(20, 1)[0]
    runs = kernel.LANES + 6
    both(FINGER, lambda: CommandSequence(speeds), runs=runs, duration=0.5)


def test_runs_of_other_steps_are_those_of_a_rig_of_these_steps():
    """Side by side, in another order: a run hangs on no other."""
    steps = np.array([4, 1, 2, 1, 4])
    rigs, speeds = differing(GRIPPER, steps.size), commands(20, 1)[0]
    found = drive_compiled(
        Simulation(rigs, seed=4), speeds, duration=0.5, keep=QUANTITIES, steps=steps
    )
    for k, number in enumerate(steps):
        own = Simulation(rigs[k], seed=4, first=k, step=0.025 / number)
        alone = drive_compiled(own, speeds, duration=0.5, keep=QUANTITIES)
        for name in QUANTITIES:
            np.testing.assert_array_equal(
                getattr(found, name)[k : k + 1], getattr(alone, name), err_msg=name
            )


@pytest.mark.parametrize("rig", [FINGER, THREE], ids=["one finger", "three"])
def test_sensors_feel_what_they_feel_on_numpy(rig):
    rigs, speeds = differing(rig, 5), commands(40, 5)
    found = drive_compiled(Simulation(rigs, seed=4), speeds, duration=1.0, keep=FELT)
    held = Simulation(rigs, seed=4)
    for k, command in enumerate(speeds.T, start=1):
        held.hold(command)
        pressure, angle = held.felt
        for one, expected in ((found.felt_pressure, pressure), (found.felt_angle, angle.T)):
            atol = 1e-9 * abs(one).max()
            np.testing.assert_allclose(one[..., k], expected, rtol=0, atol=atol)
    assert not found.felt_angle[..., 0].any()


def test_both_ends_of_the_stroke_stop_the_motor_as_on_numpy():
    rigs = [replace(FINGER, pump=replace(FINGER.pump, backlash=b)) for b in (0.0, 1e-3)]
    speeds = np.repeat([5.0, -5.0, 5.0], 120) * REV
    found = both(rigs, lambda: CommandSequence(speeds), runs=2, duration=9.0)
    assert found.plunger.max() == FINGER.pump.stroke
    assert (found.plunger[:, 230] == 0).all()


def test_rig_starts_where_it_stands_and_is_pushed_as_on_numpy():
    def rig():
        found = Simulation(GRIPPER, runs=3, seed=4, plunger=[0.0, 0.02, 0.05])
        found.push([[1e-3], [-5e-4]])
        return found

    speeds = np.full(20, -2.0)
    found = drive_compiled(rig(), speeds, duration=1.0, keep=QUANTITIES)
    agree(found, drive(rig(), CommandSequence(speeds), duration=1.0))


MODEL = SecondOrder(2.86, 0.7)
GAIN = (10.0, 6.07, 1.304)
STEPS = np.repeat([0.0, 30.0, 60.0, 20.0], 30) * DEG
PIDS = {
    "PI": lambda: PID(Gains(20.0, 12.0), limits=(-8.0, 6.0)),
    "PID": lambda: PID(Gains(20.0, 12.0, 3.0, 0.05), limits=(-10.0, 10.0)),
    "PID that winds up": lambda: PID(
        Gains(20.0, 12.0, 3.0), limits=(-10.0, 10.0), anti_windup=False
    ),
    "PID on the measurement": lambda: PID(
        Gains(20.0, 12.0, 3.0), limits=(-10.0, 10.0), derivative_on="measurement"
    ),
    "PID a run": lambda: PID(
        Gains(np.array([5.0, 20.0, 40.0]), np.array([0.0, 9.0, 30.0]), 1.0), limits=(-10.0, 10.0)
    ),
    "PID of a pressure": lambda: PressureAsSpeed(
        PID(Gains(9e4, 6e4, 1e4), limits=(-5e4, 5e4)), set_pressure=1.5e5
    ),
}
REGULATORS = {
    "LQR, robust differentiator": lambda: StateFeedback(GAIN, 60.0, RobustDifferentiator(10.0)),
    "LQR, robust differentiator a run": lambda: StateFeedback(
        GAIN, 60.0, RobustDifferentiator(np.array([1.0, 10.0, 100.0]))
    ),
    "LQR a run, robust differentiator": lambda: StateFeedback(
        np.outer(GAIN, [0.5, 1.0, 2.0]), 60.0, RobustDifferentiator(10.0)
    ),
    "LQR, fit": lambda: StateFeedback(GAIN, 60.0, PolynomialDifferentiator(9)),
    "LQR, observer": lambda: ObserverFeedback(GAIN, MODEL, 60.0, limit=12.0),
}


@pytest.mark.parametrize("rig", [FINGER, THREE], ids=["one finger", "three"])
@pytest.mark.parametrize("name", [*PIDS, *REGULATORS])
def test_controller_of_one_angle_does_what_it_does_on_numpy(name, rig):
    make = (PIDS | REGULATORS)[name]
    found = both(differing(rig, 3), lambda: Tracking(make(), STEPS), duration=3.0, limit=4 * REV)
    assert abs(found.command).max() > 5.0


@pytest.mark.parametrize("limit", [np.inf, 2.0])
@pytest.mark.parametrize("digits", [None, 6])
def test_internal_model_does_what_it_does_on_numpy(limit, digits):
    matrices = controller_matrices(
        PRINTED, mean_inverse(PRINTED), filter_state_space(*SLOW), delay_samples=1
    )

    def make():
        return InternalModelController(matrices, [0.7, 0.8], limit=limit, digits=digits)

    found = both(
        differing(GRIPPER, 3), make, duration=6.0, period=0.1, limit=3.0, delay=1,
        push=np.vstack([np.zeros((30, 2)), np.tile([[-1e-3, 0.0]], (5, 1)), np.zeros((1, 2))]),
    )  # fmt: skip
    assert abs(found.command).max() == min(limit, 3.0)


def test_controller_of_a_longer_period_comes_late_as_on_numpy():
    pid = PIDS["PID"]().gains
    both(GRIPPER, lambda: Tracking(PID(pid, period=0.1), [0.5]), duration=3.0, every=4, delay=2)


def test_law_of_each_run_is_its_own():
    laws = [sampled_law(Tracking(PID(Gains(kp, 5.0)), [0.5]), 1) for kp in (5.0, 10.0, 20.0)]
    arrays = {
        field.name: np.stack([np.reshape(getattr(law.matrices, field.name), shape) for law in laws])
        for field, shape in zip(
            fields(laws[0].matrices)[:-1],
            ((2, 2), (2, 1), (2, 1), (2,), (2,), (1,), (1,)),
            strict=True,
        )
    }
    law = replace(laws[0], matrices=replace(laws[0].matrices, **arrays))
    gains = Gains(np.array([5.0, 10.0, 20.0]), 5.0)
    both(FINGER, lambda: law, reference=lambda: Tracking(PID(gains), [0.5]), duration=2.0)


def measures(part):
    """Return the last angles of some runs of three experiments, shape (runs, 3)."""
    rigs = take(RIGS, part)
    run = {"runs": part.stop - part.start, "seed": 4, "first": part.start, "step": FINEST}
    found = [
        drive_compiled(Simulation(rigs, **run), law, duration=0.5, keep=("true_angle",))
        for law in (commands(20, 1)[0], Tracking(PIDS["PID"](), STEPS + 0.5))
    ]
    return np.stack([one.true_angle[:, 0, -1] for one in found], axis=-1)


RIGS = stacked(differing(FINGER, 11))
FINEST = 2e-3
"""s, the step of all parts: by itself a part takes that of its stiffest rig."""


@pytest.mark.parametrize("jobs", [1, 2])
def test_parts_change_nothing(jobs):
    # Threads, since the kernel lets go of the interpreter; processes take long to start.
    whole = measures(slice(0, 11))
    with parallel_config(backend="threading", n_jobs=jobs):
        found = in_parts(measures, 11, 1.0, memory=3.0)
    np.testing.assert_array_equal(found, whole)
    assert np.ptp(whole, axis=0).min() > 1 * DEG


def test_less_kept_is_the_same():
    def run(**keep):
        return drive_compiled(Simulation(GRIPPER, runs=2), commands(20, 1)[0], duration=1.0, **keep)

    whole = run(keep=QUANTITIES)
    for name in QUANTITIES:
        found = run(keep=(name,))
        np.testing.assert_array_equal(getattr(found, name), getattr(whole, name))
        assert [one for one in QUANTITIES if getattr(found, one) is not None] == [name]


def test_rig_stays_where_it_is():
    rig = Simulation(FINGER, seed=4)
    before = rig.measure()
    drive_compiled(rig, np.array([5.0]), duration=1.0)
    assert rig.time == 0
    assert before.angle == Simulation(FINGER, seed=4).measure().angle


def test_fingerprint_is_of_each_formula(monkeypatch):
    plain = kernel._fingerprint()
    assert plain == kernel._fingerprint()
    monkeypatch.setattr(kernel, "SHARED", kernel.SHARED[1:])
    assert kernel._fingerprint() != plain


def test_kernel_compiles_where_nothing_can_be_written(monkeypatch):
    def refuse(function, **options):
        if options.pop("cache", False):
            raise RuntimeError("no locator available")
        return "compiled anew"

    monkeypatch.setattr(kernel, "njit", refuse)
    assert kernel._kernel(0) == "compiled anew"


def test_rig_that_moved_or_touches_is_refused():
    moved = Simulation(FINGER)
    moved.advance(1.0)
    touching = Simulation(GRIPPER, contact=DiscBetweenFingers(ElasticDisc(50.0)))
    for rig in (moved, touching):
        with pytest.raises(InvalidInputError, match="rig: expected one that has not moved"):
            drive_compiled(rig, np.ones(1), duration=1.0)


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("keep", {"keep": ("angel",)}),
        ("keep", {"keep": ()}),
        ("every", {"every": 0}),
        ("delay", {"delay": -1}),
        ("limit", {"limit": 0.0}),
        ("duration", {"duration": 0.0}),
        ("steps", {"steps": np.array([1])}),
        ("steps", {"steps": np.array([1, 0])}),
        ("push", {"push": np.zeros((3, 2))}),
        ("push", {"push": np.nan}),
        ("reference", {"control": np.zeros((3, 5))}),
        ("reference", {"control": np.array([np.nan])}),
        ("controller", {"control": Tracking(PressureByPlunger(PID(Gains(1.0)), 1e3), [0.5])}),
        ("period of the controller", {"control": Tracking(PID(Gains(1.0), period=0.1), [0.5])}),
        (
            "B_measured",
            {"control": replace(sampled_law(Tracking(PID(Gains(1.0)), [0.5]), 2), jerk=None)},
        ),
    ],
)
def test_bad_value_is_refused_by_name(name, options):
    arguments = {"control": np.ones(1), "duration": 1.0, **options}
    with pytest.raises(InvalidInputError, match=name):
        drive_compiled(Simulation(FINGER, runs=2), **arguments)


def test_numbers_of_runs_begin_again_after_a_cycle():
    """Two rigs, three runs each: those of either rig alone, from its first sample or its second."""
    rigs, speeds = differing(FINGER, 2), commands(20, 1)[0]
    lanes = [rig for rig in rigs for _ in range(3)]
    both = drive_compiled(Simulation(lanes, seed=4, cycle=3), speeds, duration=0.5, unread=1)
    for k, rig in enumerate(rigs):
        seen, _ = Simulation(rig, runs=3, seed=4).open_loop(speeds)
        own = both.angle[3 * k : 3 * k + 3, 0, 1:]
        np.testing.assert_allclose(own, seen.angle[:, 0].T, rtol=0, atol=1e-9)
