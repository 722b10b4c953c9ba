"""What softgrip raises: each message says what was expected, what came, and what is valid."""


class SoftgripError(Exception):
    """Base of all errors of this package."""


class InvalidInputError(SoftgripError, ValueError):
    """A value given by the caller is outside what is valid."""

    def __init__(self, name: str, *, expected: str, got: object) -> None:
        self.expected, self.got = expected, got
        super().__init__(f"{name}: expected {expected}, got {got!r}")


class NotFiniteError(InvalidInputError):
    """A sample that is not a finite number; what was given it is as it was before."""

    def __init__(self, name: str, *, got: object) -> None:
        expected = "finite numbers (nothing has changed: leave this sample out, or stop)"
        super().__init__(name, expected=expected, got=got)


class FitWarning(UserWarning):
    """A fit that does not hold: what it gives is returned, and is not to be relied on."""


class DependentRowsWarning(UserWarning):
    """Rows that are not independent: what is tested on some of them was trained on their like."""


class LeftOutWarning(UserWarning):
    """Something of a file that was not read, such as a comment between its rows."""


class UnknownNameError(SoftgripError, KeyError):
    """A name that is not in a table; the message lists those that are."""

    def __init__(self, kind: str, name: str, valid: list[str]) -> None:
        self.message = f"no {kind} is named {name!r}; valid are: {', '.join(valid)}"
        super().__init__(self.message)

    def __str__(self) -> str:
        return self.message  # KeyError would show the repr, with its quotes


class DataFileError(SoftgripError, ValueError):
    """A data file does not hold what it should; names the file and, where known, the line."""

    def __init__(self, path: object, *, expected: str, got: str, line: int | None = None) -> None:
        where = f"{path}" if line is None else f"{path}, line {line}"
        super().__init__(f"{where}: expected {expected}, got {got}")


class DataUnavailableError(SoftgripError, OSError):
    """A public data set can neither be read from a folder nor fetched; says how to get it."""
