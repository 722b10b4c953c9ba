"""The search page in a browser that has no network: what it finds, in which order, and how."""

import json
import re
from functools import cache
from itertools import takewhile
from pathlib import Path
from urllib.parse import parse_qs, quote_plus, urlsplit

import pytest
from bs4 import BeautifulSoup

from book.build.equations import NUMBERS, pairs
from book.companion.claims import read_claims
from tests.book.build.test_axe import CALM, SCHEMES, SETTLE, VIOLATIONS, axe
from tests.book.build.test_pages import WIDTHS, Visit, pages

pytestmark = [pytest.mark.book, pytest.mark.browser, pytest.mark.usefixtures("local_scripts")]

__all__ = ["axe"]  # a fixture

READY = "document.querySelector('ol.results').ariaBusy === 'false'"
FOUND = """query => search(query).results.map(({ entry }) =>
  ({ kind: entry.kind, place: entry.place, title: entry.title }))"""
TYPED = """query => {
  const field = document.getElementById("search-field");
  field.value = query;
  field.dispatchEvent(new Event("input", { bubbles: true }));
  document.body.offsetHeight; // has it laid out
}"""
SHOWN = """() => [...document.querySelectorAll("ol.results > li:not(.others)")].map((item) => ({
  kind: item.className,
  place: item.querySelector("a").getAttribute("href"),
  title: item.querySelector(".title").innerText,
  where: item.querySelector(".where").innerText,
  text: item.querySelector(".text").innerText,
  marks: [...item.querySelectorAll("mark")].map((mark) => mark.innerText.toLowerCase()),
}))"""


@cache
def ids(file: Path) -> frozenset[str]:
    """Return the anchors of a page."""
    return frozenset(re.findall(r'\bid="([^"]+)"', file.read_text(encoding="utf-8")))


@pytest.fixture(scope="module")
def entries(html):
    """Return the index as it was written."""
    text = (html / "_static" / "search_index.js").read_text(encoding="utf-8")
    return json.loads(text.partition(" = ")[2].rstrip(";\n"))


@pytest.fixture(scope="module")
def visit(html, browser):
    with Visit(browser, html / "search.html") as visit:
        visit.page.wait_for_function(READY)
        yield visit
        assert visit.complaints == []
        assert {urlsplit(url).scheme for url in visit.requests} <= {"file", "data"}


@pytest.fixture
def page(visit):
    visit.page.set_viewport_size({"width": 1280, "height": 900})
    return visit.page


def shown(page, query):
    """Type a query, and return what the page shows."""
    page.evaluate(TYPED, query)
    return page.evaluate(SHOWN)


def kinds(found):
    return [result["kind"] for result in found]


def test_everything_that_is_found_is_there(html, entries):
    places = [row[1] for row in entries["documents"]]
    places += [
        f"api/{at}.html#{'module-' if kind == 'module' else ''}{name}"
        for kind, name, at, _ in entries["names"]
    ]
    for place in places:
        file, _, anchor = place.partition("#")
        assert anchor in ids(html / file), place


def test_every_printed_number_is_found_by_what_is_printed(page, html):
    soup = BeautifulSoup((html / "ledger.html").read_text(encoding="utf-8"), "html.parser")
    rows = {row["id"]: row("td")[1].get_text() for row in soup.select("table.numbers tr[id]")}
    assert len(rows) == len(read_claims())
    for printed in sorted(set(rows.values())):
        found = page.evaluate(FOUND, printed)
        numbers = [result["place"] for result in found if result["kind"] == "claim"]
        for claim, own in rows.items():
            if own == printed:
                place = f"ledger.html#{claim}"
                assert place in numbers, (printed, claim)
                before = kinds(found[: [r["place"] for r in found].index(place)])
                assert {*before} <= {"equation", "exhibit", "claim"}, (printed, claim, before)


def test_every_equation_is_found_by_its_number(page):
    missing = {*NUMBERS} - {*pairs()}
    assert len(missing) < len(NUMBERS) / 10
    for number in pairs():
        anchor = f"#equation-eq-{number.replace('.', '-')}"
        for query in (
            number,
            f"({number})",
            f"Eq. {number}",
            f"eq {number}",
            f"Equation ({number})",
        ):
            first, *_ = page.evaluate(FOUND, query)
            assert first["kind"] == "equation", query
            assert first["place"].endswith(anchor), query


def test_every_figure_and_table_is_found_by_its_number(page, html):
    titles = {}
    for file in html.glob("*.html"):
        soup = BeautifulSoup(file.read_text(encoding="utf-8"), "html.parser")
        for number in soup.select("figure[id] .caption-number, table[id] .caption-number"):
            own = number.find_parent(["figure", "table"])
            titles[number.get_text().strip()] = f"{file.name}#{own['id']}"
    assert len(titles) > 100
    for title, place in titles.items():
        kind, number = title.split()
        for query in (title, title.lower(), f"{kind[:3]}. {number}"):
            first, *_ = page.evaluate(FOUND, query)
            assert (first["kind"], first["place"]) == ("exhibit", place), query
        alone = page.evaluate(FOUND, number)
        others = alone[: [result["place"] for result in alone].index(place)]
        assert {*kinds(others)} <= {"equation", "exhibit"}, number


