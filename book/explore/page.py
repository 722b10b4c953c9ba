"""The HTML of an explorer: its sliders, its place for the plot, and what its script needs."""

import html
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from book.explore.plot import Mark, Plot
from book.explore.sliders import Range, Slider
from softgrip.errors import SoftgripError

BOOK = Path(__file__).parents[1]
VENDOR = BOOK / "_vendor"
LIBRARIES = ("_static/plot/d3.min.js", "_static/plot/plot.umd.min.js")
"""What draws, fetched by `book.build.vendor`."""
OWN = BOOK / "_static" / "explorer"


@dataclass(frozen=True)
class Explorer:
    """A figure with sliders that a page, or a notebook's cell, shows.

    Attributes:
        name: Its id in the page.
        sliders: By the name of what they move.
        alt: The picture in words.
        call: The function that gives the same in Python.
        plot, laws: What is drawn, and the law in JavaScript for each choice among words; or
        frames, told: pictures that were drawn ahead, as addresses of data, and what each says.
        alone: Whether it brings the scripts along that a page of the book has.
    """

    name: str
    sliders: Mapping[str, Slider | Range]
    alt: str
    call: str
    plot: Plot | None = None
    laws: Mapping[str, str] | None = None
    frames: Sequence[str] = ()
    told: Sequence[str] = ()
    alone: bool = False

    def _repr_html_(self) -> str:
        return (_scripts() if self.alone else "") + self._figure() + self._script()

    def _figure(self) -> str:
        controls = "".join(
            control(self.name, name, slider) for name, slider in self.sliders.items()
        )
        if self.plot is None:
            picture = f'<img src="{self.frames[0]}" alt="{html.escape(self.alt)}">'
            role, play, values = "", "", ""
            told = '<p class="told heard" aria-live="polite"></p>'
        else:
            picture, role = "", ' role="img"'
            told = '<p class="told" aria-live="polite"></p>'
            moves = any(getattr(m, "time", "") for panel in self.plot.panels for m in panel.marks)
            play = '<button type="button" class="play">play</button>' if moves else ""
            values = '<details class="values"><summary>values</summary><div></div></details>'
        key = (
            _key([mark for panel in self.plot.panels for mark in panel.marks]) if self.plot else ""
        )
        return (
            f'<figure class="explorer" id="{self.name}">'
            f'<div class="controls">{controls}</div>{told}'
            f'<div class="panels"{role}>{picture}</div>{key}'
            f'<div class="more"><button type="button" class="reset">reset</button>{play}{values}'
            '<details><summary>as code</summary><code class="call"></code></details>'
            f'<a class="link" href="#{self.name}">link to this state</a></div>'
            "<noscript>The sliders need JavaScript.</noscript></figure>"
        )

    def _script(self) -> str:
        told: dict[str, Any] = {
            "sliders": [slider.data(name) for name, slider in self.sliders.items()],
            "alt": self.alt, "call": self.call,
        }  # fmt: skip
        if self.plot is None:
            told |= {"frames": self.frames, "told": self.told}
        else:
            told["plot"] = self.plot.data()
        # A closing tag in a text would end the script.
        data = json.dumps(told, ensure_ascii=False).replace("</", "<\\/")
        laws = ",".join(f"{json.dumps(words)}:{law}" for words, law in (self.laws or {}).items())
        return (
            f"<script>(window.softgripExplorers||={{}})[{json.dumps(self.name)}]="
            f"Object.assign({data},{{laws:{{{laws}}}}});"
            f"window.softgripExplore?.();</script>"
        )


def control(explorer: str, name: str, slider: Slider | Range, note: str = "") -> str:
    """Return a slider with its label, and a note in smaller letters."""
    place = slider.start if isinstance(slider, Slider) else slider.place
    steps = slider.data(name)["steps"]
    return (
        f'<div class="control"><label for="{explorer}-{name}">{html.escape(slider.label)}'
        f"{f' <small>{html.escape(note)}</small>' if note else ''}</label>"
        f'<output for="{explorer}-{name}"></output>'
        f'<input type="range" id="{explorer}-{name}" name="{name}" min="0" max="{steps}" step="1" '
        f'value="{place}" autocomplete="off"></div>'
    )


def _key(marks: Sequence[Mark]) -> str:
    """Return the legend: a swatch and a word for each mark that has one."""
    shown = {mark.label: _swatch(mark) for mark in marks if mark.label}
    entries = "".join(f"<li>{swatch}{html.escape(label)}</li>" for label, swatch in shown.items())
    return f'<ul class="key">{entries}</ul>' if entries else ""


def _swatch(mark: Mark) -> str:
    colour = "currentColor" if mark.colour == "#000000" else mark.colour
    if mark.kind in ("line", "level"):
        inner = (
            f'<path d="M1 5h22" stroke="{colour}" stroke-width="2" '
            f'stroke-dasharray="{getattr(mark, "dash", "")}"/>'
        )
    elif mark.kind == "dots":
        inner = f'<circle cx="12" cy="5" r="3.5" fill="{colour}"/>'
    else:
        inner = f'<rect x="1" y="0" width="22" height="10" fill="{colour}" opacity="0.4"/>'
    return f'<svg viewBox="0 0 24 10" aria-hidden="true">{inner}</svg>'


def own_scripts() -> str:
    """Return what moves sliders in a notebook's cell: a page of the book has it from its head."""
    style = (OWN / "explore.css").read_text(encoding="utf-8")
    script = (OWN / "explore.js").read_text(encoding="utf-8")
    return f"<style>{style}</style><script>{script}</script>"


@cache
def _scripts() -> str:
    """Return the same, and before it what draws."""
    if not all((VENDOR / path).is_file() for path in LIBRARIES):
        raise SoftgripError(
            "what draws the sliders' figures was not fetched yet: `make lab` and `make book` do it"
        )
    texts = [(VENDOR / path).read_text(encoding="utf-8") for path in LIBRARIES]
    libraries = "".join(
        # Once a notebook; and not by the loader of modules that JupyterLab has.
        f"if(!window.{known}){{const define=undefined;{text}}}"
        for known, text in zip(("d3", "Plot"), texts, strict=True)
    ).replace("</script", "<\\/script")
    return f"<script>{libraries}</script>{own_scripts()}"
