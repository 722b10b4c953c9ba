"""Serve an emulated rig on a pseudo-terminal until interrupted: a port to try programs on."""

import time

from softgrip.board.emulated.emulated_rig import EmulatedRig
from softgrip.board.emulated.terminal import Terminal

if __name__ == "__main__":
    with Terminal(EmulatedRig()) as port:
        print(f"connect({port!r}, emulated=True) drives a simulated rig; end this with Ctrl-C")
        try:
            while True:
                time.sleep(1)
        except KeyboardInterrupt:
            pass
