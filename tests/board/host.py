"""A host that says what it is told to, right or wrong; for tests of the firmware alone."""

from softgrip.board import protocol
from softgrip.board.emulated.board import PRESSURE, EmulatedBoard
from softgrip.board.framing import Frame, FrameReader, encode
from softgrip.board.protocol import Flag, Message, Reason

BEAT = 0.05
"""s between heartbeats."""
STEPS_A_COUNT = 40
"""Steps that raise the pressure by a count, of the syringe that `Host.run` pretends."""
PHASES = [0.0, 0.13e-3, 0.37e-3, 0.61e-3, 0.89e-3, 7.2e-3, 19.4e-3]
"""s: of what happens within the board's tick of 1 ms and its frame of 25 ms."""


class Host:
    """The other end of an emulated board's line.

    Attributes:
        board: At the other end.
        closed: Whether the pressure rises as the plunger goes in; else it is what a test puts
            there.
    """

    def __init__(self, board: EmulatedBoard, *, closed: bool = True) -> None:
        self.board, self.closed = board, closed
        self.telemetry: dict = {}
        self.frames: list[dict] = []
        self._reader, self._sequence = FrameReader(), 0
        board.advance(0.01)  # until it listens

    @property
    def flags(self) -> Flag:
        return Flag(self.telemetry["flags"])

    def listen(self) -> list[Frame]:
        """Return the answers that have come, telemetry put aside."""
        answers = []
        for frame in self._reader.feed(self.board.read_timed()[0]):
            if frame.id == protocol.TELEMETRY.id:
                self.telemetry = protocol.TELEMETRY.unpack(frame.payload)
                self.frames.append(self.telemetry)
            else:
                answers.append(frame)
        return answers

    def say(self, message: Message, *, sequence: int | None = None, **values: int) -> int:
        """Send a message, and return its sequence number; no time passes."""
        if sequence is None:
            sequence = self._sequence = (self._sequence + 1) % 256
        self.board.write(encode(Frame(message.id, sequence, message.pack(**values))))
        return sequence

    def ask(self, message: Message, *, sequence: int | None = None, **values: int):
        """Send a message; return None for its ACK, a Reason, or the values of another answer."""
        sequence = self.say(message, sequence=sequence, **values)
        for _ in range(20):
            self.board.advance(0.001)
            for frame in self.listen():
                if frame.sequence == sequence:
                    found = protocol.BY_ID[frame.id].unpack(frame.payload)
                    if frame.id == protocol.NACK.id:
                        return Reason(found["reason"])
                    return found if len(found) > 1 else None
        raise TimeoutError(f"no answer to {message.name}")

    def greet(self) -> dict:
        return self.ask(protocol.HELLO, version=protocol.PROTOCOL_VERSION, table=protocol.TABLE)

    def run(self, seconds: float, *, beat: bool = True) -> None:
        """Let time pass, heartbeats sent or not, to the last telemetry in it."""
        for k in range(round(seconds / 0.01)):
            if beat and k % round(BEAT / 0.01) == 0:
                self.say(protocol.HEARTBEAT)
            if self.closed:
                count = 102 + max(self.board.position, 0) // STEPS_A_COUNT
                self.board.set_count(PRESSURE, min(count, 380))
            self.board.advance(0.01)
            self.listen()

    def home(self) -> None:
        """Greet, home, and wait for the end of it."""
        self.greet()
        assert self.ask(protocol.HOME) is None
        for _ in range(400):
            self.run(0.1)
            if not self.flags & Flag.HOMING:
                break
        assert self.flags & Flag.HOMED

    def stopped_at(self) -> float:
        """Return the time of the last step, s."""
        return float(self.board.edges()[0][-1])


def pushing_host() -> Host:
    """Return a host whose motor pushes at full speed, 600 steps or more from home."""
    host = Host(EmulatedBoard(position=20))
    host.home()
    assert host.ask(protocol.SETPOINT, speed=4000 * protocol.SPEED_SCALE) is None
    host.run(0.3)
    assert host.board.position > 600
    return host
