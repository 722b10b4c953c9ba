"""Long sweeps that lose nothing: what is worked out is written down at once, and not done again."""

import json
from collections.abc import Callable, Mapping, Sequence
from os import fsync
from pathlib import Path
from typing import Any, TypeVar

from joblib import Parallel, delayed

from softgrip.errors import DataFileError

Question = TypeVar("Question")
Answer = Mapping[str, Any]


def continued(
    work: Callable[[Question], Answer],
    questions: Sequence[Question],
    file: Path,
    *,
    jobs: int | None = None,
) -> list[Answer]:
    """Return the answer to each question, in order; those that the journal has are not asked again.

    The questions go through `joblib.Parallel`: ``joblib.parallel_config`` says where they run, such
    as ``backend="dask"`` for a cluster. An answer is written down as soon as it is there, by the
    process that asks, so that workers need no common disk. If a worker or the whole sweep is
    killed, the same call goes on where it stopped; a line that was torn is left out.

    Args:
        work: From a question to its answer, of what JSON holds.
        questions: They are known by their `repr`.
        file: The journal, a line an answer; it belongs to one state of the work.
        jobs: As joblib's `n_jobs`; None leaves it to its configuration.

    Raises:
        DataFileError: If a line of the journal, other than the last, is torn.
    """
    known = _written(file)
    left = [one for one in dict.fromkeys(questions) if repr(one) not in known]
    file.parent.mkdir(parents=True, exist_ok=True)
    asked = Parallel(n_jobs=jobs, return_as="generator_unordered")
    whole = "".join(_line(name, answer) for name, answer in known.items())
    beside = file.with_suffix(file.suffix + ".new")
    beside.write_text(whole, "utf-8")  # without a torn line
    beside.replace(file)
    with file.open("a", encoding="utf-8") as journal:
        for name, answer in asked(delayed(_answered)(work, one) for one in left):
            known[name] = answer
            journal.write(_line(name, answer))
            journal.flush()
            fsync(journal.fileno())
    return [known[repr(one)] for one in questions]


def _answered(work: Callable[[Question], Answer], question: Question) -> tuple[str, Answer]:
    return repr(question), work(question)


def _line(name: str, answer: Answer) -> str:
    return json.dumps([name, dict(answer)]) + "\n"


def _written(file: Path) -> dict[str, Answer]:
    """Return what a journal holds, by question."""
    if not file.exists():
        return {}
    found: dict[str, Answer] = {}
    lines = file.read_text("utf-8").splitlines(keepends=True)
    for number, line in enumerate(lines, 1):
        try:
            if not line.endswith("\n"):
                raise ValueError
            name, answer = json.loads(line)
        except ValueError:
            if number == len(lines):
                break
            raise DataFileError(
                file, expected="a question and its answer", got=line[:40], line=number
            ) from None
        found[name] = answer
    return found
