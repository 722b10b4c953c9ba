"""A finger as a linear second-order system, Eq. (4.11)-(4.15): poles, responses, state spaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, final, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats, Number, check_positive, floats, largest_of
from softgrip.errors import InvalidInputError

if TYPE_CHECKING:
    import control


Hold = Literal["linear", "zero"]


@final
@dataclass(frozen=True)
class SecondOrder:
    """A finger by damping ratio and natural frequency, Eq. (4.13) with F = C P.

    Attributes:
        natural_frequency: omega_n, rad/s, > 0. Design 1 of Chapter 3: 2.86 rad/s.
        damping_ratio: zeta, dimensionless, >= 0. Chapter 3: 0.7 +- 0.1.
        gain: Angle held by a constant pressure, rad/Pa, not 0. Eq. (4.14) carries it as ``C / M_eq
            = gain * omega_n**2``.

    Raises:
        InvalidInputError: If a value is outside its range.

    >>> finger = SecondOrder(2.86, 0.7, 2.4e-5)
    >>> np.round(finger.rates, 2).tolist()
    [(2+2.04j), (2-2.04j)]
    """

    natural_frequency: float
    damping_ratio: float
    gain: float = 1.0

    def __post_init__(self) -> None:
        check_positive(natural_frequency=self.natural_frequency)
        if not (np.isfinite(self.damping_ratio) and self.damping_ratio >= 0):
            raise InvalidInputError(
                "damping_ratio", expected="a finite number >= 0", got=self.damping_ratio
            )
        if not np.isfinite(self.gain) or self.gain == 0:
            raise InvalidInputError("gain", expected="a finite number other than 0", got=self.gain)

    @property
    def rates(self) -> tuple[complex, complex]:
        """Rates a and b of the response, 1/s: minus the poles, a complex pair when zeta < 1."""
        fast, slow = _rates(self.natural_frequency, self.damping_ratio)
        return complex(fast), complex(slow)

    @classmethod
    def from_rates(cls, a: complex, b: complex, gain: float = 1.0) -> SecondOrder:
        """Return the system whose response decays at the rates a and b, Eq. (4.12).

        Args:
            a, b: Rates, 1/s: two real numbers > 0, or a complex pair with a real part >= 0.
            gain: Static gain, rad/Pa.

        Raises:
            InvalidInputError: If a and b are no such pair, so that Eq. (4.12) would not be real and
                stable.

        >>> SecondOrder.from_rates(1.99 + 2.04j, 1.99 - 2.04j).natural_frequency.__round__(2)
        2.85
        """
        total, product = complex(a) + complex(b), complex(a) * complex(b)
        # The imaginary parts of a computed pair cancel up to rounding only.
        imaginary = max(abs(total.imag), abs(product.imag) ** 0.5) / (abs(a) + abs(b) or 1.0)
        if not (imaginary < 1e-6 and product.real > 0 and total.real >= 0):
            raise InvalidInputError(
                "a, b", expected="two numbers > 0, or a conjugate pair, real part >= 0", got=(a, b)
            )
        natural_frequency = product.real**0.5
        return cls(natural_frequency, total.real / (2 * natural_frequency), gain)


def upper_pole(natural_frequency: Number, damping_ratio: Number) -> tuple[Number, Number]:
    """Return real and imaginary part of the pole that is not below the real axis, rad/s.

    It is minus the first of `SecondOrder.rates`, or minus its conjugate; of symbols too, of which
    none is complex.

    Args:
        natural_frequency: rad/s, > 0.
        damping_ratio: Dimensionless, >= 0.

    >>> upper_pole(1.0, 0.6)
    (-0.6, 0.8)
    """
    w, z = natural_frequency, damping_ratio
    beyond = z * z - 1
    return (
        -w * (z + largest_of([beyond, 0.0]) ** 0.5),
        w * largest_of([-beyond, 0.0]) ** 0.5,
    )


def step_response(
    time: ArrayLike, natural_frequency: ArrayLike, damping_ratio: ArrayLike
) -> Floats:
    """Return the response to a unit step, Eq. (4.11), divided by the static gain.

    One form serves a complex pair, two equal rates and two real rates. All arguments broadcast:
    with time of shape (N,) and parameters of shape (runs, 1) the result is (runs, N).

    Args:
        time: Time since the step, s, >= 0.
        natural_frequency: rad/s, > 0.
        damping_ratio: Dimensionless, >= 0.

    Raises:
        InvalidInputError: If a value is outside its range.

    >>> step_response([0.0, 1.0], 1.0, 1.0).round(6).tolist()
    [0.0, 0.264241]
    """
    t, w, z = map(np.asarray, (time, natural_frequency, damping_ratio))
    if not (np.all(t >= 0) and np.all(w > 0) and np.all(z >= 0)):
        raise InvalidInputError(
            "time, natural_frequency, damping_ratio", expected=">= 0, > 0, >= 0", got=(t, w, z)
        )
    c, s = free_motion(t, w, z)
    return np.asarray(1 - c - z * w * s)


def free_motion(
    time: ArrayLike, natural_frequency: ArrayLike, damping_ratio: ArrayLike
) -> tuple[Floats, Floats]:
    """Return ``exp(-zeta w t) cosh(d t)`` and ``exp(-zeta w t) sinh(d t) / d``, d = half of a - b.

    Every solution of Eq. (4.12) without input is a sum of the two. The arguments broadcast.
    """
    (t,) = floats(time=time)
    fast, slow = _rates(natural_frequency, damping_ratio)
    x = (fast - slow) * t
    # The quotient is 1 at equal rates, where sinh(d t) / d is t: the critically damped case.
    tiny = np.abs(x) < 1e-12
    quotient = np.where(tiny, 1.0, -np.expm1(-x) / np.where(tiny, 1.0, x))
    decay = np.exp(-slow * t)
    return np.real(decay * (1 + np.exp(-x)) / 2), np.real(decay * t * quotient)


def state_space(system: SecondOrder) -> control.StateSpace:
    """Return the finger as a state space, Eq. (4.14), from pressure [Pa] to angle [rad].

    The states are angle and rate. The equation is printed with P in its numerator, which is then
    the angle and not its ratio to the pressure; here P is the input.
    """
    import control

    w = system.natural_frequency
    return control.ss(
        [[0, 1], [-(w**2), -2 * system.damping_ratio * w]],
        [[0], [system.gain * w**2]],
        [[1, 0]],
        0,
        inputs=["pressure"],
        outputs=["angle"],
        states=["angle", "rate"],
    )


def full_state_space(system: SecondOrder, pump_gain: float) -> control.StateSpace:
    """Return pump and finger as a state space, Eq. (4.15), from motor speed [rad/s] to angle [rad].

    The states are pressure [Pa], angle [rad] and angular rate [rad/s]. The equation is printed with
    the motor speed in its numerator although that is the input, so it holds either for the angle
    itself or for an input that is a share of one set speed; here the speed is the input.

    Args:
        system: The finger.
        pump_gain: Pressure rate per motor speed, ``A l / (2 pi C_i)`` of Eq. (4.5), Pa/s per rad/s,
            > 0, for one constant capacity C_i; else InvalidInputError is raised.
    """
    import control

    check_positive(pump_gain=pump_gain)
    w = system.natural_frequency
    return control.ss(
        [[0, 0, 0], [0, 0, 1], [system.gain * w**2, -(w**2), -2 * system.damping_ratio * w]],
        [[pump_gain], [0], [0]],
        [[0, 1, 0]],
        0,
        inputs=["motor_speed"],
        outputs=["angle"],
        states=["pressure", "angle", "rate"],
    )


def response(
    system: SecondOrder,
    time: ArrayLike,
    pressure: ArrayLike,
    *,
    initial_pressure: float | None = None,
    hold: Hold = "linear",
) -> Floats:
    """Return the angle that a sampled pressure makes, from rest, exactly between the samples.

    Args:
        system: The finger.
        time: Increasing, s, shape (N,), N >= 2; the steps may differ.
        pressure: Pa, shape (N,) or (runs, N).
        initial_pressure: Pressure at which the finger rested before the first sample, Pa; the first
            sample if None.
        hold: Pressure between samples: "linear" for a measured one, "zero" for a held command.

    Returns:
        ndarray: Angle, rad, of the shape of `pressure`.

    Raises:
        InvalidInputError: If the time does not increase, the shapes differ, or `hold` is unknown.

    >>> response(SecondOrder(1.0, 1.0), [0, 1], [1, 1], initial_pressure=0).round(6).tolist()
    [0.0, 0.264241]
    """
    t, p = floats(time=time, pressure=pressure)
    if hold not in get_args(Hold):
        raise InvalidInputError("hold", expected=f"one of {get_args(Hold)}", got=hold)
    if t.ndim != 1 or t.size < 2 or p.shape[-1:] != t.shape:
        raise InvalidInputError(
            "time, pressure", expected="shapes (N,) and (..., N), N >= 2", got=(t.shape, p.shape)
        )
    dt = np.diff(t)
    if not np.all(dt > 0):
        raise InvalidInputError("time", expected="increasing values", got=f"a step of {dt.min():g}")
    w, z = system.natural_frequency, system.damping_ratio
    q = system.gain * np.moveaxis(p, -1, 0)
    step = dt.reshape(-1, *([1] * (q.ndim - 1)))
    slope = np.diff(q, axis=0) / step
    if hold == "zero":
        slope = np.zeros_like(slope)
    c, s = free_motion(dt, w, z)
    # A ramp has the exact solution q - lag * slope; what deviates from it moves freely.
    late = 2 * z / w * slope
    ramp = q[:-1] + slope * step - late
    y = q[0] if initial_pressure is None else np.full(q.shape[1:], system.gain * initial_pressure)
    rows: list[Any] = [c + z * w * s, s, -w * w * s, c - z * w * s, q[:-1], slope, late, ramp]
    if q.ndim == 1:
        # Floats, not numpy scalars, where there is one run: the loop is then ten times as fast.
        y, rows = float(y), [row.tolist() for row in rows]
    rate, angle = 0 * y, [y]
    for yy, yr, ry, rr, start, m, behind, straight in zip(*rows, strict=True):
        dy, dr = y - start + behind, rate - m
        y = straight + yy * dy + yr * dr
        rate = m + ry * dy + rr * dr
        angle.append(y)
    return np.moveaxis(np.array(angle), 0, -1)


def _rates(
    natural_frequency: ArrayLike, damping_ratio: ArrayLike
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    w, z = np.asarray(natural_frequency, np.complex128), np.asarray(damping_ratio, np.complex128)
    fast = w * (z + np.sqrt(z * z - 1))
    # Their product is w**2: the difference would lose the slow rate of a strongly damped system.
    return np.asarray(fast), np.asarray(w * w / fast)
