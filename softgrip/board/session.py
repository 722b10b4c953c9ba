"""A conversation with a board: numbered commands and their answers, telemetry, a heartbeat."""

import threading
from collections.abc import Callable
from dataclasses import dataclass

from softgrip.board import protocol
from softgrip.board.errors import (
    BoardError,
    BoardResetError,
    CommandRefusedError,
    NoAnswerError,
    NoBoardError,
    VersionMismatchError,
)
from softgrip.board.framing import Frame, FrameReader, encode
from softgrip.board.link import Link
from softgrip.board.protocol import Flag, Message, Reason, Values, in_words

GREET_WITHIN = 6.0
"""s: an Arduino that was reset by the opening of its port answers after one to two."""
HEARTBEAT_EVERY = 0.05
"""s: a quarter of the silence that the board allows."""
READ_FOR = 0.01
"""s that one reading waits."""
ANSWER_WITHIN = 0.25
"""s for an answer, before a command is sent again."""
TRIES = 4


@dataclass(frozen=True)
class Telemetry:
    """A telemetry frame.

    Attributes:
        number: Of the frame, round from 65535.
        time: Since the board's reset, s.
        channels: Counts, in the order of `protocol.CHANNELS`.
        position, speed: In steps, and in the board's unit of speed.
        flags: The board's state.
    """

    number: int
    time: float
    channels: tuple[int, ...]
    position: int
    speed: int
    flags: Flag

    @classmethod
    def of(cls, payload: bytes) -> "Telemetry":
        """Return the content of a frame's payload."""
        number, time, *more = protocol.TELEMETRY.layout.unpack(payload)
        position, speed, flags, _ = more[-4:]
        return cls(number, time * 1e-3, tuple(more[:-4]), position, speed, Flag(flags))


