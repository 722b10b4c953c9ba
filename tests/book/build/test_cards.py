"""Cards of numbers, terms and equations: what they say, when they are seen, how large they are."""

import os
import random
import re
import subprocess
import sys
from dataclasses import replace

import pytest
from bs4 import BeautifulSoup

from book.companion import chips
from book.companion.claim_card import LONGEST, claim_card
from book.companion.claims import claim_by_id, read_claims
from book.companion.judged import VARIABLE, file_of, write
from book.companion.printed import Spread
from book.companion.verdict import Entry, Outcome
from tests.book.build.test_pages import pages

CHAPTER, MANY = 5, 100
CONF = """\
ours = ["book.build.claim_role", "book.build.cards", "book.build.typed_numbers"]
extensions = ["myst_parser", *ours]
myst_enable_extensions = ["dollarmath", "colon_fence"]
html_static_path = ["cards"]
html_css_files = ["cards.css"]
html_js_files = ["cards.js"]
mathjax_path = "none.js"
suppress_warnings = ["config.cache"]
"""
GLOSSARY = """\
# Glossary

```{glossary}
capacity
  Air per pressure, $C = V/p$, as by {term}`elastance`.

elastance
  Its inverse; see [the first page](index.md).
```
"""
INDEX = """\
# Numbers

```{toctree}
glossary
ledger
other
```

{claim}`%s` is printed, and {claim}`%s`. A {term}`capacity` has {term}`capacities <capacity>`.
By {eq}`eq-5-1` it grows.

$$
a = b \\\\ c = d
$$ (eq-5-1)
"""
PAGES = {
    "glossary": GLOSSARY,
    "ledger": "# The ledger\n",
    "other": "# Other\n\nBy {eq}`eq-5-1`.\n",
}


def made_up() -> dict[str, Entry]:
    """Return verdicts at random on a chapter's claims: what a card shows is not judged here."""
    chance = random.Random(5)
    return {
        claim.id: Entry(
            claim,
            chance.choice([*Outcome]),
            Spread(1 / 3, 1 / 3, 1 / 3),
            under_assumption=chance.choice([None, 2.5]),
        )
        for claim in read_claims(CHAPTER)
    }


class Project:
    """A small book with cards, and verdicts that a test may change."""

    def __init__(self, folder, root):
        self.source, self.html, self.root = folder / "source", folder / "html", root
        self.verdicts = folder / "verdicts"
        self.verdicts.mkdir()
        self.source.mkdir()
        (self.source / "conf.py").write_text(CONF)
        (self.source / "cards").symlink_to(root / "book/_static/cards")
        self.entries = made_up()
        self.ids = [*self.entries]
        self.put(**PAGES, index=INDEX % (self.ids[0], self.ids[1]))
        self.judge()

    def put(self, **texts):
        for page, text in texts.items():
            (self.source / f"{page}.md").write_text(text, encoding="utf-8")

    def judge(self, **changed):
        """Write verdicts, some of them with another outcome."""
        for id, outcome in changed.items():
            self.entries[id] = replace(self.entries[id], outcome=outcome)
        found = {id: (entry, frozenset()) for id, entry in self.entries.items()}
        write(file_of(self.verdicts, CHAPTER), found, frozenset())

    def run(self):
        options = ["-b", "html", "-W", "--keep-going", "-v", str(self.source), str(self.html)]
        return subprocess.run(
            [sys.executable, "-m", "sphinx", *options],
            capture_output=True,
            text=True,
            cwd=self.root,
            env=os.environ | {VARIABLE: str(self.verdicts), "PYTHONPATH": str(self.root)},
        )

    def build(self):
        """Build, and return what Sphinx said."""
        done = self.run()
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
        return done.stdout

    def soup(self, page="index"):
        return BeautifulSoup((self.html / f"{page}.html").read_text("utf-8"), "html.parser")


@pytest.fixture
def project(tmp_path, root):
    return Project(tmp_path, root)


def card_of(soup, link):
    """Return the card of a link, by the address of both."""
    (found,) = (card for card in soup.select(".note-card") if card["data-of"] == link["href"])
    return found


def told(card):
    """Return the facts of a claim's card, by name."""
    names, values = ([cell.get_text(" ") for cell in card(tag)] for tag in ("dt", "dd"))
    return dict(zip(names, values, strict=True))


