"""Files that a reader hands over."""

from pathlib import Path

from softgrip.errors import DataFileError, InvalidInputError


def path_of(path: Path | str) -> Path:
    """Return the path that is given.

    Raises:
        InvalidInputError: If it is none.
    """
    if not isinstance(path, str | Path):
        raise InvalidInputError("path", expected="the path of a file", got=path)
    return Path(path)


def existing(path: Path | str) -> Path:
    """Return the path of a file that is there.

    Raises:
        InvalidInputError: If it is no path.
        DataFileError: If there is no such file.
    """
    file = path_of(path)
    if not file.is_file():
        raise DataFileError(file, expected="a file", got="none")
    return file
