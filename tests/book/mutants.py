"""Break formulas by chance, and see which ones the ledger does not notice.

``python -m tests.book.mutants --count 200 --seed 1`` draws that many changes among all functions of
``book.chapter_N.numbers``, ``book.companion.relations`` and the laws of ``softgrip`` that a claim
reaches. Each is put in the place of the sound one in a process of its own, and the quickest claims
that reach it are judged. What changes neither an outcome nor a value has survived: a claim may be
missing, the change may make no difference, or it is for the function's own tests to notice.
"""

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
from dataclasses import dataclass
from types import FunctionType

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
TRIED = 3
"""Claims, the quickest, by which a mutant is judged."""
WITHIN = 60.0
"""s for one mutant: what takes longer has been changed enough to be noticed."""


@dataclass(frozen=True)
class Mutant:
    """One change of one function."""

    module: str
    name: str
    place: int
    """Which of the nodes that can be changed."""
    was: str
    now: str

    def code(self) -> FunctionType:
        """Return the changed function."""
        function = getattr(importlib.import_module(self.module), self.name)
        tree = _parsed(function)
        node = _nodes(tree)[self.place]
        _change(node)
        namespace = dict(function.__globals__)
        exec(compile(ast.fix_missing_locations(tree), "<mutant>", "exec"), namespace)
        return namespace[self.name]


def _parsed(function: Callable) -> ast.Module:
    tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    tree.body[0].decorator_list = []
    return tree


def _nodes(tree: ast.Module) -> list[ast.AST]:
    """Return the nodes that can be changed: operators, numbers but in a signature, comparisons."""
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
    answer = here.recv() if here.poll(wait) else None
    worker.kill()
    worker.join()
    return answer


def killed(mutant: Mutant, claims: list[Claim]) -> bool:
    """Tell whether a change shows in what the ledger has accepted of some claims."""
    function = getattr(importlib.import_module(mutant.module), mutant.name)
    inner = inspect.unwrap(function)
    inner.__code__ = mutant.code().__code__
    accepted = expected()
    for claim in claims:
        try:
            if changes(judge(claim), accepted[claim.id]):
                return True
        except Exception:  # whatever a broken formula leads to, it is noticed
            return True
    return False


def main() -> None:
    """Draw, break, judge, list."""
    parser = argparse.ArgumentParser(prog="python -m tests.book.mutants", description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--chapter", type=int)
    asked = parser.parse_args()
    by = judged_by(read_claims(asked.chapter))
    every = [(mutant, by[key]) for key in sorted(by) for mutant in mutants(*key)]
    drawn = random.Random(asked.seed).sample(every, min(asked.count, len(every)))
    print(f"{len(every)} mutants of {len(by)} functions, {len(drawn)} drawn", flush=True)
    survivors = 0
    for mutant, claims in drawn:
        survived = in_process(killed, mutant, claims[:TRIED], wait=WITHIN) is False
        survivors += survived
        place = f"{mutant.module}.{mutant.name}: {mutant.was} -> {mutant.now}"
        fate = "SURVIVED" if survived else "noticed "
        print(fate, place, *(claim.id for claim in claims[:TRIED]), sep="  ", flush=True)
    print(f"{survivors} of {len(drawn)} survived")


if __name__ == "__main__":
    main()
