"""What happens to files: on disks, on lines, and in spreadsheets."""

import re
from collections.abc import Callable

from numpy.random import Generator

ODD = (
    b"", b"nan", b"NaN", b"inf", b"-inf", b"1e999", b"-", b"+", b".", b",", b"1,234.5", b"1.234,5",
    b"0x10", b"1_000", b"#REF!", b"n/a", b"--", b'"', b'"a""b"', b"'", b"\x00", b"\xff", b"\xc3",
    b"1e-320", b"-0", b"9" * 400, b"[", b"]", b"[Pa]", b"time [s]", b"True", b"null", b"{}", b"[]",
    b"1+2j", b"\xd9\xa1", b"\xc2\xb2", b"\xe2\x88\x925", b"#", b"=", b"line: a", b"weight: x gf",
    b"weight: -5 gf", b"weight: 1e400 gf",
)  # fmt: skip
"""Cells that are none."""
UNITS = (
    b"[deg]", b"[psi]", b"[bar]", b"[furlong]", b"[]", b"[", b"[1]", b"[m^]", b"[%]", b"[1/0]",
    b"[s**99]", b"[kg*(]", b"[degC]", b"[dB]",
)  # fmt: skip
ENCODINGS = ("utf-16", "utf-16-le", "utf-8-sig", "utf-32", "latin-1", "cp437", "utf-7")

Damage = Callable[[bytes, Generator], bytes]


def flip(data: bytes, random: Generator) -> bytes:
    """Change some bytes."""
    found = bytearray(data)
    for at in random.integers(0, max(len(found), 1), random.integers(1, 9)):
        found[at : at + 1] = bytes([random.integers(256)])
    return bytes(found)


def cut(data: bytes, random: Generator) -> bytes:
    """End a file early, or begin it late."""
    at = int(random.integers(0, len(data) + 1))
    return data[:at] if random.random() < 0.7 else data[at:]


def lines(data: bytes, random: Generator) -> bytes:
    """Lose, double, swap or empty lines."""
    found = data.splitlines(keepends=True)
    for _ in range(int(random.integers(1, 6))):
        if not found:
            break
        one, other = (int(k) for k in random.integers(0, len(found), 2))
        match random.integers(5):
            case 0:
                del found[min(one, other) : max(one, other) + 1]
            case 1:
                found.insert(other, found[one])
            case 2:
                found[one], found[other] = found[other], found[one]
            case 3:
                found[one] = b"\n"
            case _:
                found[one] = found[one].rstrip(b"\r\n") + found[other]
    return b"".join(found)


def cells(data: bytes, random: Generator) -> bytes:
    """Put into some cells what is none, or another one's."""
    found = re.split(rb"([,;\t\n:=])", data)
    for _ in range(int(random.integers(1, 6))):
        at = 2 * int(random.integers(0, (len(found) + 1) // 2))
        other = 2 * int(random.integers(0, (len(found) + 1) // 2))
        found[at] = ODD[random.integers(len(ODD))] if random.random() < 0.7 else found[other]
    return b"".join(found)


def column(data: bytes, random: Generator) -> bytes:
    """Change a whole column: lose it, double it, or put one thing into it."""
    separator = max((b",", b";", b"\t"), key=data.count)
    at, odd, way = int(random.integers(8)), ODD[random.integers(len(ODD))], random.integers(3)
    found = []
    for line in data.splitlines():
        row = line.split(separator)
        if len(row) > max(at, 1) and not line.startswith(b"#"):
            row[at : at + 1] = ([], [row[at]] * 2, [odd])[way]
        found.append(separator.join(row))
    return b"\n".join(found) + b"\n"


def units(data: bytes, random: Generator) -> bytes:
    """Put another unit in place of one, here or throughout."""
    found = re.findall(rb"\[[^\]\n]*\]", data)
    if not found:
        return data
    count = 1 if random.random() < 0.7 else -1
    return data.replace(
        found[random.integers(len(found))], UNITS[random.integers(len(UNITS))], count
    )


def signs(data: bytes, random: Generator) -> bytes:
    """Take one separator, sign, quote or line end for another, here and there or throughout."""
    known = (b",", b";", b"\t", b" ", b".", b'"', b"\n", b"\r\n", b":", b"[", b"(", b"-", b"e")
    old, new = (known[k] for k in random.integers(0, len(known), 2))
    count = -1 if random.random() < 0.6 else int(random.integers(1, 30))
    return data.replace(old, new, count)


def encoding(data: bytes, random: Generator) -> bytes:
    """Save in another encoding, and perhaps read it as a third."""
    text = data.decode("latin-1")
    return text.encode(ENCODINGS[random.integers(len(ENCODINGS))], errors="replace")


def numbers(data: bytes, random: Generator) -> bytes:
    """Make some numbers other ones: negative, huge, tiny, all alike."""
    found = re.split(rb"(\d+(?:[.,]\d+)?(?:e[+-]?\d+)?)", data)
    places = range(1, len(found), 2)
    if not len(places):
        return data
    new = (b"0", b"-1", b"1e300", b"1e-300", b"-1e300", b"1", b"3e5", b"1e19")[random.integers(8)]
    share = random.choice([0.01, 0.1, 1.0])
    first = int(random.integers(2)) * len(found) // 3
    for at in places:
        if at > first and random.random() < share:
            found[at] = new
    return b"".join(found)


def together(data: bytes, random: Generator) -> bytes:
    """Append a file to itself, or put it within itself."""
    at = int(random.integers(0, len(data) + 1))
    return data[:at] + data + data[at:]


DAMAGES: tuple[Damage, ...] = (
    flip, cut, lines, cells, column, units, signs, encoding, numbers, together
)  # fmt: skip


def damaged(data: bytes, random: Generator) -> bytes:
    """Return a file that some of this happened to."""
    for _ in range(int(random.choice([1, 1, 1, 2, 3]))):
        data = DAMAGES[random.integers(len(DAMAGES))](data, random)
    return data
