"""A notebook holds what a page says as text: no role, label or directive is left as its source."""

import re

import jupytext
import nbformat
import pytest

from book.build import notebooks
from book.build.lab_form import pages
from book.build.plain_markdown import plain, with_boxes, with_equations, with_roles
from softgrip.errors import InvalidInputError

RAW = re.compile(r"\{[a-z][a-z:]*\}`|^\s*(?:`{3,}|:{3,}) *\{|\$\$ \([\w-]+\)|^\([\w-]+\)=$", re.M)
"""A role, a directive, an equation's label, a target: what a notebook shows as its source."""
KNOWN = {"eq": lambda words, to: f"[{words or to}](#{to})", "claim": lambda _, name: f"<{name}>"}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("{eq}`eq-4-1`", "[eq-4-1](#eq-4-1)"),
        ("{eq}`the first <eq-4-1>`", "[the first](#eq-4-1)"),
        ("{eq}`over\ntwo <eq-4-1>`", "[over two](#eq-4-1)"),
        ("`{eq}` and {claim}`a`{claim}`b`", "`{eq}` and <a><b>"),
    ],
)
def test_roles(text, expected):
    assert with_roles(text, KNOWN) == expected


def test_a_role_that_is_not_known_is_an_error():
    with pytest.raises(InvalidInputError, match="whatever"):
        with_roles("{whatever}`x`", KNOWN)


def test_an_equation_bears_its_number_and_keeps_its_lines():
    text = "a\n\n$$\n\\begin{aligned}\nx &= 1\n\\end{aligned}\n$$ (eq-6-25)\n\nb\n\n$$\ny\n$$\n"
    found = with_equations(text)
    assert '<a id="eq-6-25"></a>\n\n$$\n\\begin{aligned}' in found
    assert "\\end{aligned}\n\\tag{6.25}\n$$\n\nb\n\n$$\ny\n$$\n" in found


BOX = ":::{warning}\nHot.\n:::\n"


def test_boxes_are_set_within_each_other():
    text = (
        "::::{admonition} Task 1\n:class: task\nDo.\n\n:::{tip}\n:class: dropdown\nSo.\n:::\n::::"
    )
    found = with_boxes(f"{BOX}\n{text}")
    assert found.count('<div class="alert alert-block alert-') == 2
    assert found.index("**Task 1**") < found.index("<details>") < found.index("So.")
    assert found.count("</div>") == 2
    assert found.count("</details>") == 1
    assert ":::" not in found
    assert ":class:" not in found


def test_code_is_left_alone():
    text = (
        "```{code-cell} ipython3\n:tags: [x]\n\nprint(':::{warning}')\n```\n\n```python\n{a}\n```\n"
    )
    assert with_boxes(text) == text


def test_a_box_about_a_cell_becomes_its_heading():
    cell = "```{code-cell} ipython3\nshow(1)\n```"
    found = with_boxes(f":::{{admonition}} Evidence\n:class: dropdown\n{cell}\n:::\n")
    assert cell in found
    assert "**Evidence**" in found
    assert "<details>" not in found


def test_a_directive_that_is_no_box_is_an_error():
    with pytest.raises(InvalidInputError, match="bibliography"):
        with_boxes("```{bibliography}\n```")


def test_links_lead_to_the_built_pages():
    text = '[a](rig.md), [b](rig.md#run), [c](#here), <a href="ledger.html#y">y</a>\n\n(at)=\n'
    found = plain(text, {}, "../")
    assert "[a](../rig.html), [b](../rig.html#run), [c](#here)" in found
    assert 'href="../ledger.html#y"' in found
    assert '<a id="at"></a>' in found


class Anything(dict):
    """Sets any role, by its words or what it names."""

    def __missing__(self, name):
        return lambda words, to: words or to

    def __contains__(self, name):
        return True


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.stem)
def test_each_page_can_be_a_notebook(page):
    found = notebooks.notebook(page, Anything())
    nbformat.validate(found)
    code = [cell.source for cell in jupytext.read(page).cells if cell.cell_type == "code"]
    assert [cell.source for cell in found.cells if cell.cell_type == "code"] == code
    for cell in found.cells:
        if cell.cell_type == "markdown":
            assert not RAW.search(cell.source), cell.source


@pytest.mark.book
def test_no_source_is_left_in_built_notebooks(html):
    files = sorted((html / "_sources").glob("*.ipynb"))
    assert {file.stem for file in files} == {page.stem for page in pages()}
    for file in files:
        for cell in nbformat.read(file, as_version=4).cells:
            if cell.cell_type == "markdown":
                assert not RAW.search(cell.source), (file.name, cell.source)


@pytest.mark.book
def test_links_within_built_notebooks_lead_somewhere(html):
    for file in (html / "_sources").glob("*.ipynb"):
        cells = nbformat.read(file, as_version=4).cells
        words = "\n".join(cell.source for cell in cells if cell.cell_type == "markdown")
        code = "\n".join(cell.source for cell in cells if cell.cell_type == "code")
        titles = re.findall(r'show\("(Figure|Table) (\d)\.(\w+)"', code)
        shown = {f"{kind[:3].lower()}-{a}-{b.lower()}" for kind, a, b in titles}
        for place, anchor in re.findall(r"\]\(([^)#]*)#?([^)]*)\)", words):
            if place.startswith("../"):
                assert (file.parent / place).is_file(), (file.name, place)
                built = (file.parent / place).read_text(encoding="utf-8")
                assert not anchor or f'id="{anchor}"' in built, (file.name, place, anchor)
            elif not place and anchor.startswith(("fig-", "tab-")):
                assert anchor in shown, (file.name, anchor)
            elif not place and anchor.startswith("eq-"):
                assert f'<a id="{anchor}"></a>' in words, (file.name, anchor)
