"""The largest step that any controller can settle in a given time: one linear program."""

import control
import numpy as np
from scipy.linalg import toeplitz
from scipy.optimize import linprog

from softgrip.arrays import check_positive
from softgrip.control.pid import PERIOD
from softgrip.control.state_space_plant import pulse_response
from softgrip.errors import InvalidInputError


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

    The question of `minimum_time.minimum_settling_time` turned round: the time is given, the change
    is what the program makes large. What it finds knows the plant, fears no noise, and overshoots
    within the band where that helps; so no controller of the same period does more. Samples alone
    are looked at, which is worth a part of a period.

    Parameters
    ----------
    system
        One input, one output, continuous, D = 0.
    limit
        Largest absolute command, > 0.
    time
        From which on all samples lie in the band, s, a period at least.
    band
        Half width of the band as a share of the change, 0 to 1.
    hold
        Time for which the output must stay there, s, > 0.
    period
        Time between two commands, s, > 0.

    Returns
    -------
    float
        Output unit.

    Raises
    ------
    InvalidInputError
        If an argument is outside its range.

    Examples
    --------
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
