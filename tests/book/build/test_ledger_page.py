"""The ledger in a browser: filters, orders and addresses against Python's own selection."""

import csv
import html
import inspect
import json
import random
import re
from importlib import import_module
from urllib.parse import parse_qsl, urlsplit

import pytest
from bs4 import BeautifulSoup

from book.build.reference import modules, packages
from book.companion import chips
from book.companion.claims import Basis, read_claims
from book.companion.ledger import write_records
from book.companion.ledger_address import NONE, address, row_address
from book.companion.ledger_form import filter_form
from book.companion.printed import Spread
from book.companion.twin_reach import told
from book.companion.verdict import Entry, Outcome, recomputation

SEEN = "[...document.querySelectorAll('tr[id]')].filter(r => r.checkVisibility()).map(r => r.id)"
FILL = """state => {
  const form = document.querySelector("form.ledger-filter");
  for (const name of ["chapter", "outcome", "basis", "place", "text"])
    form.elements[name].value = state[name] ?? "";
  form.dispatchEvent(new Event("input", { bubbles: true }));
}"""
WIDTHS = (1280, 400)


def made_up() -> list[Entry]:
    """Return all claims, with outcomes and values at random: what a page shows is not judged.

    They stand in the order of the page, place by place.
    """
    chance = random.Random(7)
    claims = read_claims()
    places = [*dict.fromkeys((claim.chapter, claim.where) for claim in claims)]
    entries = []
    for claim in sorted(claims, key=lambda claim: places.index((claim.chapter, claim.where))):
        value = chance.choice([None, chance.gauss(0, 100), chance.gauss(0, 1), float("nan")])
        spread = None if value is None else Spread(value, value, value)
        function = recomputation(claim) if claim.function else None
        entries.append(
            Entry(
                claim,
                chance.choice([*Outcome]),
                spread,
                under_assumption=chance.choice([None, 2.5]),
                function=f"{function.__module__}.{function.__name__}" if function else "",
            )
        )
    return entries


@pytest.fixture(scope="module")
def entries():
    return made_up()


def document(root, entries) -> str:
    """Return a page as the book has it, with nothing around its ledger."""
    static = (root / "book" / "_static").as_uri()
    parts = "".join(
        f'<section id="chapter-{n}"><h2>Chapter {n}</h2>{chips.counts_chips(own, chapter=n)}'
        f"{chips.verdict_table(own)}</section>"
        for n in sorted({entry.claim.chapter for entry in entries})
        if (own := [entry for entry in entries if entry.claim.chapter == n])
    )
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8"><title>The ledger</title>'
        '<meta name="viewport" content="width=device-width">'
        f'<link rel="stylesheet" href="{static}/softgrip.css">'
        f'<link rel="stylesheet" href="{static}/ledger/ledger.css">'
        f'<script src="{static}/ledger/ledger.js"></script></head><body><main><h1>The ledger</h1>'
        f"{chips.counts_chips(entries)}{filter_form(e.claim for e in entries)}{parts}"
        "</main></body></html>"
    )


