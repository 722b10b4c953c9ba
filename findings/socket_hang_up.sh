#!/usr/bin/env bash
# pyserial 3.5, socket://: a reading in which the peer hangs up loses what it had got.
#
# Guess: as on a socket, the bytes that came before the end are read first; then the end is told.
# Seen:  read(n) collects in a list; when it meets the end before n bytes are there, it raises, and
#        the list is dropped. A reader that asks for 64 bytes at a time, or for one and then for
#        `in_waiting` (which is 1 at the end too), loses the last frame, and with it why the peer
#        went. Asked for byte by byte, all arrive.
# Meets: who reads a board behind a serial-to-network bridge, or an emulated one.
set -euo pipefail
folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install -q --disable-pip-version-check pyserial==3.5
"$folder/venv/bin/python" - <<'PY'
import socket
import sys

import serial

SAID = b"12.5\n13.0\nover pressure, off\n"


def heard(size):
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = serial.serial_for_url(f"socket://127.0.0.1:{server.getsockname()[1]}", timeout=5)
        peer, _ = server.accept()
        with peer:
            peer.sendall(SAID)
        found = b""
        try:
            while True:
                found += port.read(size)
        except serial.SerialException as error:
            print(f"read({size}): {found!r}, then {error}")
        port.close()
        return found


sys.exit((heard(8), heard(1)) != (SAID[:24], SAID))
PY
