"""The harness as Python calls it, and the firmware that it runs; both are built once a process."""

import ctypes
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from softgrip.board.emulated import build
from softgrip.board.protocol import SetUp


@cache
def _folder() -> TemporaryDirectory[str]:
    return TemporaryDirectory(prefix="softgrip-emulator-")


def built(set_up: SetUp = SetUp.GRIPPER, *, valve: bool = False) -> Path:
    """Return a firmware, built once a process."""
    return build.firmware(Path(_folder().name), set_up, valve=valve)


@cache
def library() -> ctypes.CDLL:
    """Return the functions of ``harness.c``, each with the prefix ``board_``."""
    found = ctypes.CDLL(str(build.harness(Path(_folder().name))))
    cycles, board = ctypes.c_uint64, ctypes.c_void_p
    doubles, numbers = ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_uint64)
    kinds = {
        "new": (board, ctypes.c_char_p),
        "free": (None, board),
        "run": (ctypes.c_int, board, cycles),
        "write": (None, board, ctypes.c_char_p, ctypes.c_size_t),
        "read": (ctypes.c_size_t, board, ctypes.c_char_p, doubles, ctypes.c_size_t),
        "pending": (ctypes.c_size_t, board),
        "due": (cycles, board),
        "cycle": (cycles, board),
        "edges": (ctypes.c_size_t, board),
        "edge_times": (numbers, board),
        "edge_ways": (ctypes.POINTER(ctypes.c_int8), board),
        "valve": (ctypes.c_int, board),
        "position": (ctypes.c_int32, board),
        "place": (None, board, ctypes.c_int32),
        "switch": (None, board, ctypes.c_int),
        "volts": (None, board, ctypes.c_int, ctypes.c_int),
        "hang": (None, board, ctypes.c_uint32, ctypes.c_int),
    }
    for name, (result, *arguments) in kinds.items():
        function = getattr(found, f"board_{name}")
        function.restype, function.argtypes = result, arguments
    return found
