"""Where a number or a file comes from, and the files that the package brings.

Each file of ``data/`` opens with comment lines that state it::

    # provenance: printed
    # source: Table 5.1
"""

import csv
import hashlib
from dataclasses import dataclass
from enum import StrEnum
from io import StringIO
from pathlib import Path

from softgrip.errors import DataFileError, InvalidInputError
from softgrip.files import existing


class Provenance(StrEnum):
    """The class of a data source, from the farthest from us to the nearest."""

    PRINTED = "printed"
    """Transcribed from the dissertation."""
    PUBLIC = "public"
    """Measured by others and published."""
    SIMULATED = "simulated"
    """Made by our simulated rig, from a seed."""
    LOGGED = "logged"
    """Recorded on a real rig."""


@dataclass(frozen=True)
class DataFile:
    """A file of ``data/`` with what its header states."""

    path: Path
    provenance: Provenance
    source: str

    @property
    def digest(self) -> str:
        """First 12 hexadecimal digits of the file's SHA-256."""
        return hashlib.sha256(self.path.read_bytes()).hexdigest()[:12]


def data_folder() -> Path:
    """Return the folder of the files that the package brings (in a wheel, or in a checkout)."""
    package = Path(__file__).parent
    installed = package / "_data"
    return installed if installed.is_dir() else package.parent / "data"


def data_file(name: str) -> DataFile:
    """Find a file of ``data/`` and read its provenance.

    Args:
        name: Path below ``data/``, with forward slashes.

    Raises:
        InvalidInputError: If there is no such file.
        DataFileError: If its header does not state provenance and source.

    >>> data_file("materials/table_5_1.csv").provenance
    <Provenance.PRINTED: 'printed'>
    """
    path = data_folder() / name
    if not path.is_file():
        raise InvalidInputError("name", expected=f"a file below {data_folder()}", got=name)
    return describe(path)


def describe(path: Path) -> DataFile:
    """Read the provenance of any file that states it, such as a log of a reader's own rig.

    Raises:
        DataFileError: If there is no such file, or its header does not state provenance and source.
    """
    existing(path)
    header: dict[str, str] = {}
    for line in _lines(path):
        if not line.startswith("#"):
            break
        key, _, value = line.lstrip("# ").partition(":")
        header[key.strip()] = value.strip()
    try:
        return DataFile(path, Provenance(header["provenance"]), header["source"])
    except (KeyError, ValueError) as error:
        raise DataFileError(
            path,
            expected="a header with '# provenance:' (one of "
            f"{', '.join(Provenance)}) and '# source:'",
            got=f"{error.args[0]!r}",
            line=1,
        ) from None


def cells(path: Path) -> list[list[str]]:
    """Read a CSV as strings, the columns' names first, without its lines that begin with ``#``."""
    return list(csv.reader(line for line in _lines(path) if not line.startswith("#")))


def _lines(path: Path) -> StringIO:
    try:
        return StringIO(path.read_text(encoding="utf-8-sig"))
    except UnicodeDecodeError as error:
        raise DataFileError(path, expected="text in UTF-8", got=str(error)) from None


def data_rows(name: str) -> list[dict[str, str]]:
    """Read a table of ``data/`` as strings, each row by the columns' names; see `data_file`."""
    names, *rows = cells(data_file(name).path)
    return [dict(zip(names, row, strict=True)) for row in rows]
