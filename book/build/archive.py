"""One file to keep: sources, data, the built book, and all that builds it again without a network.

``python -m book.build.archive`` writes ``dist/softgrip-VERSION-archive.tar.gz``; with ``--wheels``
it holds the packages of the lock for this platform too. The book in it is built from the archive's
own tree, and without the public data of others, which are not ours to pass on. Packed again, the
same tree gives the same bytes.
"""

import gzip
import hashlib
import json
import os
import platform
import shutil
import subprocess
import sys
import tarfile
from dataclasses import asdict
from pathlib import Path

import softgrip
from book.build.__main__ import ROOT, VARIABLES
from book.build.edition import Edition, edition
from softgrip.errors import SoftgripError

NAME = f"softgrip-{softgrip.__version__}"
SUMS, MANIFEST = "SHA256SUMS", "MANIFEST.json"
MADE_FOR = "made-for.txt"
"""Which Python the wheels are for, said by ``.ci/environment`` where they do not fit."""
NOT_KEPT = ("book/_build", "dist", "__pycache__", ".venv")
"""What a build leaves in the archive's tree and no archive holds."""


def lay_sources(root: Path, tree: Path) -> None:
    """Copy the tracked files of a checkout; what was tracked before and is no more goes."""
    tracked = subprocess.check_output(["git", "ls-files", "-z"], cwd=root, text=True).split("\0")
    names = [name for name in tracked if (root / name).is_file()]
    old = json.loads(_list(tree).read_text()) if _list(tree).is_file() else []
    for name in set(old) - set(names):
        (tree / name).unlink(missing_ok=True)
    for name in names:
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(root / name, tree / name)
    _list(tree).write_text(json.dumps(names))


def _list(tree: Path) -> Path:
    """Return where it is kept which files were laid in a tree."""
    tree.parent.mkdir(parents=True, exist_ok=True)
    return tree.parent / f".{tree.name}.json"


def alone(cache: Path) -> dict[str, str]:
    """Return an environment in which nothing is found but what the tree holds.

    Args:
        cache: A folder without the public data, in the place of the user's.
    """
    nowhere = dict.fromkeys(("http_proxy", "https_proxy", "HTTPS_PROXY"), "http://127.0.0.1:9")
    kept = {name: text for name, text in os.environ.items() if name not in VARIABLES}
    return kept | nowhere | {"XDG_CACHE_HOME": str(cache)}


def build(tree: Path) -> None:
    """Build the book of a tree, and lay it and the ledger where a reader finds them.

    Raises:
        SoftgripError: If a page was built with the measurements of others.
    """
    environment = alone(tree.parent / "cache") | {"PYTHONPATH": str(tree)}
    subprocess.run([sys.executable, "-m", "book.build"], cwd=tree, check=True, env=environment)
    made = tree / "book" / "_build"
    for context in (made / "traces").glob("*.context.json"):
        around = json.loads(context.read_text())
        if "True" in (around["tensile tests"], around["force readings"]):
            raise SoftgripError(f"{context.name}: a page was built with the measurements of others")
    shutil.rmtree(tree / "html", ignore_errors=True)
    shutil.copytree(made / "html", tree / "html")
    for name in ("ledger.json", "ledger.csv"):
        shutil.copy(made / name, tree / name)


def download(tree: Path) -> None:
    """Download what the lock names for this platform; pip checks each against its digest."""
    shutil.rmtree(tree / "wheels", ignore_errors=True)
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--require-hashes"]
    subprocess.run(
        [*command, "--requirement", tree / "environment.lock", "--dest", tree / "wheels"],
        check=True,
    )
    # The lock has other versions for other Pythons, also for 3.11.2 than for 3.11.7.
    made_for = f"Python {platform.python_version()}, {platform.system()} {platform.machine()}\n"
    (tree / "wheels" / MADE_FOR).write_text(made_for, encoding="utf-8")


def files(tree: Path) -> list[str]:
    """Return the names of the files that an archive holds, sorted."""
    names = (file.relative_to(tree).as_posix() for file in tree.rglob("*") if file.is_file())
    return sorted(
        name
        for name in names
        if not any(f"{left}/" in f"{name}/" for left in NOT_KEPT) or name.startswith("html/")
    )


def describe(tree: Path, told: Edition) -> None:
    """Write what the archive is, and the digests of all its files for ``sha256sum -c``."""
    wheels = (tree / "wheels").is_dir()
    made_with = {
        "python": platform.python_version(),
        "platform": f"{platform.system()} {platform.machine()}",
        "lock": hashlib.sha256((tree / "environment.lock").read_bytes()).hexdigest(),
        "wheels": f"{platform.system()} {platform.machine()}" if wheels else "none",
    }
    holds = {
        "html/index.html": "the book, built without the public measurements of others",
        "ledger.json, ledger.csv": "all verdicts",
        "data/": "numbers and simulated logs, described by data/datapackage.json",
        "book/_vendor/": "scripts of the pages, from npm",
        "make book": "builds book/_build/html from this tree; with wheels, without a network",
    }
    manifest = {"name": "softgrip", **asdict(told), "made_with": made_with, "holds": holds}
    text = json.dumps(manifest, indent=1) + "\n"
    (tree / MANIFEST).write_text(text, encoding="utf-8")
    sums = [
        f"{hashlib.sha256((tree / name).read_bytes()).hexdigest()}  {name}\n"
        for name in files(tree)
        if name != SUMS
    ]
    (tree / SUMS).write_text("".join(sums), encoding="utf-8")


def pack(tree: Path, archive: Path) -> None:
    """Pack a tree: sorted, with one owner and one time; the same files give the same bytes."""

    def plain(entry: tarfile.TarInfo) -> tarfile.TarInfo:
        entry.uid = entry.gid = entry.mtime = 0
        entry.uname = entry.gname = ""
        entry.mode = 0o755 if entry.mode & 0o100 else 0o644
        return entry

    with (
        archive.open("wb") as file,
        # Without the name and time that gzip would keep of what it packs.
        gzip.GzipFile("", "wb", compresslevel=9, fileobj=file, mtime=0) as packed,
        tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as tar,
    ):
        for name in files(tree):
            tar.add(tree / name, f"{tree.name}/{name}", filter=plain)


def main(*, wheels: bool) -> Path:
    """Make the archive, and return its path."""
    from book.build import vendor

    tree = ROOT / "dist" / NAME
    told = edition(ROOT)
    lay_sources(ROOT, tree)
    scripts = ROOT / "book" / "_vendor"
    if not vendor.ensure(scripts):
        raise SoftgripError(
            "the npm registry cannot be reached, which has the scripts of the pages"
        )
    shutil.copytree(scripts, tree / "book" / "_vendor", dirs_exist_ok=True)
    build(tree)
    if wheels:
        download(tree)
    else:
        shutil.rmtree(tree / "wheels", ignore_errors=True)
    describe(tree, told)
    archive = ROOT / "dist" / f"{NAME}-archive.tar.gz"
    pack(tree, archive)
    for name in told.changed:
        print(f"NOTE: {name} differs from the commit, or is not in it.")
    return archive


if __name__ == "__main__":
    try:
        made = main(wheels="--wheels" in sys.argv[1:])
    except (SoftgripError, subprocess.CalledProcessError) as error:
        sys.exit(f"No archive was made: {error}")
    print(f"{made} ({made.stat().st_size / 1e6:.0f} MB)")
