"""The Kalman filter of Eq. (4.8)-(4.10) as printed, and why it cannot find the capacity.

The state is [C, theta] and only theta is measured. Its transition has no path from C to theta, so
no measurement holds anything of C: the observability matrix has rank 1 (`observability`). What the
filter returns is its starting guess plus k times the running sum of the angle, an integral in open
loop. Its variance never falls below that of the guess, and at a bent finger held still the
capacity goes on growing for ever, where the text has capacity proportional to the angle.

The print also measures x_k at k + 1, Eq. (4.9); we take the measurement of x_k at k.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, floats
from softgrip.checks import check_finite, check_not_negative, record, takes_numbers

if TYPE_CHECKING:
    from filterpy.kalman import KalmanFilter


@takes_numbers
def printed_filter(
    gain: float,
    *,
    capacity: float,
    capacity_std: float,
    capacity_step: float,
    angle_std: float,
    angle_step: float,
    sensor: float,
    angle: float = 0.0,
) -> KalmanFilter:
    """Set up the filter of the process, Eq. (4.8), and the measurement, Eq. (4.9), with Eq. (4.10).

    No noise level is printed, so all are arguments.

    Args:
        gain: k, m^3/Pa a radian and sample: the rate of the integral, so it depends on the loop
            time.
        capacity, angle: First guess of C, m^3/Pa, and of theta, rad.
        capacity_std, angle_std: Standard deviations of the first guess, > 0.
        capacity_step, angle_step: Standard deviations of w_k, a sample, >= 0.
        sensor: Standard deviation of v_k, the flex sensor's, rad, > 0.

    Returns:
        filterpy.kalman.KalmanFilter: State a column (2, 1).

    Raises:
        InvalidInputError: If a value is out of range.
    """
    check_finite(gain=gain, capacity=capacity, angle=angle)
    check_positive(capacity_std=capacity_std, angle_std=angle_std, sensor=sensor)
    check_not_negative(capacity_step=capacity_step, angle_step=angle_step)
    # It brings SciPy's distributions and more along: only who filters waits for them.
    from filterpy.kalman import KalmanFilter

    kalman = KalmanFilter(dim_x=2, dim_z=1)
    kalman.x = np.array([[capacity], [angle]])
    kalman.F = np.array([[1.0, gain], [0.0, 1.0]])
    kalman.H = np.array([[0.0, 1.0]])
    kalman.P = np.diag([capacity_std**2, angle_std**2])
    kalman.Q = np.diag([capacity_step**2, angle_step**2])
    kalman.R = np.array([[sensor**2]])
    return kalman


def run_printed(kalman: KalmanFilter, angle: ArrayLike) -> tuple[Floats, Floats]:
    """Run the printed filter over measured angles; it updates the filter that is given.

    Args:
        kalman: From `printed_filter`.
        angle: Measured theta, rad, shape (N,), N >= 1; NaN where a sample is missing: there the
            filter predicts and measures nothing.

    Returns:
        state (ndarray): [C, theta] after each measurement, shape (N, 2).
        covariance (ndarray): Shape (N, 2, 2).

    Raises:
        InvalidInputError: If an angle is infinite, or they are not of shape (N,).
    """
    (measured,) = floats(angle=angle)
    missing = np.isnan(measured)
    record(at_least=1, angle=np.where(missing, 0.0, measured))
    states, covariances = np.empty((measured.size, 2)), np.empty((measured.size, 2, 2))
    for k, z in enumerate(measured):
        if k:
            kalman.predict()
        if not missing[k]:
            kalman.update(z)
        states[k], covariances[k] = kalman.x[:, 0], kalman.P
    return states, covariances


@takes_numbers
def open_loop_capacity(angle: ArrayLike, gain: float, capacity: float) -> Floats:
    """Return the capacity that the process makes of known angles: ``C_0 + k sum_{j<k} theta_j``.

    Args:
        angle: theta, rad, shape (N,).
        gain: k, m^3/Pa a radian and sample.
        capacity: C_0, m^3/Pa.

    Returns:
        ndarray: Capacity at each sample, m^3/Pa, shape (N,).

    >>> open_loop_capacity([1.0, 1.0, 1.0], 0.5, 2.0).tolist()  # the angle stands still
    [2.0, 2.5, 3.0]
    """
    (known,) = record(at_least=1, angle=angle)
    return np.asarray(capacity + gain * (np.cumsum(known) - known), dtype=np.float64)
