"""Numbers in SI that are likely to be in another unit: refused, with the unit that was meant.

The ranges are those of what is built, with a margin, and not those in which a law holds: a finger
of 110 m is no finger, and its design would come out as an optimum all the same.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import floats, is_symbol
from softgrip.errors import InvalidInputError

Units = tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class Plausible:
    """What a quantity can be.

    Attributes:
        what: In words.
        low, high: Least and largest value, SI.
        unit: Of these.
        reason: For the range.
        others: Units that people write instead, with their factors into SI; that which comes
            nearest to the middle of the range is named first.
    """

    what: str
    low: float
    high: float
    unit: str
    reason: str
    others: Units

    def check(self, name: str, value: ArrayLike) -> None:
        """Refuse numbers outside the range.

        Raises:
            InvalidInputError: If one is; says in which units it would lie within.

        >>> LENGTH.check("length", 0.094)
        >>> LENGTH.check("length", 110)
        Traceback (most recent call last):
        softgrip.errors.InvalidInputError: length: expected the length of a finger, 0.001 to 1 m \
(from micro-grippers to arms of 1 m), got '110: probably mm (0.11 m)'
        """
        if is_symbol(value):
            return
        numbers = np.atleast_1d(floats(**{name: value})[0])
        outside = numbers[~((numbers >= self.low) & (numbers <= self.high))]
        if not outside.size:
            return
        first = float(outside[0])
        middle = (self.low * self.high) ** 0.5
        likely = sorted(
            (abs(np.log(first * factor / middle)), unit, first * factor)
            for unit, factor in self.others
            if self.low <= first * factor <= self.high
        )
        meant = [f"{unit} ({value:.3g} {self.unit})" for _, unit, value in likely]
        raise InvalidInputError(
            name,
            expected=f"{self.what}, {self.low:g} to {self.high:g} {self.unit} ({self.reason})",
            got=f"{first:g}" + (f": probably {' or '.join(meant)}" if meant else ""),
        )


_PRESSURES: Units = (
    ("kPa", 1e3),
    ("MPa", 1e6),
    ("bar", 1e5),
    ("psi", 6894.757),
)
_LENGTHS: Units = (("mm", 1e-3), ("cm", 1e-2), ("um", 1e-6), ("in", 0.0254))

PRESSURE = Plausible(
    "a gauge pressure", 500.0, 3e6, "Pa", "fingers bend at 1 kPa to 1 MPa", _PRESSURES
)
YOUNG_MODULUS = Plausible(
    "Young's modulus of an elastomer", 1e3, 1e9, "Pa", "from gels to hard urethanes", _PRESSURES
)
STRENGTH = Plausible(
    "the tensile strength of an elastomer", 1e4, 2e8, "Pa", "from foams to urethanes", _PRESSURES
)
VISCOSITY = Plausible(
    "a mixed viscosity", 0.05, 2e3, "Pa s", "what can be poured or pressed into a mould",
    (("cP (mPa s)", 1e-3), ("P", 0.1)),
)  # fmt: skip
LENGTH = Plausible(
    "the length of a finger", 1e-3, 1.0, "m", "from micro-grippers to arms of 1 m", _LENGTHS
)
DIMENSION = Plausible(
    "a dimension of a finger's section", 5e-5, 0.3, "m", "what can be cast", _LENGTHS
)
MASS = Plausible("a mass", 1e-4, 50.0, "kg", "a finger and what it holds", (("g", 1e-3),))
ANGLE = Plausible(
    "an angle", 1e-3, 50.0, "rad", "eight turns; 50 deg is 0.87 rad", (("deg", np.pi / 180),)
)
AREA = Plausible(
    "the cross-section of a syringe", 1e-6, 0.1, "m^2", "inside diameters of 1 mm to 36 cm",
    (("mm^2", 1e-6), ("cm^2", 1e-4)),
)  # fmt: skip
LEAD = Plausible("the lead of a screw", 1e-4, 0.2, "m", "travel in one turn", _LENGTHS)
