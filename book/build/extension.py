"""The Sphinx extension of the book: scripts without a network, stale pages, numbers, links."""

import json
import os
from pathlib import Path
from typing import Any

from jupyter_cache import get_cache
from sphinx.application import Sphinx

from book.build import (
    accessible,
    api,
    cards,
    claim_role,
    equations,
    execution,
    judging,
    light,
    notebooks,
    numbering,
    search,
    style_sheets,
    tracing,
    typed_numbers,
    vendor,
)
from book.companion import prose
from book.companion.judged import VARIABLE


def _build_folder(app: Sphinx) -> Path:
    return Path(app.outdir).parent


def _drawn(app: Sphinx) -> Path:
    """Return the folder of frames that are drawn ahead; its layout is that of the pages' folder."""
    return _build_folder(app) / "drawn" / "_static" / "frames"


def _verdicts(app: Sphinx) -> Path:
    return _build_folder(app) / "verdicts"


def _trace(app: Sphinx, page: str) -> Path:
    return _build_folder(app) / "traces" / f"{page}.json"


def _numbers(app: Sphinx, page: str) -> str:
    """Return the names of the computed numbers that a page's prose uses, parted by blanks."""
    text = Path(app.env.doc2path(page)).read_text(encoding="utf-8")
    return " ".join(prose.used(text))


def use_local_scripts(app: Sphinx, config: Any) -> None:
    """Point the pages at fetched scripts; where none can be had, at the usual addresses."""
    folder, drawn = Path(app.srcdir) / "_vendor", _drawn(app)
    drawn.mkdir(parents=True, exist_ok=True)
    config.html_extra_path = [str(folder), str(drawn.parents[1])]
    if not vendor.ensure(folder):
        print(
            "NOTE: the npm registry cannot be reached. The book is built all the same, but its\n"
            "      pages will load what sets equations and draws figures with sliders from public\n"
            "      addresses, and show neither without a network.",
            flush=True,
        )
    # KaTeX in the place of MathJax: a quarter of the size, and the page is set when it is shown.
    config.mathjax_path = vendor.address(folder, vendor.EQUATIONS)
    config.mathjax_options = {"defer": "defer"}


def prepare_kernels(app: Sphinx) -> None:
    """Make the kernels of this build record what they read, and draw sliders as frames."""
    ipython = _build_folder(app) / "ipython"
    tracing.install_hook(ipython)
    os.environ["IPYTHONDIR"] = str(ipython)
    os.environ["SOFTGRIP_BOOK"] = "static"
    os.environ["SOFTGRIP_FRAMES"] = str(_drawn(app))
    os.environ[VARIABLE] = str(_verdicts(app))
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # else each process compiles all it imports
    for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ.setdefault(threads, "1")  # a page has a core: more would wait for each other


def find_stale_pages(
    app: Sphinx, env: Any, _added: set[str], _changed: set[str], _removed: set[str]
) -> list[str]:
    """Drop the kept outputs whose trace no longer holds, and have their pages read again.

    One output is kept a page, the newest: an older one, of a former text, has lost its trace.
    """
    cache = get_cache(env.mystnb_config.execution_cache_path)
    around = tracing.surroundings()
    stale, seen = set(), set()
    for entry in sorted(cache.list_cache_records(), key=lambda e: e.created, reverse=True):
        # Relative by text: the outputs may be those of a folder that has been moved since.
        page = Path(os.path.relpath(entry.uri, app.srcdir)).with_suffix("").as_posix()
        current = page in env.found_docs and tracing.is_current(
            _trace(app, page), around | {prose.USED: _numbers(app, page)}
        )
        if not current:
            stale.add(page)
        if not current or page in seen:
            cache.remove_cache(entry.pk)
        seen.add(page)
    for page in sorted(stale & env.found_docs):
        print(f"stale: {page} (something that it uses has changed)", flush=True)
    return sorted(stale & env.found_docs)


def announced(app: Sphinx, page: str) -> dict[str, str]:
    """Write down what is around a page, and return what tells its kernel which page it serves."""
    trace, numbers = _trace(app, page), {prose.USED: _numbers(app, page)}
    context = tracing.context_of(trace)
    context.parent.mkdir(parents=True, exist_ok=True)
    context.write_text(json.dumps(tracing.surroundings() | numbers))
    return {tracing.TRACE_VARIABLE: str(trace), **numbers}


def run_pages(app: Sphinx, env: Any, pages: list[str]) -> None:
    """Run the pages that are about to be read and have no outputs, side by side."""
    judging.forget_stale(_verdicts(app))
    execution.execute(env, pages, lambda page: announced(app, page), _verdicts(app))


def announce(app: Sphinx, page: str, _source: list[str]) -> None:
    """Tell the kernel that may now start which page it serves."""
    os.environ.update(announced(app, page))


def add_scripts(
    app: Sphinx, page: str, _template: str, context: dict[str, Any], _tree: Any
) -> None:
    """Give the pages that have figures with sliders, or equations, and only these, what they need.

    The theme adds the book's own scripts, and Sphinx that of equations.
    """
    folder = Path(app.srcdir) / "_vendor"
    if 'class="explorer"' in context.get("body", ""):
        for package in vendor.PLOTS:
            app.add_js_file(vendor.address(folder, package), loading_method="defer")
    if app.env.get_domain("math").has_equations(page):  # type: ignore[attr-defined]
        app.add_css_file(vendor.address(folder, vendor.EQUATIONS, 1))


def setup(app: Sphinx) -> dict[str, Any]:
    """Connect the parts to the stages of a build."""
    accessible.setup(app)
    api.setup(app)
    cards.setup(app)
    claim_role.setup(app)
    light.setup(app)
    notebooks.setup(app)
    equations.setup(app)
    numbering.setup(app)
    search.setup(app)
    style_sheets.setup(app)
    typed_numbers.setup(app)
    app.connect("config-inited", use_local_scripts)
    app.connect("builder-inited", prepare_kernels)
    app.connect("env-get-outdated", find_stale_pages)
    app.connect("env-before-read-docs", run_pages)
    app.connect("source-read", announce)
    app.connect("html-page-context", add_scripts)
    app.add_css_file("softgrip.css")
    return {
        "version": "1",
        "env_version": 1,  # another: all pages are read anew, as what is noted of them has changed
        "parallel_read_safe": False,
        "parallel_write_safe": True,
    }
