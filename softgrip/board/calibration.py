"""From the counts of a board's converter to pressure and angle, fitted and kept with its board."""

import csv
from dataclasses import astuple, dataclass, replace
from pathlib import Path
from typing import Literal, get_args, overload

import numpy as np
import scipy
from numpy.typing import ArrayLike

from softgrip.arrays import Floats, check_positive, floats
from softgrip.board.errors import WrongBoardError
from softgrip.checks import takes_numbers
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.files import path_of
from softgrip.provenance import Provenance, cells, describe
from softgrip.simulator.parameters import SensorParameters

ANY_BOARD = "any"
COLUMNS = ("sensor", "gain", "offset", "residual", "low_count", "high_count")
POLE = "pole"
"""A sixth column, which only a file with a divider has; empty for a line."""

TOP_COUNT = 1023
"""Of a converter of 10 bits; 4095 for one of 12."""
RAIL = 1.0
"""Counts from either end within which a reading may have been cut off."""
BENT, CHANCE, BADLY_BENT = 0.01, 1e-2, 0.1
"""A curve does not fit where it leaves a bend of more than the first share of the range, and chance
would leave as much less often than the second; or a bend of more than the third, by chance or not.
Flex sensors repeat to no better than 1 %."""
BETTER = 2.0
"""By what the residual of a divider must be less than that of a line that may be bent."""
Curve = Literal["line", "divider"]


@dataclass(frozen=True)
class SensorLine:
    """A sensor's value as a line of the counts.

    Attributes:
        gain: Unit per count.
        offset: Value at count zero.
        residual: Root mean square about the line, with N - 2 degrees of freedom; 0 for a nominal
            line.
        low_count, high_count: Range in which the line was measured.
    """

    gain: float
    offset: float
    residual: float
    low_count: float
    high_count: float

    def value(self, counts: ArrayLike) -> Floats:
        """Return what counts stand for, of their shape."""
        return np.asarray(self.offset + self.gain * floats(counts=counts)[0])


@dataclass(frozen=True)
class DividerCurve:
    """A sensor whose resistance is a line of its value, in a voltage divider with a fixed resistor.

    The resistance is a constant times ``counts / (top - counts)``, or the inverse, so the value is
    ``offset + gain / (counts - pole)``; the pole is 0 where the fixed resistor lies at ground, and
    the count of the supply where the sensor does.

    Attributes:
        gain: Unit times count.
        offset: Of the value.
        residual, low_count, high_count: As of `SensorLine`.
        pole: Count at which the resistance is infinite.
    """

    gain: float
    offset: float
    residual: float
    low_count: float
    high_count: float
    pole: float

    def value(self, counts: ArrayLike) -> Floats:
        """Return what counts stand for, of their shape; at the pole, which is a rail, infinity."""
        with np.errstate(divide="ignore"):
            apart = floats(counts=counts)[0] - self.pole
            return np.asarray(self.offset + self.gain / apart)


SensorCurve = SensorLine | DividerCurve


