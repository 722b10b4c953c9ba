"""What JupyterLab opens: copies of the pages as notebooks, in a folder of a reader's own.

``python -m book.build.lab`` lays them, after a build. A copy that was changed stays, and is named.
"""

import hashlib
import json
import os
from pathlib import Path

from book.build.notebooks import BOOK
from book.build.tracing import ROOT
from book.companion.ledger_address import BOOK as VARIABLE


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def lay(notebooks: Path, folder: Path, address: str) -> list[str]:
    """Copy the notebooks of a built book; leave those that a reader has changed.

    Args:
        notebooks: Folder in which the build wrote them.
        folder: Where they shall lie.
        address: Where a browser finds the built book from there, with a stroke at its end.

    Returns:
        list[str]: Names of those that were changed, of which the book has another now.
    """
    folder.mkdir(parents=True, exist_ok=True)
    stamp = folder / ".laid.json"
    laid = json.loads(stamp.read_text(encoding="utf-8")) if stamp.is_file() else {}
    kept = []
    for source in sorted(notebooks.glob("*.ipynb")):
        copy = folder / source.name
        text = source.read_text(encoding="utf-8").replace(f"]({BOOK}", f"]({address}")
        text = text.replace(f'href=\\"{BOOK}', f'href=\\"{address}')
        before = laid.get(source.name)
        if copy.is_file() and _digest(copy.read_text(encoding="utf-8")) != before:
            kept += [source.name] if _digest(text) != before else []
            continue
        copy.write_text(text, encoding="utf-8")
        laid[source.name] = _digest(text)
    stamp.write_text(json.dumps(laid, indent=1), encoding="utf-8")
    return kept


if __name__ == "__main__":
    sources = ROOT / "book" / "_build" / "html" / "_sources"
    # Not in _build: that is thrown away, and these are a reader's.
    old = lay(sources, ROOT / "lab", os.environ.get(VARIABLE, "/static/"))
    for name in old:
        print(f"{name}: yours is kept, of a former edition. Delete it for that of today.")
