"""Push the plunger of a rig, rest, and keep the log: what a rig is fitted to. The motor turns.

Example::

  softgrip record simulated -o push.csv --travel "20 mm" --speed "2 rad/s" --duration 15
  softgrip record /dev/ttyACM0 -o step.csv --travel "12 mm" --duration 8
"""

from argparse import ArgumentParser, Namespace
from pathlib import Path

import numpy as np

from softgrip.commands.quantity import quantity
from softgrip.control.loop import SPEED_LIMIT
from softgrip.errors import InvalidInputError
from softgrip.quantities import in_si
from softgrip.rig.connect import connect
from softgrip.rig.record import record
from softgrip.simulator.parameters import PumpParameters


def add_arguments(parser: ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("rig", help="as of connect: simulated, emulated, simulated:FILE, a port")
    parser.add_argument("-o", "--output", required=True, help="the log, which must not exist")
    parser.add_argument(
        "--travel", type=quantity, required=True, help='of the plunger, such as "20 mm"'
    )
    parser.add_argument(
        "--speed",
        type=quantity,
        default=SPEED_LIMIT,
        help='of the motor, such as "2 rad/s"; without, the largest allowed',
    )
    parser.add_argument(
        "--duration", type=quantity, default=10.0, help='of push and rest, such as "10 s"'
    )
    parser.add_argument("--calibration", help="file of the board's calibration")


def speeds(travel: float, speed: float, duration: float, period: float) -> np.ndarray:
    """Return the motor's speed in each period: to a travel at a speed, then rest, rad/s.

    Args:
        travel: m, within the stroke.
        speed: rad/s, up to the limit.
        duration, period: s.
    """
    pump = PumpParameters()
    if not 0 < travel <= pump.stroke:
        raise InvalidInputError("--travel", expected=f"up to {pump.stroke} m", got=travel)
    if not 0 < speed <= SPEED_LIMIT:
        raise InvalidInputError("--speed", expected=f"up to {SPEED_LIMIT:.4g} rad/s", got=speed)
    pushing = travel / (pump.advance * speed)
    if not pushing < duration:
        raise InvalidInputError(
            "--duration", expected=f"more than the push, {pushing:.3g} s", got=duration
        )
    # The last period of the push turns by what is left.
    turned = np.clip(pushing / period - np.arange(round(duration / period)), 0, 1)
    return np.asarray(speed * turned)


def run(asked: Namespace) -> int:
    """Record and return the exit code."""
    travel = in_si("--travel", asked.travel, "m")
    speed = in_si("--speed", asked.speed, "rad/s")
    duration = in_si("--duration", asked.duration, "s")
    if Path(asked.output).exists():
        raise InvalidInputError("--output", expected="a new file", got=asked.output)
    with connect(asked.rig, calibration=asked.calibration) as rig:
        commands = speeds(travel, speed, duration, rig.period)
        rig.home()
        made = record(rig, commands, duration, asked.output, shows=f"a push by {asked.travel}")
    print(f"{made.path}: {made.samples} rows")
    if made.log_failure:
        raise InvalidInputError("--output", expected="a disk with room", got=made.log_failure)
    return 0