@pytest.mark.parametrize("chapter", [2, 3, 4, 5, 6])
def test_a_card_says_what_is_printed_and_what_came_of_it(chapter):
    for claim in read_claims(chapter):
        entry = Entry(claim, Outcome.OPEN, Spread(1 / 3, 0.25, 1 / 3), under_assumption=2.5)
        card = BeautifulSoup(claim_card(entry), "html.parser")
        facts = told(card)
        assert claim.printed in facts["printed"]
        assert facts["recomputed"].split() == ["0.25", "to", "0.3333", "if", "assumed:", "2.5"]
        assert facts.get("basis", "") in (claim.basis, claim.nature)
        assert card.select_one(".verdict").text == "◇ open"
        assert claim.what in card.p.text
        assert claim.where in card.small.text
        assert len(card.get_text()) < LONGEST + 250


def test_the_signs_on_paper_are_those_of_the_labels(root):
    style = (root / "book/_static/cards/cards.css").read_text("utf-8")
    signs = dict(re.findall(r'a\.claim\.(\w+)::after \{ content: "(.)"', style))
    assert signs == {str(outcome): sign for outcome, sign in chips.MARKS.items()}
    labels = (root / "book/_static/softgrip.css").read_text("utf-8")
    for outcome in Outcome:
        (ground,) = re.findall(rf"^\.verdict\.{outcome} {{ background: (#\w+)", labels, re.M)
        assert f"background: {ground}" in style.split(f"a.claim.{outcome}")[1].split("\n")[0]


def test_marks_have_text_outcome_and_card(project):
    project.build()
    soup = project.soup()
    for link, id in zip(soup.select("a.claim"), project.ids, strict=False):
        assert link.text == claim_by_id(id).printed
        assert project.entries[id].outcome in link["class"]
        card = card_of(soup, link)
        assert claim_by_id(id).printed in told(card)["printed"]
        assert card.select("a")[-1]["href"] == link["href"] == f"ledger.html#claim-{id}"


def test_a_term_shows_its_definition_and_is_underlined_once(project):
    project.build()
    soup = project.soup()
    first, second = soup.select("a:has(> .std-term)")
    assert ("term" in first["class"], "term" in second["class"]) == (True, False)
    card = card_of(soup, first)
    assert "Air per pressure" in card.text
    assert card.select_one("span.math").text == r"\(C = V/p\)"
    assert [link["href"] for link in card("a")] == ["glossary.html#term-capacity"]
    assert len(soup.select(".note-card")) == 4  # two numbers, one term, one equation


def test_an_equation_is_shown_on_its_page_and_on_others(project):
    project.build()
    for page, address in (("index", "#equation-eq-5-1"), ("other", "index.html#equation-eq-5-1")):
        soup = project.soup(page)
        card = card_of(soup, soup.find("a", href=address, class_="internal"))
        assert r"\[\begin{split} a = b \\ c = d \end{split}\]" in " ".join(card.text.split())
        assert card.find(id=True) is None
        assert any("mathjax" in str(s) or "none.js" in str(s) for s in soup("script"))


def test_another_verdict_changes_mark_and_card_though_no_page_has_changed(project):
    id = project.ids[0]
    project.judge(**{id: Outcome.CLOSE})
    project.build()
    assert "close" in project.soup().select_one("a.claim")["class"]
    written = (project.html / "other.html").stat().st_mtime_ns
    project.judge(**{id: Outcome.CONTRADICTS})
    said = project.build()
    link = project.soup().select_one("a.claim")
    assert ("close" in link["class"], "contradicts" in link["class"]) == (False, True)
    assert card_of(project.soup(), link).select_one(".verdict").text == "✗ contradicts"
    assert "0 added, 0 changed, 0 removed" in said, "nothing is read for it"
    assert (project.html / "other.html").stat().st_mtime_ns == written, "nor others written"


def test_another_definition_or_equation_changes_the_cards_of_other_pages(project):
    project.build()
    project.put(glossary=GLOSSARY.replace("Air per", "Gas per"))
    project.build()
    assert any("Gas per" in card.text for card in project.soup().select(".note-card"))
    project.put(index=(project.source / "index.md").read_text().replace("c = d", "c = e"))
    project.build()
    assert "c = e" in project.soup("other").select_one(".note-card").text


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("It is 95.4 %.", "typed in prose: 95.4"),
        ("It is {claim}`no-such-claim`.", "no-such-claim"),
        ("It is {claim}`95 <{id}>`.", "no claim is named '95 <"),
        ("It is [95](ledger.md).", "typed in prose: 95"),
    ],
)
def test_a_number_that_is_typed_or_has_no_claim_is_an_error_of_the_build(project, text, said):
    project.put(other=f"# Other\n\n{text.replace('{id}', project.ids[0])}\n")
    done = project.run()
    assert done.returncode != 0
    assert said in done.stderr
    assert "other.md:3" in done.stderr


