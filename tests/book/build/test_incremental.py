"""A second build runs nothing; a change runs exactly the pages that depend on it."""

import shutil

import pytest
from bs4 import BeautifulSoup

from tests.book.conftest import build

PAGE = """\
---
jupytext:
  text_representation:
    format_name: myst
kernelspec:
  name: python3
  display_name: Python 3
---

# {title}

```{{code-cell}}
{code}
```
"""

CONFIG = """\
title: Small
only_build_toc_files: true
execute: {execute_notebooks: cache, timeout: -1}
sphinx:
  extra_extensions: [book.build.extension]
  config:
    nb_execution_raise_on_error: true
    numfig: true
    suppress_warnings: [config.cache]
"""


@pytest.fixture
def project(tmp_path, root):
    """A book of two pages, over a copy of the package and its data."""
    # Another process may be fetching the scripts: what it has not finished is left to it.
    scripts = [] if (root / "book/_vendor/packages.json").exists() else ["_vendor"]
    without = shutil.ignore_patterns("__pycache__", "_build", "*.md", *scripts)
    for name in ("softgrip", "data", "book"):
        shutil.copytree(root / name, tmp_path / name, ignore=without)
    shutil.copy(root / "environment.lock", tmp_path)
    book = tmp_path / "book"
    (book / "_config.yml").write_text(CONFIG)
    (book / "_toc.yml").write_text("format: jb-book\nroot: a\nchapters:\n  - file: b\n")
    (book / "a.md").write_text(PAGE.format(title="A", code="import softgrip.units as u\nu.MPa"))
    code = 'from softgrip.materials.table import material\nmaterial("Dragon Skin 20")'
    (book / "b.md").write_text(PAGE.format(title="B", code=code))
    return tmp_path


@pytest.mark.book
def test_exactly_the_dependent_pages_run_again(project):
    def built():
        """Build, and return the pages whose kernel ran."""
        traces = {name: project / "book/_build/traces" / f"{name}.json" for name in "ab"}
        before = {name: t.stat().st_mtime_ns if t.exists() else 0 for name, t in traces.items()}
        build(project / "book", PYTHONPATH=str(project))
        return {name for name, t in traces.items() if t.stat().st_mtime_ns != before[name]}

    assert built() == {"a", "b"}
    assert built() == set()

    table = project / "data/materials/table_5_1.csv"
    table.write_text(table.read_text().replace("Dragon Skin 20,2.500", "Dragon Skin 20,2.750"))
    assert built() == {"b"}
    assert "2.75" in (project / "book/_build/html/b.html").read_text()

    units = project / "softgrip/units.py"
    units.write_text(units.read_text().replace("MPa = 1e6", "MPa = 2e6"))
    assert built() == {"a", "b"}
    assert "2000000.0" in (project / "book/_build/html/a.html").read_text()

    # A former text with a former output: what was kept of it must not come back.
    page = project / "book/a.md"
    text = page.read_text()
    page.write_text(text.replace("u.MPa", "u.PSI"))
    assert built() == {"a"}
    units.write_text(units.read_text().replace("MPa = 2e6", "MPa = 3e6"))
    page.write_text(text)
    assert built() == {"a", "b"}
    assert "3000000.0" in (project / "book/_build/html/a.html").read_text()

    # A page is told the numbers that its prose uses: one more, with the same code, is another run.
    other = project / "book/b.md"
    tells = 'from book.companion.prose import tell\ntell("companion")'
    other.write_text(PAGE.format(title="B", code=tells))
    assert built() == {"b"}
    other.write_text(other.read_text() + "\nWithin {glue:text}`close` %.\n")
    assert built() == {"b"}
    assert (
        "Within 5 %"
        in BeautifulSoup((project / "book/_build/html/b.html").read_text(), "html.parser").text
    )

    moved = project.with_name("moved")
    project.rename(moved)
    build(moved / "book", PYTHONPATH=str(moved))
    assert "3000000.0" in (moved / "book/_build/html/a.html").read_text()