@pytest.fixture(scope="module")
def file(root, entries, tmp_path_factory):
    file = tmp_path_factory.mktemp("ledger") / "ledger.html"
    file.write_text(document(root, entries), encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def texts(file):
    """Return what a reader may find in each row, by its id."""
    soup = BeautifulSoup(file.read_text(encoding="utf-8"), "html.parser")
    return {
        row["id"]: " ".join(
            [row["id"], row.parent["data-place"], *(cell.get_text() for cell in row("td"))]
        ).lower()
        for row in soup.select("tr[id]")
    }


@pytest.fixture
def page(browser, file):
    context = browser.new_context(viewport={"width": 1280, "height": 900}, offline=True)
    page = context.new_page()
    complaints = []
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto(file.as_uri())
    yield page
    context.close()
    assert complaints == []


def at(page, file, fragment):
    """Open the page anew at a fragment."""
    page.goto("about:blank")
    page.goto(f"{file.as_uri()}#{fragment}" if fragment else file.as_uri())


def rows(entries):
    return [f"claim-{entry.claim.id}" for entry in entries]


def selection(entries, texts, state):
    """Return the rows of a state of the form, as Python selects them."""
    return [
        f"claim-{entry.claim.id}"
        for entry in entries
        if state.get("chapter", str(entry.claim.chapter)) == str(entry.claim.chapter)
        and state.get("outcome", entry.outcome) == entry.outcome
        and state.get("basis", entry.basis or NONE) == (entry.basis or NONE)
        and state.get("place", entry.claim.where) == entry.claim.where
        and all(
            w in texts[f"claim-{entry.claim.id}"] for w in state.get("text", "").lower().split()
        )
    ]


def states(entries, count):
    """Return states of the form: each field alone at all its values, then some together."""
    chance = random.Random(11)
    values = {
        "chapter": sorted({str(entry.claim.chapter) for entry in entries}),
        "outcome": [*map(str, Outcome)],
        "basis": [basis or NONE for basis in Basis],
        "place": sorted({entry.claim.where for entry in entries}),
        "text": ["0.359", "torque Design", "MPa", "3.4-plateau", "IF ASSUMED", "<", "no such row"],
    }
    alone = [{name: value} for name, found in values.items() for value in found]
    together = []
    for _ in range(count):
        like = chance.choice(entries)  # so that most of these states leave rows
        own = {
            "chapter": str(like.claim.chapter),
            "outcome": str(like.outcome),
            "basis": like.basis or NONE,
            "place": like.claim.where,
            "text": chance.choice([like.claim.printed, *like.claim.what.split()]),
        }
        if chance.random() < 0.2:
            name = chance.choice([*values])
            own[name] = chance.choice(values[name])
        names = chance.sample([*own], chance.randint(2, 4))
        together.append({name: own[name] for name in names})
    return alone + together


@pytest.mark.browser
def test_each_filter_and_many_together_leave_the_rows_that_python_selects(page, entries, texts):
    some = 0
    for state in states(entries, 150):
        page.evaluate(FILL, state)
        wanted = selection(entries, texts, state)
        assert page.evaluate(SEEN) == wanted, state
        assert page.locator("output").inner_text() == f"{len(wanted)} of {len(entries)} numbers"
        some += bool(wanted)
    assert some > 150


@pytest.mark.browser
def test_chapters_and_places_without_a_row_are_not_shown(page, entries):
    place = "Table 5.2"
    page.evaluate(FILL, {"place": place})
    heads = page.locator("th[scope=rowgroup]:visible").all_inner_texts()
    assert (page.locator("h2:visible").all_inner_texts(), heads) == (["Chapter 5"], [place])


@pytest.mark.browser
def test_the_address_holds_the_state(page, file, entries, texts):
    for state in [*states(entries, 12)[-12:], {"text": "a & b=c#d +%"}, {}]:
        page.evaluate(FILL, state)
        fragment = urlsplit(page.url).fragment
        assert dict(parse_qsl(fragment)) == state
        at(page, file, fragment)
        assert page.evaluate(SEEN) == selection(entries, texts, state)
        own = {name: page.locator(f"form [name={name}]").input_value() for name in state}
        assert own == state


@pytest.mark.browser
def test_an_address_that_python_writes_is_followed_on_the_page_and_back(page, entries, texts):
    for state in ({"place": "Section 6.4, proj(Y_d)"}, {"chapter": "4", "outcome": "open"}):
        page.evaluate("to => location.hash = to", address(**state).partition("#")[2])
        page.wait_for_function(
            "n => document.querySelectorAll('tr[id]:not([hidden])').length === n",
            arg=len(selection(entries, texts, state)),
        )
        assert page.evaluate(SEEN) == selection(entries, texts, state)
    page.go_back()
    page.go_back()
    page.wait_for_function("!document.querySelector('tr[hidden]')")


@pytest.mark.browser
def test_a_choice_that_is_not_there_filters_nothing(page, file, entries):
    at(page, file, "chapter=9&sort=nonsense&other=1")
    assert page.evaluate(SEEN) == rows(entries)


def column(entry, name):
    """Return what a column is sorted by; None where it has nothing."""
    return {
        "what": entry.claim.what.lower(),
        "printed": float(entry.claim.printed),
        "recomputed": entry.spread and entry.spread.value,
        "outcome": [*Outcome].index(entry.outcome),
        "basis": entry.basis or (entry.claim.nature if entry.claim.nature != "result" else ""),
        "twin": told(entry.claim.id),
    }[name]


def ordered(entries, name, back):
    """Return the rows sorted chapter by chapter; what has nothing in the column comes last."""
    found = []
    for chapter in sorted({entry.claim.chapter for entry in entries}):
        own = [entry for entry in entries if entry.claim.chapter == chapter]
        # No number is a number, in the sense of the sort, that differs from itself.
        full = [e for e in own if (v := column(e, name)) not in (None, "") and v == v]
        found += sorted(full, key=lambda entry: column(entry, name), reverse=back)
        found += [entry for entry in own if entry not in full]
    return rows(found)


@pytest.mark.browser
@pytest.mark.parametrize("name", ["what", "printed", "recomputed", "outcome", "basis", "twin"])
def test_a_heading_sorts_up_then_down_then_not(name, page, file, entries):
    head = page.locator(f"#chapter-3 th[data-sort={name}]")
    for sign, said in (("", "ascending"), ("-", "descending"), (None, "none")):
        head.get_by_role("button").click()
        assert head.get_attribute("aria-sort") == said
        assert page.locator(f"th[aria-sort={said}]").count() >= 5
        wanted = rows(entries) if sign is None else ordered(entries, name, bool(sign))
        assert page.evaluate(SEEN) == wanted
        assert urlsplit(page.url).fragment == ("" if sign is None else f"sort={sign}{name}")
    assert page.locator("th[scope=rowgroup]:visible").count() > 50


@pytest.mark.browser
def test_sorted_and_filtered_rows_stay_so_when_the_address_is_opened(page, file, entries, texts):
    at(page, file, "sort=-printed&outcome=open")
    kept = selection(entries, texts, {"outcome": "open"})
    assert page.evaluate(SEEN) == [i for i in ordered(entries, "printed", True) if i in kept]
    place = page.locator("tr[id]:visible td").first.evaluate(
        "cell => getComputedStyle(cell, '::before').content"
    )
    assert json.loads(place) in {entry.claim.where for entry in entries}, "each tells its place"


@pytest.mark.browser
def test_reset_shows_all_rows_in_their_order(page, file, entries):
    at(page, file, "sort=-printed&outcome=open&text=angle")
    page.get_by_role("button", name="show all").click()
    assert page.evaluate(SEEN) == rows(entries)
    assert page.url == file.as_uri()


@pytest.mark.browser
def test_a_row_has_an_address_that_shows_it_whatever_is_filtered(page, file, entries):
    target = next(e.claim.id for e in entries if e.claim.chapter == 6 and e.outcome == "given")
    fragment = row_address(target).partition("#")[2]
    inside = "id => { const r = document.getElementById(id).getBoundingClientRect();" + (
        " return r.top > -1 && r.bottom <= innerHeight && r.height > 0 }"
    )
    page.evaluate(FILL, {"outcome": "open", "chapter": "2"})
    page.evaluate("to => location.hash = to", fragment)
    page.wait_for_function(inside, arg=fragment)
    seen = page.evaluate(SEEN)
    assert fragment in seen
    assert len(seen) > 1, "and the filter stands"
    page.evaluate(FILL, {"outcome": "open", "chapter": "2"})
    assert fragment not in page.evaluate(SEEN), "until it is changed"
    at(page, file, fragment)
    page.wait_for_function(inside, arg=fragment)
    assert page.evaluate(SEEN) == rows(entries)


@pytest.mark.browser
def test_the_sign_of_a_row_is_seen_on_hover_and_on_focus_and_is_its_address(page, entries):
    row = page.locator("tr[id]").nth(3)
    sign = row.locator("a.permalink")
    shown = "sign => getComputedStyle(sign).opacity"
    assert sign.evaluate(shown) == "0"
    row.hover()
    assert sign.evaluate(shown) == "1"
    page.mouse.move(0, 0)
    sign.focus()
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Tab")
    assert sign.evaluate(shown) == "1"
    page.keyboard.press("Enter")
    assert urlsplit(page.url).fragment == row.get_attribute("id")


@pytest.mark.browser
def test_a_heading_that_a_filter_hides_is_shown_when_it_is_linked(page, entries):
    page.evaluate(FILL, {"chapter": "2"})
    assert not page.locator("#chapter-5").is_visible()
    page.evaluate("location.hash = 'chapter-5'")
    page.wait_for_function("document.getElementById('chapter-5').checkVisibility()")
    assert page.evaluate(SEEN) == rows(entries)


@pytest.mark.browser
def test_the_form_works_by_keyboard_and_says_what_it_did(page, file, entries, texts):
    page.get_by_label("text", exact=True).focus()
    page.keyboard.type("buckl")
    page.keyboard.press("Enter")  # sends nothing
    assert page.evaluate(SEEN) == selection(entries, texts, {"text": "buckl"})
    told = page.get_by_role("status")
    assert told.inner_text().startswith(f"{len(page.evaluate(SEEN))} of ")
    for name in ("place", "basis", "outcome", "chapter"):
        page.keyboard.press("Shift+Tab")
        assert page.evaluate("document.activeElement.name") == name
    page.keyboard.press("ArrowDown")
    first = str(min(entry.claim.chapter for entry in entries))
    assert page.evaluate(SEEN) == selection(entries, texts, {"text": "buckl", "chapter": first})


@pytest.mark.browser
def test_without_a_script_and_on_paper_all_rows_stand_and_no_control(browser, file, entries, page):
    context = browser.new_context(java_script_enabled=False, offline=True)
    plain = context.new_page()
    plain.goto(f"{file.as_uri()}#outcome=open")
    assert plain.locator("tr[id]:visible").count() == len(entries)
    assert not plain.locator("form").is_visible()
    context.close()
    for state in ("outcome=open&chapter=3", "sort=-printed&text=torque"):
        at(page, file, state)
        page.emulate_media(media="print")
        assert sorted(page.evaluate(SEEN)) == sorted(rows(entries))
        assert page.locator("h2:visible").count() == 5
        assert not page.locator("form").is_visible()
        page.emulate_media(media="screen")


@pytest.mark.browser
@pytest.mark.parametrize("width", WIDTHS)
def test_the_page_fits_its_screen_and_nothing_in_it_moves_while_it_loads(width, page, file):
    page.set_viewport_size({"width": width, "height": 900})
    page.add_init_script(
        "window.shifts = 0; new PerformanceObserver(list => {"
        " for (const each of list.getEntries()) window.shifts += each.value"
        "}).observe({ type: 'layout-shift', buffered: true })"
    )
    page.goto("about:blank")
    page.goto(file.as_uri())
    page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert page.evaluate("window.shifts") == 0
    assert page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.browser
def test_the_script_does_nothing_where_there_is_no_ledger(root, page, tmp_path):
    other = tmp_path / "other.html"
    script = (root / "book" / "_static" / "ledger" / "ledger.js").as_uri()
    body = '<table class="ledger errata"><tr id="a"><td>1</td></tr></table>'
    other.write_text(f'<!doctype html><script src="{script}"></script>{body}', encoding="utf-8")
    page.goto(f"{other.as_uri()}#outcome=open")
    assert page.locator("tr:visible").count() == 1
    assert page.locator("button").count() == 0


LINK = re.compile(r'<a[^>]* href="ledger\.html#([^"]*=[^"]*)"[^>]*>\W*(\d+)[^<]*</a>')
"""A count that leads to the rows that it counts."""


def counted(markup):
    """Return the counts of a piece of HTML, each with the state that it leads to."""
    return [(dict(parse_qsl(html.unescape(to))), int(n)) for to, n in LINK.findall(markup)]


def test_counts_lead_to_as_many_rows_as_they_say(entries, texts):
    tables = [chips.chapter_counts(entries), chips.basis_counts(entries)]
    markup = chips.counts_chips(entries)
    for table in tables:
        markup += chips.markdown_table(chips._with_links(table), numbers=table)
    found = counted(markup)
    assert len(found) == 5 + sum((table.iloc[:, 1:] > 0).sum().sum() for table in tables) - 2
    for state, number in found:
        assert len(selection(entries, texts, state)) == number, state


def test_every_function_of_a_row_has_its_place_in_the_reference(entries):
    for full in sorted({entry.function for entry in entries if entry.function}):
        module, _, name = full.rpartition(".")
        package = module.rpartition(".")[0]
        assert package in packages(), full
        assert module in modules(package), full
        function = getattr(import_module(module), name)
        assert function.__module__ == module, full
        assert not name.startswith("_"), full
        assert inspect.getdoc(function), full


def test_a_value_under_an_assumption_stands_beside_what_is_recomputed(file, entries):
    soup = BeautifulSoup(file.read_text(encoding="utf-8"), "html.parser")
    for entry in entries[::9]:
        cell = soup.find(id=f"claim-{entry.claim.id}")("td")[2]
        assert ("if assumed: 2.5" in cell.text) == (entry.under_assumption is not None)


def test_what_can_be_downloaded_is_every_record(entries, tmp_path):
    records = [entry.record() for entry in entries]
    write_records(tmp_path / "a.json", entries)
    write_records(tmp_path / "b" / "a.json", entries)
    for name in ("a.json", "a.csv"):
        assert (tmp_path / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    assert json.loads((tmp_path / "a.json").read_text(encoding="utf-8")) == records
    with (tmp_path / "a.csv").open(encoding="utf-8", newline="") as stream:
        table = [*csv.DictReader(stream)]
    assert [row["id"] for row in table] == [record["id"] for record in records]
    for row, record in zip(table, records, strict=True):
        for name, value in record.items():
            kept = json.dumps(value) if isinstance(value, list | dict) else value
            assert row[name] == ("" if kept is None else str(kept)), (record["id"], name)


@pytest.mark.book
def test_labels_of_all_pages_lead_to_the_rows_that_they_count(html):
    soup = BeautifulSoup((html / "ledger.html").read_text(encoding="utf-8"), "html.parser")
    shown = [
        {
            "chapter": row.find_parent("table")["data-chapter"],
            "place": row.parent["data-place"],
            "outcome": row["data-outcome"],
            "basis": row["data-basis"],
        }
        for row in soup.select("table.numbers tr[id]")
    ]
    assert len(shown) == len(read_claims())
    pages = {file.name: counted(file.read_text(encoding="utf-8")) for file in html.glob("*.html")}
    assert pages["index.html"]
    for n in sorted({claim.chapter for claim in read_claims()}):
        assert any("place" in state for state, _ in pages[f"chapter-{n}.html"]) or n == 6
    for name, found in pages.items():
        for state, number in found:
            assert sum(state.items() <= row.items() for row in shown) == number, (name, state)


@pytest.mark.book
def test_the_ledger_offers_its_records_and_a_heading_for_each_chapter(html):
    soup = BeautifulSoup((html / "ledger.html").read_text(encoding="utf-8"), "html.parser")
    files = [html / link["href"] for link in soup.select("a.download")]
    assert [file.name for file in files] == ["ledger.csv", "ledger.json"]
    records = json.loads(files[1].read_text(encoding="utf-8"))
    assert [record["id"] for record in records] == [claim.id for claim in read_claims()]
    chapters = {f"#chapter-{claim.chapter}" for claim in read_claims()}
    assert chapters <= {link["href"] for link in soup.select(".page-toc a[href]")}
    for record in records:
        row = soup.find(id=f"claim-{record['id']}")
        assert row["data-outcome"] == record["outcome"]
