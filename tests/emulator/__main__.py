"""Serve an emulated rig on a pseudo-terminal until interrupted: a port to try programs on."""

import time

from tests.emulator.emulated_rig import EmulatedRig
from tests.emulator.terminal import Terminal

if __name__ == "__main__":
    with Terminal(EmulatedRig()) as port:
        print(f"a simulated rig on an emulated board listens on {port}; end it with Ctrl-C")
        try:
            while True:
                time.sleep(1)
        except KeyboardInterrupt:
            pass
