"""What no controller can beat: how far and how fast a limited command can move a linear plant."""

import control
import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import toeplitz
from scipy.optimize import linprog

from softgrip.arrays import Floats, check_positive
from softgrip.control.pid import PERIOD
from softgrip.control.state_space_plant import StateSpacePlant, pulse_response
from softgrip.errors import InvalidInputError


def farthest(system: control.StateSpace, limit: float, time: ArrayLike) -> Floats:
    """Return the largest output that any command within +-limit reaches from rest.

    It is the limit times the integral of the absolute impulse response. No controller, sampled or
    not, whatever it knows, is farther at that time; where the impulse response does not change
    sign, the full command is what gets there, and the plant does not stop then.

    Args:
        system: One input, one output, continuous, D = 0.
        limit: Largest absolute command, > 0.
        time: Time since the start, s, >= 0, any shape.

    Returns:
        ndarray: Output unit, shape of `time`.

    >>> double_integrator = control.ss([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], 0)
    >>> farthest(double_integrator, 2.0, [1.0, 3.0]).round(6).tolist()
    [1.0, 9.0]
    """
    check_positive(limit=limit)
    t = np.asarray(time, dtype=np.float64)
    if not np.all(t >= 0):
        raise InvalidInputError("time", expected="numbers >= 0", got=time)
    grid = np.linspace(0, max(float(t.max()), 1e-9), 4001)
    impulse = StateSpacePlant(system, initial=system.B[:, 0])
    step = float(grid[1])
    h = np.abs([float(impulse.advance(0.0, step if k else 0.0)) for k in range(grid.size)])
    covered = np.concatenate([[0.0], np.cumsum((h[1:] + h[:-1]) / 2) * step])
    return np.asarray(limit * np.interp(t, grid, covered))


def minimum_settling_time(
    system: control.StateSpace,
    change: float,
    limit: float,
    *,
    band: float,
    hold: float = 1.0,
    period: float = PERIOD,
    longest: float = 20.0,
) -> float:
    """Return the least settling time that any held command within +-limit allows, from rest.

    Each trial time is a linear program: is there a sequence of commands, one a period, so that all
    samples from then on lie in the band? It knows the plant and the reference beforehand, and has
    no noise to fear, so what a controller of the same period does is never faster.

    Args:
        system: One input, one output, continuous, D = 0.
        change: Step of the output, > 0.
        limit: Largest absolute command, > 0.
        band: Half width of the band, in the unit of `change`, > 0.
        hold: Time for which the output must stay in the band, s, > 0. A longer one asks for more.
        period: Time between two commands, s, > 0.
        longest: Time at which to give up, s.

    Returns:
        float: s, a multiple of the period; infinite if not even `longest` suffices.

    Raises:
        InvalidInputError: If an argument is outside its range.

    >>> double_integrator = control.ss([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], 0)
    >>> round(minimum_settling_time(double_integrator, 1.0, 1.0, band=1e-6), 3)  # 2 sqrt(1)
    2.0
    """
    check_positive(change=change, limit=limit, band=band, hold=hold, period=period, longest=longest)
    stay = round(hold / period)
    last = round(longest / period)
    share = limit / change * pulse_response(system, period, last + stay)

    def feasible(samples: int) -> bool:
        n = samples + stay
        reached = toeplitz(share[:n], np.zeros(n))[samples - 1 :]
        low, high = 1 - band / change, 1 + band / change
        found = linprog(
            np.zeros(n),
            A_ub=np.vstack([reached, -reached]),
            b_ub=np.concatenate([np.full(len(reached), high), np.full(len(reached), -low)]),
            bounds=(-1, 1),
        )
        return bool(found.status == 0)

    # What settles in k periods settles in k + 1, by waiting one: so halving finds the first.
    few, many = 0, 1
    while not feasible(many):
        few, many = many, 2 * many
        if few >= last:
            return np.inf
        many = min(many, last)
    while many - few > 1:
        middle = (few + many) // 2
        few, many = (few, middle) if feasible(middle) else (middle, many)
    return many * period


def largest_step(
    system: control.StateSpace,
    limit: float,
    time: float,
    *,
    band: float,
    hold: float = 1.0,
    period: float = PERIOD,
) -> float:
    """Return the largest change of the output that held commands within +-limit settle, from rest.

    The question of `minimum_settling_time` turned round, with its arguments and errors: the time
    [s] is given, the change, in the output's unit, is what the program makes large. It overshoots
    within the band, here a share of the change, where that helps. Samples alone are looked at,
    which is worth a part of a period.

    >>> double_integrator = control.ss([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], 0)
    >>> round(largest_step(double_integrator, 1.0, 2.0, band=1e-6), 1)  # (2 / 2)^2
    1.0
    """
    check_positive(limit=limit, time=time, band=band, hold=hold, period=period)
    samples, stay = round(time / period), round(hold / period)
    if samples < 1 or stay < 1 or band >= 1:
        raise InvalidInputError(
            "time, hold, band", expected="a period or more, band < 1", got=(time, hold, band)
        )
    n = samples + stay
    reached = toeplitz(limit * pulse_response(system, period, n), np.zeros(n))[samples - 1 :]
    ones = np.ones((len(reached), 1))
    found = linprog(
        [*np.zeros(n), -1.0],
        A_ub=np.block([[reached, -(1 + band) * ones], [-reached, (1 - band) * ones]]),
        b_ub=np.zeros(2 * len(reached)),
        bounds=[(-1, 1)] * n + [(0, None)],
    )
    return float(found.x[-1])
