"""The page *Change an input* in a browser: its sliders judge as Python does."""

import random

import pytest

from book.companion.inputs import inputs
from book.explore.change_an_input import NAME
from book.explore.claim_laws import page_claims
from tests.book.build.test_pages import WIDTHS, Visit
from tests.book.explore.test_claim_laws import by_python, value_at

pytestmark = [pytest.mark.book, pytest.mark.browser]

MOVED = "document.querySelector('.what-if .told').textContent.includes('moved')"


@pytest.fixture(scope="module")
def page(html, browser):
    with Visit(browser, html / "change-an-input.html") as visit:
        yield visit.page
        assert visit.complaints == []
        assert all(url.startswith("file:") for url in visit.requests)


@pytest.fixture
def figure(page):
    box = page.locator(f"#{NAME}")
    box.locator("button").click()
    return box


def test_sliders_judge_as_python_does(page, figure):
    chance, symbols = random.Random(3), page_claims().symbols
    for _ in range(10):
        places = {s: chance.randint(0, 200) for s in chance.sample(symbols, 6)}
        values = {s: value_at(s, place) for s, place in places.items()}
        shown = page.evaluate(
            """([name, places]) => {
              const it = softgripExplorers[name], root = document.getElementById(name);
              root.querySelector("button").click();
              for (const [symbol, place] of Object.entries(places))
                root.querySelector(`[name="${symbol}"]`).value = place;
              root.querySelector("input").dispatchEvent(new Event("input"));
              return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
                const call = root.querySelector(".call").textContent;
                const at = (s) => new RegExp(`[( ]${s.name}=([^,)]+)`).exec(call)?.[1];
                const given = it.sliders.map((s) => (at(s) === undefined ? undefined : +at(s)));
                const found = it.changes(given);
                done([call, [...found.moved, ...found.shifted, ...found.still].map((c) => [
                  c.claim.id, c.now.outcome])]);
              })));
            }""",
            [NAME, places],
        )
        changed = {s: value for s, value in values.items() if value != inputs()[s].stated}
        for symbol, value in changed.items():
            assert f"{symbol}={value:.12g}".replace("e-0", "e-") in shown[0]
        assert dict(shown[1]) == {id: e.outcome for id, e in by_python(changed).items()}


def test_a_key_moves_a_slider_and_the_change_is_told(page, figure):
    told = figure.locator("[role=status]")
    assert told.inner_text() == "All inputs are as stated."
    figure.locator("[name=omega]").press("ArrowRight")
    page.wait_for_function(MOVED)
    assert "moved" in told.inner_text()
    assert figure.locator(".moved tbody tr").count() > 0
    assert figure.locator(".control.changed label").inner_text().startswith("omega")
    assert "ledger.html#claim-" in figure.locator(".moved a").first.get_attribute("href")
    figure.locator("button").click()
    assert figure.locator(".moved tbody tr").count() == 0


def test_a_state_can_be_linked(page, figure):
    figure.locator("[name=E]").fill("10")
    page.wait_for_function(MOVED)
    link, shown = (
        figure.locator(".link").get_attribute("href"),
        figure.locator(".moved").inner_text(),
    )
    assert link == f"#{NAME}?E=0.22"
    figure.locator("button").click()
    page.evaluate("hash => { location.hash = hash; }", link)
    page.wait_for_function(MOVED)
    assert figure.locator(".moved").inner_text() == shown


def test_the_strip_stays_in_sight_while_a_slider_moves(page, figure):
    for width in WIDTHS:
        page.set_viewport_size({"width": width, "height": 900})
        figure.locator("[name=a]").scroll_into_view_if_needed()
        figure.locator("[name=a]").press("ArrowRight")
        page.wait_for_function(MOVED)
        box = figure.locator(".strip").bounding_box()
        assert box["y"] + box["height"] <= 901
        assert page.evaluate("document.documentElement.scrollWidth") <= width
