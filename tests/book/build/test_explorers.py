"""Figures with sliders in the built book: they move, compute what Python does, can be linked."""

import json
import re

import numpy as np
import pytest

from book.companion.finger_drawing import bent
from book.explore.law import recorded
from tests.book.build.test_pages import Visit
from tests.book.explore.page_laws import page_laws

pytestmark = [pytest.mark.book, pytest.mark.browser, pytest.mark.usefixtures("local_scripts")]

POINTS = 1000
CLOSE = 1e-9
"""Of the range of an output over all points: Chromium's powers and exponentials are rounded by its
own library."""
LOOK = """([name, words, points, directions]) => {
  const law = softgripExplorers[name].laws[words], found = {};
  for (const point of points) for (const [output, values] of Object.entries(law(point)))
    (found[output] ||= []).push(directions.map((seed) => {
      let sum = 0;
      for (let k = 0; k < values.length; k++) sum += values[k] * Math.cos(seed * (k + 1));
      return sum / Math.max(1, values.length);
    }));
  return found;
}"""
"""Each output of each point along some directions, of which none misses a value that is off."""
DIRECTIONS = [0.0, 0.7, 2.1]


@pytest.fixture(scope="module")
def chapters(html, browser):
    """Return a page by what it shows; each is opened once."""
    found, visits = {}, []
    for file in sorted(html.glob("*.html")):
        if 'class="explorer"' in file.read_text(encoding="utf-8"):
            visits.append(Visit(browser, file))
            for name in visits[-1].page.evaluate("Object.keys(softgripExplorers)"):
                found[name] = visits[-1].page
    yield found
    for visit in visits:
        visit.context.close()


def along(values):
    values = np.ravel(values)
    k = np.arange(1, values.size + 1)
    return [float(values @ np.cos(seed * k)) / max(1, values.size) for seed in DIRECTIONS]


@pytest.mark.parametrize("name", [*page_laws()])
def test_the_page_computes_what_python_computes(name, chapters):
    shown = page_laws()[name]
    place = f"explore-{name.replace('_', '-')}"
    columns = shown.points(POINTS)
    points = np.column_stack([*columns.values()]).tolist()
    for words in shown.words:
        law = recorded(shown.law, list(columns), **words)
        found = chapters[place].evaluate(
            LOOK, [place, "|".join(words.values()), points, DIRECTIONS]
        )
        expected = [{n: along(v) for n, v in law(point).items()} for point in points]
        for output, rows in found.items():
            wanted = np.array([each[output] for each in expected])
            got = np.array([[np.nan if x is None else x for x in row] for row in rows], float)
            finite = wanted[np.isfinite(wanted)]
            scale = max(float(np.ptp(finite)), 1e-12) if finite.size else 1.0
            np.testing.assert_allclose(got, wanted, rtol=0, atol=CLOSE * scale, err_msg=output)


def shown_by(box):
    # Clips and heads of lines are numbered through the page, picture by picture.
    return re.sub(r"plot-(clip|marker)-\d+", "", box.locator(".panels").inner_html())


def test_every_slider_moves_its_picture(chapters):
    moved = 0
    for name, page in chapters.items():
        box = page.locator(f"#{name}")
        for handle in box.locator("input[type=range]").all():
            box.locator(".reset").click()  # some sliders move nothing where another one is
            before = shown_by(box)
            last = handle.input_value() == handle.get_attribute("max")
            for _ in range(5):  # a step may change nothing that a digit of a pixel shows
                handle.press("ArrowLeft" if last else "ArrowRight")
            for _ in range(300):
                if shown_by(box) != before:
                    break
                page.wait_for_timeout(20)
            assert shown_by(box) != before, (name, handle.get_attribute("name"))
            assert handle.get_attribute("aria-valuetext")
            assert page.locator(f"label[for={handle.get_attribute('id')}]").inner_text()
            moved += 1
        box.locator(".reset").click()
    assert moved >= 30


def test_a_state_can_be_linked_and_reset(chapters):
    page = chapters["explore-finger"]
    box = page.locator("#explore-finger")
    begin = shown_by(box)
    box.locator("[name=top]").fill("10")
    page.wait_for_function(
        "document.querySelector('#explore-finger .link').href.includes('top=15')"
    )
    linked, state = box.locator(".link").get_attribute("href"), shown_by(box)
    box.locator(".reset").click()
    assert shown_by(box) == begin
    page.evaluate("hash => { location.hash = hash; }", linked)
    page.wait_for_function("document.querySelector('#explore-finger [name=top]').value === '10'")
    assert shown_by(box) == state
    box.locator(".reset").click()


def test_values_are_told_in_words_and_in_a_table(chapters):
    page = chapters["explore-finger"]
    box = page.locator("#explore-finger")
    words = box.locator(".panels").get_attribute("aria-label")
    assert "a 20 mm" in words
    assert box.locator(".told").inner_text() in words
    box.locator(".values summary").click()
    page.wait_for_selector("#explore-finger .values table td")
    assert box.locator(".values th").all_inner_texts()[0] == "rubber x"


def drawn_path(page, name):
    """Return the corners of the last shape that is bent, pixels."""
    path = page.locator(f"#{name} .bent path").last.get_attribute("d")
    return np.array(re.findall(r"([-\d.]+),([-\d.]+)", path), float)


def test_a_finger_is_bent_by_the_angle_that_its_law_gives(chapters):
    found = drawn_path(chapters["explore-finger"], "explore-finger")
    angle = np.radians(page_laws()["finger"].law(top=20, bottom=4, wall=1.5)["widest"])
    straight = np.array([-4j, 94 - 4j, 94 + 20j, 20j])
    part = np.linspace(0, 1, 47, endpoint=False)  # of edges of 2 mm
    edges = zip(straight, np.roll(straight, -1), strict=True)
    corners = [a + part * (b - a) if a.imag == b.imag else np.array([a]) for a, b in edges]
    expected = bent(np.concatenate(corners), 94, angle)
    assert len(found) == len(expected)
    scale = np.ptp(found[:, 0]) / np.ptp(expected.real)
    for pixels, mm in ((found[:, 0], expected.real), (-found[:, 1], expected.imag)):
        assert np.ptp(pixels - scale * mm) < 0.5


def test_what_is_played_moves_and_ends_where_it_was(chapters):
    for name in ("explore-lqr", "explore-pid", "explore-gripper-step", "explore-gripper-push"):
        page = chapters[name]
        before = drawn_path(page, name)
        page.locator(f"#{name} .play").click()
        page.wait_for_timeout(300)
        assert np.abs(drawn_path(page, name) - before).max() > 5, name
        page.locator(f"#{name} .reset").click()
        np.testing.assert_array_equal(drawn_path(page, name), before)
    assert chapters["explore-pump"].locator("#explore-pump .play").count() == 0


def test_a_redraw_takes_ten_frames_at_most(chapters):
    """Half of them, on a busy machine too; on a quiet one most are there in the next frame."""
    for name, page in chapters.items():
        times = page.evaluate(
            """async (name) => {
              const input = document.getElementById(name).querySelector("input"), found = [];
              for (let k = 0; k < 40; k++) {
                input.value = k % 2 ? input.min : input.max;
                const start = performance.now();
                input.dispatchEvent(new Event("input"));
                await new Promise((done) => requestAnimationFrame(() => done()));
                found.push(performance.now() - start);
              }
              return found;
            }""",
            name,
        )
        assert np.median(times) < 160, (name, json.dumps(times))
