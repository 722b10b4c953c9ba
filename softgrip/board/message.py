"""A message of the board's protocol: its fields, and how they go into bytes and back."""

import struct
from dataclasses import dataclass
from functools import cached_property

from softgrip.errors import InvalidInputError


@dataclass(frozen=True)
class Field:
    """One number of a message, or an array of them: name, code of `struct`, unit, words."""

    name: str
    code: str
    unit: str
    words: str
    count: int = 1


@dataclass(frozen=True)
class Message:
    """A message: name, id (from the host below 128), words, fields.

    Examples
    --------
    >>> turn = Message("turn", 2, "Turn.", (Field("speed", "i", "step/s", ""),))
    >>> turn.pack(speed=-2).hex(), turn.unpack(turn.pack(speed=-2))
    ('feffffff', {'speed': -2})
    """

    name: str
    id: int
    words: str
    fields: tuple[Field, ...] = ()

    @cached_property
    def layout(self) -> struct.Struct:
        """Its payload, little-endian and unpadded."""
        codes = (f"{field.count if field.count > 1 else ''}{field.code}" for field in self.fields)
        return struct.Struct("<" + "".join(codes))

    def pack(self, **values: int | tuple[int, ...]) -> bytes:
        """Return the payload that holds a value for each field.

        Raises
        ------
        InvalidInputError
            If a field is missing, unknown, or its value does not fit.
        """
        names = [field.name for field in self.fields]
        if sorted(values) != sorted(names):
            raise InvalidInputError(self.name, expected=f"fields {names}", got=sorted(values))
        flat: list[int] = []
        for field in self.fields:
            value = values[field.name]
            flat.extend(value if isinstance(value, tuple) else (value,))
        try:
            return self.layout.pack(*flat)
        except struct.error as error:
            raise InvalidInputError(
                self.name, expected=f"numbers that fit {self.layout.format}", got=values
            ) from error

    def unpack(self, payload: bytes) -> dict[str, int | tuple[int, ...]]:
        """Return the values in a payload, a tuple for an array.

        Raises
        ------
        InvalidInputError
            If the payload's length is another one.
        """
        if len(payload) != self.layout.size:
            raise InvalidInputError(
                self.name, expected=f"{self.layout.size} bytes of payload", got=len(payload)
            )
        numbers = iter(self.layout.unpack(payload))
        return {
            field.name: tuple(next(numbers) for _ in range(field.count))
            if field.count > 1
            else next(numbers)
            for field in self.fields
        }
