"""Which files a page depends on: recorded while its kernel runs, compared before the next build.

jupyter-cache keys a page's outputs on the page's text alone. A page is also stale when a module
that it imported, or a data file that it opened, has changed. The kernel of each page writes both,
with their digests, into a trace (`record`, called by an IPython startup file that `install_hook`
lays); the build re-executes the pages whose trace no longer holds (`is_current`).
"""

import atexit
import hashlib
import json
import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path

from IPython import get_ipython

import softgrip
from softgrip import reads

TRACE_VARIABLE = "SOFTGRIP_PAGE_TRACE"
ROOT = Path(softgrip.__file__).resolve().parent.parent
WATCHED = (
    *(ROOT / "softgrip", ROOT / "data"),
    *sorted(
        file.parent
        for file in (ROOT / "book").glob("*/__init__.py")
        if file.parent != Path(__file__).resolve().parent
    ),
)

STARTUP = f"""\
import os
if os.environ.get({TRACE_VARIABLE!r}):
    from book.build import tracing
    tracing.record(os.environ[{TRACE_VARIABLE!r}])
"""


def install_hook(ipython_folder: Path) -> None:
    """Make kernels started with IPYTHONDIR at this folder record what they read."""
    profile = ipython_folder / "profile_default"
    (profile / "startup").mkdir(parents=True, exist_ok=True)
    (profile / "startup" / "00-trace.py").write_text(STARTUP)
    # Each kernel would warn that it talks to its own machine over TCP.
    (profile / "ipython_kernel_config.py").write_text("get_config().IPKernelApp.log_level = 40\n")


def surroundings() -> dict[str, str]:
    """Return what every page depends on beside its files: Python, libraries, the public data."""
    from softgrip.materials import tensile
    from softgrip.tactile import published_readings

    public = {"tensile tests": tensile, "force readings": published_readings}
    return {
        "python": sys.version,
        "environment.lock": digest(ROOT / "environment.lock"),
        **{name: str(files.available()) for name, files in public.items()},
    }


def digest(path: Path) -> str:
    """Return the SHA-256 of a file, or of the names in a folder, or ``missing``."""
    if path.is_dir():
        names = sorted(entry.name for entry in path.iterdir() if entry.name != "__pycache__")
        return hashlib.sha256("\n".join(names).encode()).hexdigest()
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "missing"


def _watched(files: Iterable[Path]) -> set[Path]:
    return {
        file
        for file in files
        if any(file.is_relative_to(top) for top in WATCHED)
        and "__pycache__" not in file.parts
        and not (file / "__init__.py").is_file()  # listed by an import, not by the page
    }


def context_of(trace: Path) -> Path:
    """Return the file that tells what was around when a trace was taken."""
    return trace.with_suffix(".context.json")


def record(trace: str) -> Callable[[], None]:
    """Watch this process; write the watched files that it used into ``trace``.

    That happens when what is returned is called, when the process ends and, in IPython, after each
    cell: who asked for the cells may not wait for the end, on a busy machine, and kill the process.

    Modules are taken from `sys.modules` (an import opens the compiled file, not the source), data
    files and listed folders from the interpreter's own audit. A file that was changed while the
    process ran may have been read before: it is recorded as such, and matches nothing.
    """
    opened: set[Path] = set()
    started = time.time()

    def write(*_: object) -> None:
        modules = (
            Path(file).resolve()
            for name, module in list(sys.modules.items())
            if name.partition(".")[0] in ("softgrip", "book")
            and (file := getattr(module, "__file__", None)) is not None
        )
        # Another thread of a page may open files meanwhile.
        files = sorted(_watched(opened.copy() | reads.elsewhere) | _watched(modules))
        content = {
            str(file.relative_to(ROOT)): digest(file)
            if file.is_dir() or file.stat().st_mtime < started
            else "changed meanwhile"
            for file in files
            if file.exists()
        }
        Path(trace).parent.mkdir(parents=True, exist_ok=True)
        Path(trace).write_text(json.dumps(content, indent=1))

    Path(trace).unlink(missing_ok=True)  # what an earlier process read is not what this one does
    reads.listen(opened.add, "open", "os.listdir", "os.scandir")
    atexit.register(write)
    if shell := get_ipython():
        shell.events.register("post_run_cell", write)
    return write


def is_current(trace: Path, around: dict[str, str]) -> bool:
    """Tell whether every file of a trace is still as the page read it, and so its surroundings."""
    if not trace.is_file():
        return False
    seen = json.loads(trace.read_text())
    context = context_of(trace)
    return (
        all(digest(ROOT / name) == value for name, value in seen.items())
        and context.is_file()
        and json.loads(context.read_text()) == around
    )
