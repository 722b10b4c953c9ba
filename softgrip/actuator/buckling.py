"""Up to which pressure a finger whose tip is held does not buckle.

Section 3.4 says that a softer finger buckles, and that one with more chambers would, so that its
torque stays behind; it gives no criterion. This is ours, from two classical results:

- a closed tube whose ends are held apart buckles as a column under the push of the pressure on its
  end, ``P A_c`` (J. A. Haringx, Philips Research Reports 7, 1952);
- a column of a rubber that is not linear buckles by its tangent modulus, ``pi**2 E_t I / (K L)**2``
  (F. Engesser, 1889), here ``E_t = n E e**(n - 1)`` of Ludwick's law at the strain to which Eq.
  (3.3) stretches the wall, ``E e**n = P_w``.

Put together, ``P A_c = pi**2 E_t I / (K L)**2`` solved for P is `buckling_pressure`. Assumed is:
the *whole* push acts along the finger, which is the most that can; the wall is as stretched as that
of a free finger, which is the stiffest that it can be; the section is solid, as in Eq. (3.8); and
the ends do not turn, K = 1/2. With K of another textbook case (0.7, 1, 2) or with n = 1 Design 1
would buckle below the 0.25 MPa at which it was measured. With K = 1/2 it does not, and Design 3
does between 0.1 MPa, up to which all three designs are alike, and 0.25 MPa. So the criterion is
held against three printed facts and chosen by one of them; it is no more than that.
"""

from math import pi

from softgrip.actuator.bending import Finger
from softgrip.actuator.section import chamber_area, wall_area
from softgrip.arrays import Number, least_of

HELD = 0.5
"""K of a column whose ends neither move apart nor turn."""


def moments(width: Number, height: Number) -> tuple[Number, Number]:
    """Return the second moments of area of a solid rectangle, up and aside, m^4.

    >>> [12 * moment for moment in moments(2.0, 1.0)]
    [2.0, 8.0]
    """
    return width * height**3 / 12, height * width**3 / 12


def buckling_pressures(finger: Finger, end_factor: float = HELD) -> tuple[Number, Number]:
    """Return the gauge pressures at which a finger whose tip is held buckles up and aside, Pa.

    ``E n**n (pi**2 I / (K L)**2)**n / (A_c A_w**(n - 1))``: they grow with E, and fall with the
    length to the power 2 n. They grow with I, thus with a, b and w, and fall with both areas.

    Args:
        finger: Its section, length and material; floats, arrays or symbols.
        end_factor: K, of the ends.
    """
    section, n = finger.section, finger.fractional_power
    areas = chamber_area(section) * wall_area(section) ** (n - 1)
    columns = (
        n * pi**2 * moment / (end_factor * finger.length) ** 2
        for moment in moments(section.width, section.height)
    )
    up, aside = (finger.young_modulus * column**n / areas for column in columns)
    return up, aside


def buckling_pressure(finger: Finger, end_factor: float = HELD) -> Number:
    """Return the lower of the two `buckling_pressures`, Pa.

    >>> from softgrip.actuator.section import Section
    >>> soft = Finger(Section(0.020, 0.004, 0.030, 0.0015), 0.094, 0.26e6, 1.538)  # Design 3
    >>> round(buckling_pressure(soft) / 1e6, 3)
    0.129
    """
    return least_of(buckling_pressures(finger, end_factor))
