"""Serve an emulated rig on a pseudo-terminal until interrupted: a port to try programs on."""

import time

from softgrip.board.emulated.link import EmulatedFingers
from softgrip.board.emulated.terminal import Terminal

if __name__ == "__main__":
    with Terminal(EmulatedFingers()) as port:
        print(f"connect({port!r}, emulated=True) drives a simulated rig; end this with Ctrl-C")
        try:
            while True:
                time.sleep(1)
        except KeyboardInterrupt:
            pass