@pytest.mark.parametrize(
    ("query", "printed"),
    [("0.359", "0.359"), ("0.8 s", "0.8 s"), ("95.4 %", "95.4 %"), ("95.4%", "95.4 %"),
     ("0.303π", "0.303 pi rad"), ("0.303 pi", "0.303 pi rad"), ("3.95 s", "3.95 s")],
)  # fmt: skip
def test_a_number_leads_to_the_ledger_first_and_then_to_where_it_stands(page, query, printed):
    found = shown(page, query)
    numbers = [*takewhile(lambda result: result["kind"] == "claim", found)]
    assert numbers
    for result in numbers:
        assert printed in result["title"].partition(":")[0]
        assert re.search(r"(Section|Table|Figure|Eq\.) ", result["where"])
        assert re.search("reproduced|close|contradicts|open|given", result["text"])
    assert {"section", "exhibit"} & {*kinds(found)}


def test_a_number_says_the_sections_that_it_stands_in(page, html):
    soup = BeautifulSoup((html / "chapter-3.html").read_text(encoding="utf-8"), "html.parser")
    link = soup.select_one("article p a[href^='ledger.html#claim-3.4']")
    section = link.find_parent("section")["id"]
    shown(page, link.get_text())
    item = page.locator("li.claim", has=page.locator(f"a[href='{link['href']}']"))
    assert item.locator(f"a[href='chapter-3.html#{section}']").count() == 1


def test_ludwick_leads_to_chapter_5_and_then_to_what_the_word_means(page):
    first, second, *others = shown(page, "Ludwick")
    assert first["kind"] == "section"
    assert "Chapter 5" in first["where"] + first["title"]
    assert (second["kind"], second["title"][:7]) == ("term", "Ludwick")
    names = [kind == "name" for kind in kinds(others)]
    assert names == sorted(names)  # the package's come last


@pytest.mark.parametrize("query", ["buckling", "flex sensor", "flex sens", "pump", "settling time"])
def test_words_lead_to_sections_with_the_words_marked(page, query):
    found = shown(page, query)
    assert found[0]["kind"] == "section"
    for result in found:
        assert "#" in result["place"]
        assert result["marks"], result
        for mark in result["marks"]:
            assert any(word[:3] in mark for word in query.split()), result
    sections = [kind in ("section", "term") for kind in kinds(found)]
    assert sections == sorted(sections, reverse=True)


def test_headings_come_before_text(page, entries):
    heading = "A spring from the law"
    assert heading in [row[2] for row in entries["documents"]]
    assert shown(page, heading)[0]["title"] == heading
    assert shown(page, "sprin law")[0]["title"] == heading


def test_terms_and_symbols_are_found_by_what_they_are_called(page, entries):
    terms = [row[2] for row in entries["documents"] if row[0] == "term"]
    assert len(terms) > 20
    for term in terms:
        found = page.evaluate(FOUND, term)
        assert any(r["kind"] == "term" and r["title"] == term for r in found), term


def test_names_of_the_reference_are_found_after_all_else(page):
    found = page.evaluate(FOUND, "softgrip.units")
    assert "api/softgrip.html#module-softgrip.units" in [result["place"] for result in found]
    for query in ("modified_moment", "pressure"):
        found = kinds(page.evaluate(FOUND, query))
        assert "name" in found
        assert found.index("name") == len(found) - found.count("name")


@pytest.mark.parametrize(
    ("typed", "meant"),
    [("bukling", "buckling"), ("Ludvick", "Ludwick"), ("elastanse", "elastance")],
)
def test_a_slip_of_a_letter_is_forgiven_and_said(page, typed, meant):
    slipped = page.evaluate(FOUND, typed)
    assert {result["place"] for result in slipped} & {
        result["place"] for result in page.evaluate(FOUND, meant)
    }
    shown(page, typed)
    if not page.evaluate("query => search(query).exact", typed):
        assert page.locator(".search-count").inner_text().startswith("Nothing matches this")


def test_a_decimal_comma_is_a_point(page):
    assert page.evaluate(FOUND, "0,359") == page.evaluate(FOUND, "0.359")
    assert page.evaluate("pointed('1,009 of 1,5 and 12,25')") == "1,009 of 1.5 and 12.25"


def test_a_number_with_a_unit_that_it_has_not_still_leads_to_the_number(page):
    first = page.evaluate(FOUND, "5.14 MPa")[0]
    assert (first["kind"], first["place"]) == ("equation", page.evaluate(FOUND, "5.14")[0]["place"])


def test_what_is_nowhere_gives_nothing(page):
    assert shown(page, "xyzzyquux") == []
    assert page.locator(".search-count").inner_text() == "0 results"


