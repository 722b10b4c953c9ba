"""What a board said of itself when it was greeted: its build, and its limits in SI units."""

from dataclasses import dataclass

from softgrip.board.calibration import SensorLine
from softgrip.board.protocol import SPEED_SCALE, ResetCause, SetUp, Values
from softgrip.simulator.parameters import PumpParameters
from softgrip.units import REV


@dataclass(frozen=True)
class Limits:
    """At what a board stops by itself.

    Attributes:
        pressure: Gauge, Pa, above which nothing is pushed.
        travel: Of the plunger from home, m.
        speed, acceleration: Of the motor, rad/s and rad/s^2.
        silence: Of the host, s.
    """

    pressure: float
    travel: float
    speed: float
    acceleration: float
    silence: float


@dataclass(frozen=True)
class Scale:
    """From the board's units to SI and back.

    Attributes:
        steps: A turn of the motor.
        pump: Its lead makes travel of turns.
        pressure: Line of the pressure sensor.
    """

    steps: int
    pump: PumpParameters
    pressure: SensorLine

    def speed_out(self, speed: float) -> int:
        """Return the board's speed for rad/s."""
        return round(speed / REV * self.steps * SPEED_SCALE)

    def travel_in(self, position: int) -> float:
        """Return the travel of the plunger, m, at a position in steps."""
        return float(position / self.steps * self.pump.lead)

    def limits_in(self, told: Values, prefix: str = "") -> Limits:
        """Return the limits in an answer to HELLO; prefixed ``hard_`` are the bounds on them."""
        turn = REV / self.steps
        return Limits(
            pressure=float(self.pressure.value(told[f"{prefix}pressure"])),
            travel=self.travel_in(told[f"{prefix}position"]),
            speed=told[f"{prefix}speed"] * turn,
            acceleration=told[f"{prefix}acceleration"] * turn,
            silence=told[f"{prefix}silence"] * 1e-3,
        )

    def limits_out(self, limits: Limits) -> dict[str, int]:
        """Return the fields of SET_LIMITS; each rounded to the safe side."""
        turn = REV / self.steps
        return {
            "pressure": int((limits.pressure - self.pressure.offset) / self.pressure.gain),
            "position": int(limits.travel / self.pump.lead * self.steps + 1e-6),
            "speed": int(limits.speed / turn + 1e-6),
            "acceleration": int(limits.acceleration / turn + 1e-6),
            "silence": int(limits.silence * 1e3 + 1e-6),
        }


@dataclass(frozen=True)
class BoardInfo:
    """Who a board is.

    Attributes:
        identity: Its USB serial number, or, where it has none, its build.
        build: Of the firmware, as in logs.
        set_up: What the firmware was built for.
        reset_cause: Of its last reset.
        valve: Whether it can vent.
        limits, bounds: In force, and the furthest that can be set.
    """

    identity: str
    build: str
    set_up: SetUp
    reset_cause: ResetCause
    valve: bool
    limits: Limits
    bounds: Limits

    @classmethod
    def of(cls, told: Values, usb_serial: str, scale: Scale) -> "BoardInfo":
        """Return what an answer to HELLO says."""
        build = f"{told['build']:08x}"
        return cls(
            identity=usb_serial or f"build {build}",
            build=build,
            set_up=SetUp(told["set_up"]),
            reset_cause=ResetCause(told["reset_cause"]),
            valve=bool(told["valve"]),
            limits=scale.limits_in(told),
            bounds=scale.limits_in(told, "hard_"),
        )
