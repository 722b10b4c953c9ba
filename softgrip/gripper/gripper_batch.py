"""Many grippers at once: how they are drawn from the uncertainty, and what they are put through."""

from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from softgrip.arrays import Floats, check_positive
from softgrip.checks import check_not_negative
from softgrip.errors import InvalidInputError
from softgrip.gripper.plant import Gripper
from softgrip.gripper.uncertainty import DAMPING_BOUND, STIFFNESS_BOUND

Bools = NDArray[np.bool_]


@final
@dataclass(frozen=True)
class GripperBatch:
    """Grippers of equally many fingers; each array has the shape (count, fingers).

    Attributes:
        damping, stiffness, gain: As of `FingerDynamics`, finite and > 0: 1/s, 1/s^2, rad/s^3 per
            unit of the input.
        first: Number of the first gripper in its study: what chance gives to a gripper hangs on its
            number alone, not on the batch that it is in.

    Raises:
        InvalidInputError: If the arrays are not of one shape with two axes, or a number is not
            above zero.

    >>> from softgrip.gripper.plant import PRINTED
    >>> draw_grippers(PRINTED, 3, seed=1).take(slice(1, 3)).first
    1
    """

    damping: Floats
    stiffness: Floats
    gain: Floats
    first: int = 0

    def __post_init__(self) -> None:
        arrays = (self.damping, self.stiffness, self.gain)
        if self.damping.ndim != 2 or len({a.shape for a in arrays}) > 1:
            raise InvalidInputError(
                "damping, stiffness, gain",
                expected="arrays of one shape (count, fingers)",
                got=[a.shape for a in arrays],
            )
        check_positive(damping=self.damping, stiffness=self.stiffness, gain=self.gain)

    @classmethod
    def of(cls, *grippers: Gripper) -> "GripperBatch":
        """Return the batch of some grippers with equally many fingers."""
        damping, stiffness, gain = (
            np.array([[getattr(f, name) for f in g.fingers] for g in grippers])
            for name in ("damping", "stiffness", "gain")
        )
        return cls(damping, stiffness, gain)

    @property
    def count(self) -> int:
        """Number of grippers."""
        return int(self.damping.shape[0])

    @property
    def fingers(self) -> int:
        """Number of fingers of each."""
        return int(self.damping.shape[1])

    def take(self, part: slice) -> "GripperBatch":
        """Return the grippers of a slice with a start and without a step."""
        return GripperBatch(
            self.damping[part], self.stiffness[part], self.gain[part], self.first + part.start
        )


def uniforms(seed: int, stream: int, first: int, shape: tuple[int, ...]) -> Floats:
    """Return uniform numbers in (0, 1), those of item `first` and on, whatever is drawn with them.

    One stream serves all items: each takes as many numbers as ``shape[1:]`` says, and the
    generator is moved on past those of the items before. A generator for each would cost more than
    the simulation.

    Args:
        seed, stream: Of the study, and of what the numbers are for.
        first: Number of the first item, >= 0.
        shape: Items, then numbers of an item.
    """
    generator = np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(stream,)))
    generator.advance(first * int(np.prod(shape[1:])))
    # Half a step off, so that neither 0 nor 1 is ever drawn.
    return np.asarray(np.random.Generator(generator).random(shape) + 2.0**-54)


def draw_grippers(
    nominal: Gripper,
    count: int,
    *,
    seed: int = 0,
    first: int = 0,
    damping: float = DAMPING_BOUND,
    stiffness: float = STIFFNESS_BOUND,
) -> GripperBatch:
    """Draw grippers whose fingers deviate from nominal, each finger on its own.

    Section 6.4 gives bounds on C_n and K_n and no distribution: the deviations are uniform between
    the bounds, independent of each other. The gain, which holds neither, stays nominal.

    Args:
        nominal: The gripper about which they lie.
        count: How many, >= 1.
        seed: Of the study.
        first: Number of the first, >= 0: grippers 5 to 9 of a seed are the same, drawn alone or
            with others.
        damping, stiffness: Largest deviations as shares of nominal, 0 <= share < 1.

    Raises:
        InvalidInputError: If an argument is outside its range.
    """
    if count < 1 or first < 0:
        raise InvalidInputError("count, first", expected=">= 1 and >= 0", got=(count, first))
    if not (0 <= damping < 1 and 0 <= stiffness < 1):
        raise InvalidInputError(
            "damping, stiffness", expected="0 <= share < 1", got=(damping, stiffness)
        )
    middle = GripperBatch.of(nominal)
    deviation = 2 * uniforms(seed, 0, first, (count, 2, middle.fingers)) - 1
    return GripperBatch(
        middle.damping * (1 + damping * deviation[:, 0]),
        middle.stiffness * (1 + stiffness * deviation[:, 1]),
        np.repeat(middle.gain, count, axis=0),
        first,
    )


