"""Loop shaping by a controller of fixed order, under a bound on the coprime-factor margin.

Glover and McFarlane's controller is the most robust one, mixed sensitivity follows a target loop
best; this lies between. For a target loop ``Gd = c / s`` it takes

1. a prefilter W that gives the plant the target's crossover (`softgrip.gripper.prefilter`), and
   the shaped plant ``Gs = G W``;
2. the largest coprime-factor margin that a controller of Gs can have, less the usual step back of
   1 % (`softgrip.gripper.loop_shaping`);
3. of the controllers Ks of a given order whose margin is a share of that or more, the one with the
   least peak over frequency of ``[W1 S; W3 T]``, where ``W1 = Gd + 1/2`` and ``W3 = 1/Gd + 1/2``,
   both levelled at 60 dB. The plant's own controller is ``W Ks``.

MathWorks' help states this of ``loopsyn`` since R2021b, with half of the largest margin by default;
it does not give the 1/2, the 60 dB, the 1 % and the order. With these the rule brings out both
filters H(s) that Section 6.4 prints, and with others it does not. What is here is an implementation
of its own in SciPy; MATLAB was not run.

At an optimum of peaks several of them are equal, and the bound on the margin is reached. A pole of
Ks far beyond the crossover hardly moves the least peak, by some thousandths for the printed
filters: one that is known can be held.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import final

import control
import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize
from scipy.signal import argrelmax

from softgrip.arrays import Floats, check_positive, read_only
from softgrip.errors import InvalidInputError, SoftgripError
from softgrip.gripper.loop_shaping import BACK_OFF, glover_mcfarlane, least_gamma
from softgrip.gripper.order_reduction import reduce_order
from softgrip.gripper.prefilter import polynomials, prefilter
from softgrip.gripper.shaping_filter import filter_state_space

SHARE = 0.5
"""Of the largest margin that is kept."""
ORDER = 3
"""Of the controller of the shaped plant."""
ASYMPTOTE = 0.5
"""What W1 and W3 are where the target loop does not ask for more."""
LEVEL = 1e3
"""At which they are levelled: 60 dB."""
FINE = np.concatenate([[1e-9, 1e-6], np.geomspace(1e-4, 1e4, 8001), [1e6, 1e9]])
"""Frequencies over the crossover at which peaks are taken; the ends stand for 0 and infinity."""


class NoControllerError(SoftgripError):
    """No controller of the order was found that keeps the margin."""


@final
@dataclass(frozen=True)
class ShapedLoop:
    """A shaped plant, a controller of it, and a target loop that the two are judged by.

    Attributes:
        shape: Gs.
        controller: Ks, with negative feedback.
        crossover: c of the target loop ``c / s``, rad/s.
    """

    shape: control.TransferFunction
    controller: control.TransferFunction
    crossover: float

    @cached_property
    def largest_margin(self) -> float:
        """The coprime-factor margin that no controller of the shaped plant exceeds."""
        return 1 / least_gamma(_realized(self.shape))

    def mixed_sensitivity(self, frequency: ArrayLike) -> Floats:
        """Return the size of ``[W1 S; W3 T]`` at frequencies in rad/s, shape (N,)."""
        s = 1j * np.asarray(frequency, np.float64) / self.crossover
        loop = self.shape(s * self.crossover) * self.controller(s * self.crossover)
        W1, W3 = weights(s)
        return np.asarray(np.sqrt(W1**2 + (W3 * abs(loop)) ** 2) / abs(1 + loop))

    def coprime_gain(self, frequency: ArrayLike) -> Floats:
        """Return the size of ``[I; K] S [I, G]``, whose peak is one over the margin, shape (N,)."""
        s = 1j * np.asarray(frequency, np.float64)
        G, K = self.shape(s), self.controller(s)
        return np.asarray(np.sqrt((1 + abs(G) ** 2) * (1 + abs(K) ** 2)) / abs(1 + G * K))

    @cached_property
    def cost(self) -> float:
        """The peak of the mixed sensitivity, which the controller should make small."""
        return float(self.mixed_sensitivity(self.crossover * FINE).max())

    @cached_property
    def margin(self) -> float:
        """The coprime-factor margin; 0 if the loop is not stable."""
        return float(1 / self.coprime_gain(self.crossover * FINE).max()) if self.stable else 0.0

    @property
    def stable(self) -> bool:
        """Whether all poles of the closed loop lie in the open left half plane."""
        return bool(np.roots(self.coefficients[1]).real.max() < 0)

    @cached_property
    def coefficients(self) -> tuple[Floats, Floats]:
        """Numerator and denominator of H, highest power first, the latter starting with 1."""
        (top, low), (over, under) = polynomials(self.shape), polynomials(self.controller)
        numerator = np.polymul(top, over)
        denominator = np.polyadd(np.polymul(low, under), numerator)
        return numerator / denominator[0], denominator / denominator[0]

    @property
    def complementary(self) -> control.TransferFunction:
        """``H = Gs Ks / (1 + Gs Ks)``, the complementary sensitivity."""
        return control.tf(*self.coefficients)


def shaped_plant(plant: control.LTI, crossover: float) -> control.TransferFunction:
    """Return ``Gs = G W`` for the target loop ``crossover / s``.

    Args:
        plant: One input, one output, continuous, proper.
        crossover: rad/s, > 0.
    """
    top, low = polynomials(plant)
    W = prefilter(plant, crossover)
    return control.tf(np.polymul(top, W.num[0][0]), np.polymul(low, W.den[0][0]))


def weights(s: np.ndarray, asymptote: float = ASYMPTOTE) -> tuple[Floats, Floats]:
    """Return ``|W1|`` and ``|W3|`` at ``s`` in units of the crossover, with their asymptote.

    >>> [w.round(2).tolist() for w in weights(np.array([1e-9j, 1j, 1e9j]))]
    [[1000.0, 1.12, 0.5], [0.5, 1.12, 1000.0]]
    """
    return (
        np.asarray(np.abs((asymptote * s + 1) / (s + 1 / LEVEL))),
        np.asarray(np.abs((s + asymptote) / (s / LEVEL + 1))),
    )


def _realized(system: control.TransferFunction) -> control.StateSpace:
    """Return a system in scaled companion form."""
    top, low = polynomials(system)
    direct, rest = np.polydiv(top, low)
    strictly = filter_state_space(rest, low)
    return control.ss(strictly.A, strictly.B, strictly.C, direct.sum())


def loop_of_filter(
    numerator: ArrayLike, denominator: ArrayLike, plant: control.LTI, crossover: float
) -> ShapedLoop:
    """Return the loop that a given H would be of, with the controller that it implies.

    Args:
        numerator, denominator: Coefficients of H, highest power first.
        plant, crossover: Of the loop that it is taken for.
    """
    shape = shaped_plant(plant, crossover)
    under = read_only(denominator)
    over = np.pad(read_only(numerator), (len(under) - np.size(numerator), 0))
    top, low = polynomials(shape)
    of_loop = read_only(np.polymul(over, low)), read_only(np.polymul(under - over, top))
    # An integrator of the plant is in both.
    common = min(len(p) - len(np.trim_zeros(p, "b")) for p in of_loop)
    return ShapedLoop(shape, control.tf(*(p[: len(p) - common] for p in of_loop)), crossover)


def shape_loop(
    plant: control.LTI,
    crossover: float,
    *,
    order: int = ORDER,
    share: float = SHARE,
    back_off: float = BACK_OFF,
    held_pole: float | None = None,
) -> ShapedLoop:
    """Return the loop whose controller follows ``crossover / s`` best with a margin to keep.

    Args:
        plant: G: one input, one output, minimal, continuous, proper.
        crossover: c, rad/s, > 0.
        order: Of the controller Ks, >= 1.
        share: Of the largest margin that Ks keeps, 0 to 1: towards 1 it is the most robust one.
        back_off: The largest margin is first divided by this, > 1.
        held_pole: Decay rate of a real pole that Ks is given, rad/s, > 0; None leaves all free.

    Raises:
        InvalidInputError: If an argument is not as described.
        NoControllerError: If none is found that keeps the margin.

    >>> loop = shape_loop(control.tf([1.0], [1.0, 1.0, 0.0]), 3.0, order=2)
    >>> round(loop.margin / loop.largest_margin, 4)  # 0.5 / 1.01
    0.495
    """
    check_positive(crossover=crossover, order=order, share=share)
    if not (share < 1 and back_off > 1 and order == int(order)):
        raise InvalidInputError(
            "share, back_off, order",
            expected="0 < share < 1, back_off > 1, a whole order",
            got=(share, back_off, order),
        )
    shape = shaped_plant(plant, crossover)
    # Frequencies are counted in units of the crossover from here on.
    top, low = _scaled(*polynomials(shape), crossover)
    robust = glover_mcfarlane(_realized(control.tf(top, low)), factor=back_off)
    least = share / (back_off * robust.gamma)
    held = None
    if held_pole is not None:
        check_positive(held_pole=held_pole)
        held = held_pole / crossover
    form = _Form(order, held)
    search = _Search(top, low, least, form)
    best = form.polynomials(search.best(form.start(robust.controller)))
    found = ShapedLoop(shape, control.tf(*_scaled(*best, 1 / crossover)), crossover)
    if not found.margin > (1 - 1e-3) * least:
        raise NoControllerError(
            f"no controller of order {order} was found with a margin of {least:.3g}, {share:g} of "
            f"the largest: it came to {found.margin:.3g}. Try a higher order or a smaller share."
        )
    return found


def _scaled(top: Floats, low: Floats, unit: float) -> tuple[Floats, Floats]:
    """Return the polynomials of a ratio with s counted in units, the lower one starting with 1."""
    powers = np.arange(len(low))
    return top / unit ** powers[-len(top) :], low / unit**powers


@final
@dataclass(frozen=True)
class _Form:
    """A controller as real quadratic and linear factors, whose coefficients are free.

    A vector of the form is: gain, coefficients of the numerator's factors, of the denominator's.
    """

    order: int
    held: float | None

    def start(self, controller: control.StateSpace) -> Floats:
        """Return the vector of a controller, brought to the order by truncation or by pairs."""
        if controller.nstates > self.order:
            controller = reduce_order(controller, self.order)
        over, under = polynomials(controller)
        zeros, poles = np.roots(over), np.roots(under)
        fastest = np.abs(poles).max()
        gain = over[0]
        for k in range(self.order - len(poles)):
            pair = -fastest * 3.0 ** (k + 1)
            zeros, poles = np.append(zeros, pair), np.append(poles, pair)
        for _ in range(len(poles) - len(zeros)):  # a strictly proper one gets zeros far away
            far = 3 * np.abs(poles).max()
            zeros, gain = np.append(zeros, -far), gain / far
        if self.held is not None:
            real = np.flatnonzero((poles.imag == 0) & (poles.real < 0))
            if not len(real):
                raise InvalidInputError(
                    "held_pole", expected="None, as the start has no real pole", got=self.held
                )
            replaced = real[np.argmin(poles[real].real)]
            gain *= self.held / abs(poles[replaced])
            poles = np.delete(poles, replaced)
        return np.array([gain, *_factored(zeros), *_factored(poles)])

    def polynomials(self, x: Floats) -> tuple[Floats, Floats]:
        """Return numerator and denominator."""
        over, under = np.array([x[0]]), np.array([1.0] if self.held is None else [1.0, self.held])
        for factor in _factors(x[1 : 1 + self.order]):
            over = np.polymul(over, factor)
        for factor in _factors(x[1 + self.order :]):
            under = np.polymul(under, factor)
        return over, under

    def response(self, x: Floats, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return K at s, shape (N,), and the slopes of its logarithm, shape (len(x), N)."""
        zeros, poles = _factors(x[1 : 1 + self.order]), _factors(x[1 + self.order :])
        value = np.full(len(s), x[0], np.complex128)
        value /= 1 if self.held is None else s + self.held
        slopes: list[np.ndarray] = [np.full(len(s), 1 / x[0])]
        for factors, sign in ((zeros, 1), (poles, -1)):
            for factor in factors:
                at = np.polyval(factor, s)
                value *= at**sign
                slopes += [np.asarray(sign * s**k / at) for k in range(len(factor) - 2, -1, -1)]
        return value, np.array(slopes)


