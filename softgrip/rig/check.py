"""One look at a rig that moves nothing: line, telemetry, channels, noise, limits."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from softgrip.arrays import Floats
from softgrip.board.driver import Board
from softgrip.board.errors import BoardError
from softgrip.board.firmware.config import CONSTANTS
from softgrip.board.protocol import TELEMETRY_PERIOD, Flag, ResetCause, SetUp, in_words
from softgrip.logs.gaps import find_gaps, places
from softgrip.logs.schema import PAD_CHANNELS
from softgrip.rig.interface import Rig
from softgrip.rig.replay import Replay
from softgrip.simulator.simulation import together
from softgrip.units import DEG, MPa

LISTEN = 2.0
"""s."""
RATE_WITHIN = 0.02
"""Of 40 Hz: the two clocks of host and board, and the frames at the ends."""
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


def check(rig: Rig) -> list[Finding]:
    """Listen to a rig at rest, and judge what it says."""
    if isinstance(rig, Board):
        return _check_board(rig)
    times, channels = _sensors(rig)
    if isinstance(rig, Replay):
        mended = rig.log.repairs
        return [Finding("log", not mended, "; ".join(mended) or "whole"), *channels]
    return [_none_missing(times, rig.period), *channels]


def _check_board(board: Board) -> list[Finding]:
    found, now = _told(board), board.session.link.now
    begun, number, before = now(), board.telemetry.number, board.session.lost
    pad = board.info.set_up is SetUp.PAD
    times, channels = _pad(board) if pad else _sensors(board)
    frames, lost = (board.telemetry.number - number) % 65536, board.session.lost - before
    rate = frames / (now() - begun)
    good = abs(rate * TELEMETRY_PERIOD - 1) < RATE_WITHIN and not lost
    return [
        *found,
        Finding("telemetry", good, f"{rate:.2f} Hz, {lost} of {frames} frames lost"),
        _none_missing(times, TELEMETRY_PERIOD if pad else board.period),
        *channels,
    ]


def _none_missing(times: ArrayLike, period: float) -> Finding:
    gaps = find_gaps(times, period)
    return Finding("samples", not gaps, places(gaps) or "none missing")


def _told(board: Board) -> list[Finding]:
    """Judge what a board says of itself."""
    info, limits, bounds = board.info, board.info.limits, board.info.bounds
    latched = Flag.ESTOPPED | Flag.SENSOR_RANGE | Flag.SENSOR_STUCK | Flag.SWITCH_FAULT
    faults, cause = board.telemetry.flags & latched, info.reset_cause
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


def _pad(board: Board) -> tuple[Floats, list[Finding]]:
    """Listen to the pad's channels; return the frames' times, s, and what was found."""
    told = [board.listen() for _ in range(round(LISTEN / TELEMETRY_PERIOD))]
    counts = np.array([frame.channels[: len(PAD_CHANNELS)] for frame in told])
    return np.array([frame.time for frame in told]), [
        # An amplifier at an end of its range says nothing, whatever touches the pad.
        Finding(
            name, bool(raw.min() > 0 and raw.max() < 1023), f"counts {raw.min()} to {raw.max()}"
        )
        for name, raw in zip(PAD_CHANNELS, counts.T, strict=True)
    ]


def _sensors(rig: Rig) -> tuple[Floats, list[Finding]]:
    """Listen to pump and fingers; return the samples' times, s, and what was found."""
    count = max(2, round(LISTEN / rig.period))
    seen = together([rig.advance(0.0) for _ in range(count)])
    found = [_channel("pressure", seen.pressure_counts, seen.pressure, 1e-3, "kPa")]
    for finger in range(rig.fingers):
        counts, angles = seen.angle_counts[:, finger], seen.angle[:, finger]
        found.append(_channel(f"angle {finger + 1}", counts, angles, 1 / DEG, "deg"))
    return np.asarray(seen.time), found


def _channel(what: str, counts: object, values: object, factor: float, unit: str) -> Finding:
    raw, read = np.asarray(counts), np.asarray(values, dtype=np.float64)
    # From sample to sample, so that what moves slowly is no noise.
    noise = float(np.diff(read, axis=0).std() / 2**0.5)
    low, high = (CONSTANTS[f"PRESSURE_{end}"].value for end in ("LOW", "HIGH"))
    # Beyond these the wire of a sensor of 0.5 to 4.5 V is broken, whatever it feels.
    alive = raw.min() >= low and raw.max() <= high
    good = bool(alive) and noise <= LARGEST_NOISE[what.split()[0]]
    return Finding(
        what,
        good,
        f"{read.mean() * factor:.2f} {unit}, noise {noise * factor:.2f} {unit}, "
        f"counts {int(raw.min())} to {int(raw.max())}",
    )


def run_check(open_rig: Callable[[], Rig], say: Callable[[str], None] = print) -> int:
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
