"""The cantilever of Figure 3.4 at any rotation: what Eq. (3.13) is right up to.

With the angle theta along the arc length s and ``kappa = dtheta/ds``, Ludwick's law gives
``M = E I_n kappa**n``, and a force F across the tip gives ``dM/ds = -F cos(theta - beta)``. Here
beta is 0 for a dead load, which keeps its direction, and the tip's angle for a follower, which
turns with the tip. Eq. (3.13) puts 1 for the cosine. The true lever arm is shorter, so the closed
form says too large an angle. The first term of a series in the angle is ``theta**2 / (18 n + 12)``
of it for a follower, and ``theta**2 (1 - n / (2 n + 1) + n / (9 n + 6)) / (2 n)`` for a dead load:
1/30 and 11/30 of ``theta**2`` at n = 1.

Pressure is neither of the two. It makes a moment T that is the same along the whole finger, which
bends to an arc of ``theta = L (T / (E I_n))**(1/n)``, exactly and at any angle. Eq. (3.7) has
``n / (n + 1)`` times that: it is the angle by a tip force F = T / L.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad, solve_bvp
from scipy.optimize import brentq

from softgrip.actuator.bending import Finger, check_power, modified_moment
from softgrip.actuator.frequency import spring_constant
from softgrip.arrays import Floats, read_only
from softgrip.errors import InvalidInputError

TOLERANCE = 1e-8
"""Of the boundary-value problem, relative; angles come out to about 1e-10 rad."""


@dataclass(frozen=True)
class BentShape:
    """A bent finger; each array has shape (N,), from the base to the tip.

    Attributes:
        arc_length: s, m, 0 to L.
        angle: theta, rad, 0 at the base.
        curvature: kappa, 1/m.
        x, y: Along the straight finger and across it, towards the force, m.
    """

    arc_length: Floats
    angle: Floats
    curvature: Floats
    x: Floats
    y: Floats

    @property
    def tip_angle(self) -> float:
        """Theta at the tip, rad."""
        return float(self.angle[-1])

    @property
    def tip(self) -> tuple[float, float]:
        """Place of the tip, (x, y), m."""
        return float(self.x[-1]), float(self.y[-1])


def tip_force_angle(finger: Finger, force: float) -> float:
    """Return theta, rad, by the closed form for a force across the tip [N], Eq. (3.13)."""
    return float((force / spring_constant(finger)) ** (1 / finger.fractional_power))


def constant_moment_angle(finger: Finger, moment: float) -> float:
    """Return the exact theta, rad, for a moment that is the same along the finger, N m.

    >>> from softgrip.actuator.section import Section
    >>> finger = Finger(Section(0.02, 0.004, 0.03, 0.0015), fractional_power=2.5)
    >>> round(tip_force_angle(finger, 0.1 / 0.094) / constant_moment_angle(finger, 0.1), 4)
    0.7143
    """
    return float(finger.length * (moment / _stiffness(finger)) ** (1 / finger.fractional_power))


def bend(
    finger: Finger, *, force: float = 0.0, moment: float = 0.0, follower: bool = False
) -> BentShape:
    """Solve the boundary-value problem of the finger, fixed at its base and loaded at its tip.

    Args:
        finger: Its section counts as a solid rectangle, Eq. (3.8).
        force: F, N, >= 0, across the straight finger.
        moment: At the tip, N m, >= 0.
        follower: Whether the force turns with the tip, and does not stay as it is.

    Raises:
        InvalidInputError: If a load is negative or not finite, or so large that no shape is found.
            Tried for n from 1 to 3 up to tip angles of 85 degrees by a dead load and 170 by a
            follower.
    """
    for name, value in (("force", force), ("moment", moment)):
        if not (np.isfinite(value) and value >= 0):
            raise InvalidInputError(name, expected="a finite number >= 0", got=value)
    n, length = finger.fractional_power, finger.length
    load = force * length ** (n + 1) / _stiffness(finger)
    end = moment * length**n / _stiffness(finger)

    # Measured from the tip, where the curvature of a tip force grows as (1 - s)**(1/n): as a
    # function of r, with 1 - s = r**3, the solution is smooth for all n up to 3.
    def slope(r: Floats, state: Floats, tip: Floats) -> Floats:
        angle, bending, _, _ = state
        curvature = np.sign(bending) * np.abs(bending) ** (1 / n)
        lever = load * np.cos(angle - tip[0] if follower else angle)
        slopes: Floats = np.array([curvature, -lever, np.cos(angle), np.sin(angle)])
        return -3 * r**2 * slopes

    def ends(tip: Floats, base: Floats, unknown: Floats) -> Floats:
        return np.array([tip[0] - unknown[0], tip[1] - end, base[0], base[2], base[3]])

    r = np.linspace(0, 1, 51)
    limit = np.pi if follower else np.pi / 2
    guess = limit * np.tanh(n / (n + 1) * load ** (1 / n) / limit) + end ** (1 / n)
    start = np.array([guess * (1 - r**4), load * r**3 + end, 1 - r**3, 0 * r])
    found = solve_bvp(slope, ends, r, start, p=[guess], tol=TOLERANCE, max_nodes=5000)
    # A heavy load also holds shapes that bend both ways; they are not meant.
    if not found.success or found.y[1].min() < -1e-6 * (load + end):
        raise InvalidInputError(
            "force, moment", expected="loads that bend the finger one way", got=(force, moment)
        )
    angle, bending, x, y = found.y[:, ::-1]
    curvature = np.sign(bending) * np.abs(bending) ** (1 / n) / length
    columns = (length * (1 - found.x[::-1] ** 3), angle, curvature, length * x, length * y)
    return BentShape(*map(read_only, columns))


def load_number(tip_angle: float, fractional_power: float, *, follower: bool = False) -> float:
    """Return ``F L**(n + 1) / (E I_n)`` of the force that holds a tip angle, by quadrature.

    ``dM/ds`` times kappa integrates once: ``n / (n + 1) E I_n kappa**(n + 1) = F g``, with
    ``g = sin(theta_tip) - sin(theta)`` for a dead load and ``sin(theta_tip - theta)`` for a
    follower. Then L is the integral of ``dtheta / kappa``.

    Args:
        tip_angle: rad, > 0, below pi/2 for a dead load and below pi for a follower.
        fractional_power: n, >= 1.
        follower: As in `bend`.

    Raises:
        InvalidInputError: If a value is out of its range.
    """
    check_power(fractional_power)
    limit = np.pi if follower else np.pi / 2
    if not 0 < tip_angle < limit:
        raise InvalidInputError("tip_angle", expected=f"0 < rad < {limit:.4f}", got=tip_angle)
    n = fractional_power
    p = 1 / (n + 1)

    def smooth(u: float) -> float:  # (g / u)**-p, u = theta_tip - theta
        if follower:
            return float(np.sinc(u / np.pi) ** -p)
        return float((np.cos(tip_angle - u / 2) * np.sinc(u / (2 * np.pi))) ** -p)

    whole = quad(smooth, 0, tip_angle, weight="alg", wvar=(-p, 0), epsabs=0, epsrel=1e-11)[0]
    return float(n / (n + 1) * whole ** (n + 1))


def closed_form_error(
    tip_angle: float, fractional_power: float, *, follower: bool = False
) -> float:
    """Return by how much of the true tip angle the closed form exceeds it; see `load_number`.

    >>> round(closed_form_error(np.radians(45), 1.0), 3)
    0.282
    """
    n = fractional_power
    load = load_number(tip_angle, n, follower=follower)
    return float(n / (n + 1) * load ** (1 / n) / tip_angle - 1)


def angle_limit(error: float, fractional_power: float, *, follower: bool = False) -> float:
    """Return the tip angle, rad, up to which the closed form errs by `error`, a part, > 0."""
    largest = np.pi / 2 if not follower else np.pi
    low, high = 1e-3 * largest, (1 - 1e-6) * largest

    def excess(angle: float) -> float:
        return closed_form_error(angle, fractional_power, follower=follower) - error

    if not (excess(low) < 0 < excess(high)):
        raise InvalidInputError("error", expected="a part that is reached, > 1e-5", got=error)
    return float(brentq(excess, low, high, xtol=1e-9))


def _stiffness(finger: Finger) -> float:
    n, section = finger.fractional_power, finger.section
    return float(finger.young_modulus * modified_moment(n, section.width, section.height))