def test_the_address_holds_what_is_asked(page, html):
    for query in ("0.359", "a & b=c#d +%", "95.4 %"):
        shown(page, query)
        assert parse_qs(urlsplit(page.url).query) == {"q": [query]}
    page.goto(f"{(html / 'search.html').as_uri()}?q={quote_plus('Figure 4.4')}")
    page.wait_for_function(READY)
    assert page.locator("#search-field").input_value() == "Figure 4.4"
    assert page.locator("ol.results .title").first.inner_text() == "Figure 4.4"
    assert re.fullmatch(r"\d+ results", page.locator("[role=status]").inner_text())
    shown(page, "")
    assert urlsplit(page.url).query == ""
    assert page.locator(".search-hints").is_visible()


def test_the_keyboard_leads_through_the_results(page):
    shown(page, "flex sensor")
    page.locator("#search-field").focus()
    on = "document.activeElement.getAttribute('href') ?? document.activeElement.id"
    places = [link.get_attribute("href") for link in page.locator("p.title a").all()]
    page.keyboard.press("ArrowDown")
    assert page.evaluate(on) == places[0]
    page.keyboard.press("ArrowDown")
    assert page.evaluate(on) == places[1]
    page.keyboard.press("Tab")
    assert page.evaluate(on) == places[2]
    for _ in range(3):
        page.keyboard.press("ArrowUp")
    assert page.evaluate(on) == "search-field"


def test_what_is_too_much_to_show_is_shown_when_asked(page):
    count = len(page.evaluate(FOUND, "pressure"))
    first = len(shown(page, "pressure"))
    assert first < count
    page.get_by_role("button", name=f"Show the other {count - first}").click()
    assert page.locator("ol.results > li").count() == count
    assert page.evaluate("document.activeElement.closest('li') ===" " document.querySelectorAll("
                         f"'ol.results > li')[{first}]")  # fmt: skip


def test_results_are_there_as_one_types(visit, page):
    """After each key within 0.05 s of the processor's time, which other processes take none of."""
    session = visit.context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})

    def busy() -> float:
        metrics = session.send("Performance.getMetrics")["metrics"]
        return next(m["value"] for m in metrics if m["name"] == "TaskDuration")

    def took(query: str) -> float:
        before = busy()
        page.evaluate(TYPED, query)
        return busy() - before

    for query in ("flex sensor", "pressure of the pump", "0.359", "Eq. 5.14"):
        times = [min(took(query[: k + 1]) for _ in range(3)) for k in range(len(query))]
        assert max(times) < 0.05, (query, times)
    session.detach()


def test_the_index_is_small_and_no_other_page_loads_it(html):
    assert (html / "_static" / "search_index.js").stat().st_size < 1.5e6
    for file in pages(html):
        scripts = re.findall(r'<script[^>]* src="([^"]+)"', file.read_text(encoding="utf-8"))
        names = {urlsplit(script).path.rpartition("/")[2] for script in scripts}
        assert ("search_index.js" in names) == (file == html / "search.html"), file
        assert not names & {"searchindex.js", "searchtools.js", "language_data.js"}, file
    assert not (html / "searchindex.js").exists()
    assert not (html / "api" / "search.html").exists()


@pytest.mark.parametrize("start", ["index.html", "glossary.html", "api/softgrip.html"])
def test_the_buttons_and_the_key_of_all_pages_lead_there(html, browser, start):
    there = (html / "search.html").as_uri()
    with Visit(browser, html / start) as visit:
        links = visit.page.locator("a.search-button__button")
        assert links.count() >= 1
        for link in links.all():
            assert link.evaluate("link => link.href") == there
        visit.page.keyboard.press("Control+k")
        visit.page.wait_for_url(there)
        visit.page.wait_for_function(READY)
        assert visit.page.evaluate("document.activeElement.id") == "search-field"
        assert visit.complaints == []
        visit.page.go_back()
        visit.page.locator("a.search-button__button:visible").first.click()
        visit.page.wait_for_url(there)


def test_without_javascript_a_sentence_says_so(html, browser):
    context = browser.new_context(java_script_enabled=False, offline=True)
    page = context.new_page()
    page.goto((html / "search.html").as_uri())
    assert "The search needs JavaScript" in page.locator(".search-page").inner_text()
    assert not page.locator("#search-field").is_visible()
    context.close()


@pytest.mark.parametrize("query", ["Ludwick", "5.14", "pressure", "no such word as this"])
def test_results_violate_no_rule_and_are_no_wider_than_the_screen(page, axe, query):
    page.add_style_tag(content=CALM)
    page.mouse.move(0, 0)  # on a link the theme has another colour
    if not page.evaluate("typeof axe === 'object'"):
        page.evaluate(axe)
    shown(page, query)
    for scheme in SCHEMES:
        for width in WIDTHS:
            page.emulate_media(color_scheme=scheme)
            page.set_viewport_size({"width": width, "height": 900})
            page.evaluate(SETTLE, scheme)
            assert page.evaluate("document.documentElement.scrollWidth") <= width
            assert page.evaluate(VIOLATIONS, SCHEMES[scheme]) == [], (scheme, width)
