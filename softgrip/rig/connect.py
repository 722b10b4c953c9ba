"""One name for each back end: a simulated rig, a replay, a board on a port, or the one found."""

import sys
from pathlib import Path

from softgrip.board.calibration import load
from softgrip.board.driver import Board
from softgrip.board.find import find_board
from softgrip.board.protocol import TELEMETRY_PERIOD
from softgrip.errors import UnknownNameError
from softgrip.rig.interface import Connection
from softgrip.rig.replay import ReplayConnection
from softgrip.rig.simulated import simulated_finger, simulated_gripper

SIMULATED = {"simulated": simulated_finger, "simulated:gripper": simulated_gripper}


def connect(
    where: str | None = None,
    *,
    fingers: int = 1,
    period: float = TELEMETRY_PERIOD,
    calibration: Path | str | None = None,
    seed: int = 0,
    emulated: bool = False,
) -> Connection:
    """Return a rig to drive, replayed, simulated or real.

    Parameters
    ----------
    where
        "simulated" for the finger of Chapters 3 to 5, "simulated:gripper" for the two of Chapter 6,
        "replay:PATH" for a log, a port or a URL such as "socket://host:port", or None for the one
        board that is found on USB.
    fingers, period
        Of a board; the others have their own.
    calibration
        File of `calibration`, for a board; None for the data sheets' lines.
    seed
        Of chance, for a simulated rig.
    emulated
        Whether what answers on a port is an emulated board: its logs are then called simulated.

    Raises
    ------
    BoardError
        If a board cannot be reached.
    DataFileError
        If a log or a calibration cannot be read.

    Examples
    --------
    >>> with connect("simulated") as rig:
    ...     rig.home()
    ...     rig.advance(10.0).time
    0.025
    """
    if where is not None and where.startswith("simulated"):
        if where not in SIMULATED:
            raise UnknownNameError("simulated rig", where, [*SIMULATED])
        return SIMULATED[where](seed=seed)
    if where is not None and where.startswith("replay:"):
        return ReplayConnection(where.removeprefix("replay:"))
    if where is None:
        found = find_board()
        print(f"found {found}", file=sys.stderr)
        where = found.port
    lines = None if calibration is None else load(calibration)
    return Board(where, fingers=fingers, period=period, calibration=lines, emulated=emulated)
