"""The laws of the pages, with plots and sliders as their cells give them, and their titles."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

import book
from book.explore import Range, Slider
from book.explore.plot import Plot
from softgrip.arrays import Floats
from softgrip.materials.table import table_5_1


@dataclass(frozen=True)
class PageLaw:
    """What a cell gives to `explore`."""

    law: Callable[..., Mapping[str, Any]]
    plot: Plot
    sliders: Mapping[str, Slider | Range]

    @property
    def ranges(self) -> dict[str, Range]:
        return {n: s for n, s in self.sliders.items() if isinstance(s, Range)}

    @property
    def words(self) -> list[dict[str, str]]:
        """All choices among words; one that is empty if there are none."""
        chosen = {n: s.values for n, s in self.sliders.items() if isinstance(s, Slider)}
        return [dict(zip(chosen, each, strict=True)) for each in product(*chosen.values())]

    def points(self, count: int, seed: int = 0) -> dict[str, Floats]:
        """Return points of the sliders' box, one array a slider: both ends, then random ones.

        They are that many for all choices among words together.
        """
        count = -(-count // len(self.words))
        random = np.random.default_rng(seed)
        found = {}
        for name, each in self.ranges.items():
            low, high = (np.log if each.log else float)(each.low), each.high
            high = np.log(high) if each.log else high
            at = random.uniform(low, high, count)
            values = np.exp(at) if each.log else at
            values[:2] = each.low, each.high
            found[name] = values
        return found


@cache
def page_laws() -> dict[str, PageLaw]:
    """Return all laws that the pages show, by name: of Chapters 2 to 6, and beyond them."""
    found = {}

    def explore(function, plot=None, *, alt, **sliders):
        assert alt
        if plot is not None:
            found[function.__name__] = PageLaw(function, plot, sliders)

    rooms = {f"chapter-{k}*.md": f"book.chapter_{k}.sliders" for k in range(2, 7)}
    rooms["beyond-design.md"] = "book.beyond.design.explorer"
    for names, room in rooms.items():
        pages = sorted(Path(book.__file__).parent.glob(names))
        text = "".join(page.read_text(encoding="utf-8") for page in pages)
        given = {"draw": import_module(room), "explore": explore,
                 "Range": Range, "Slider": Slider, "table_5_1": table_5_1}  # fmt: skip
        for cell in re.findall(r"^explore\(.*?^\)", text, re.MULTILINE | re.DOTALL):
            exec(cell, given)
    return found


def title(plot: Plot, found: Mapping[str, Any], **words: str) -> str:
    """Return what the page says above a plot."""
    told = {n: float(np.ravel(v)[0]) for n, v in found.items() if np.size(v)} | words
    hit = next((text for name, text in plot.cases if told[name]), plot.title)
    return hit.format(**told)
