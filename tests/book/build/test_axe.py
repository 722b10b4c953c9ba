"""Every page is clean to axe-core, of any impact, in both schemes and at both widths."""

from itertools import product
from pathlib import Path

import pytest

from book.build.vendor import Package, ensure
from tests.book.build.test_pages import WIDTHS, pages

pytestmark = [pytest.mark.book, pytest.mark.browser]

AXE = Package(
    "axe-core",
    "4.14.1",
    "sha512-FHfa+lmNjQZfJz1q8wKqIDwC6DExcHt/pkjNQb09a3NPjCKg2rhu5qb2S4r76ASyFNNtuFooJpZe37OgudVGtQ==",
    (("axe.min.js", "axe.min.js"),),
)
TEMPLATES = ("index", "py-modindex", "softgrip.dynamics")
"""Pages of the reference, one of each template that the book itself has not."""

# Nothing but colours hangs on the scheme: half of the time is saved for it.
SCHEMES = {"light": {}, "dark": {"runOnly": ["color-contrast", "link-in-text-block"]}}

# A colour on its way to another has no contrast of its own.
CALM = "*, ::before, ::after { transition: none !important; animation: none !important }"

# Folds hide hundreds of remarks that are alike: one of each kind is opened.
UNFOLD = """() => {
  const kinds = new Set();
  for (const fold of document.querySelectorAll("details")) {
    const kind = fold.querySelector("summary")?.textContent.trim();
    if (!kinds.has(kind)) fold.open = true;
    kinds.add(kind);
  }
}"""
SETTLE = """scheme => new Promise((done) => {
  const look = () => document.documentElement.dataset.theme === scheme
    ? requestAnimationFrame(() => requestAnimationFrame(done)) : requestAnimationFrame(look);
  look();
})"""
VIOLATIONS = """async (rules) => {
  const found = await axe.run({ resultTypes: ["violations"], preload: false, ...rules });
  return found.violations.flatMap(({ id, nodes }) =>
    nodes.map((node) => `${id}: ${node.target}: ${node.failureSummary}`));
}"""


@pytest.fixture(scope="module")
def axe(pytestconfig) -> str:
    """Return axe-core, kept among what tests keep."""
    folder = pytestconfig.cache.mkdir("axe-core")
    if not ensure(folder, [AXE]):
        pytest.skip("needs the npm registry, for axe-core")
    return (folder / "axe.min.js").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def page(browser):
    context = browser.new_context(offline=True)
    context.set_default_timeout(0)  # a busy machine is no fault of a page
    yield context.new_page()
    context.close()


def sample(html: Path) -> list[tuple[Path, list[tuple[str, int]]]]:
    """Return the pages of the book with all schemes and widths, and some of the reference.

    Its hundreds of pages come from few templates: one of each, some more, and each scheme once.
    """
    ways = list(product(SCHEMES, WIDTHS))
    book = [file for file in pages(html) if file.parent == html]
    reference = [file for file in pages(html) if file not in book][::20]
    reference += [html / "api" / f"{name}.html" for name in TEMPLATES]
    return [(file, ways) for file in book] + [(file, [ways[0], ways[-1]]) for file in reference]


@pytest.mark.usefixtures("local_scripts")
def test_no_page_violates_a_rule(html, page, axe):
    for file, ways in sample(html):
        page.goto(file.as_uri())
        page.add_style_tag(content=CALM)
        page.evaluate(UNFOLD)
        page.evaluate(axe)
        for scheme, width in ways:
            page.emulate_media(color_scheme=scheme)
            page.set_viewport_size({"width": width, "height": 900})
            page.evaluate(SETTLE, scheme)
            found = page.evaluate(VIOLATIONS, SCHEMES[scheme])
            assert found == [], (file.name, scheme, width)


@pytest.mark.usefixtures("local_scripts")
@pytest.mark.parametrize("kind", ["claim", "term", "equation"])
def test_no_open_card_violates_a_rule(html, page, axe, kind):
    file = next(f for f in pages(html) if f'id="card-{kind}-' in f.read_text(encoding="utf-8"))
    page.goto(file.as_uri())
    page.add_style_tag(content=CALM)
    page.evaluate(axe)
    for scheme, width in product(SCHEMES, WIDTHS):
        page.emulate_media(color_scheme=scheme)
        page.set_viewport_size({"width": width, "height": 900})
        page.evaluate(SETTLE, scheme)
        mark = page.locator(f"a[aria-describedby^='card-{kind}-']").first
        mark.evaluate("mark => { mark.blur(); mark.focus({ focusVisible: true }) }")
        assert page.locator(".note-card:popover-open").count() == 1, (scheme, width)
        assert page.evaluate(VIOLATIONS, SCHEMES[scheme]) == [], (scheme, width)
