"""How long a moved slider takes to its new curve: in the page, and where a kernel draws it."""

import gc
import random
from pathlib import Path
from time import perf_counter

import numpy as np
from playwright.sync_api import Browser

from book.chapter_2.sliders import draw_touch
from book.chapter_3.sliders import draw_best
from book.explore.frames import render
from tests.bench.entry import Entry, entry

FRAME = 16.0
"""ms: one picture of a screen of 60 Hz."""
MOVES = 60
TIMED = """window.frames_ms = [];
const later = window.requestAnimationFrame.bind(window);
window.requestAnimationFrame = (draw) => later((now) => {
  const start = performance.now();
  draw(now);
  document.body?.offsetHeight; // has it laid out
  window.frames_ms.push(performance.now() - start);
});"""
MOVED = """async (moves) => {
  const found = {};
  for (const root of document.querySelectorAll("figure.explorer")) {
    const sliders = [...root.querySelectorAll("input[type=range]")];
    if (!sliders.length || !root.dataset.started) continue;
    root.scrollIntoView();
    found[root.id] = [];
    for (const move of moves) {
      const one = sliders[Math.floor(move[0] * sliders.length)];
      one.value = +one.min + move[1] * (one.max - one.min);
      await new Promise((done) => setTimeout(done, 20));
      window.frames_ms.length = 0;
      one.dispatchEvent(new Event("input", { bubbles: true }));
      await new Promise((done) => setTimeout(done, 60));
      found[root.id].push(Math.max(0, ...window.frames_ms));
    }
  }
  return found;
}"""
LIVE = (
    (draw_touch, {"x": 0.0, "angle": 30.0}, "item", ("egg", "small carrot", "hot dog", "sponge")),
    (draw_best, {"pressure": 0.15, "modulus": 0.34}, "low", (1.2, 1.6, 2.0, 2.4, 2.8)),
)
"""What the page cannot compute, its other sliders, and one that moves."""


def in_page(browser: Browser, folder: Path) -> dict[str, list[float]]:
    """Return the milliseconds of each move of each explorer of the built pages."""
    chance, found = random.Random(0), {}
    moves = [[chance.random(), chance.random()] for _ in range(MOVES)]
    for file in sorted(folder.glob("*.html")):
        if 'class="explorer"' not in file.read_text(encoding="utf-8"):
            continue
        size = {"width": 1280, "height": 900}
        page = browser.new_context(viewport=size, offline=True).new_page()
        page.add_init_script(TIMED)
        page.goto(file.as_uri())
        page.wait_for_timeout(1500)
        found |= page.evaluate(MOVED, moves)
        page.context.close()
    return found


def drawn_live() -> list[float]:
    """Return the milliseconds in which a kernel draws what the page cannot compute."""
    found = []
    for draw, others, moved, values in LIVE:
        render(draw, {**others, moved: values[0]})  # what is made once is made
        gc.freeze()  # as `book.explore.redrawn` does
        for value in 4 * values:
            start = perf_counter()
            render(draw, {**others, moved: value}, small=False)
            found.append(1e3 * (perf_counter() - start))
    return found


def entries(browser: Browser, folder: Path) -> list[Entry]:
    """Return the lines of the built pages below a folder."""
    in_pages, live = in_page(browser, folder), drawn_live()
    late = {name: float(np.percentile(times, 95)) for name, times in in_pages.items()}
    slowest = max(late, key=lambda name: late[name])
    drawn = float(np.percentile(live, 95))
    return [
        entry(
            "slider to new curve in the page", late[slowest], "ms", None,
            f"<= {FRAME:g} ms", late[slowest] <= FRAME,
            f"The slowest of {len(late)} explorers, {slowest}: 95 of 100 moves of {MOVES}. Law, "
            "picture and layout; without the wait for the next frame of the screen. The median of "
            f"the explorers is {np.median([*late.values()]):.2g} ms.",
        ),
        entry(
            "slider to new picture by a kernel", drawn, "ms", None, "<= 80 ms", drawn <= 80,
            f"95 of 100 of {len(live)} redraws of {len(LIVE)} explorers, without the way to the "
            "page and back. All others compute in the page, in a notebook too.",
        ),
    ]  # fmt: skip