class Session:
    """A conversation over a link.

    Every message can be said twice without harm, so that one without an answer is said again,
    under a new number.

    Args:
        link: The line. If it is a real-time one, a thread listens and keeps the heart beating
            between calls; else its clock stands still meanwhile, and the caller's waiting does
            both.

    Attributes:
        telemetry: The last frame; None before the first.
        heard_at: When it came, by the line's clock, s.
        lost: Telemetry frames that never came, by their numbers.
    """

    def __init__(self, link: Link) -> None:
        self.link, self.port = link, link.name
        self.reader = FrameReader()
        self.telemetry: Telemetry | None = None
        self.heard_at, self.lost = link.now(), 0
        self._sequence, self._sent_at = 0, link.now()
        self._alive_until = float("inf")
        self._answers: dict[int, Frame] = {}
        self._fault: BoardError | None = None
        self._news = threading.Condition()
        self._closing = False
        self._thread: threading.Thread | None = None
        if link.real_time:
            self._thread = threading.Thread(target=self._listen, name="softgrip link", daemon=True)
            self._thread.start()

    @property
    def state(self) -> str:
        """The board's flags in words; empty before telemetry."""
        return "" if self.telemetry is None else in_words(self.telemetry.flags)

    def alive_for(self, seconds: float) -> None:
        """Let the heart beat for some seconds from now, and no longer.

        A program that hangs must not keep a motor turning: without a heartbeat the board stops it.
        """
        self._alive_until = self.link.now() + seconds

    def ask(self, message: Message, *, tries: int = TRIES, **values: int) -> Values:
        """Say a message with these fields and return the answer's.

        Raises:
            CommandRefusedError: If the board says no.
            NoAnswerError: If it says nothing.
            ConnectionLostError: If the line broke, or the board has begun anew.
        """
        payload = message.pack(**values)
        for _ in range(tries):
            with self._news:
                sequence = self._send(message, payload)
                deadline = self.link.now() + ANSWER_WITHIN
                while sequence not in self._answers and self.link.now() < deadline:
                    self._turn()
                answer = self._answers.pop(sequence, None)
            if answer is None:
                continue
            if answer.id != protocol.NACK.id:
                return protocol.BY_ID[answer.id].unpack(answer.payload)
            _, reason = protocol.NACK.layout.unpack(answer.payload)
            if reason == Reason.NOT_GREETED:
                raise BoardResetError(self.port, "the board was reset", command=message.name)
            if reason != Reason.STALE:  # it was overtaken: say it again
                raise CommandRefusedError(
                    self.port,
                    protocol.reason_in_words(reason),
                    command=message.name,
                    state=self.state,
                )
        raise NoAnswerError(self.port, "no answer", command=message.name, state=self.state)

    def greet(self, within: float = GREET_WITHIN) -> Values:
        """Say HELLO until a board answers, and return its answer.

        Raises:
            VersionMismatchError: If the firmware was made from another table of messages.
            NoBoardError: If nothing answers.
        """
        own = {"version": protocol.PROTOCOL_VERSION, "table": protocol.TABLE}
        deadline = self.link.now() + within
        while True:
            try:
                told = self.ask(protocol.HELLO, tries=1, **own)
                break
            except NoAnswerError:
                if self.link.now() >= deadline:
                    raise NoBoardError(
                        self.port, f"no board answered in {within:g} s: is softgrip_rig flashed?"
                    ) from None
            except CommandRefusedError as error:
                if error.reason != in_words(Reason.WRONG_VERSION):
                    raise
                told = {}
                break
        if not own.items() <= told.items():
            raise VersionMismatchError(
                self.port,
                "the firmware is not of this softgrip, which speaks protocol "
                f"{own['version']} ({own['table']:08x}): flash "
                "softgrip/board/firmware/softgrip_rig/softgrip_rig.ino",
                command="hello",
            )
        return told

    def wait(self, done: Callable[[], bool], seconds: float, what: str) -> None:
        """Listen until something is so; NoAnswerError if it is not within some seconds."""
        deadline = self.link.now() + seconds
        with self._news:
            while not done():
                if self.link.now() >= deadline:
                    raise NoAnswerError(self.port, f"no {what} in {seconds:g} s", state=self.state)
                self._turn()

    def end(self) -> None:
        """End the conversation; the line stays open."""
        self._closing = True
        if self._thread is not None:
            self._thread.join()

    def _send(self, message: Message, payload: bytes) -> int:
        with self._news:
            self._sequence = (self._sequence + 1) % 256
            self._answers.pop(self._sequence, None)
            self._sent_at = self.link.now()
            self.link.write(encode(Frame(message.id, self._sequence, payload)))
            return self._sequence

    def _turn(self) -> None:
        """Let something happen: listen, or wait for the thread that does.

        What had come before a fault counts first, so a fault of this turn is raised in the next.
        """
        if self._fault is not None:
            raise self._fault
        if self._thread is None:
            self._exchange()
        else:
            self._news.wait(READ_FOR)

    def _listen(self) -> None:
        while not self._closing and self._fault is None:
            try:
                self._exchange()
            except BoardError as error:
                with self._news:
                    self._fault = error
                    self._news.notify_all()

    def _exchange(self) -> None:
        data = self.link.read(READ_FOR)
        now = self.link.now()
        with self._news:
            for frame in self.reader.feed(data):
                self._take(frame)
            self._news.notify_all()
        if now - self._sent_at >= HEARTBEAT_EVERY and now < self._alive_until:
            self._send(protocol.HEARTBEAT, b"")

    def _take(self, frame: Frame) -> None:
        if (
            frame.id not in protocol.BY_ID
            or len(frame.payload) != protocol.BY_ID[frame.id].layout.size
        ):
            return  # a board of another version; the handshake says so
        if frame.id == protocol.TELEMETRY.id:
            new, old = Telemetry.of(frame.payload), self.telemetry
            if old is not None:
                if new.time < old.time:
                    # Its time and place are of another life: what was last known stays.
                    self._fault = BoardResetError(
                        self.port, "the board was reset", state=self.state
                    )
                    return
                self.lost += (new.number - old.number - 1) % 65536 if new.time > old.time else 0
            self.telemetry, self.heard_at = new, self.link.now()
        elif not (frame.id == protocol.ACK.id and frame.payload[0] == protocol.HEARTBEAT.id):
            self._answers[frame.sequence] = frame
