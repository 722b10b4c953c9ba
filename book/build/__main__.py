"""Build the book, or say that nothing has changed: ``python -m book.build``.

Whether anything has is told by digests, before Sphinx or anything of the book is imported.
"""

import hashlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BOOK = ROOT / "book"
HTML = BOOK / "_build" / "html"
STAMP = BOOK / "_build" / "built.json"
MADE_OF = ("book", "softgrip", "data", "tests", "environment.lock", "pyproject.toml")
MADE = {"_build", "_vendor", "__pycache__"}
"""Folders that a build or a run makes."""
TOOL = """\
import sys
# Where it is there, jsonschema compiles the grammars of all parts of addresses: two seconds.
sys.modules["rfc3987_syntax"] = None
from jupyter_book.cli.main import main
main()
"""
VARIABLES = ("SOFTGRIP_MATERIALS_DIR", "SOFTGRIP_AUTHOR_DIR")


def _files(top: Path) -> Iterator[Path]:
    for folder, inner, names in os.walk(top):
        inner[:] = sorted(name for name in inner if name not in MADE)
        yield from (Path(folder) / name for name in sorted(names))


def _sources() -> str:
    """Return a digest of what a build reads: files by content, public data by place and size."""
    found = hashlib.sha256(sys.version.encode())
    for name in MADE_OF:
        top = ROOT / name
        for file in _files(top) if top.is_dir() else [top]:
            found.update(f"{file.relative_to(ROOT)}\0".encode() + file.read_bytes())
    for variable in VARIABLES:
        folder = os.environ.get(variable, "")
        sizes = (
            [(str(file), file.stat().st_size) for file in _files(Path(folder))] if folder else []
        )
        found.update(json.dumps([variable, folder, sizes]).encode())
    return found.hexdigest()


def _pages() -> str:
    """Return a digest of names, sizes and times of all that was built."""
    found = hashlib.sha256()
    for file in _files(HTML):
        told = file.stat()
        found.update(f"{file.relative_to(HTML)} {told.st_size} {told.st_mtime_ns}\n".encode())
    return found.hexdigest()


def _is_current() -> bool:
    try:
        kept = json.loads(STAMP.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return bool(kept == {"sources": _sources(), "pages": _pages()})


def main() -> int:
    """Build, and return the exit code."""
    place = f"The book: {(HTML / 'index.html').as_uri()}"
    if _is_current():
        print(f"Nothing has changed. {place}")
        return 0
    STAMP.unlink(missing_ok=True)
    sources = _sources()
    options = ["build", "--quiet", "-W", "-n", "--keep-going", str(BOOK)]
    command = [sys.executable, "-c", TOOL, *options]
    if code := subprocess.run(command, check=False).returncode:
        # Sphinx tells a warning once: the next build reads all anew, and tells it again.
        shutil.rmtree(BOOK / "_build" / ".doctrees", ignore_errors=True)
        return code
    from book.build.tracing import surroundings

    # Public data that could not be had may be there the next time.
    if "False" not in surroundings().values():
        STAMP.write_text(json.dumps({"sources": sources, "pages": _pages()}), encoding="utf-8")
    print(place)
    return 0


if __name__ == "__main__":
    sys.exit(main())
