"""Damage valid files and read them: what is neither a result nor an error of ours is printed.

Each file is that of its seed and number, whenever and wherever it is made. What was done is kept
beside (``--state``), and a further run goes on from there. Exit code 1 if anything was found.

Example:
  python -m tests.fuzz --files 100000 --seed 1 --processes 2
  python -m tests.fuzz --seed 1 --only 4711
"""

import json
import signal
import sys
import tempfile
import time
import traceback
import warnings
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from itertools import islice
from pathlib import Path

import numpy as np

from softgrip.errors import DependentRowsWarning, FitWarning, LeftOutWarning, SoftgripError
from tests.fuzz.damage import damaged
from tests.fuzz.readers import RARE, READERS, SELDOM
from tests.fuzz.seeds import SEEDS

BLOCK = 100
"""Files that a process is given at a time."""
ALL = 20
"""Of so many files one is read by all that read its kind; the others by the first, and, if that
does not refuse them, by another one in turn: so that a million takes an hour or two."""
LONGEST = 20
"""s of computing that a reader may take: a busy machine makes it no slower."""
SHOWN = 5.0
"""s from one line of progress to the next."""

Finding = tuple[str, str]
"""What tells findings apart, and all that is known of one."""


class SlowError(Exception):
    """A reader that takes too long."""


def _slow(*_: object) -> None:
    raise SlowError(f"more than {LONGEST} s")


@cache
def whole(kind: str) -> bytes:
    return SEEDS[kind]()


def made(seed: int, number: int) -> tuple[str, bytes]:
    """Return kind and content of a file."""
    random = np.random.default_rng([seed, number])
    kind = [*SEEDS][random.integers(len(SEEDS))]
    return kind, damaged(whole(kind), random)


def write(kind: str, content: bytes, folder: Path) -> Path:
    """Write a file under the name that its readers expect, and what lies beside it."""
    path = folder / "run.csv"
    mapping = folder / "run.toml"
    mapping.unlink(missing_ok=True)
    if kind == "mapping":
        mapping.write_bytes(content)
        content = whole("other log")
    path.write_bytes(content)
    return path


def read(seed: int, number: int, folder: Path) -> list[Finding]:
    """Read a file by all that read its kind."""
    kind, content = made(seed, number)
    path = write(kind, content, folder)
    found = []
    first, *others = READERS[kind]
    rare = RARE.get(kind, ()) if number % SELDOM == 0 else ()
    if number % ALL and others:
        others = [others[number // len(SEEDS) % len(others)]]
    refused = False
    for reader in (first, *others, *rare):
        if refused and number % ALL:
            break
        signal.setitimer(signal.ITIMER_PROF, LONGEST)
        try:
            reader(path)
        except (SoftgripError, OSError):
            refused |= reader is first
        except (Exception, SystemExit) as error:
            name = getattr(reader, "__name__", str(reader))
            frames = traceback.extract_tb(error.__traceback__)
            ours = [one for one in frames if "/softgrip/" in one.filename] or frames
            where = f"{type(error).__name__} at {ours[-1].filename}:{ours[-1].lineno}"
            told = "".join(traceback.format_exception(error)[-6:])
            found.append((where, f"--seed {seed} --only {number}: {kind}, {name}\n{told}"))
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
    return found


def read_block(seed: int, first: int, files: int) -> tuple[int, list[Finding]]:
    """Read files from a number on, and return how many, with what was found."""
    signal.signal(signal.SIGPROF, _slow)
    with warnings.catch_warnings(), tempfile.TemporaryDirectory() as folder:
        # Of NumPy and SciPy: what warns of an invalid number shows it to a user.
        warnings.simplefilter("error", RuntimeWarning)
        for ours in (FitWarning, DependentRowsWarning, LeftOutWarning):
            warnings.simplefilter("ignore", ours)
        numbers = range(first, first + files)
        return files, [one for number in numbers for one in read(seed, number, Path(folder))]


def blocks(asked: Namespace, first: int) -> Iterator[tuple[int, list[Finding]]]:
    """Yield what comes of each block, in order, until the files or the time are over."""
    end, last = time.monotonic() + asked.seconds, first + asked.files
    starts = range(first, last, BLOCK)
    tasks = ((asked.seed, start, min(BLOCK, last - start)) for start in starts)
    if asked.processes == 1:
        for task in tasks:
            if time.monotonic() > end:
                return
            yield read_block(*task)
        return
    with ProcessPoolExecutor(asked.processes) as pool:
        running = [pool.submit(read_block, *task) for task in islice(tasks, asked.processes)]
        while running:
            yield running.pop(0).result()
            if time.monotonic() <= end and (task := next(tasks, None)):
                running.append(pool.submit(read_block, *task))


def main() -> int:
    """Run, and return the exit code."""
    parser = ArgumentParser(
        prog="python -m tests.fuzz",
        description=__doc__,
        formatter_class=RawDescriptionHelpFormatter,
    )
    parser.add_argument("--files", type=int, default=1_000_000, help="how many, at most")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="how long, at most")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", type=int, metavar="NUMBER", help="one file, again")
    parser.add_argument("--keep", type=Path, help="with --only: where the file is written")
    parser.add_argument("--processes", type=int, default=1, choices=(1, 2))
    parser.add_argument("--state", type=Path, default=Path(".fuzz.json"), help="what was done")
    asked = parser.parse_args()
    if asked.only is not None:
        if asked.keep:
            asked.keep.write_bytes(made(asked.seed, asked.only)[1])
        _, found = read_block(asked.seed, asked.only, 1)
        print("\n".join(told for _, told in found) or "nothing was found")
        return int(bool(found))
    state = json.loads(asked.state.read_text()) if asked.state.is_file() else {}
    first = state.get(str(asked.seed), 0)
    seen: Counter[str] = Counter()
    done, begun, shown = 0, time.monotonic(), 0.0
    for files, found in blocks(asked, first):
        done += files
        for where, told in found:
            seen[where] += 1
            if seen[where] == 1:
                print(told, flush=True)
        # What was found is to be mended and tried again: only what comes before it is done.
        if not seen:
            state[str(asked.seed)] = first + done
            aside = asked.state.with_suffix(".part")  # at once or not at all
            aside.write_text(json.dumps(state) + "\n")
            aside.replace(asked.state)
        if time.monotonic() - shown > SHOWN:
            shown = time.monotonic()
            rate = done / (shown - begun)
            print(
                f"\rseed {asked.seed}: {first + done} files, {rate:.0f} a second, "
                f"{len(seen)} found", end="", file=sys.stderr, flush=True,
            )  # fmt: skip
    print(file=sys.stderr)
    for where, count in seen.most_common():
        print(f"{count} times {where}")
    print(f"{done} files of seed {asked.seed}, from {first} on: {len(seen)} kinds of error")
    return int(bool(seen))


if __name__ == "__main__":
    sys.exit(main())
