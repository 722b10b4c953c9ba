"""A capacity filter that the pressure sensor can correct: pressure and elastance as the state.

What holds the capacity is the pressure, which the rig measures, not the angle. Eq. (4.5) over one
sample is ``P_{k+1} = P_k + Q_k dt / C``, which is not linear in C but linear in the elastance
S = 1/C. With the flow known from the commanded steps, the filter is linear and time-varying::

    P_{k+1} = P_k + Q_k dt S_k + w
    S_{k+1} = S_k + g (theta_{k+1} - theta_k) + w'
    z_k     = P_k + v

It is observable as soon as some flow is not zero, and only then: with the pump at rest the
pressure says nothing of the capacity, and the elastance moves with the angle alone. Here the gain
g multiplies the *change* of the angle, so that the capacity follows the angle, as the text wants,
and stands still with it. Eq. (4.10) multiplies the angle itself.

The angle is taken as measured. The flex sensor's noise passes into S as g times that noise, which
the filter's covariance does not know of: smooth the angle first if that is much.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, floats, one_number
from softgrip.checks import check_finite, check_not_negative, takes_numbers

if TYPE_CHECKING:
    from filterpy.kalman import KalmanFilter


@dataclass(frozen=True)
class NoiseLevels:
    """Standard deviations of the filter's three noises.

    Attributes:
        pressure_step: Of w, what the model misses of the pressure in one sample, Pa, >= 0.
        elastance_step: Of w', the wander of the elastance in one sample, Pa/m^3, >= 0.
        sensor: Of v, the pressure sensor's, Pa, > 0.
    """

    pressure_step: float
    elastance_step: float
    sensor: float

    def __post_init__(self) -> None:
        one_number(**vars(self))
        check_not_negative(pressure_step=self.pressure_step, elastance_step=self.elastance_step)
        check_positive(sensor=self.sensor)


@dataclass(frozen=True)
class Prior:
    """What is known before the first sample: means and standard deviations.

    Attributes:
        pressure, pressure_std: Pa; gauge or absolute, as the sensor reads.
        elastance, elastance_std: 1/C, Pa/m^3, > 0: absolute pressure over gas volume, `1 /
            gas.capacity`.
    """

    pressure: float
    pressure_std: float
    elastance: float
    elastance_std: float

    def __post_init__(self) -> None:
        one_number(**vars(self))
        check_positive(
            pressure_std=self.pressure_std,
            elastance=self.elastance,
            elastance_std=self.elastance_std,
        )


@dataclass(frozen=True)
class ElastanceModel:
    """All that the filter must be told.

    Attributes:
        time_step: dt, s, > 0.
        noise: Noise levels; `noise.estimate_noise` finds them from a record.
        prior: The state before the first sample.
        angle_gain: g, Pa/m^3 a radian: for a capacity that goes from C_0 to C_1 while the finger
            bends by theta, ``(1/C_1 - 1/C_0) / theta``. With 0 the filter follows the pressure
            alone.
    """

    time_step: float
    noise: NoiseLevels
    prior: Prior
    angle_gain: float = 0.0

    def __post_init__(self) -> None:
        one_number(time_step=self.time_step, angle_gain=self.angle_gain)
        check_positive(time_step=self.time_step)


@takes_numbers
def transitions(flow: ArrayLike, time_step: float) -> Floats:
    """Return the transition of [P, S] for each flow: ``[[1, Q dt], [0, 1]]``.

    Args:
        flow: Q, m^3/s, shape (K,).
        time_step: dt, s, > 0.

    Returns:
        ndarray: Shape (K, 2, 2).

    >>> transitions([2.0], 0.5).tolist()
    [[[1.0, 1.0], [0.0, 1.0]]]
    """
    check_finite(flow=flow)
    check_positive(time_step=time_step)
    steps = floats(flow=flow)[0].ravel() * time_step
    result = np.tile(np.eye(2), (steps.size, 1, 1))
    result[:, 0, 1] = steps
    return result


def elastance_filter(model: ElastanceModel) -> KalmanFilter:
    """Set up the filter at its prior, before the first measurement.

    Returns:
        filterpy.kalman.KalmanFilter: State [P, S], a column (2, 1); input the change of the angle,
            a column (1, 1). The transition changes from sample to sample: give `predict` one of
            `transitions`.

    >>> noise = NoiseLevels(pressure_step=10.0, elastance_step=1e7, sensor=100.0)
    >>> prior = Prior(pressure=0.0, pressure_std=100.0, elastance=1e9, elastance_std=2e8)
    >>> kalman = elastance_filter(ElastanceModel(0.025, noise, prior))
    >>> kalman.predict(u=[[0.0]], F=transitions([8e-6], 0.025)[0])
    >>> kalman.x[:, 0].round(6).tolist()
    [200.0, 1000000000.0]
    """
    # It brings SciPy's distributions and more along: only who filters waits for them.
    from filterpy.kalman import KalmanFilter

    kalman = KalmanFilter(dim_x=2, dim_z=1, dim_u=1)
    prior, noise = model.prior, model.noise
    kalman.x = np.array([[prior.pressure], [prior.elastance]])
    kalman.P = np.diag([prior.pressure_std**2, prior.elastance_std**2])
    kalman.B = np.array([[0.0], [model.angle_gain]])
    kalman.H = np.array([[1.0, 0.0]])
    kalman.Q = np.diag([noise.pressure_step**2, noise.elastance_step**2])
    kalman.R = np.array([[noise.sensor**2]])
    return kalman