def _factors(coefficients: Floats) -> list[Floats]:
    """Return the factors ``s^2 + a s + b``, and ``s + a`` if the number is odd."""
    cut = range(0, len(coefficients), 2)
    return [np.concatenate([[1.0], coefficients[k : k + 2]]) for k in cut]


def _factored(roots: np.ndarray) -> list[float]:
    """Return the coefficients of the factors of a real polynomial; an odd root is the fastest."""
    real = sorted(roots[roots.imag == 0].real, key=abs)
    alone = [real.pop()] if len(real) % 2 else []
    pairs = [(z, z.conj()) for z in roots if z.imag > 0]
    pairs += zip(real[::2], real[1::2], strict=True)
    found = [part for a, b in pairs for part in (-(a + b).real, (a * b).real)]
    return found + [-root for root in alone]


@final
class _Search:
    """The search for the vector with the least peak, by sequential quadratic programs.

    Both criteria are taken as logarithms. A program has them at a coarse grid of frequencies and at
    the peaks that they were found to have; the box that a program may search is halved when it
    leaves the stable loops.
    """

    COARSE = np.concatenate([[1e-9], np.geomspace(1e-4, 1e5, 30), [1e9]])
    ROUNDS, PATIENCE, MEMORY = 40, 12, 8

    def __init__(self, top: Floats, low: Floats, least: float, form: _Form) -> None:
        self.top, self.low, self.least, self.form = top, low, least, form

    def best(self, start: Floats) -> Floats:
        """Return the best vector near a start."""
        # The inverse hyperbolic sine counts large numbers by their logarithm, small ones evenly.
        y, box, before = np.arcsinh(start), 1.0, np.inf
        peaks: list[Floats] = []
        for k in range(self.ROUNDS):
            cost = self._criteria(np.sinh(y), FINE)[0].max()
            # Peaks of long ago have moved on, those of the last rounds are kept.
            peaks = [*peaks[-self.MEMORY :], self._peaks(np.sinh(y))]
            grid = np.unique(np.concatenate([self.COARSE, *peaks]))
            found = self._program(y, cost, grid, box)
            if not self._stable(np.sinh(found)):
                box /= 2
                continue
            moved, y = np.abs(found - y).max(), found
            # With more freedom than the peaks use up, what is left may slide for ever.
            if moved < 1e-6 or (k > self.PATIENCE and abs(before - cost) < 1e-6):
                break
            before = cost
        return np.asarray(np.sinh(y))

    def _program(self, y: Floats, cost: float, grid: Floats, box: float) -> Floats:
        def constraints(z: Floats) -> Floats:
            J, M, *_ = self._criteria(np.sinh(z[:-1]), grid)
            return np.concatenate([z[-1] - J, -M])

        def slopes(z: Floats) -> Floats:
            *_, J, M = self._criteria(np.sinh(z[:-1]), grid)
            inner = np.cosh(z[:-1])
            return np.vstack(
                [
                    np.column_stack([-J * inner, np.ones(len(J))]),
                    np.column_stack([-M * inner, np.zeros(len(M))]),
                ]
            )

        found = minimize(
            lambda z: (z[-1], np.append(np.zeros(len(y)), 1.0)),
            np.append(y, cost),
            jac=True,
            bounds=[*((value - box, value + box) for value in y), (None, None)],
            constraints=[{"type": "ineq", "fun": constraints, "jac": slopes}],
            method="SLSQP",
            options={"maxiter": 100, "ftol": 1e-13},
        )
        return np.asarray(found.x[:-1])

    def _criteria(self, x: Floats, frequency: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """Return cost and margin's excess as logarithms, and their slopes, shape (N, len(x))."""
        s = 1j * frequency
        G = np.polyval(self.top, s) / np.polyval(self.low, s)
        K, slopes = self.form.response(x, s)
        loop = G * K
        W1, W3 = weights(s)
        mixed = W1**2 + (W3 * np.abs(loop)) ** 2
        apart = 2 * np.log(np.abs(1 + loop))
        coprime = (1 + np.abs(G) ** 2) * (1 + np.abs(K) ** 2)
        common = 2 * np.real(slopes * (loop / (1 + loop)))
        of_mixed = 2 * slopes.real * (W3 * np.abs(loop)) ** 2 / mixed - common
        of_coprime = 2 * slopes.real * np.abs(K) ** 2 / (1 + np.abs(K) ** 2) - common
        excess = np.log(coprime) - apart + 2 * np.log(self.least)
        return np.log(mixed) - apart, excess, of_mixed.T, of_coprime.T

    def _peaks(self, x: Floats) -> Floats:
        """Return where the two criteria have peaks, with the neighbours of each."""
        at = np.concatenate([argrelmax(c)[0] for c in self._criteria(x, FINE)[:2]])
        return np.asarray(FINE[np.unique(np.add.outer(at, [-1, 0, 1]))])

    def _stable(self, x: Floats) -> bool:
        over, under = self.form.polynomials(x)
        closed = np.polyadd(np.polymul(over, self.top), np.polymul(under, self.low))
        return bool(np.isfinite(closed).all() and np.roots(closed).real.max() < 0)
