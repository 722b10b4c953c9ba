"""The Sphinx extension of the book: scripts without a network, stale pages, numbers, links."""

import json
import os
from pathlib import Path
from typing import Any

from jupyter_cache import get_cache
from sphinx.application import Sphinx

from book.build import api, claim_role, equations, execution, numbering, tracing, vendor


def _build_folder(app: Sphinx) -> Path:
    return Path(app.outdir).parent


def _drawn(app: Sphinx) -> Path:
    """Return the folder of frames that are drawn ahead; its layout is that of the pages' folder."""
    return _build_folder(app) / "drawn" / "_static" / "frames"


def _trace(app: Sphinx, page: str) -> Path:
    return _build_folder(app) / "traces" / f"{page}.json"


def use_local_scripts(app: Sphinx, config: Any) -> None:
    """Point the pages at fetched scripts; where none can be had, at the usual addresses."""
    folder, drawn = Path(app.srcdir) / "_vendor", _drawn(app)
    drawn.mkdir(parents=True, exist_ok=True)
    config.html_extra_path = [str(folder), str(drawn.parents[1])]
    if vendor.ensure(folder):
        config.mathjax_path = "mathjax/tex-mml-chtml.js"
    else:
        print(
            "NOTE: the npm registry cannot be reached. The book is built all the same, but its\n"
            "      pages will load MathJax, and what draws figures with sliders, from public CDN\n"
            "      addresses, and show neither without a network.",
            flush=True,
        )


def prepare_kernels(app: Sphinx) -> None:
    """Make the kernels of this build record what they read, and draw sliders as frames."""
    ipython = _build_folder(app) / "ipython"
    tracing.install_hook(ipython)
    os.environ["IPYTHONDIR"] = str(ipython)
    os.environ["SOFTGRIP_BOOK"] = "static"
    os.environ["SOFTGRIP_FRAMES"] = str(_drawn(app))


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
        current = page in env.found_docs and tracing.is_current(_trace(app, page), around)
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
    trace = _trace(app, page)
    context = trace.with_suffix(".context.json")
    context.parent.mkdir(parents=True, exist_ok=True)
    context.write_text(json.dumps(tracing.surroundings()))
    return {tracing.TRACE_VARIABLE: str(trace)}


def run_pages(app: Sphinx, env: Any, pages: list[str]) -> None:
    """Run the pages that are about to be read and have no outputs, side by side."""
    execution.execute(env, pages, lambda page: announced(app, page))


def announce(app: Sphinx, page: str, _source: list[str]) -> None:
    """Tell the kernel that may now start which page it serves."""
    os.environ.update(announced(app, page))


def add_explorers(
    app: Sphinx, _page: str, _template: str, context: dict[str, Any], _tree: Any
) -> None:
    """Give the pages that have figures with sliders, and only these, what draws them."""
    if 'class="explorer"' in context.get("body", ""):
        # The theme adds the book's own script by itself.
        for package in vendor.PLOTS:
            ((source, place),) = package.files
            if not (Path(app.srcdir) / "_vendor" / place).is_file():
                place = f"{vendor.PUBLIC}/{package.name}@{package.version}/{source}"
            app.add_js_file(place.removeprefix("_static/"), loading_method="defer")


def remove_former_modules(app: Sphinx, _error: Exception | None) -> None:
    """Remove source pages of modules that are no more: a build adds, but never takes away."""
    pages = Path(app.outdir) / "_modules"
    for page in [
        page for top in ("softgrip", "book", "tests") for page in (pages / top).rglob("*.html")
    ]:
        source = tracing.ROOT / page.relative_to(pages).with_suffix("")
        if not (source.is_dir() or source.with_suffix(".py").is_file()):
            page.unlink()


def setup(app: Sphinx) -> dict[str, Any]:
    """Connect the parts to the stages of a build."""
    api.setup(app)
    claim_role.setup(app)
    equations.setup(app)
    numbering.setup(app)
    app.connect("config-inited", use_local_scripts)
    app.connect("builder-inited", prepare_kernels)
    app.connect("env-get-outdated", find_stale_pages)
    app.connect("env-before-read-docs", run_pages)
    app.connect("source-read", announce)
    app.connect("html-page-context", add_explorers)
    app.connect("build-finished", remove_former_modules)
    app.add_css_file("softgrip.css")
    return {"version": "1", "parallel_read_safe": False, "parallel_write_safe": True}
