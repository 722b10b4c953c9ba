"""``python -m book.build.picture``: the README's picture, taken from the built book."""

from pathlib import Path

from book.build.browser import chromium

BOOK = Path("book")
PICTURE = BOOK / "images" / "page.png"
TOP, BOTTOM = "#tab-5-2", "#tab-5-b"


def main() -> None:
    """Take the part of Chapter 5's page between two of its tables."""
    page_file = (BOOK / "_build" / "html" / "chapter-5.html").resolve()
    PICTURE.parent.mkdir(exist_ok=True)
    with chromium() as browser:
        page = browser.new_page(
            viewport={"width": 1280, "height": 900}, device_scale_factor=1.5, offline=True
        )
        page.goto(page_file.as_uri())
        page.wait_for_selector(".math .katex")
        page.locator(TOP).scroll_into_view_if_needed()
        first, last = page.locator(TOP).bounding_box(), page.locator(BOTTOM).bounding_box()
        if first is None or last is None:
            raise SystemExit(f"{page_file} does not show {TOP} and {BOTTOM}")
        offset = page.evaluate("window.scrollY")
        page.screenshot(
            path=PICTURE,
            full_page=True,
            clip={
                "x": first["x"] - 20,
                "y": first["y"] + offset - 10,
                "width": first["width"] + 40,
                "height": last["y"] - first["y"],
            },
        )
    print(PICTURE)


if __name__ == "__main__":
    main()