@overload
def fit_sensor(
    counts: ArrayLike, known: ArrayLike, *, curve: Literal["line"], top: float = TOP_COUNT
) -> SensorLine: ...
@overload
def fit_sensor(
    counts: ArrayLike, known: ArrayLike, *, curve: Curve | None = None, top: float = TOP_COUNT
) -> SensorCurve: ...
@takes_numbers
def fit_sensor(
    counts: ArrayLike, known: ArrayLike, *, curve: Curve | None = None, top: float = TOP_COUNT
) -> SensorCurve:
    """Fit a line, or the curve of a voltage divider, through pairs by least squares.

    Readings at either end of the converter are left out: they may have been cut off. Without a
    curve it is a line if a line fits, else that of a divider.

    Args:
        counts: Of the converter, 0 to `top`, shape (N,); N >= 3 that are not at an end, not all
            equal.
        known: What the sensor felt, Pa or rad, shape (N,).
        curve: "line" or "divider", or None to have it chosen.
        top: Highest count of the converter, 4095 for one of 12 bits.

    Raises:
        InvalidInputError: If the pairs do not fix a curve, a count is not one of the converter, or
            a bend is left that neither curve, or not the one that was asked for, has.

    >>> fit_sensor([100, 200, 300], [0.0, 1.0, 2.0]).value(250).item()
    1.5
    >>> fit_sensor([100, 200, 400, 800], [8.0, 4.0, 2.0, 1.0]).value(160).round(6).item()
    5.0
    """
    x, y = floats(counts=counts, known=known)
    check_positive(top=top)
    good = x.ndim == 1 and x.shape == y.shape and bool(np.isfinite(x).all())
    if good and not ((x >= 0) & (x <= top)).all():
        raise InvalidInputError(
            "counts",
            expected=f"0 to {top:g}, the highest of the converter (top=4095 for one of 12 bits)",
            got=(float(x.min()), float(x.max())),
        )
    if curve is not None and curve not in get_args(Curve):
        raise InvalidInputError("curve", expected=f"one of {get_args(Curve)} or None", got=curve)
    if good:
        free = ~((x <= RAIL) | (x >= top - RAIL))
        x, y = x[free], y[free]
        good = x.size >= 3
    if not (good and np.isfinite(x).all() and np.isfinite(y).all() and np.ptp(x) > 0):
        raise InvalidInputError(
            "counts, known",
            expected="three pairs or more, finite, of counts that are not all equal, and that lie "
            f"between the ends of the converter, 0 and {top:g}",
            got=(x.tolist(), y.tolist()),
        )
    dividers = [_curve(x, y, pole) for pole in (0.0, float(top))]
    tried = {"line": _curve(x, y, None), "divider": min(dividers, key=lambda c: c.residual)}
    bends = {name: _bend(x, y, tried[name]) for name in ([curve] if curve else tried)}
    for name, (bend, chance) in bends.items():
        may_be = curve is None and name == "line" and bend > BENT
        if may_be and BETTER * tried["divider"].residual < tried["line"].residual:
            continue
        if bend <= BENT or (bend <= BADLY_BENT and chance > CHANCE):
            return tried[name]
    said = ", ".join(f"{bend:.1%} of the range off a {name}" for name, (bend, _) in bends.items())
    raise InvalidInputError(
        "counts, known",
        expected=f"pairs on a {' or a '.join(bends)}, with no bend of more than {BENT:.0%} left: "
        "take another curve, or fit a part of the range",
        got=f"a bend of {said}",
    )


def _curve(x: Floats, y: Floats, pole: float | None) -> SensorCurve:
    """Return the line in the counts, or in their inverse from a pole, by least squares."""
    line = scipy.stats.linregress(x if pole is None else 1 / (x - pole), y)
    gain, offset = float(line.slope), float(line.intercept)
    found = (gain, offset, 0.0, float(x.min()), float(x.max()))
    curve = SensorLine(*found) if pole is None else DividerCurve(*found, pole)
    residual = float(np.sqrt(np.sum((y - curve.value(x)) ** 2) / (x.size - 2)))
    return replace(curve, residual=residual)


def _bend(x: Floats, y: Floats, curve: SensorCurve) -> tuple[float, float]:
    """Return how far a parabola through what a curve leaves bends, and the chance of as much.

    The first is a share of the range, the second that of Fisher's test; 0 where three pairs leave
    nothing to judge by.
    """
    rest, at = y - curve.value(x), (x - x.mean()) / np.ptp(x)
    if np.unique(x).size < 3 or not np.ptp(y) > 0:
        return 0.0, 1.0
    parabola = np.polyval(np.polyfit(at, rest, 2), at)
    bend = float(np.max(np.abs(parabola)) / np.ptp(y))
    left = float(np.sum((rest - parabola) ** 2))
    if x.size == 3 or left == 0:
        return bend, 0.0
    ratio = (float(np.sum(rest**2)) - left) / (left / (x.size - 3))
    return bend, float(scipy.special.fdtrc(1, x.size - 3, max(ratio, 0.0)))


