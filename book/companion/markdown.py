"""Markdown that a cell displays, in a page as in a notebook."""

from collections.abc import Callable
from dataclasses import dataclass

import pandas as pd


@dataclass(frozen=True)
class Markdown:
    """A piece of Markdown that a notebook displays."""

    text: str

    def _repr_markdown_(self) -> str:
        return self.text


def markdown_table(frame: pd.DataFrame, cell: Callable[[object], str] = str) -> str:
    """Return a table in Markdown, its columns of numbers to the right; cells may hold Markdown."""
    numeric = [pd.api.types.is_numeric_dtype(kind) for kind in frame.dtypes]
    lines = [
        "| " + " | ".join(map(str, frame.columns)) + " |",
        "|" + "|".join("---:" if right else ":---" for right in numeric) + "|",
        *("| " + " | ".join(map(cell, row)) + " |" for row in frame.itertuples(index=False)),
    ]
    return "\n".join(lines)


def as_markdown(frame: pd.DataFrame) -> Markdown:
    """Return a table to display, as of `markdown_table`."""
    return Markdown(markdown_table(frame))
