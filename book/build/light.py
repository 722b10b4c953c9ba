"""What a page loads: no icon, index or script that it has no use for, no picture before its turn.

The theme has each page load all 2,000 icons of its font as a script (1.5 MB), and Sphinx's search
with its index, in whose place the book has a page of its own (`book.build.search`): neither is
made, and the theme's dialog for it is left out of the template of pages. Jupyter Book has each load
Thebe, which would run cells on a server elsewhere, and that twice, which the browser takes for an
error.
"""

import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

ICONS = "_static/scripts/fontawesome.js"
ICON = re.compile(r'"?([\w-]+)"?:\[\d+,\d+,\[[^\]]*\],"[0-9a-f]*",(?:"[^"]*"|\[[^\]]*\])\],?')
"""An icon in the theme's script: width, height, other names, code and outline, by its name."""
USED = re.compile(r"\bfa-([a-z0-9-]+)")
SEARCH = ("searchindex.js", "_static/searchtools.js", "_static/language_data.js")
"""Of Sphinx's search: what it lays even if it makes no index, and an index of a former build."""
UNUSED = re.compile(
    r'\s*<script(?: src="[^"]*(?:searchtools|language_data|searchindex)\.js">'
    r'| async="async" src="[^"]*sphinx-thebe\.js[^"]*">|>const THEBE_JS_URL[^<]*)</script>'
)


def with_icons(script: str, names: set[str]) -> str:
    """Return the script of icons with those alone that are named.

    >>> with_icons('a={sun:[5,5,[],"f1","M0"],"no-sun":[5,5,["x"],"f2",["M1","M2"]]}', {"sun"})
    'a={sun:[5,5,[],"f1","M0"],}'
    """

    def kept(found: re.Match[str]) -> str:
        own = {found[1], *re.findall(r'"([a-z-]+)"', found[0].partition("]")[0])}
        return found[0] if own & names else ""

    return ICON.sub(kept, script)


def light_head(head: str) -> str:
    """Return the head of a page without the scripts that it does not use.

    >>> light_head('<script src="searchindex.js"></script><script>const THEBE_JS_URL = 1</script>')
    ''
    """
    return UNUSED.sub("", head)


def lighten(_app: Sphinx, _page: str, _template: str, context: dict[str, Any], _tree: Any) -> None:
    """Give the template of pages what lightens their heads, and have pictures wait."""
    context["light_head"] = light_head
    if body := context.get("body"):
        context["body"] = body.replace("<img ", '<img loading="lazy" ')


def drop_icons(app: Sphinx, error: Exception | None) -> None:
    """Leave the icons that a page or a script of the theme names."""
    script = Path(app.outdir) / ICONS
    if error or not script.is_file():
        return
    others = [*Path(app.outdir).glob("*.html"), *script.parent.glob("*theme.js")]
    names = {name for file in others for name in USED.findall(file.read_text(encoding="utf-8"))}
    script.write_text(with_icons(script.read_text(encoding="utf-8"), names), encoding="utf-8")


def leave_search(app: Sphinx) -> None:
    """Have Sphinx make no index, and no page that reads it."""
    app.builder.search = False  # type: ignore[attr-defined]


def drop_search(app: Sphinx, _error: Exception | None) -> None:
    """Remove what no page loads."""
    for name in SEARCH:
        Path(app.outdir, name).unlink(missing_ok=True)


def setup(app: Sphinx) -> None:
    """Connect these to the stages of a build."""
    app.connect("builder-inited", leave_search)
    app.connect("html-page-context", lighten)
    app.connect("build-finished", drop_icons)
    app.connect("build-finished", drop_search)
