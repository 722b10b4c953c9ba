"""Break formulas by chance, and see which ones the ledger does not notice.

``python -m tests.book.mutants --count 200 --seed 1`` draws that many changes among all functions of
``book.chapter_N.numbers``, ``book.companion.relations`` and the laws of ``softgrip`` that a claim
reaches. Each is put in the place of the sound one in a process of its own, and the claims that
reach it are judged, the quickest first, until one of them notices. What changes neither an outcome
nor a value has survived: a claim may be missing, the change may make no difference, or it is for
the function's own tests to notice. ``--tests`` asks these too, of laws of ``softgrip``.
"""

import __future__

import argparse
import ast
import importlib
import inspect
import multiprocessing
import random
import sys
import textwrap
import time
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from types import CodeType, FunctionType

import pytest

from book.companion.claims import Claim, read_claims
from book.companion.ledger import changes, expected
from book.companion.verdict import judge

SWAPS = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Pow: ast.Mult,
}
ROOT = Path(__file__).parents[2]
WITHIN = 60.0
"""s for one mutant, ten times as long for its tests."""
READ_ONLY = ("softgrip.reads", "book.companion.claims")
"""Modules whose caches hold no result of a law."""


@dataclass(frozen=True)
class Mutant:
    """One change of one function."""

    module: str
    name: str
    place: int
    """Which of the nodes that can be changed."""
    was: str
    now: str

    def __str__(self) -> str:
        return f"{self.module}.{self.name}: {self.was} -> {self.now}"

    @property
    def function(self) -> FunctionType:
        """The sound function, without what decorates it."""
        return inspect.unwrap(getattr(importlib.import_module(self.module), self.name))

    def code(self) -> CodeType:
        """Return the code of the changed function."""
        tree = _parsed(self.function)
        _change(_nodes(tree)[self.place])
        namespace = dict(self.function.__globals__)
        flags = (
            __future__.annotations.compiler_flag
        )  # what is imported for types alone is not evaluated
        exec(compile(ast.fix_missing_locations(tree), "<mutant>", "exec", flags), namespace)
        return namespace[self.name].__code__


def _parsed(function: Callable) -> ast.Module:
    tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    tree.body[0].decorator_list = []
    return tree


def _nodes(tree: ast.Module) -> list[ast.AST]:
    """Return the nodes that can be changed: operators, numbers but in a signature."""
    body = [inner for statement in tree.body[0].body for inner in ast.walk(statement)]
    return [
        node
        for node in body
        if (isinstance(node, ast.BinOp) and type(node.op) in SWAPS)
        or (isinstance(node, ast.Constant) and type(node.value) in (int, float))
    ]


def _change(node: ast.AST) -> None:
    if isinstance(node, ast.BinOp):
        node.op = SWAPS[type(node.op)]()
    else:
        node.value = node.value * 2 or 1


def mutants(module: str, name: str) -> Iterator[Mutant]:
    """Return all changes of one function."""
    function = getattr(importlib.import_module(module), name)
    for place in range(len(_nodes(_parsed(function)))):
        tree = _parsed(function)
        node = _nodes(tree)[place]
        was = ast.unparse(node)
        _change(node)
        yield Mutant(module, name, place, was, ast.unparse(node))


def mutant(text: str) -> Mutant:
    """Return a mutant by how it is listed.

    Raises:
        LookupError: If its function has no such change, or has it at several places.
    """
    place, _, change = text.partition(": ")
    every = [*mutants(*place.rsplit(".", 1))]
    found = [one for one in every if str(one) == text]
    if len(found) != 1:
        valid = sorted(str(one).partition(": ")[2] for one in every)
        raise LookupError(f"expected one {change!r} in {place}, got {len(found)}; valid: {valid}")
    return found[0]


def forget() -> None:
    """Empty our caches, that what is broken, or sound again, is computed anew."""
    for name, module in [*sys.modules.items()]:
        if name.startswith(("softgrip.", "book.")) and name not in READ_ONLY:
            for value in [*vars(module).values()]:
                getattr(value, "cache_clear", lambda: None)()


def reached(claim: Claim) -> set[tuple[str, str]]:
    """Judge a claim; return the functions of ours, by module and name, that it calls."""
    found = set()

    def note(frame, event, _):
        module = frame.f_globals.get("__name__", "")
        if event == "call" and module.startswith(("softgrip.", "book.")):
            found.add((module, frame.f_code.co_name))

    sys.setprofile(note)
    try:
        judge(claim)
    finally:
        sys.setprofile(None)
    return found


