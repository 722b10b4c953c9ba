#!/usr/bin/env bash
# pyserial 3.5 on Linux: exclusive=True keeps nobody out who does not ask, and outlives close().
#
# Guess: while a port is open with exclusive=True no other program can open it (TIOCEXCL); once it
#        is closed, anybody can.
# Seen:  it is a flock. A program that asks for no lock opens the port and writes into the
#        conversation. And a forked child shares the lock: after close() in the parent the port
#        cannot be opened again, by the parent either, as long as the child lives.
# Meets: who leaves a serial monitor open beside a controller; who has a pool of forked workers
#        (multiprocessing on Linux before Python 3.14) and reconnects after a pulled cable.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check pyserial==3.5
"$folder/venv/bin/python" - <<'PY'
import os
import subprocess
import sys

import serial

board, device = os.openpty()
name = os.ttyname(device)
port = serial.Serial(name, exclusive=True)
subprocess.run(["sh", "-c", f"printf intruder > {name}"], check=True)
arrived = os.read(board, 100)
print(f"beside an exclusive port another program wrote {arrived!r}")

reading, writing = os.pipe()
if not (child := os.fork()):
    os.close(writing)
    os.read(reading, 1)  # until the parent is done
    os._exit(0)
port.close()
try:
    serial.Serial(name, exclusive=True).close()
    kept = False
except serial.SerialException as error:
    kept = True
    print(f"closed, and opened again: {error}")
os.close(writing)
os.waitpid(child, 0)
serial.Serial(name, exclusive=True).close()
print("when the child has ended, it opens")
sys.exit(not (arrived == b"intruder" and kept))
PY
