"""The emulated board in real time behind a pseudo-terminal, which pyserial opens as a port."""

import contextlib
import os
import threading
import time
import tty

from softgrip.board.emulated.link import EmulatedLink


class Terminal:
    """A pseudo-terminal; ``with Terminal(link) as port`` gives its name."""

    def __init__(self, link: EmulatedLink) -> None:
        self._link, self._over = link, threading.Event()
        self._host, self._device = os.openpty()
        tty.setraw(self._device)
        os.set_blocking(self._host, False)
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self) -> str:
        self._thread.start()
        return os.ttyname(self._device)

    def __exit__(self, *error: object) -> None:
        self._over.set()
        self._thread.join()
        os.close(self._host)
        os.close(self._device)

    def _run(self) -> None:
        begun = time.monotonic() - self._link.now()
        while not self._over.is_set():
            with contextlib.suppress(BlockingIOError):
                self._link.write(os.read(self._host, 4096))
            ahead = time.monotonic() - begun - self._link.now()
            # A machine that was busy must not make the host seem silent: time lost stays lost.
            begun += max(0.0, ahead - 0.05)
            if ahead <= 0:
                time.sleep(0.001)
            elif data := self._link.read(min(ahead, 0.005)):
                # A port that nobody reads loses what does not fit, as a serial line does.
                with contextlib.suppress(BlockingIOError):
                    os.write(self._host, data)
