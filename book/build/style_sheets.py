"""The style sheets of a page: no rule that matches nothing, no icon that is not shown.

The theme's sheet has all of Bootstrap and an icon font of 1,400 signs (0.55 MB of the 2 MB that a
chapter may load). A rule is left out if it asks for a class or an id that occurs as a word neither
in a page nor in a script, from which a class could be set later.
"""

import re
from collections.abc import Iterable
from itertools import groupby
from pathlib import Path
from typing import Any

import tinycss2
from fontTools import subset
from fontTools.ttLib import TTFont
from sphinx.application import Sphinx

SHEETS = ("styles/pydata-sphinx-theme.css", "sphinx-design.min.css", "mystnb.*.css")
"""Of the theme and of extensions, below ``_static``: those that are large."""
FONTS = "vendor/fontawesome/webfonts/*.ttf"
WORD = re.compile(r"[A-Za-z_][\w-]*")
MADE_BY_SCRIPTS = {"bs-tooltip-auto"}
"""Classes that the theme's scripts put together from parts."""
ICON = re.compile(r"[\ue000-\uf8ff]|\\[ef][0-9a-f]{3}\b")
"""A sign of an icon font, or its code, in a sheet."""
COMPRESSED = re.compile(r'url\([^)]*\.woff2\) format\("woff2"\),')


def names(selector: Iterable[Any]) -> set[str]:
    """Return the classes and ids that a selector asks for, those within ``:not()`` left aside.

    >>> sorted(names(tinycss2.parse_component_value_list("a.one:not(.two) > #three[four]:hover")))
    ['one', 'three']
    """
    found, before = set(), ""
    for token in selector:
        if token.type == "hash" or (token.type == "ident" and before == "."):
            found.add(token.value)
        before = token
    return found


def pruned(sheet: Iterable[Any], words: set[str]) -> list[Any]:
    """Return the rules of a parsed sheet that words allow, also those within ``@media``."""
    kept = []
    for rule in sheet:
        if rule.type == "qualified-rule":
            commas = groupby(rule.prelude, lambda token: token == ",")
            one_by_one = [list(part) for comma, part in commas if not comma]
            some = [part for part in one_by_one if names(part) <= words]
            if not some:
                continue
            if len(some) < len(one_by_one):
                rule.prelude = tinycss2.parse_component_value_list(
                    ",".join(map(tinycss2.serialize, some))
                )
        elif rule.type == "at-rule" and rule.lower_at_keyword in ("media", "supports"):
            rule.content = pruned(tinycss2.parse_rule_list(rule.content, True, True), words)
            if not rule.content:
                continue
        kept.append(rule)
    return kept


def light_sheet(sheet: str, words: set[str]) -> str:
    """Return a sheet without the rules that match nothing in pages of these words.

    Its fonts are then looked for where `light_font` leaves them.

    >>> light_sheet(".on, .off {top: 0} @media print {.off {top: 1px}}", {"on"})
    '.on{top: 0}'
    """
    rules = tinycss2.parse_stylesheet(sheet, skip_comments=True, skip_whitespace=True)
    light = tinycss2.serialize(pruned(rules, words)).replace(" {", "{")
    return COMPRESSED.sub("", light)


def icons(sheet: str) -> set[int]:
    r"""Return the code points of the icons that a sheet shows.

    >>> sorted(map(hex, icons('.a {content: "\\f0f3"} .b {content: "\uf06a"}')))
    ['0xf06a', '0xf0f3']
    """
    return {int(one[1:], 16) if one[0] == "\\" else ord(one) for one in ICON.findall(sheet)}


def light_font(file: Path, shown: set[int]) -> None:
    """Leave those signs (code points) in a font file alone that are shown."""
    with TTFont(file) as font:
        small = subset.Subsetter()
        small.populate(unicodes=shown)
        small.subset(font)
        font.save(file)


def lighten(app: Sphinx, error: Exception | None) -> None:
    """Lighten what a build has laid beside the pages."""
    static = Path(app.outdir) / "_static"
    if error or not static.is_dir():
        return
    texts = [*Path(app.outdir).rglob("*.html"), *static.rglob("*.js")]
    words = {word for file in texts for word in WORD.findall(file.read_text(encoding="utf-8"))}
    words |= MADE_BY_SCRIPTS
    for file in (file for name in SHEETS for file in static.glob(name)):
        file.write_text(light_sheet(file.read_text(encoding="utf-8"), words), encoding="utf-8")
    sheets = [file.read_text(encoding="utf-8") for file in static.rglob("*.css")]
    shown = set().union(*map(icons, sheets))
    for file in static.glob(FONTS):
        light_font(file, shown)
        file.with_suffix(".woff2").unlink(missing_ok=True)


def setup(app: Sphinx) -> None:
    """Connect it to the end of a build."""
    app.connect("build-finished", lighten)
