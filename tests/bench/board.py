"""The firmware on the emulated board, in virtual time: telemetry, answers, stops, memory."""

from math import ceil

import numpy as np

from softgrip.board.emulated.board import EmulatedBoard
from softgrip.board.emulated.build import firmware, missing, sizes
from softgrip.board.protocol import ESTOP, HEARTBEAT, SETPOINT, TELEMETRY_PERIOD, Flag
from tests.bench.entry import Entry, entry
from tests.board.host import Host, pushing_host

FLASH, RAM = 256 * 1024 - 8192, 8192
"""Bytes of an ATmega2560, its boot loader's part taken off."""
ACKNOWLEDGED_WITHIN, STOPPED_WITHIN = 5.0, 1.0
"""ms."""


def telemetry(seconds: float) -> tuple[float, int]:
    """Return the rate of telemetry, Hz, and the number of lost frames, of a moving board."""
    host = Host(EmulatedBoard(position=20))
    host.home()
    host.frames.clear()
    for k in range(ceil(seconds)):
        host.ask(SETPOINT, speed=256 * (800 if k % 4 < 2 else -800))
        host.run(1.0)
    numbers = np.array([frame["number"] for frame in host.frames])
    times = np.array([frame["time"] for frame in host.frames]) * 1e-3
    lost = int((np.diff(numbers) % 65536 - 1).sum())
    return (times.size - 1) / float(times[-1] - times[0]), lost


def acknowledged(count: int) -> np.ndarray:
    """Return the times from a command's first bit to its answer's last, ms."""
    host, chance, taken = Host(EmulatedBoard(position=20)), np.random.default_rng(0), []
    host.home()
    for _ in range(count):
        host.run(0.02)
        host.board.advance(float(chance.uniform(0, TELEMETRY_PERIOD)))
        host.listen()
        said = host.board.time
        sequence = host.say(HEARTBEAT)
        while True:
            host.board.advance(5e-5)
            if any(frame.sequence == sequence for frame in host.listen()):
                break
        taken.append(1e3 * (host.board.time - said))
    return np.array(taken)


def stopped(count: int) -> np.ndarray:
    """Return the times from an emergency stop's first bit to the last step, ms."""
    chance, taken = np.random.default_rng(1), []
    for _ in range(count):
        host = pushing_host()
        host.board.advance(float(chance.uniform(0, TELEMETRY_PERIOD)))
        said = host.board.time
        host.say(ESTOP)
        host.run(0.1)
        assert host.flags & Flag.ESTOPPED
        taken.append(1e3 * (host.stopped_at() - said))
    return np.array(taken)


def entries(*, seconds: float = 600.0, count: int = 1000, stops: int = 100) -> list[Entry]:
    """Return what the emulated board does; nothing where the emulator is not installed."""
    if missing():
        return []
    rate, lost = telemetry(seconds)
    answers, ends = acknowledged(count), stopped(stops)
    late, latest = float(np.percentile(answers, 99)), float(ends.max())
    where = "emulated board, virtual time"
    found = [
        entry(
            "board, telemetry", rate, "Hz", 1 / TELEMETRY_PERIOD,
            "40.0 Hz, none lost", abs(rate - 40) < 0.05 and lost == 0,
            f"{where}: {seconds:g} s with a moving motor; {lost} frames lost.",
        ),
        entry(
            "board, command to acknowledge, p99", late, "ms", ACKNOWLEDGED_WITHIN,
            f"< {ACKNOWLEDGED_WITHIN:g} ms", late < ACKNOWLEDGED_WITHIN,
            f"{where}: {count:,} heartbeats at random times, from the first bit to the answer's"
            f" last. Median {np.median(answers):.2f} ms, slowest {answers.max():.2f} ms.",
        ),
        entry(
            "board, emergency stop to last step, slowest", latest, "ms", STOPPED_WITHIN,
            f"< {STOPPED_WITHIN:g} ms", latest < STOPPED_WITHIN,
            f"{where}: {stops} stops from 5 rev/s at random times, from the command's first bit."
            f" Median {np.median(ends):.2f} ms.",
        ),
    ]  # fmt: skip
    used = zip(("flash", "RAM"), sizes(firmware()), (FLASH, RAM), strict=True)
    for name, size, room in used:
        note = f"avr-size of the firmware; baseline: the ATmega2560's {name}."
        note += " Without the stack." if name == "RAM" else ""
        found.append(
            entry(
                f"board, {name}", size / 1024, "KiB", room / 1024,
                "fits, half of it free", size < room / 2, note,
            )
        )  # fmt: skip
    return found
