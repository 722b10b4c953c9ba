"""What reads files: every public reader, and the commands, called in process."""

import io
import json
from collections.abc import Callable, Sequence
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

from softgrip.board import calibration
from softgrip.commands.__main__ import main
from softgrip.logs.check import contents
from softgrip.logs.contacts import read_contacts, read_weights
from softgrip.logs.fingers import identified_gripper, read_runs
from softgrip.logs.pushes import compare
from softgrip.logs.reader import read_log
from softgrip.logs.repeated_steps import read_step_test
from softgrip.logs.staircase import judge_staircase
from softgrip.logs.steps import judge_step_log
from softgrip.materials import tensile
from softgrip.materials.elasticity import elasticity
from softgrip.materials.fitting import Fitting, fit
from softgrip.materials.tester import read_export
from softgrip.rig.acceptance import judge
from softgrip.rig.connect import connect
from softgrip.rig.replay import Replay
from softgrip.simulator.rig_file import read_rig
from softgrip.tactile import pad_model
from softgrip.tactile.own_pad import read_readings
from softgrip.text_table import read_table

Reader = Callable[[Path], object]


class WrongAnswerError(Exception):
    """A command that says what it must not."""


def command(*arguments: str) -> Reader:
    """Return what runs a command on a file; its JSON must be JSON, its code one that is known."""

    def run(path: Path) -> None:
        out, said = io.StringIO(), io.StringIO()
        with redirect_stdout(out), redirect_stderr(said):
            code = main([str(path) if one == "FILE" else one for one in arguments])
        if code not in (0, 1, 2) or (code == 2 and not said.getvalue().strip()):
            raise WrongAnswerError(f"code {code}, {said.getvalue()!r}")
        if "--json" in arguments and code != 2:
            json.loads(out.getvalue(), parse_constant=_no_json)

    run.__name__ = "softgrip " + " ".join(arguments)
    return run


def _no_json(word: str) -> None:
    raise WrongAnswerError(f"{word} in JSON")


def named(name: str, reader: Reader) -> Reader:
    reader.__name__ = name
    return reader


LOGS: Sequence[Reader] = (
    read_log,
    contents,
    judge_step_log,
    judge_staircase,
    compare,
    Replay,
    read_contacts,
    read_weights,
    named("read_step_test", lambda path: read_step_test([path])),
    named("read_runs", lambda path: read_runs([path])),
    named("judge", lambda path: judge(path, "pid")),
    command("check", "FILE"),
    command("check", "--json", "FILE"),
    command("accept", "FILE", "--experiment", "pid", "--json"),
)
EXPORTS: Sequence[Reader] = (
    read_table,
    read_export,
    named("read_export with sizes",
          lambda path: read_export(path, gauge_length="30 mm", area="12 mm^2", zero="first row")),
    named("elasticity", lambda path: elasticity(read_export(path).test, resamples=4)),
)  # fmt: skip
VOLTS = ("e1", "e2", "e3")
READERS: dict[str, Sequence[Reader]] = {
    "log": LOGS,
    "other log": (read_table, *LOGS),
    "mapping": (read_log, contents, judge_step_log, command("check", "FILE")),
    "pad log": LOGS,
    "layer log": LOGS,
    "gripper log": LOGS,
    "readings": (
        named("kinds", lambda path: read_readings(path, label="kind", channels=VOLTS)),
        named(
            "forces",
            lambda path: read_readings(path, label="weight", channels=VOLTS, group="press"),
        ),
        named(
            "in grams",
            lambda path: read_readings(path, label="weight", channels=["e1"], unit=0.00980665),
        ),
    ),
    "export": EXPORTS,
    "german export": EXPORTS,
    "database": (
        *EXPORTS,
        tensile.parse,
        named("fitting.fit", lambda path: fit(tensile.parse(path), Fitting("engineering"))),
    ),
    "calibration": (calibration.load,),
    "rig": (read_rig, named("connect", lambda path: connect(f"simulated:{path}"))),
    "model": (pad_model.load,),
}
"""What reads each kind of `seeds.SEEDS`."""
RARE: dict[str, Sequence[Reader]] = {
    "export": (command("fit", "material", "FILE", "--json"),),
    "german export": (command("fit", "material", "FILE", "--json"),),
    "gripper log": (named("identified", lambda path: identified_gripper(read_runs([path]))),),
}
"""Those that take a second, for one file of `SELDOM`."""
SELDOM = 50
