"""Chapter 4's pushes with the example rig's finger, as logs: they hang on no fit."""

from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from book.chapter_4.logs import PUSHES
from tests.simulator.rigs import design_1

_FOLDER = TemporaryDirectory()


@cache
def push_log(name):
    """Write the log of a push, one of `PUSHES`, and return its path."""
    recipe = PUSHES[name]
    rig, path = replace(design_1(), pump=recipe.rig().pump), Path(_FOLDER.name) / f"{name}.csv"
    replace(recipe, rig=lambda: rig).write(path, "the example rig")
    return path
