"""What each gripper of a study is put through: a step, a motor limit, noise and delay."""

from dataclasses import dataclass
from typing import final

import numpy as np

from softgrip.arrays import check_positive
from softgrip.errors import InvalidInputError


@final
@dataclass(frozen=True)
class Trial:
    """A step from rest at angle 0 in the sampled loop.

    Attributes
    ----------
    target
        Angle of each finger, rad, not 0: its share of the desired output, Eq. (6.25).
    duration
        s, a whole number of periods.
    period
        Time between commands, s; Section 6.4 has 100 ms.
    plant_step
        Time between the points at which the fingers are looked at, s; divides the period.
    limit
        Largest absolute command, > 0.
    noise
        Standard deviation of the measured angles, rad, >= 0.
    delay_samples
        Periods by which the command comes late, >= 0.
    feedforward
        Commands that are added to the controller's, one a period; none if empty.
    bands
        Half widths of the settling bands as shares of the target, each between 0 and 1.
    seed
        Of the noise.

    Raises
    ------
    InvalidInputError
        If a number is outside its range, or the times do not divide.

    Examples
    --------
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
        check_positive(
            duration=self.duration, period=self.period, plant_step=self.plant_step,
            limit=1.0 if np.isposinf(self.limit) else self.limit,
        )  # fmt: skip
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
        if not (0 <= self.noise < np.inf and self.delay_samples >= 0):
            raise InvalidInputError(
                "noise, delay_samples", expected=">= 0", got=(self.noise, self.delay_samples)
            )
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
