"""A board in memory that speaks the protocol, with faults to order: for the driver's own tests.

It is no firmware: what the firmware does is tested on the emulated board. Its clock stands still
unless it is read, and the simulated rig is what it drives.
"""

from softgrip.board import protocol
from softgrip.board.errors import ConnectionLostError
from softgrip.board.framing import Frame, FrameReader, encode
from softgrip.board.protocol import Flag, Reason, SetUp
from softgrip.simulator.simulation import Simulation
from softgrip.units import REV
from tests.simulator.rigs import design_1

STEPS = 800
LIMITS = {"pressure": 399, "position": 9000, "speed": 4000, "acceleration": 40000, "silence": 200}
HARD = {"pressure": 547, "position": 12000, "speed": 4000, "acceleration": 40000, "silence": 200}
"""Of the firmware's config.h."""


class StubBoard:
    """A `Link` with the board at its end.

    Faults: `deaf` answers nothing, `pull(seconds)` breaks the line for so long, `swallow` drops so
    many telemetry frames, `table` and `build` make another firmware, `reset()` starts it anew.
    """

    name, real_time = "stub", False

    def __init__(self, *, valve=False, table=protocol.TABLE, build=0xC0FFEE, rig=None):
        self.rig = rig or Simulation(design_1(), period=protocol.TELEMETRY_PERIOD)
        self.valve, self.table, self.build = valve, table, build
        self.deaf = self.closed = False
        self.pulled_until = -1.0
        self.swallow = 0
        self.received = []
        self._t = 0.0
        self.reset()
        self._measured = self.rig.measure()

    def reset(self):
        self.flags, self.speed, self.number, self.started = Flag(0), 0, 0, self._t
        self.limits, self.heard, self.last = dict(LIMITS), self._t, 0
        self._reader, self.out, self._next = FrameReader(), bytearray(), protocol.TELEMETRY_PERIOD

    # The link.

    def now(self):
        return self._t

    def write(self, data):
        self._check()
        for frame in self._reader.feed(data):
            self.heard = self._t
            self.received.append(protocol.BY_ID[frame.id].name)
            if not self.deaf:
                self._handle(frame)

    def read(self, timeout):
        self._check()
        if not self.out:
            self.elapse(timeout)
        return self.take()

    def take(self):
        data, self.out = bytes(self.out), bytearray()
        return data

    def close(self):
        self.closed = True

    def pull(self, seconds):
        self.pulled_until = self._t + seconds

    def _check(self):
        if self._t < self.pulled_until:
            self.elapse(0.01)
            raise ConnectionLostError("stub", "cable pulled")

    # The board.

    def elapse(self, seconds):
        end = self._t + seconds
        while self._t < end - 1e-9:
            self._t = min(end, self._t + 1e-3)
            if self._t - self.heard > self.limits["silence"] * 1e-3:
                self.flags |= Flag.HOST_SILENT
                self.speed = 0
            if self._t - self.started >= self._next - 1e-9:
                self._next += protocol.TELEMETRY_PERIOD
                self._sample()

    def _sample(self):
        command = self.speed / protocol.SPEED_SCALE / STEPS * REV
        if self.flags & Flag.HOMING:
            command = -REV
        self._measured = self.rig.advance(command)
        pressure, place = int(self._measured.pressure_counts[0]), self.rig.truth.plunger[0]
        self._set(Flag.OVER_PRESSURE, pressure >= self.limits["pressure"])
        if self.flags & Flag.OVER_PRESSURE and self.speed > 0:
            self.speed = 0
        if self.flags & Flag.HOMING and place <= 0:
            self.flags = (self.flags & ~Flag.HOMING) | Flag.HOMED
        self._set(Flag.MOVING, bool(abs(self.rig.truth.motor_speed[0]) > 1e-9))
        self.number = (self.number + 1) % 65536
        if self.swallow:
            self.swallow -= 1
            return
        channels = [0] * len(protocol.CHANNELS)
        channels[protocol.CHANNELS.index("pressure")] = pressure
        channels[protocol.CHANNELS.index("flex_1")] = int(self._measured.angle_counts[0, 0])
        channels[protocol.CHANNELS.index("flex_2")] = 512
        self._say(
            protocol.TELEMETRY, 0, number=self.number, time=round((self._t - self.started) * 1e3),
            channels=tuple(channels), position=round(place / 8e-3 * STEPS), speed=self.speed,
            flags=int(self.flags), last=self.last,
        )  # fmt: skip

    def _set(self, flag, on):
        self.flags = self.flags | flag if on else self.flags & ~flag

    def _say(self, message, sequence, **values):
        self.out += encode(Frame(message.id, sequence, message.pack(**values)))

    def _handle(self, frame):
        fields = protocol.BY_ID[frame.id].unpack(frame.payload)
        self.flags &= ~Flag.HOST_SILENT
        self.last, reason = frame.sequence, 0
        if frame.id == protocol.HELLO.id:
            if fields["table"] != self.table:
                reason = Reason.WRONG_VERSION
            else:
                self.flags = (self.flags | Flag.GREETED) & ~Flag.HOMING
                self.speed = 0
                hard = {f"hard_{name}": value for name, value in HARD.items()}
                self._say(
                    protocol.HELLO_ANSWER, frame.sequence,
                    version=protocol.PROTOCOL_VERSION, table=self.table, build=self.build,
                    set_up=int(SetUp.GRIPPER), reset_cause=1, valve=int(self.valve), steps=STEPS,
                    **self.limits, **hard,
                )  # fmt: skip
                return
        elif not self.flags & Flag.GREETED and frame.id != protocol.ESTOP.id:
            reason = Reason.NOT_GREETED
        elif frame.id == protocol.COUNTERS.id:
            zeros = dict.fromkeys(("bad", "overlong", "lost", "stale", "dropped"), 0)
            self._say(protocol.COUNTERS_ANSWER, frame.sequence, good=self._reader.good, **zeros)
            return
        else:
            reason = self._act(frame.id, fields)
        if reason:
            self._say(protocol.NACK, frame.sequence, id=frame.id, reason=int(reason))
        else:
            self._say(protocol.ACK, frame.sequence, id=frame.id)

    def _act(self, message, fields):
        if message == protocol.SETPOINT.id:
            if self.flags & Flag.HOMING:
                return Reason.MOVING
            speed, self.speed = fields["speed"], 0
            if self.flags & Flag.ESTOPPED:
                return Reason.ESTOPPED
            if abs(speed) > self.limits["speed"] * protocol.SPEED_SCALE:
                return Reason.SPEED_LIMIT
            if speed > 0 and not self.flags & Flag.HOMED:
                return Reason.NOT_HOMED
            if speed > 0 and self.flags & Flag.OVER_PRESSURE:
                return Reason.OVER_PRESSURE
            self.speed = speed
        elif message == protocol.ESTOP.id:
            self.flags |= Flag.ESTOPPED
            self.speed = 0
        elif message == protocol.CLEAR.id:
            self.flags &= ~Flag.ESTOPPED
        elif message == protocol.HOME.id:
            if self.flags & Flag.ESTOPPED:
                return Reason.ESTOPPED
            if self.flags & (Flag.MOVING | Flag.HOMING):
                return Reason.MOVING
            self.flags = (self.flags & ~Flag.HOMED) | Flag.HOMING
        elif message == protocol.SET_LIMITS.id:
            if any(fields[name] > HARD[name] for name in HARD):
                return Reason.HARD_BOUND
            self.limits = fields
        elif message == protocol.VENT.id:
            if not self.valve:
                return Reason.NO_VALVE
            self._set(Flag.VALVE_OPEN, bool(fields["open"]))
        return 0
