"""Measure all subjects, write them to ``book/_build/bench.json`` and print them."""

import os
from importlib import import_module
from pathlib import Path
from time import perf_counter

from tests.bench.entry import table, write

PATH = Path(__file__).parents[2] / "book" / "_build" / "bench.json"
SUBJECTS = (
    *("step_responses", "rig", "growth", "controller", "design", "elastica", "grippers"),
    *("kernel_regression", "pad_reading", "drift", "board", "twin", "delay", "front"),
)


def main() -> None:
    """Run the bench."""
    start = perf_counter()
    found = [one for name in SUBJECTS for one in import_module(f"tests.bench.{name}").entries()]
    write(found, PATH)
    print(table(found))
    # What else the machine had to do is the first thing to look at when a time is off.
    load = f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}"
    print(f"\nTook {perf_counter() - start:.0f} s ({load}); written to {PATH}.")


if __name__ == "__main__":
    main()
