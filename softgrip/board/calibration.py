"""From the counts of a board's converter to pressure and angle, fitted and kept with its board."""

import csv
from dataclasses import astuple, dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike
from scipy.stats import linregress

from softgrip.arrays import Floats
from softgrip.board.errors import WrongBoardError
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.provenance import Provenance, cells, describe
from softgrip.simulator.parameters import SensorParameters

ANY_BOARD = "any"
COLUMNS = ("sensor", "gain", "offset", "residual", "low_count", "high_count")


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
        return np.asarray(self.offset + self.gain * np.asarray(counts, dtype=np.float64))


def fit_sensor(counts: ArrayLike, known: ArrayLike) -> SensorLine:
    """Fit a line through pairs by least squares.

    Args:
        counts: Of the converter, shape (N,), N >= 3, not all equal.
        known: What the sensor felt, Pa or rad, shape (N,).

    Raises:
        InvalidInputError: If the pairs do not fix a line.

    >>> fit_sensor([100, 200, 300], [0.0, 1.0, 2.0]).value(250).item()
    1.5
    """
    x, y = np.asarray(counts, np.float64), np.asarray(known, np.float64)
    good = x.ndim == 1 and x.shape == y.shape and x.size >= 3
    if not (good and np.isfinite(x).all() and np.isfinite(y).all() and np.ptp(x) > 0):
        raise InvalidInputError(
            "counts, known",
            expected="three pairs or more, finite, of counts that are not all equal",
            got=(x.tolist(), y.tolist()),
        )
    line = linregress(x, y)
    slope, offset = float(line.slope), float(line.intercept)
    residual = float(np.sqrt(np.sum((y - offset - slope * x) ** 2) / (x.size - 2)))
    return SensorLine(slope, offset, residual, float(x.min()), float(x.max()))


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
    angles: tuple[SensorLine, ...]
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
    with Path(path).open("x", encoding="utf-8", newline="") as out:
        out.write(f"# provenance: {provenance}\n# source: {source}\n# board: {calibration.board}\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow(COLUMNS)
        named = [("pressure [Pa]", calibration.pressure)]
        named += [(f"angle_{k} [rad]", line) for k, line in enumerate(calibration.angles, 1)]
        table.writerows([name, *map(repr, astuple(line))] for name, line in named)


def load(path: Path | str) -> BoardCalibration:
    """Read a calibration.

    Raises:
        DataFileError: If the file is not one.
    """
    file = Path(path)
    describe(file)
    text = file.read_text(encoding="utf-8").splitlines()
    boards = [line.partition(":")[2].strip() for line in text if line.startswith("# board:")]
    rows = cells(file)
    if len(boards) != 1 or not rows or tuple(rows[0]) != COLUMNS or len(rows) < 3:
        raise DataFileError(
            file, expected=f"a line '# board:', and the columns {COLUMNS}", got=str(rows[:1])
        )
    names = [row[0] for row in rows[1:]]
    try:
        lines = [SensorLine(*map(float, row[1:])) for row in rows[1:]]
    except (TypeError, ValueError) as error:
        raise DataFileError(file, expected="five numbers a sensor", got=str(error)) from None
    wanted = ["pressure [Pa]", *(f"angle_{k} [rad]" for k in range(1, len(rows) - 1))]
    if names != wanted:
        raise DataFileError(file, expected=f"the sensors {wanted}", got=str(names))
    return BoardCalibration(boards[0], lines[0], tuple(lines[1:]), file.name)
