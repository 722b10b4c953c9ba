"""One step of the predictive controller, beside the same problem by a general package."""

import gc
import warnings
from collections.abc import Callable
from time import thread_time_ns
from typing import Any

import casadi as ca
import numpy as np

from book.chapter_6.controllers import own_model, target_angles
from softgrip.control.loop import SPEED_LIMIT
from softgrip.gripper.delayed_plant import DelayedGripper
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.predictive import (
    PredictiveController,
    PredictiveLaw,
    Weights,
    predictive_law,
)
from tests.bench.entry import Entry, entry

WANTED_MS, WANTED_TIMES = 5.0, 5.0
DELAY = 0.2
HORIZON = 20
"""Commands, each free, so that both solve the same problem."""


def problem() -> PredictiveLaw:
    """Return the controller of the book's gripper whose moves are all of one period."""
    plant = DelayedGripper(own_model(), (DELAY, DELAY))
    return predictive_law(
        plant, target_angles(own_model()), limit=SPEED_LIMIT, widths=(1,) * HORIZON
    )


def cost(law: PredictiveLaw, state: Any) -> Any:
    """Return what a state costs, as a symbol: `predictive_law` says what of."""
    own, count = Weights(), law.model.fingers
    size = law.model.last_command + law.model.commands
    share = ca.mtimes(ca.DM(law.model.C / law.target[:, None]), state)
    # What offsets make of it at rest is not to be helped.
    offset = np.linalg.svd(np.ones((1, count)))[2][1:].T
    apart = share - ca.mtimes(ca.DM(offset), state[size:])
    away = apart - ca.sum1(apart) / count
    return (ca.sumsqr(share - 1) + own.together * ca.sumsqr(away)) / count


def by_do_mpc(law: PredictiveLaw) -> Callable[[np.ndarray], float]:
    """Return a step of do-mpc with its default settings, from a state to the first command."""
    with warnings.catch_warnings():
        # Its texts have lone backslashes, and CasADi has changed since it was written.
        warnings.simplefilter("ignore")
        import do_mpc

        model = do_mpc.model.Model("discrete")
        x = model.set_variable("_x", "x", (len(law.model.A), 1))
        u = model.set_variable("_u", "u", (1, 1))
        sent = law.limit * u
        model.set_rhs("x", ca.mtimes(ca.DM(law.model.A), x) + ca.DM(law.model.B) * sent)
        model.setup()
        mpc = do_mpc.controller.MPC(model)
        # Ours looks on while its last commands are on their way; what is sent then changes nothing.
        mpc.settings.n_horizon = HORIZON + law.model.commands
        mpc.settings.t_step = PERIOD
        mpc.settings.supress_ipopt_output()
        # It counts the states from the present one on, and the last apart.
        mpc.set_objective(lterm=cost(law, model.x["x"]), mterm=cost(law, model.x["x"]))
        mpc.set_rterm(u=Weights().smooth)
        mpc.bounds["lower", "_u", "u"], mpc.bounds["upper", "_u", "u"] = -1.0, 1.0
        mpc.setup()
        mpc.x0 = np.zeros((len(law.model.A), 1))
        mpc.set_initial_guess()

    def step(state: np.ndarray) -> float:
        mpc.u0 = state[law.model.last_command, None, None] / law.limit
        return float(law.limit * mpc.make_step(state[:, None])[0, 0])

    return step


def by_ipopt(law: PredictiveLaw) -> Callable[[np.ndarray], float]:
    """Return a step of the same program by CasADi's default solver of nonlinear programs."""
    moves, state = ca.SX.sym("v", HORIZON), ca.SX.sym("x", len(law.model.A))
    x, total, before = state, 0.0, state[law.model.last_command] / law.limit
    for k in range(HORIZON + law.model.commands):
        v = moves[min(k, HORIZON - 1)]
        x = ca.mtimes(ca.DM(law.model.A), x) + ca.DM(law.model.B) * (law.limit * v)
        total += cost(law, x)
        if k < HORIZON:
            total += Weights().smooth * (v - before) ** 2
            before = v
    program = {"x": moves, "p": state, "f": total}
    quiet = {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes"}
    solver = ca.nlpsol("moves", "ipopt", program, quiet)
    last = [np.zeros(HORIZON)]

    def step(state: np.ndarray) -> float:
        found = solver(x0=last[0], p=state, lbx=-1, ubx=1)["x"]
        last[0] = np.asarray(found).ravel()
        return float(law.limit * last[0][0])

    return step


def taken(function: Callable[[Any], object], inputs: list[Any]) -> np.ndarray:
    """Return what each call takes, ms, of the processor's time of this thread."""
    found = []
    gc.disable()
    try:
        for one in inputs:
            start = thread_time_ns()
            function(one)
            found.append((thread_time_ns() - start) / 1e6)
    finally:
        gc.enable()
    return np.array(found)


def states_on_the_way(law: PredictiveLaw, count: int) -> tuple[list[Any], list[Any]]:
    """Return angles as measured, and the states that a controller finds from them."""
    loop = PredictiveController(law)
    rng, angles, states = np.random.default_rng(0), [], []
    for k in range(count):
        if k % 50 == 0:
            loop.reset()
            x = np.zeros(len(law.model.A))
        angles.append(law.model.C @ x + 0.03 * rng.standard_normal(2))
        command = loop.update(angles[-1])
        states.append(x.copy())
        x = law.model.A @ x + law.model.B * command
    return angles, states


def entries(*, count: int = 2000, others: int = 100) -> list[Entry]:
    """Return the step's 99th percentile, and its median against a general package's."""
    usual = predictive_law(
        DelayedGripper(own_model(), (DELAY, DELAY)), target_angles(own_model()), limit=SPEED_LIMIT
    )
    angles, _ = states_on_the_way(usual, count)
    ours = taken(PredictiveController(usual).update, angles)
    high = float(np.percentile(ours, 99))
    law = problem()
    angles, states = states_on_the_way(law, others)
    same = taken(PredictiveController(law).update, angles)
    step = by_do_mpc(law)
    step(states[0])
    theirs = taken(step, states)
    middle, other = float(np.median(same)), float(np.median(theirs))
    return [
        entry(
            "predictive step, p99", high, "ms", 1e3 * PERIOD, f"< {WANTED_MS:g} ms",
            high < WANTED_MS,
            f"{count:,} steps of filter and program, the processor's time; median "
            f"{np.median(ours):.3f} ms; baseline: the period of the loop.",
        ),
        entry(
            "predictive step over do-mpc, as it is set at first", middle, "ms", other,
            f">= {WANTED_TIMES:g} times",
            other / middle >= WANTED_TIMES,
            f"Medians of {others} states on the way, {HORIZON} free commands each, the processor's "
            f"time; 99th percentiles {np.percentile(same, 99):.3f} and "
            f"{np.percentile(theirs, 99):.3f} ms; ours with the filter, theirs without.",
        ),
    ]  # fmt: skip