def test_a_claim_that_nobody_judged_is_an_error_of_the_build(project):
    del project.entries[project.ids[0]]
    project.judge()
    done = project.run()
    assert done.returncode != 0
    assert f"claim {project.ids[0]} has no verdict" in done.stderr


def test_a_page_of_a_hundred_marks_stays_small(project):
    project.put(other="# Other\n")
    project.build()
    without = (project.html / "other.html").stat().st_size
    marks = "\n\n".join(f"{{claim}}`{id}`" for id in [*project.ids, *project.ids[:20]][:MANY])
    project.put(other=f"# Other\n\n{marks}\n")
    project.build()
    assert len(project.soup("other").select("a.claim")) == min(MANY, len(project.ids) + 20)
    assert (project.html / "other.html").stat().st_size - without < 1200 * MANY


OPEN = "[...document.querySelectorAll('.note-card')].filter(c => c.matches(':popover-open'))"


@pytest.fixture(scope="module")
def built(tmp_path_factory, root):
    """Return a small book, built, with a long page."""
    project = Project(tmp_path_factory.mktemp("cards"), root)
    text = (project.source / "index.md").read_text("utf-8")
    last = f"\nAt the end {{claim}}`{project.ids[2]}`.\n"
    project.put(index=text + "\n\nMore text.\n" * 60 + last)
    project.build()
    return project


@pytest.fixture
def page(browser, built, request):
    """Open it, on a telephone if the test asks."""
    touch = getattr(request, "param", None) == "touch"
    size = {"width": 400 if touch else 1280, "height": 700}
    context = browser.new_context(viewport=size, has_touch=touch, offline=True)
    page = context.new_page()
    complaints = []
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto((built.html / "index.html").as_uri())
    yield page
    context.close()
    assert complaints == []


def shown(page):
    """Return the ids of the cards that are open."""
    return page.evaluate(f"{OPEN}.map(c => c.id)")


def until(page, ids):
    page.wait_for_function(f"ids => {OPEN}.map(c => c.id).join() === ids.join()", arg=ids)


@pytest.mark.browser
def test_no_card_is_seen_before_and_each_mark_is_described_by_its_own(page, built):
    assert page.locator(".note-card:visible").count() == 0
    for mark in page.locator("a[aria-describedby]").all():
        card = page.locator(f"[id='{mark.get_attribute('aria-describedby')}']")
        assert card.get_attribute("data-of") == mark.get_attribute("href")
    assert page.locator("a[aria-describedby]").count() == 6


@pytest.mark.browser
def test_a_pointer_shows_a_card_which_stays_while_the_pointer_is_on_it(page, built):
    name = f"card-claim-{built.ids[0]}"
    page.locator("a.claim").first.hover()
    until(page, [name])
    card = page.locator(f"[id='{name}']")
    assert card.is_visible()
    card.hover()
    page.wait_for_timeout(600)  # longer than a card waits for the pointer
    assert shown(page) == [name]
    page.mouse.move(0, 0)
    until(page, [])


@pytest.mark.browser
def test_one_card_is_open_at_a_time(page, built):
    for mark, id in zip(page.locator("a.claim").all(), built.ids, strict=False):
        mark.hover()
        until(page, [f"card-claim-{id}"])


@pytest.mark.browser
def test_a_pointer_that_only_passes_opens_nothing(page):
    box = page.locator("a.claim").first.bounding_box()
    page.mouse.move(box["x"] + 2, box["y"] + 2)
    page.mouse.move(0, 0)
    page.wait_for_timeout(400)
    assert shown(page) == []


@pytest.mark.browser
def test_the_keyboard_shows_hides_and_leads_on(page, built):
    mark = page.locator("a.claim").first
    page.locator("h1").first.click()
    for _ in range(60):
        if page.evaluate("document.activeElement.classList.contains('claim')"):
            break
        page.keyboard.press("Tab")
    until(page, [f"card-claim-{built.ids[0]}"])
    page.keyboard.press("Escape")
    until(page, [])
    assert mark.evaluate("m => m === document.activeElement"), "and the place is not lost"
    page.keyboard.press("Tab")
    until(page, [f"card-claim-{built.ids[1]}"])
    page.keyboard.press("Enter")
    page.wait_for_url(f"**/ledger.html#claim-{built.ids[1]}")


