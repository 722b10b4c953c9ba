#!/usr/bin/env bash
# Linux, pseudo-terminals: what the device side said last is lost, what the host said last is not.
#
# Guess: a pseudo-terminal is a pair of pipes: after either end is closed the other one reads what
#        was sent before, and then meets the end.
# Seen:  so it is for the side of the emulated device (the master). When that side closes, the
#        kernel hangs the terminal up and throws away what the host has not read yet, though
#        in_waiting had told how much it was; pyserial 3.5 then says that the device "returned no
#        data". So a test that lets an emulated board say its last word and close is a race with
#        the reader. A USB adapter that is pulled is hung up too; that was not tried.
# Meets: who tests a driver against a pty; who wants to know a board's last word before it went.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check pyserial==3.5
"$folder/venv/bin/python" - <<'PY'
import os
import select
import sys
import tty

import serial


def ends():
    board, device = os.openpty()
    tty.setraw(device)
    return board, device, os.ttyname(device)


board, device, name = ends()
port = serial.Serial(name, timeout=1)
os.write(board, b"over pressure, off\n")
select.select([port], [], [])
waiting = port.in_waiting
os.close(board)
try:
    heard = port.read(waiting)
except serial.SerialException as error:
    heard = b""
    print(f"the host had {waiting} bytes waiting, and reads {heard!r}: {error}")
os.close(device)

board, device, name = ends()
port = serial.Serial(name)
port.write(b"stop\n")
port.close()
os.close(device)
asked = os.read(board, 100)
print(f"the device, after the host has closed, reads {asked!r}")
sys.exit(not (waiting == 19 and heard == b"" and asked == b"stop\n"))
PY
