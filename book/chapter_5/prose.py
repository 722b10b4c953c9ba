"""Computed numbers in the prose of Chapter 5."""

from collections.abc import Callable

WORDS: dict[str, Callable[[], str]] = {}
