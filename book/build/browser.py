"""The browser that prints and pictures built pages."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome")


@contextmanager
def chromium() -> Iterator[Any]:
    """Open Chromium, through Playwright, and close it.

    Raises:
        SystemExit: If it is not there.
    """
    from playwright.sync_api import sync_playwright  # of the tests' environment

    path = next(filter(None, map(shutil.which, NAMES)), None)
    if path is None:
        raise SystemExit("This needs Chromium: install it (Debian: apt-get install chromium).")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=path, args=["--no-sandbox", "--disable-gpu"]
        )
        yield browser
        browser.close()