def can_rest(grippers: GripperBatch, target: ArrayLike, band: float) -> Bools:
    """Return which grippers have a place of the pump that rests all fingers within their bands.

    At rest the pump's one number gives each finger ``gain / stiffness`` times itself. Where no
    number serves all, no controller settles the gripper, whatever it knows.

    Args:
        grippers: The grippers.
        target: Angle of each finger, rad, > 0, shape (fingers,).
        band: Half width as a share of each target, 0 to 1.

    Returns:
        ndarray: Shape (count,).
    """
    pump = np.asarray(target) * grippers.stiffness / grippers.gain
    return np.asarray((1 - band) * pump.max(axis=1) <= (1 + band) * pump.min(axis=1))


@final
@dataclass(frozen=True)
class Trial:
    """A step from rest at angle 0 in the sampled loop.

    Attributes:
        target: Angle of each finger, rad, not 0: its share of the desired output, Eq. (6.25).
        duration: s, a whole number of periods.
        period: Time between commands, s; Section 6.4 has 100 ms.
        plant_step: Time between the points at which the fingers are looked at, s; divides the
            period.
        limit: Largest absolute command, > 0.
        noise: Standard deviation of the measured angles, rad, >= 0.
        delay_samples: Periods by which the command comes late, >= 0.
        feedforward: Commands that are added to the controller's, one a period; none if empty.
        bands: Half widths of the settling bands as shares of the target, each between 0 and 1.
        seed: Of the noise.

    Raises:
        InvalidInputError: If a number is outside its range, or the times do not divide.

    >>> Trial((0.75, 0.85)).periods, Trial((0.75, 0.85)).points
    (30, 3000)
    """

    target: tuple[float, ...]
    duration: float = 3.0
    period: float = 0.1
    plant_step: float = 1e-3
    limit: float = np.inf
    noise: float = 0.0
    delay_samples: int = 0
    feedforward: tuple[float, ...] = ()
    bands: tuple[float, ...] = (0.02, 0.05)
    seed: int = 0

    def __post_init__(self) -> None:
        check_positive(duration=self.duration, period=self.period, plant_step=self.plant_step)
        check_positive(limit=1.0 if np.isposinf(self.limit) else self.limit)
        for name, whole, part in (
            ("duration", self.duration, self.period),
            ("period", self.period, self.plant_step),
        ):
            if round(whole / part) < 1 or not np.isclose(whole / part, round(whole / part)):
                raise InvalidInputError(name, expected=f"a multiple of {part:g} s", got=whole)
        if not (np.isfinite(self.target).all() and np.all(np.abs(self.target) > 0)):
            raise InvalidInputError(
                "target", expected="finite angles other than 0", got=self.target
            )
        check_not_negative(noise=self.noise, delay_samples=self.delay_samples)
        if not all(0 < band < 1 for band in self.bands):
            raise InvalidInputError("bands", expected="shares between 0 and 1", got=self.bands)
        if len(self.feedforward) not in (0, self.periods):
            raise InvalidInputError(
                "feedforward",
                expected=f"none, or {self.periods} commands",
                got=len(self.feedforward),
            )

    @property
    def periods(self) -> int:
        """Number of commands."""
        return round(self.duration / self.period)

    @property
    def points_a_period(self) -> int:
        """Number of points in a period, its end included."""
        return round(self.period / self.plant_step)

    @property
    def points(self) -> int:
        """Number of points after the start."""
        return self.periods * self.points_a_period
