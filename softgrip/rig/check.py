"""One look at a rig that moves nothing: line, telemetry, channels, noise, limits."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from softgrip.board.driver import Board
from softgrip.board.errors import BoardError
from softgrip.board.protocol import TELEMETRY_PERIOD, Flag, ResetCause, SetUp, in_words
from softgrip.board.session import Telemetry
from softgrip.logs.gaps import find_gaps, places
from softgrip.logs.schema import PAD_CHANNELS
from softgrip.rig.interface import Connection
from softgrip.rig.replay import ReplayConnection
from softgrip.simulator.simulation import together
from softgrip.units import DEG, MPa

LISTEN = 2.0
"""s."""
RATE_WITHIN = 0.02
"""Of 40 Hz: the two clocks of host and board, and the frames at the ends."""
LEAST_COUNT, LARGEST_COUNT = 51, 972
"""Counts of 0.25 and 4.75 V: beyond them the wire of a sensor of 0.5 to 4.5 V is broken."""
LARGEST_NOISE = {"pressure": 2000.0, "angle": 4 * DEG}
"""Pa and rad, root mean square: about four times and twice what is expected."""


@dataclass(frozen=True)
class Finding:
    """One line of the report: what was looked at, whether it is good, and what was found."""

    what: str
    good: bool
    words: str

    def __str__(self) -> str:
        return f"{'ok  ' if self.good else 'FAIL'}  {self.what}: {self.words}"


def check(connection: Connection) -> list[Finding]:
    """Listen to a rig at rest, and judge what it says."""
    board = connection if isinstance(connection, Board) else None
    found = [] if board is None else _board(board)
    begin = None if board is None else (board.session.link.now(), board.telemetry.number)
    lost = 0 if board is None else board.session.lost
    pad = board if board is not None and board.info.set_up is SetUp.PAD else None
    if pad is not None:
        told = [pad.listen() for _ in range(round(LISTEN / TELEMETRY_PERIOD))]
        channels, times = _pad(told), np.array([frame.time for frame in told])
    else:
        count = max(2, round(LISTEN / connection.period))
        seen = together([connection.advance(0.0) for _ in range(count)])
        times = np.asarray(seen.time)
        channels = [_channel("pressure", seen.pressure_counts, seen.pressure, 1e-3, "kPa")]
        for finger in range(connection.fingers):
            counts, angles = seen.angle_counts[:, finger], seen.angle[:, finger]
            channels.append(_channel(f"angle {finger + 1}", counts, angles, 1 / DEG, "deg"))
    if board is not None and begin is not None:
        frames = (board.telemetry.number - begin[1]) % 65536
        rate = frames / (board.session.link.now() - begin[0])
        good = abs(rate * TELEMETRY_PERIOD - 1) < RATE_WITHIN and board.session.lost == lost
        words = f"{rate:.2f} Hz, {board.session.lost - lost} of {frames} frames lost"
        found.append(Finding("telemetry", good, words))
    if isinstance(connection, ReplayConnection):
        mended = connection.log.repairs
        found.append(Finding("log", not mended, "; ".join(mended) or "whole"))
    else:
        gaps = find_gaps(times, connection.period if pad is None else TELEMETRY_PERIOD)
        found.append(Finding("samples", not gaps, places(gaps) or "none missing"))
    return found + channels


def _pad(told: Sequence[Telemetry]) -> list[Finding]:
    counts = np.array([frame.channels[: len(PAD_CHANNELS)] for frame in told])
    return [
        # An amplifier at an end of its range says nothing, whatever touches the pad.
        Finding(
            name, bool(raw.min() > 0 and raw.max() < 1023), f"counts {raw.min()} to {raw.max()}"
        )
        for name, raw in zip(PAD_CHANNELS, counts.T, strict=True)
    ]


def _board(rig: Board) -> list[Finding]:
    info, limits, bounds = rig.info, rig.info.limits, rig.info.bounds
    flags = rig.telemetry.flags
    faults = flags & (Flag.ESTOPPED | Flag.SENSOR_RANGE | Flag.SENSOR_STUCK | Flag.SWITCH_FAULT)
    cause = info.reset_cause
    within = all(getattr(limits, name) <= getattr(bounds, name) for name in vars(limits))
    return [
        Finding("handshake", True, f"{info.set_up.name}, firmware build {info.build}"),
        Finding("last reset", not cause & ResetCause.WATCHDOG, in_words(cause) or "unknown"),
        Finding("faults", not faults, in_words(faults) or "none"),
        Finding(
            "limits",
            within,
            f"{limits.pressure / MPa:.3f} MPa, {limits.travel * 1e3:.0f} mm, "
            f"{limits.speed:.1f} rad/s, silence {limits.silence * 1e3:.0f} ms",
        ),
    ]


def _channel(what: str, counts: object, values: object, factor: float, unit: str) -> Finding:
    raw, read = np.asarray(counts), np.asarray(values, dtype=np.float64)
    # From sample to sample, so that what moves slowly is no noise.
    noise = float(np.diff(read, axis=0).std() / 2**0.5)
    alive = raw.min() >= LEAST_COUNT and raw.max() <= LARGEST_COUNT
    good = bool(alive) and noise <= LARGEST_NOISE[what.split()[0]]
    return Finding(
        what,
        good,
        f"{read.mean() * factor:.2f} {unit}, noise {noise * factor:.2f} {unit}, "
        f"counts {int(raw.min())} to {int(raw.max())}",
    )


def run_check(open_rig: Callable[[], Connection], say: Callable[[str], None] = print) -> int:
    """Report on a rig and return an exit code: 0 good, 1 something failed, 2 no rig."""
    try:
        with open_rig() as rig:
            found = check(rig)
    except BoardError as error:
        say(str(Finding("rig", False, str(error))))
        return 2
    for finding in found:
        say(str(finding))
    bad = sum(not finding.good for finding in found)
    say("all good" if not bad else f"{bad} of {len(found)} findings are not good")
    return int(bad > 0)
