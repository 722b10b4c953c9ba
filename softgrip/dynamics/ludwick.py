"""The finger as a mass, a damper and a spring after Ludwick's law, Eq. (5.12) to (5.16)."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, Number, chunks, floats
from softgrip.dynamics.integrate import Derivative, rk4
from softgrip.errors import InvalidInputError

LARGEST_STEP = 0.025
"""Of the integration of `pressure_response`, s."""


def modified_moment(fractional_power: Number, width: Number, height: Number) -> Number:
    """Return the modified moment of inertia I_n of a rectangular section, Eq. (5.14).

    ``I_n = (1/2)**n b h**(2 + n) / (2 + n)``. At n = 1 this is ``b h**3 / 6``, twice the
    ``b h**3 / 12`` of Eq. (5.11) to which it is said to degrade. Eq. (3.8) of Chapter 3 has
    ``(1/2)**(1 + n)`` in its place and does degrade; integrating Ludwick's stress over the section
    gives that one too. We keep Eq. (5.14) as it is printed.

    Args:
        fractional_power: n, >= 1.
        width, height: b and h, m, > 0.

    Returns:
        float or ndarray: m^(3 + n).

    >>> modified_moment(1.0, 12.0, 1.0)
    2.0
    """
    n = fractional_power
    return 0.5**n / (2 + n) * width * height ** (2 + n)


def spring_constant(
    young_modulus: Number, fractional_power: Number, width: Number, height: Number, length: Number
) -> Number:
    """Return the spring constant K_n of ``P = K_n theta**n``, Eq. (5.13), with `modified_moment`.

    At n = 1 it is ``E b h**3 / (3 L**2)``, twice the ``E b h**3 / (6 L**2)`` of Eq. (5.10) and
    (5.11): see `modified_moment`.

    Args:
        young_modulus: E, Pa, > 0.
        fractional_power: n, >= 1.
        width, height, length: b, h and L_0, m, > 0.

    Returns:
        float or ndarray: N (per rad**n).
    """
    n = fractional_power
    moment = modified_moment(n, width, height)
    return ((n + 1) / n) ** n * young_modulus * moment / length ** (n + 1)


def restoring_force(angle: Number, stiffness: Number, fractional_power: Number) -> Number:
    """Return the force ``K_n theta**n``, Eq. (5.12), continued as an odd function below zero.

    Args:
        angle: rad, any sign.
        stiffness: K_n, N.
        fractional_power: n, >= 1 (below 1 the slope at zero is infinite); in Eq. (5.15) it is n +
            Dn.

    >>> float(restoring_force(-2.0, 3.0, 2.0))
    -12.0
    """
    return stiffness * angle * np.abs(angle) ** (fractional_power - 1)


@dataclass(frozen=True)
class LudwickFinger:
    """Mass, damper and spring of a finger; each a number, or an array of shape (runs,).

    Attributes:
        mass: M_eq, kg, > 0.
        damping: C_n, N s/rad, >= 0.
        stiffness: K_n, N, >= 0.
        fractional_power: n + Dn, >= 1.
    """

    mass: ArrayLike
    damping: ArrayLike
    stiffness: ArrayLike
    fractional_power: ArrayLike

    def __post_init__(self) -> None:
        for name, least, open_end in (
            ("mass", 0.0, True),
            ("damping", 0.0, False),
            ("stiffness", 0.0, False),
            ("fractional_power", 1.0, False),
        ):
            value = np.asarray(getattr(self, name), dtype=np.float64)
            good = np.isfinite(value) & ((value > least) if open_end else (value >= least))
            if value.ndim > 1 or not good.all():
                sign = ">" if open_end else ">="
                raise InvalidInputError(
                    name, expected=f"a number or (runs,) numbers, {sign} {least:g}", got=value
                )

    def run(self, part: slice, runs: int) -> "LudwickFinger":
        """Return the fingers of some of `runs` runs."""
        fields = (self.mass, self.damping, self.stiffness, self.fractional_power)
        return LudwickFinger(*(np.broadcast_to(np.asarray(f), (runs,))[part] for f in fields))


def acceleration(finger: LudwickFinger, angle: Number, rate: Number, force: Number) -> Number:
    """Return the angular acceleration, Eq. (3.11): what force, damper and spring leave, Eq. (5.15).

    Args:
        finger: Its parameters; its arrays broadcast with the others.
        angle, rate: rad and rad/s.
        force: F, N.

    Returns:
        float or ndarray: rad/s^2.

    >>> float(acceleration(LudwickFinger(2.0, 1.0, 3.0, 1.0), 1.0, 1.0, 10.0))
    3.0
    """
    spring = restoring_force(
        angle, np.asarray(finger.stiffness), np.asarray(finger.fractional_power)
    )
    return (force - np.asarray(finger.damping) * rate - spring) / np.asarray(finger.mass)


def derivative(finger: LudwickFinger, force: ArrayLike) -> Derivative:
    """Return the equation of motion, Eq. (5.16), for `integrate.rk4`; rows are angle and rate.

    Args:
        finger: Its parameters.
        force: F, N, a number or shape (runs,), held over the time integrated.
    """
    m, c, k, f = (
        np.asarray(value, dtype=np.float64)
        for value in (finger.mass, finger.damping, finger.stiffness, force)
    )
    pull, drag, spring = f / m, c / m, k / m
    power = np.asarray(finger.fractional_power, dtype=np.float64) - 1

    def law(_time: float, state: Floats, slope: Floats) -> None:
        angle, rate = state
        slope[0] = rate
        bend = slope[1]
        np.abs(angle, out=bend)
        np.power(bend, power, out=bend)
        bend *= angle
        bend *= spring
        np.subtract(pull, bend, out=bend)
        bend -= drag * rate

    return law


def step_responses(
    finger: LudwickFinger,
    force: ArrayLike,
    times: ArrayLike,
    step: float,
    *,
    runs: int,
    limit: float = 64e6,
) -> Iterator[tuple[slice, Floats]]:
    """Give the angles of step responses from rest, a part of the runs at a time.

    Args:
        finger, force: As in `derivative`, each for one run or for all.
        times: Output times, s, shape (N,), rising from the time of the step.
        step: Integration step, s: see `integrate.step_for`.
        runs: Number of runs, >= 1.
        limit: Largest output held at a time, bytes.

    Yields:
        part, angle (slice, ndarray): The runs, and their angles, rad, shape (N, runs of this part).
            The array is used again for the next part: copy what is to be kept.
    """
    t = np.asarray(times, dtype=np.float64)
    pull = np.broadcast_to(np.asarray(force, dtype=np.float64), (runs,))
    room = np.empty(0)
    for part in chunks(runs, 8.0 * t.size, limit=limit):
        count = part.stop - part.start
        room = room if room.size else np.empty(t.size * count)
        law = derivative(finger.run(part, runs), pull[part])
        angles = room[: t.size * count].reshape(t.size, 1, count)
        rk4(law, np.zeros((2, count)), t, step, keep=(0,), out=angles)
        yield part, angles[:, 0]


def pressure_response(
    finger: LudwickFinger, time: ArrayLike, pressure: ArrayLike, *, force_per_pressure: float
) -> Floats:
    """Return the angle that a measured pressure makes, from rest at angle zero.

    Eq. (5.16) with ``F = force_per_pressure * P`` is integrated by the classical Runge-Kutta
    method. Between samples the pressure runs straight; steps end at the samples if these are even.

    Args:
        finger: One finger, or several as arrays of shape (runs,).
        time: Increasing, s, shape (N,), N >= 2.
        pressure: Gauge, Pa, shape (N,), for all fingers.
        force_per_pressure: F over P, N/Pa.

    Returns:
        ndarray: rad, shape (N,), or (runs, N) for several fingers.

    Raises:
        InvalidInputError: If time or pressure is not as said.

    >>> t = np.linspace(0, 20, 801)
    >>> finger = LudwickFinger(0.1, 0.3, 0.2, 2.5)
    >>> angle = pressure_response(finger, t, 0 * t + 1e4, force_per_pressure=2e-5)
    >>> round(float(angle[-1]), 3)  # at rest K_n theta**n = F
    1.0
    """
    t, p = floats(time=time, pressure=pressure)
    if t.ndim != 1 or t.size < 2 or p.shape != t.shape or not (np.diff(t) > 0).all():
        raise InvalidInputError(
            "time, pressure",
            expected="two arrays of one shape (N,), N >= 2, time rising",
            got=(t.shape, p.shape),
        )
    mass = np.asarray(finger.mass, dtype=np.float64)
    push = force_per_pressure / mass
    still = derivative(finger, 0.0)

    def law(now: float, state: Floats, slope: Floats) -> None:
        still(now, state, slope)
        slope[1] += push * np.interp(now, t, p)

    step = min(float(np.diff(t).min()), LARGEST_STEP)
    angle = rk4(law, np.zeros((2, max(mass.size, 1))), t, step, keep=(0,))[:, 0]
    return np.asarray(angle[:, 0] if mass.ndim == 0 else angle.T)
