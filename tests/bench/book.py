"""``make bench-book``: the build of the book and its pages, here and at a former commit in turn.

Both are built in fresh clones, each with an environment of its own, on this machine, one after the
other: half an hour a round. It is no part of `tests.bench`, which takes minutes.
"""

import argparse
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter

import psutil
from playwright.sync_api import Browser, sync_playwright

from tests.bench import explorers
from tests.bench.entry import Entry, entry, table, timed, write
from tests.book.conftest import CHROMIUM, FLAGS

ROOT = Path(__file__).parents[2]
FORMER = "15ac9f9"
"""The last commit whose pages drew their sliders ahead and ran one after the other."""
PAGE = "chapter-4"
SLIDERS = "figure.explorer .panels svg, figure.explorer .panels img, .jupyter-widgets img"
"""What a slider has drawn, here and then."""
IMPORT = "from softgrip.rig.connect import connect"


@contextmanager
def memory_of_children() -> Iterator[list[float]]:
    """Append to a list, on leaving, the most that all children took at a time, MB.

    Memory that several share is counted once (PSS).
    """
    most, over, found = [0.0], threading.Event(), []

    def taken(process: psutil.Process) -> float:
        try:
            return float(process.memory_full_info().pss)
        except (psutil.Error, AttributeError):
            return 0.0

    def watch() -> None:
        while not over.wait(0.5):
            children = psutil.Process().children(recursive=True)
            most[0] = max(most[0], sum(map(taken, children)))

    thread = threading.Thread(target=watch)
    thread.start()
    try:
        yield found
    finally:
        over.set()
        thread.join()
        found.append(most[0] / 1e6)


class Tree:
    """A fresh clone at a commit, and what is measured in it."""

    def __init__(self, folder: Path, commit: str) -> None:
        self.folder = folder
        subprocess.run(["git", "clone", "-q", str(ROOT), str(folder)], check=True)
        subprocess.run(["git", "checkout", "-q", commit], cwd=folder, check=True)

    def make(self, target: str) -> float:
        """Make a target, and return the seconds that it takes."""
        command = ["make", "-s", target]
        return timed(
            lambda: subprocess.run(command, cwd=self.folder, check=True, stdout=sys.stderr)
        )

    def build(self) -> dict[str, float]:
        """Measure a build from nothing, another, and one after a page's text was changed."""
        for made in (".venv", "book/_build", "book/_vendor"):
            shutil.rmtree(self.folder / made, ignore_errors=True)
        with memory_of_children() as memory:
            fresh = self.make("book")
        again = self.make("book")
        page = self.folder / "book" / f"{PAGE}.md"
        text = page.read_text(encoding="utf-8")
        page.write_text(text + "\nA sentence more.\n", encoding="utf-8")
        changed = self.make("book")
        page.write_text(text, encoding="utf-8")
        self.make("book")
        return {
            "fresh clone to built book, s": fresh,
            "again, nothing changed, s": again,
            "a chapter's text changed, s": changed,
            "memory of the build, MB": memory[0],
        }

    def load(self, browser: Browser) -> dict[str, float]:
        """Measure what a chapter loads, and when its sliders have drawn."""
        page = browser.new_context(viewport={"width": 1280, "height": 900}, offline=True).new_page()
        asked: set[str] = set()
        page.on("request", lambda request: asked.add(request.url.partition("?")[0]))
        page.goto((self.folder / "book/_build/html" / f"{PAGE}.html").as_uri())
        page.wait_for_selector(SLIDERS, state="attached")
        drawn = float(page.evaluate("performance.now()")) / 1e3
        page.wait_for_timeout(3000)
        page.context.close()
        files = [Path(url.removeprefix("file://")) for url in asked if url.startswith("file:")]
        size = sum(file.stat().st_size for file in files if file.is_file())
        return {"a chapter loads, MB": size / 1e6, "from load to sliders, s": drawn}

    def imports(self) -> dict[str, float]:
        """Measure the import of what talks to a rig."""
        command = [str(self.folder / ".venv/bin/python"), "-c", IMPORT]
        subprocess.run(command, cwd=self.folder, check=True)
        return {IMPORT: timed(lambda: subprocess.run(command, cwd=self.folder, check=True))}


WANTED: dict[str, tuple[str, Callable[[float, float], bool]]] = {
    "fresh clone to built book, s": ("4 times faster", lambda own, then: then / own >= 4),
    "again, nothing changed, s": ("8 times faster", lambda own, then: then / own >= 8),
    "a chapter's text changed, s": ("", lambda own, then: own < then),
    "memory of the build, MB": ("half", lambda own, then: own <= then / 2),
    "a chapter loads, MB": ("<= 2 MB", lambda own, _: own <= 2),
    "from load to sliders, s": ("<= 1 s", lambda own, _: own <= 1),
    IMPORT: ("4 times faster", lambda own, then: then / own >= 4),
}


def entries(former: str = FORMER, rounds: int = 3) -> list[Entry]:
    """Return a line for each thing measured: medians of some rounds, and the former as baseline."""
    found: dict[str, tuple[list[float], list[float]]] = {name: ([], []) for name in WANTED}
    with tempfile.TemporaryDirectory() as name, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        trees = [Tree(Path(name) / commit, commit) for commit in ("HEAD", former)]
        for _ in range(rounds):
            for side, tree in enumerate(trees):
                for measure in (tree.build, lambda t=tree: t.load(browser), tree.imports):
                    for what, value in measure().items():
                        found[what][side].append(value)
        lines = explorers.entries(browser, trees[0].folder / "book/_build/html")
        browser.close()
    for what, sides in found.items():
        own, then = map(statistics.median, sides)
        words, holds = WANTED[what]
        ranges = [f"{min(side):.3g} to {max(side):.3g}" for side in sides]
        note = f"Medians of {rounds} rounds in turn ({ranges[0]}; at {former} {ranges[1]})."
        subject, _, unit = what.rpartition(", ")
        lines.append(
            entry(
                subject or what, own, unit if subject else "s", then,
                words, holds(own, then) if words else None, note,
            )
        )  # fmt: skip
    return lines


def main() -> None:
    """Measure, write and print."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.book", description=__doc__)
    parser.add_argument("--former", default=FORMER, help="commit that is the baseline")
    parser.add_argument("--rounds", type=int, default=3)
    asked = parser.parse_args()
    start = perf_counter()
    found = entries(asked.former, asked.rounds)
    write(found, ROOT / "book" / "_build" / "bench-book.json")
    print(table(found), f"\nTook {perf_counter() - start:.0f} s.")


if __name__ == "__main__":
    main()
