"""A conversation with a board: numbered commands and their answers, telemetry, a heartbeat."""

import threading
from collections.abc import Callable

from softgrip.board.errors import (
    BoardError,
    BoardResetError,
    CommandRefusedError,
    NoAnswerError,
)
from softgrip.board.framing import Frame, FrameReader, encode
from softgrip.board.link import Link
from softgrip.board.protocol import ACK, BY_ID, HEARTBEAT, NACK, TELEMETRY, Flag, Message, Reason
from softgrip.board.telemetry import Telemetry, in_words, reason_name

HEARTBEAT_EVERY = 0.05
"""s: a quarter of the silence that the board allows."""
READ_FOR = 0.01
"""s that one reading waits."""
ANSWER_WITHIN = 0.25
"""s for an answer, before a command is sent again."""
TRIES = 4

Values = dict[str, int | tuple[int, ...]]


class Session:
    """A conversation over a link.

    Every message can be said twice without harm, so that one without an answer is said again,
    under a new number.

    Parameters
    ----------
    link
        The line.
    port
        Its name, for messages.
    background
        Whether a thread listens and keeps the heart beating between calls. A line whose clock
        stands still between readings must not have one: its caller's waiting does both.

    Attributes
    ----------
    telemetry
        The last frame; None before the first.
    heard_at
        When it came, by the line's clock, s.
    lost
        Telemetry frames that never came, by their numbers.
    """

    def __init__(self, link: Link, port: str, *, background: bool) -> None:
        self.link, self.port = link, port
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
        if background:
            self._thread = threading.Thread(target=self._listen, name="softgrip link", daemon=True)
            self._thread.start()

    @property
    def state(self) -> str:
        """The board's flags in words; empty before telemetry."""
        flags = Flag(0) if self.telemetry is None else self.telemetry.flags
        return ", ".join(in_words(flags))

    def alive_for(self, seconds: float) -> None:
        """Let the heart beat for some seconds from now, and no longer.

        A program that hangs must not keep a motor turning: without a heartbeat the board stops it.
        """
        self._alive_until = self.link.now() + seconds

    def ask(self, message: Message, **values: int) -> Values:
        """Say a message with these fields; see `say`."""
        return self.say(message, message.pack(**values))

    def say(self, message: Message, payload: bytes, *, tries: int = TRIES) -> Values:
        """Say something and return the answer's fields.

        Raises
        ------
        CommandRefusedError
            If the board says no.
        NoAnswerError
            If it says nothing.
        ConnectionLostError
            If the line broke, or the board has begun anew.
        """
        for _ in range(tries):
            with self._news:
                sequence = self._send(message, payload)
                deadline = self.link.now() + ANSWER_WITHIN
                while sequence not in self._answers and self.link.now() < deadline:
                    self._turn()
                answer = self._answers.pop(sequence, None)
            if answer is None:
                continue
            if answer.id != NACK.id:
                return BY_ID[answer.id].unpack(answer.payload)
            _, reason = NACK.layout.unpack(answer.payload)
            if reason == Reason.NOT_GREETED:
                raise BoardResetError(self.port, "the board was reset", command=message.name)
            if reason != Reason.STALE:  # it was overtaken: say it again
                raise CommandRefusedError(
                    self.port, reason_name(reason), command=message.name, state=self.state
                )
        raise NoAnswerError(self.port, "no answer", command=message.name, state=self.state)

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
            self._send(HEARTBEAT, b"")

    def _take(self, frame: Frame) -> None:
        if frame.id not in BY_ID or len(frame.payload) != BY_ID[frame.id].layout.size:
            return  # a board of another version; the handshake says so
        if frame.id == TELEMETRY.id:
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
        elif not (frame.id == ACK.id and frame.payload[0] == HEARTBEAT.id):
            self._answers[frame.sequence] = frame
