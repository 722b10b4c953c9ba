"""Computed numbers in the prose of Chapter 1."""

from book.chapter_1.diagrams import ENLARGED

WORDS = {"enlarged": lambda: f"{ENLARGED:g}"}