def judged_by(claims: list[Claim]) -> dict[tuple[str, str], list[Claim]]:
    """Return the claims that reach each function of the laws and recomputations, quickest first."""
    timed: dict[tuple[str, str], list[tuple[float, int]]] = {}
    for k, claim in enumerate(claims):
        importlib.import_module(f"book.chapter_{claim.chapter}.numbers")
        start = time.perf_counter()
        names = in_process(reached, claim, wait=10 * WITHIN) or set()
        took = time.perf_counter() - start
        for name in names:
            timed.setdefault(name, []).append((took, k))
    ours = {name: [claims[k] for _, k in sorted(found)] for name, found in timed.items()}
    return {key: found for key, found in ours.items() if _is_law(*key)}


def _is_law(module: str, name: str) -> bool:
    if module.startswith("book.") and not module.endswith((".numbers", ".relations")):
        return False
    if module in ("softgrip.reads", "softgrip.provenance", "softgrip.errors", "softgrip.kept"):
        return False
    found = getattr(sys.modules.get(module) or importlib.import_module(module), name, None)
    return isinstance(found, FunctionType) and found.__module__ == module


def in_process(function: Callable, *arguments: object, wait: float) -> object:
    """Call in a process of its own, that nothing is remembered; None if it takes too long."""
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    worker = context.Process(target=lambda: there.send(function(*arguments)), daemon=True)
    worker.start()
    there.close()  # or the end of one that fails would not be seen
    answer = here.recv() if here.poll(wait) else None
    worker.kill()
    worker.join()
    return answer


def noticed_by(broken: Mutant, claims: list[Claim]) -> str:
    """Return the first claim in whose accepted words and values a change shows, or nothing."""
    broken.function.__code__ = broken.code()
    accepted = expected()
    for claim in claims:
        try:
            if changes(judge(claim), accepted[claim.id]):
                return claim.id
        except Exception as error:  # whatever a broken formula leads to, it is noticed
            return f"{claim.id} ({type(error).__name__})"
    return ""


def tests_of(module: str) -> list[Path]:
    """Return a module's test files: its own, its examples, those of its package that name it."""
    parent, _, name = module.removeprefix("softgrip.").rpartition(".")
    folder = ROOT / "tests" / parent.replace(".", "/")
    own = [folder / f"test_{name}.py", ROOT / f"{module.replace('.', '/')}.py"]
    naming = [one for one in sorted(folder.glob("test_*.py")) if name in one.read_text("utf-8")]
    return [*dict.fromkeys(one for one in own + naming if one.exists())]


class Failures(list[str]):
    """A plug-in of pytest: the tests that failed."""

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note a test that failed."""
        if report.failed:
            self.append(report.nodeid)


def failing(broken: Mutant, files: list[Path]) -> str:
    """Return the first test that fails on a mutant, or nothing."""
    broken.function.__code__ = broken.code()
    forget()
    failures = Failures()
    for file in files:
        with redirect_stdout(StringIO()):
            pytest.main(["-x", "-p", "no:cacheprovider", str(file)], plugins=[failures])
        if failures:
            return failures[0]
    return ""


def main() -> None:
    """Draw, break, judge, list."""
    parser = argparse.ArgumentParser(prog="python -m tests.book.mutants", description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--chapter", type=int)
    parser.add_argument("--tests", action="store_true")
    asked = parser.parse_args()
    by = judged_by(read_claims(asked.chapter))
    every = [(broken, by[key]) for key in sorted(by) for broken in mutants(*key)]
    drawn = random.Random(asked.seed).sample(every, min(asked.count, len(every)))
    print(f"{len(every)} mutants of {len(by)} functions, {len(drawn)} drawn", flush=True)
    survivors = 0
    for broken, claims in drawn:
        by_what = in_process(noticed_by, broken, claims, wait=WITHIN)
        if by_what == "" and asked.tests and broken.module.startswith("softgrip."):
            by_what = in_process(failing, broken, tests_of(broken.module), wait=10 * WITHIN)
        fate = {None: "TOO LONG", "": "SURVIVED"}.get(by_what, "noticed ")
        survivors += fate == "SURVIVED"
        print(fate, broken, by_what or f"{len(claims)} claims", sep="  ", flush=True)
    print(f"{survivors} of {len(drawn)} survived")


if __name__ == "__main__":
    main()