@pytest.mark.browser
def test_the_link_of_an_open_card_is_the_next_stop_and_leaving_it_closes_the_card(page, built):
    page.locator("h1").first.click()
    page.evaluate("document.querySelector('a.claim').focus({ focusVisible: true })")
    until(page, [f"card-claim-{built.ids[0]}"])
    page.keyboard.press("Tab")
    card = page.evaluate("document.activeElement.closest('.note-card')?.id")
    assert card == f"card-claim-{built.ids[0]}"
    page.keyboard.press("Tab")
    until(page, [f"card-claim-{built.ids[1]}"])
    page.keyboard.press("Shift+Tab")
    until(page, [f"card-claim-{built.ids[0]}"])


@pytest.mark.browser
def test_a_click_leads_to_the_row(page, built):
    page.locator("a.claim").first.click()
    page.wait_for_url(f"**/ledger.html#claim-{built.ids[0]}")


@pytest.mark.browser
@pytest.mark.parametrize("page", ["touch"], indirect=True)
def test_a_first_tap_shows_the_card_whose_link_leads_on(page, built):
    mark, name = page.locator("a.claim").first, f"card-claim-{built.ids[0]}"
    mark.tap()
    until(page, [name])
    assert page.url.endswith("index.html")
    page.locator(f"[id='{name}'] a").tap()
    page.wait_for_url(f"**/ledger.html#claim-{built.ids[0]}")


@pytest.mark.browser
@pytest.mark.parametrize("page", ["touch"], indirect=True)
def test_a_tap_elsewhere_closes_the_card(page, built):
    page.locator("a.claim").first.tap()
    until(page, [f"card-claim-{built.ids[0]}"])
    page.touchscreen.tap(200, 600)
    until(page, [])


@pytest.mark.browser
@pytest.mark.parametrize("page", ["mouse", "touch"], indirect=True)
def test_a_card_lies_beside_its_mark_and_within_the_screen(page, built):
    for mark in page.locator("a[aria-describedby]").all():
        mark.scroll_into_view_if_needed()
        mark.evaluate("m => m.focus({ focusVisible: true })")
        name = mark.get_attribute("aria-describedby")
        until(page, [name])
        own, card = mark.bounding_box(), page.locator(f"[id='{name}']").bounding_box()
        wide, high = page.viewport_size["width"], page.viewport_size["height"]
        assert card["x"] >= 0
        assert card["x"] + card["width"] <= wide
        assert card["y"] >= 0
        assert card["y"] + card["height"] <= high
        below, above = own["y"] + own["height"], own["y"] - card["height"]
        # A pixel may be lost to rounding.
        assert min(abs(card["y"] - below), abs(card["y"] - above)) <= 1, name
        assert page.evaluate("document.documentElement.scrollWidth") <= wide


@pytest.mark.browser
def test_on_paper_the_marks_stay_and_the_cards_do_not(page, built):
    page.locator("a.claim").first.hover()
    until(page, [f"card-claim-{built.ids[0]}"])
    page.emulate_media(media="print")
    assert page.locator(".note-card:visible").count() == 0
    sign = page.locator("a.claim").first.evaluate("m => getComputedStyle(m, '::after').content")
    assert sign[1] == chips.MARKS[built.entries[built.ids[0]].outcome]


@pytest.mark.book
def test_every_mark_of_every_page_has_the_card_and_the_outcome_of_its_row(html):
    rows = {
        row["id"].removeprefix("claim-"): row["data-outcome"]
        for row in BeautifulSoup((html / "ledger.html").read_text("utf-8"), "html.parser").select(
            "tr[id]"
        )
    }
    count = 0
    for file in (file for file in pages(html) if file.parent == html):
        soup = BeautifulSoup(file.read_text("utf-8"), "html.parser")
        cards = {card["data-of"]: card for card in soup.select(".note-card")}
        for link in soup.select("a.claim"):
            id = link["href"].partition("#claim-")[2]
            card = cards[link["href"]]
            assert link.text == claim_by_id(id).printed, (file.name, id)
            assert link.text in told(card)["printed"], (file.name, id)
            assert rows[id] in link["class"], (file.name, id)
            assert card.select_one(f".verdict.{rows[id]}"), (file.name, id)
            count += 1
        for link in soup.select("a.internal:has(> .std-term)"):
            assert link["href"] in cards, (file.name, link["href"])
        assert sum(len(str(card)) for card in cards.values()) < 1200 * max(len(cards), 1)
    assert count > 50
