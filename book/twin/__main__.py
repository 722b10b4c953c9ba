"""The twin's commands.

``python -m book.twin targets`` shows the targets beside what the calibrated rig gives, ``fit`` fits
the rig to them, ``outcomes`` runs the kept rigs anew, ``walk`` some of the ensemble; ``recovery``,
``held``, ``predictions``, ``tension`` and ``bounds`` ask how far that can be trusted, and what it
says.
"""

import argparse
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from joblib import parallel_config

from book.twin import bands, kept_rigs, outcomes, study
from book.twin.fit import fit
from book.twin.laboratory import Laboratory
from book.twin.recipes import FAST, SLOW, measured
from book.twin.space import values
from book.twin.targets import Target, targets
from softgrip.kept import Kept

COMMANDS: dict[str, Kept[Any]] = {"outcomes": outcomes.KEPT, "bands": bands.KEPT, **study.TABLES}
NEAR = 10.0
"""Largest deviation, %, of a target that is counted as met."""


@dataclass(frozen=True)
class Met:
    """A target beside what a rig gives.

    Attributes:
        target: Which.
        simulated: In its unit.
    """

    target: Target
    simulated: float

    @property
    def off(self) -> float:
        """By how much it misses, in its unit."""
        return float(self.target.off(np.array(self.simulated)))

    @property
    def percent(self) -> float:
        """Size of that, in percent of the print; NaN where zero is printed."""
        return 100 * abs(self.off / self.target.value) if self.target.value else float("nan")

    @property
    def tolerances(self) -> float:
        """Size of that, in tolerances."""
        return abs(self.off) / self.target.tolerance


def met(lab: Laboratory, experiments: Collection[str]) -> list[Met]:
    """Hold the first rig of a laboratory against the targets of some experiments."""
    found = measured(lab, experiments)
    return [
        Met(one, float(found[one.experiment, one.quantity][0]))
        for one in targets()
        if one.experiment in experiments
    ]


def table(found: Sequence[Met]) -> str:
    """Return the targets, a line each, and what they come to."""
    lines = [
        f"{m.target.id:44} {m.target.relation}{m.target.value:9.4g} +- {m.target.tolerance:7.3g}"
        f" {m.simulated:10.4g} {m.target.unit:8} {m.percent:8.1f} % {m.tolerances:8.1f}"
        for m in found
    ]
    percents = np.array([m.percent for m in found])
    percents = percents[~np.isnan(percents)]
    inside = sum(m.tolerances <= 1 for m in found)
    return "\n".join(
        [
            f"{'target':44} {'printed':>10}    tolerance  simulated unit      deviation tolerances",
            *lines,
            f"median deviation {np.median(percents):.1f} %; {np.sum(percents <= NEAR)} of "
            f"{percents.size} within {NEAR:g} %; {inside} of {len(found)} within their tolerance",
        ]
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Show, fit or judge."""
    parser = argparse.ArgumentParser(prog="python -m book.twin", description=__doc__)
    parser.add_argument("command", choices=["targets", "fit", "rigs", *COMMANDS])
    parser.add_argument("--fast", action="store_true", help="targets: without slow experiments")
    parser.add_argument("--jobs", type=int, help="processes; all that joblib's configuration says")
    parser.add_argument("--stages", type=Path, default=study.STAGES, help="folder of what is done")
    chosen = parser.parse_args(arguments)
    if chosen.command == "fit":
        fit(chosen.stages, jobs=chosen.jobs)
    elif chosen.command == "rigs":
        print(*kept_rigs.write(), sep="\n")
    elif chosen.command in COMMANDS:
        with parallel_config(n_jobs=chosen.jobs):
            COMMANDS[chosen.command].main()
    else:
        experiments = [*FAST] if chosen.fast else [*FAST, *SLOW]
        print(table(met(Laboratory(values()), experiments)))


if __name__ == "__main__":
    main()
