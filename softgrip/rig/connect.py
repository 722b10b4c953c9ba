"""One name for each back end: simulated, emulated, replayed, or a board on a port."""

import sys
from collections.abc import Callable
from pathlib import Path

from softgrip.board.calibration import load
from softgrip.board.driver import Board
from softgrip.board.emulated.link import emulated_finger, emulated_gripper
from softgrip.board.find import find_board
from softgrip.board.protocol import TELEMETRY_PERIOD
from softgrip.errors import UnknownNameError
from softgrip.rig.interface import Rig
from softgrip.rig.replay import Replay
from softgrip.rig.simulated import fitted_rig, simulated_finger, simulated_gripper

NAMED: dict[str, Callable[..., Rig]] = {
    "simulated": simulated_finger,
    "simulated:gripper": simulated_gripper,
    "emulated": emulated_finger,
    "emulated:gripper": emulated_gripper,
}


def connect(
    where: str | None = None,
    *,
    fingers: int = 1,
    period: float = TELEMETRY_PERIOD,
    calibration: Path | str | None = None,
    seed: int = 0,
    emulated: bool = False,
) -> Rig:
    """Return a rig to drive: simulated, replayed, emulated or real.

    Args:
        where: "simulated" for the finger of Chapters 3 to 5, "simulated:gripper" for the two of
            Chapter 6, "simulated:FILE.csv" for a rig that was fitted to logs; "emulated" and
            "emulated:gripper" for the same at the pins of an emulated ATmega2560 that runs the
            firmware, whose virtual time goes on when a sample is asked for; "replay:PATH" for a
            log; a port or a URL such as "socket://host:port"; or None for the one board that is
            found on USB.
        fingers, period: Of a board on a port; the others have their own.
        calibration: File of `calibration`, for a board on a port; None for the data sheets' lines.
        seed: Of chance, for what is simulated or emulated.
        emulated: Whether what answers on a port is an emulated board: its logs are then called
            simulated.

    Raises:
        BoardError: If a board cannot be reached.
        EmulatorUnavailableError: If the compiler or the emulator is not installed; it says how to
            get them.
        DataFileError: If a log, a rig's file or a calibration cannot be read.

    >>> with connect("simulated") as rig:
    ...     rig.home()
    ...     rig.advance(10.0).time
    0.025
    """
    # Read for any rig: that it cannot be read should not come out on the board.
    lines = None if calibration is None else load(calibration)
    if where is not None and where.partition(":")[0] in ("simulated", "emulated"):
        if where.startswith("simulated:") and where.endswith(".csv"):
            return fitted_rig(where.removeprefix("simulated:"), seed=seed)
        if where not in NAMED:
            raise UnknownNameError("back end", where, [*NAMED, "simulated:RIG.csv"])
        return NAMED[where](seed=seed)
    if where is not None and where.startswith("replay:"):
        return Replay(where.removeprefix("replay:"))
    if where is None:
        found = find_board()
        print(f"found {found}", file=sys.stderr)
        where = found.port
    return Board(where, fingers=fingers, period=period, calibration=lines, emulated=emulated)
