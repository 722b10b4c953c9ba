"""Which edition of the sources this is, by version and commit."""

import subprocess
from dataclasses import dataclass
from datetime import date
from pathlib import Path

import softgrip


@dataclass(frozen=True)
class Edition:
    """An edition.

    Attributes:
        version: Of the package.
        commit, day: Of the last commit, the day as ``2026-11-29``; empty without a history.
        changed: Files that differ from the commit, or are not in it.
    """

    version: str
    commit: str
    day: str
    changed: tuple[str, ...]

    def __str__(self) -> str:
        """Return it in words."""
        if not self.commit:
            return f"Version {self.version}"
        spelled = date.fromisoformat(self.day).strftime("%d %B %Y").lstrip("0")
        changes = " with changes" if self.changed else ""
        return f"Version {self.version}, {spelled}, commit {self.commit[:8]}{changes}"


def edition(root: Path) -> Edition:
    """Return the edition of a checkout, or of sources without their history.

    >>> str(Edition("0.1.0", "1b37c0aa9e", "2026-02-01", ("a.py",)))
    'Version 0.1.0, 1 February 2026, commit 1b37c0aa with changes'
    """

    def git(*command: str) -> str:
        return subprocess.run(
            ["git", *command], cwd=root, check=True, capture_output=True, text=True
        ).stdout

    try:
        commit, day = git("log", "-1", "--format=%H %cs").split()
        changed = tuple(line[3:] for line in git("status", "--porcelain").splitlines())
    except (OSError, subprocess.CalledProcessError):
        commit, day, changed = "", "", ()
    return Edition(softgrip.__version__, commit, day, changed)