@dataclass(frozen=True)
class BoardCalibration:
    """The sensors of one board.

    Attributes:
        board: Identity of the board, or `ANY_BOARD`.
        pressure: Pa gauge.
        angles: rad, one for each finger.
        name: For the header of logs.
    """

    board: str
    pressure: SensorLine
    angles: tuple[SensorCurve, ...]
    name: str

    def for_board(self, identity: str, port: str) -> "BoardCalibration":
        """Return the calibration, or refuse it for another board.

        Raises:
            WrongBoardError: If it was made with another board.
        """
        if self.board not in (identity, ANY_BOARD):
            raise WrongBoardError(
                port,
                f"calibration {self.name} is of board {self.board}, this one is {identity}; "
                "calibrate this board",
            )
        return self


def nominal(fingers: int = 1, sensors: SensorParameters | None = None) -> BoardCalibration:
    """Return what the data sheets say: 0.5 to 4.5 V of 5 V over each sensor's range, any board."""
    known = SensorParameters() if sensors is None else sensors
    low, high = known.low_count, known.high_count

    def line(full: float) -> SensorLine:
        gain = full / (high - low)
        return SensorLine(gain, -gain * low, 0.0, low, high)

    angles = (line(known.angle_range),) * fingers
    return BoardCalibration(ANY_BOARD, line(known.pressure_range), angles, "nominal")


def save(
    calibration: BoardCalibration,
    path: Path | str,
    source: str,
    provenance: Provenance = Provenance.LOGGED,
) -> None:
    """Write a calibration as a small text file; `source` says in one line how it was measured.

    What was read on a simulated rig or an emulated board is of the provenance simulated.
    """
    with path_of(path).open("x", encoding="utf-8", newline="") as out:
        out.write(f"# provenance: {provenance}\n# source: {source}\n# board: {calibration.board}\n")
        table = csv.writer(out, lineterminator="\n")
        named: list[tuple[str, SensorCurve]] = [("pressure [Pa]", calibration.pressure)]
        named += [(f"angle_{k} [rad]", curve) for k, curve in enumerate(calibration.angles, 1)]
        bent = any(isinstance(curve, DividerCurve) for _, curve in named)
        table.writerow((*COLUMNS, POLE) if bent else COLUMNS)
        for name, curve in named:
            cells_of = [name, *map(repr, astuple(curve))]
            table.writerow(cells_of + [""] * (bent and isinstance(curve, SensorLine)))


def load(path: Path | str) -> BoardCalibration:
    """Read a calibration.

    Raises:
        DataFileError: If the file is not one.
    """
    file = path_of(path)
    describe(file)
    text = file.read_text(encoding="utf-8").splitlines()
    boards = [line.partition(":")[2].strip() for line in text if line.startswith("# board:")]
    rows = cells(file)
    known = (COLUMNS, (*COLUMNS, POLE))
    if len(boards) != 1 or not rows or tuple(rows[0]) not in known or len(rows) < 3:
        raise DataFileError(
            file,
            expected=f"a line '# board:', and the columns {COLUMNS}, with {POLE!r} for dividers",
            got=str(rows[:1]),
        )
    names = [row[0] if row else "" for row in rows[1:]]
    try:
        curves = [_read_curve(row[1:], len(rows[0]) - 1) for row in rows[1:]]
    except (TypeError, ValueError) as error:
        raise DataFileError(
            file, expected="five numbers a sensor, and the pole of a divider", got=str(error)
        ) from None
    wanted = ["pressure [Pa]", *(f"angle_{k} [rad]" for k in range(1, len(rows) - 1))]
    if names != wanted:
        raise DataFileError(file, expected=f"the sensors {wanted}", got=str(names))
    pressure, *angles = curves
    if not isinstance(pressure, SensorLine):
        raise DataFileError(
            file, expected="a line for the pressure sensor, whose limits the board holds in counts",
            got="a divider",
        )  # fmt: skip
    return BoardCalibration(boards[0], pressure, tuple(angles), file.name)


def _read_curve(cells_of: list[str], columns: int) -> SensorCurve:
    """Return the curve of a row; ValueError or TypeError if it is none."""
    if len(cells_of) != columns:
        raise ValueError(f"{len(cells_of)} cells under {columns}")
    numbers = [float(cell) for cell in cells_of if cell]
    return SensorLine(*numbers) if len(numbers) == len(COLUMNS) - 1 else DividerCurve(*numbers)
