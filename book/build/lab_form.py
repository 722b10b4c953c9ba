"""Pages in the form in which JupyterLab saves them: opened there, and saved, they stay the same.

``python -m book.build.lab_form`` brings the pages into it, as after writing one by hand.
"""

from pathlib import Path
from typing import Any

from book.build.tracing import ROOT

KERNEL = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
LANGUAGE = {"name": "python", "pygments_lexer": "ipython3", "file_extension": ".py"}
"""What a kernel, once it runs, has Lab write of itself."""


def has_cells(page: Path) -> bool:
    """Tell whether a page is there and has code."""
    return page.is_file() and "```{code-cell}" in page.read_text(encoding="utf-8")


def pages() -> list[Path]:
    """Return the pages that have cells."""
    return [page for page in sorted((ROOT / "book").glob("*.md")) if has_cells(page)]


def saved(page: Path) -> None:
    """Open a page, run a kernel in it, and save it, as Lab does; its folder has the settings."""
    # Not above: a build, which asks for `has_cells`, would load a server.
    from jupyter_server.services.contents.largefilemanager import LargeFileManager
    from jupytext.sync_contentsmanager import build_sync_jupytext_contents_manager_class

    manager: Any = build_sync_jupytext_contents_manager_class(LargeFileManager)()
    manager.root_dir = str(page.parent)
    notebook = manager.get(page.name, type="notebook", content=True)["content"]
    notebook["metadata"] |= {"kernelspec": KERNEL, "language_info": LANGUAGE}
    manager.save({"type": "notebook", "format": "json", "content": notebook}, page.name)


if __name__ == "__main__":
    for each in pages():
        saved(each)
