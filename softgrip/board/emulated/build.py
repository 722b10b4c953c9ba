"""What the emulator runs, built once a process: the firmware by avr-gcc, the harness by gcc."""

import atexit
import ctypes
import shutil
import subprocess
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

from softgrip.board.firmware.header import SKETCH
from softgrip.board.protocol import SetUp
from softgrip.errors import SoftgripError


class EmulatorUnavailableError(SoftgripError, RuntimeError):
    """What compiles or runs the emulated board is not installed; says how to get it."""

    def __init__(self, packages: str) -> None:
        super().__init__(f"the emulated board needs: apt install {packages}")


CORE = Path("/usr/share/arduino/hardware/arduino/avr")
HARNESS = Path(__file__).with_name("harness.c")
NEEDED = {
    "avr-gcc": "gcc-avr avr-libc binutils-avr",
    "gcc": "gcc",
    str(CORE / "cores"): "arduino-core-avr",
    "/usr/include/simavr/sim_avr.h": "libsimavr-dev libelf-dev",
}

CHIP = ["-mmcu=atmega2560", "-DF_CPU=16000000L", "-DARDUINO=10808", "-DARDUINO_ARCH_AVR"]
# Debian's core asks for a macro that its own compiler does not have.
CHIP += ["-DDECIMAL_DIG=__DECIMAL_DIG__", "-Os", "-ffunction-sections", "-fdata-sections"]
INCLUDES = [f"-I{CORE}/cores/arduino", f"-I{CORE}/variants/mega"]


def missing() -> str:
    """Return the Debian packages that are missing, or an empty string."""
    packages = [
        package
        for thing, package in NEEDED.items()
        if not (Path(thing).exists() or shutil.which(thing))
    ]
    return " ".join(packages)


def _run(*command: object) -> str:
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{command[0]} failed:\n{done.stderr}")
    return done.stdout


@cache
def _folder() -> Path:
    """Return a folder that goes when the process ends, not when this is forgotten."""
    folder = Path(mkdtemp(prefix="softgrip-emulator-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def _file(name: str) -> Path:
    return _folder() / name


@cache
def _core() -> Path:
    """Build the part of the Arduino core that the sketch starts from."""
    objects = []
    for name in ("main.cpp", "hooks.c", "wiring.c", "wiring_digital.c"):
        source = CORE / "cores" / "arduino" / name
        objects.append(_file(f"core_{name}.o"))
        compiler = "avr-g++" if name.endswith("cpp") else "avr-gcc"
        _run(compiler, *CHIP, *INCLUDES, "-w", "-c", source, "-o", objects[-1])
    archive = _file("core.a")
    _run("avr-ar", "rcs", archive, *objects)
    return archive


@cache
def firmware(set_up: SetUp = SetUp.GRIPPER, *, valve: bool = False) -> Path:
    """Build the firmware as the Arduino IDE would, and return its ELF file.

    Raises:
        EmulatorUnavailableError: If what builds or runs it is not installed.
    """
    if packages := missing():
        raise EmulatorUnavailableError(packages)
    elf = _file(f"softgrip_rig_{set_up.name.lower()}{'_valve' if valve else ''}.elf")
    _run(
        *("avr-g++", *CHIP, *INCLUDES, "-std=gnu++11", "-Wall", "-Wextra", "-Werror"),
        *("-fno-exceptions", "-fno-threadsafe-statics", "-flto", "-Wl,--gc-sections"),
        *(f"-DSET_UP={int(set_up)}", f"-DVALVE={int(valve)}", "-include", "Arduino.h"),
        *("-x", "c++", SKETCH / "softgrip_rig.ino", *sorted(SKETCH.glob("*.cpp"))),
        *("-x", "none", _core(), "-lm", "-o", elf),
    )
    return elf


def sizes(elf: Path) -> tuple[int, int]:
    """Return the bytes of flash and of RAM (without the stack) that a firmware takes."""
    text, data, bss = (int(part) for part in _run("avr-size", elf).splitlines()[1].split()[:3])
    return text + data, data + bss


def symbol(elf: Path, name: str) -> int:
    """Return the address of a symbol of a firmware."""
    for line in _run("avr-nm", elf).splitlines():
        address, _, found = line.partition(" ")
        if found.split()[-1] == name:
            return int(address, 16)
    raise RuntimeError(f"no symbol {name} in {elf}")


@cache
def library() -> ctypes.CDLL:
    """Build the harness and return its functions, each with the prefix ``board_``."""
    built = _file("harness.so")
    _run(
        *("gcc", "-O2", "-shared", "-fPIC", "-Wall", "-Wextra", "-Werror", HARNESS),
        *("-I/usr/include/simavr", "-lsimavr", "-lelf", "-o", built),
    )
    found = ctypes.CDLL(str(built))
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
