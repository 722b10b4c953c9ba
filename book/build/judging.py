"""Verdicts of chapters, judged before the pages run, each in a process of its own.

That process is watched as the kernels of pages are: a chapter is judged again when something that
its verdicts hang on has changed, and a page that tells them hangs on the same.
"""

import json
import os
import re
from collections.abc import Iterable
from pathlib import Path

from book.build import forked, tracing

TELLS = re.compile(r"show_(?:verdicts|counts|bases|assumptions|errata)\((\d?)")
"""What a page calls that tells verdicts: of a chapter, or of all."""


def trace_of(file: Path) -> Path:
    """Return where the trace of a file of verdicts is."""
    return file.with_suffix(".json")


def forget_stale(folder: Path) -> None:
    """Remove verdicts that no longer hold."""
    around = tracing.surroundings()
    for file in folder.glob("*.pickle"):
        if not tracing.is_current(trace_of(file), around):
            file.unlink()


def missing(pages: Iterable[str], folder: Path) -> list[int]:
    """Return the chapters, the longest to judge first, that pages tell and nobody has judged."""
    from book.companion.judged import file_of

    told = {chapter for page in pages for chapter in TELLS.findall(page)}
    wanted = [n for n in (6, 3, 2, 5, 4) if "" in told or str(n) in told]
    return [n for n in wanted if not file_of(folder, n).is_file()]


def ensure(chapters: Iterable[int]) -> None:
    """Judge those chapters, of which pages set numbers, that no page tells."""
    from book.companion.judged import VARIABLE, file_of

    folder = Path(os.environ[VARIABLE])
    for chapter in sorted(chapters):
        if not file_of(folder, chapter).is_file():
            judge_apart(folder, chapter)


def judge_apart(folder: Path, chapter: int) -> None:
    """Judge a chapter in another process. If that fails, the pages judge, and tell the error."""
    process = forked.process(_judge, folder, chapter)
    process.start()
    process.join()


def _judge(folder: Path, chapter: int) -> None:
    """Judge a chapter, and write what came of it, the trace first."""
    trace = trace_of(folder / f"chapter-{chapter}")
    write_trace = tracing.record(str(trace))
    # Not before: what these read is recorded.
    from book.companion import judged
    from book.companion.claims import read_claims
    from book.companion.verdict import judge
    from softgrip.reads import recorded

    found = {}
    for claim in read_claims(chapter):
        with recorded() as files:
            entry = judge(claim)
        found[claim.id] = (entry, frozenset(files))
    write_trace()
    tracing.context_of(trace).write_text(json.dumps(tracing.surroundings()))
    used = frozenset(tracing.ROOT / name for name in json.loads(trace.read_text()))
    judged.write(judged.file_of(folder, chapter), found, used)
