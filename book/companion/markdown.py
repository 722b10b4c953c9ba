"""Markdown that a cell displays, in a page as in a notebook."""

import os
from collections.abc import Callable
from dataclasses import dataclass

import pandas as pd


@dataclass(frozen=True)
class Markdown:
    """A piece of Markdown that a notebook displays."""

    text: str

    def _repr_markdown_(self) -> str:
        return self.text


def in_static_book() -> bool:
    """Tell whether a page of the book is built, and not a notebook run."""
    return os.environ.get("SOFTGRIP_BOOK") == "static"


def markdown_table(
    frame: pd.DataFrame,
    cell: Callable[[object], str] = str,
    *,
    numbers: pd.DataFrame | None = None,
) -> str:
    """Return a table in Markdown, its columns of numbers to the right; cells may hold Markdown.

    Args:
        frame: The table.
        cell: What writes a cell.
        numbers: Where the cells of the table hold numbers as links or the like: the numbers.
    """
    kinds = (frame if numbers is None else numbers).dtypes
    numeric = [pd.api.types.is_numeric_dtype(kind) for kind in kinds]
    lines = [
        "| " + " | ".join(map(str, frame.columns)) + " |",
        "|" + "|".join("---:" if right else ":---" for right in numeric) + "|",
        *("| " + " | ".join(map(cell, row)) + " |" for row in frame.itertuples(index=False)),
    ]
    return "\n".join(lines)


def as_markdown(frame: pd.DataFrame) -> Markdown:
    """Return a table to display, as of `markdown_table`."""
    return Markdown(markdown_table(frame))
