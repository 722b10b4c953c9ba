"""A simulated rig fitted to a reader's own logs: ``python -m softgrip.rig fit``."""

import hashlib
import json
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np

from softgrip.arrays import Floats
from softgrip.errors import DataFileError, InvalidInputError
from softgrip.provenance import Provenance
from softgrip.rig.fit_report import report
from softgrip.simulator.fit_estimates import Inferred
from softgrip.simulator.fitted_rigs import design_1, printed_gripper
from softgrip.simulator.free_parameters import free_parameters
from softgrip.simulator.inference import Progress, infer, silent
from softgrip.simulator.parameters import PumpParameters, RigParameters
from softgrip.simulator.rig_file import FittedRig, Line, lines_of, write_rig
from softgrip.simulator.trial import Trial, read_trial
from softgrip.units import ML


def fit_rig(
    logs: Sequence[Path | str],
    *,
    clamped: Sequence[Path | str] = (),
    weighted: Mapping[str, float] | None = None,
    syringe: float | None = None,
    part: Path | None = None,
    progress: Progress = silent,
) -> Inferred:
    """Fit a simulated rig to logs.

    Args:
        logs: One or more, of one rig, each begun at rest and at home.
        clamped: Further ones, with the tube shut at the finger.
        weighted: Further ones by their path, with a known torque on each finger from before their
            begin on, N m, positive bends further.
        syringe: Volume of air when the plunger is drawn out, m^3; None for one of the syringes of
            the dissertation, told by the area in the logs.
        part: File that keeps what an interrupted fit has found, to go on with; None for none. It is
            gone when the fit is over.
        progress: Told of each round.

    Raises:
        DataFileError: If a log cannot be used; it says why.
        InvalidInputError: If there is no log, or no volume of the syringe.
    """
    trials = [
        *(read_trial(path) for path in logs),
        *(read_trial(path, clamped=True) for path in clamped),
        *(read_trial(path, torque=torque) for path, torque in (weighted or {}).items()),
    ]
    if not trials:
        raise InvalidInputError("logs", expected="one or more", got="none")
    _check_alike(trials)
    base = base_rig(trials[0], syringe)
    asked = [(one.digest, one.clamped, one.torque) for one in trials]
    kept = _Kept(part, f"{asked} {asdict(base)} {free_parameters(trials[0].fingers)}")
    stages = kept.read()

    def tell(words: str) -> None:
        kept.write(stages)
        progress(words)

    found = infer(trials, base, stages=stages, progress=tell)
    kept.forget()
    return found


def base_rig(trial: Trial, syringe: float | None) -> RigParameters:
    """Return the rig that a fit begins with: the pump of a log, and Design 1 for each finger."""
    pumps = (PumpParameters(), printed_gripper().pump)
    known = [one.syringe_volume for one in pumps if abs(one.area / trial.pump.area - 1) < 1e-3]
    if syringe is None and not known:
        raise InvalidInputError(
            "syringe",
            expected=f"its volume, for an area of {trial.pump.area:g} m^2: known are those of "
            + " and ".join(f"{one.area:g}" for one in pumps),
            got="none",
        )
    rig = design_1()
    pump = replace(
        rig.pump,
        area=trial.pump.area,
        lead=trial.pump.lead,
        syringe_volume=known[0] if syringe is None else syringe,
    )
    return replace(rig, fingers=rig.fingers * trial.fingers, pump=pump)


def _check_alike(trials: Sequence[Trial]) -> None:
    first = trials[0]
    for one in trials[1:]:
        if (one.pump, one.fingers) != (first.pump, first.fingers):
            raise DataFileError(
                one.name,
                expected=f"a log of the same rig as {first.name}: {first.fingers} finger(s), "
                f"{first.pump}",
                got=f"{one.fingers} finger(s), {one.pump}",
            )


def fitted(found: Inferred) -> FittedRig:
    """Return the rig that a fit found, with how each parameter is known."""
    trials, rig = found.problem.trials, found.rig
    before = {
        name: getattr(found.problem.base.sensors, name)
        for name in ("pressure_noise", "angle_noise")
    }
    known = [
        Line(one.name, one.value, one.low, one.high, "told" if one.told else "not told")
        for one in found.estimates
    ] + [
        Line(f"sensors.{name}", value, None, None, "measured")
        for name, was in before.items()
        if (value := getattr(rig.sensors, name)) != was
    ]
    simulated = all(one.provenance is Provenance.SIMULATED for one in trials)
    return FittedRig(
        rig,
        trials[0].period,
        Provenance.SIMULATED if simulated else Provenance.LOGGED,
        tuple(f"{one.name} {one.digest}" for one in trials),
        lines_of(rig, known),
    )


class _Kept:
    """What an interrupted fit leaves in a file, for a fit of the same logs to the same rig."""

    def __init__(self, path: Path | None, of: str) -> None:
        self.path, self.key = path, hashlib.sha256(of.encode()).hexdigest()

    def read(self) -> dict[str, Floats]:
        if self.path is None or not self.path.is_file():
            return {}
        try:
            held = json.loads(self.path.read_text(encoding="utf-8"))
            stages = {
                name: np.array(point, dtype=np.float64) for name, point in held["stages"].items()
            }
            return stages if held["key"] == self.key else {}
        except (ValueError, KeyError, TypeError, AttributeError):
            return {}  # it saves time, no more: without it the fit begins anew

    def write(self, stages: Mapping[str, Floats]) -> None:
        if self.path is not None:
            held = {"key": self.key, "stages": {k: v.tolist() for k, v in stages.items()}}
            beside = self.path.with_suffix(self.path.suffix + "~")
            beside.write_text(json.dumps(held), encoding="utf-8")
            beside.replace(self.path)  # whole or not at all

    def forget(self) -> None:
        if self.path is not None:
            self.path.unlink(missing_ok=True)


def add_fit_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``fit`` to a parser."""
    parser.add_argument("logs", nargs="+", help="begun at home, at rest, at atmospheric pressure")
    parser.add_argument("-o", "--output", required=True, help="file of the rig, for simulated:FILE")
    parser.add_argument(
        "--clamped", action="append", default=[], metavar="LOG",
        help="a further log, with the tube shut at the finger",
    )  # fmt: skip
    parser.add_argument(
        "--weight", action="append", nargs=2, default=[], metavar=("LOG", "N_M"),
        help="a further log, with a known torque on each finger, positive bends it further",
    )  # fmt: skip
    parser.add_argument("--syringe", type=float, metavar="ML", help="its volume, if it is another")


def run_fit(asked: Namespace) -> int:
    """Fit a rig as the arguments of ``fit`` say, write its file, report, and return an exit code.

    A fit that was interrupted goes on when it is asked for again.

    Raises:
        SoftgripError: As `fit_rig`.
    """
    path = Path(asked.output)
    part = path.with_name(f"{path.name}.part")
    try:
        found = fit_rig(
            asked.logs,
            clamped=asked.clamped,
            weighted={log: _torque(words) for log, words in asked.weight},
            syringe=None if asked.syringe is None else asked.syringe * ML,
            part=part,
            progress=_show_stage,
        )
    except KeyboardInterrupt:
        print(f"interrupted: asked for again, it goes on from {part}", file=sys.stderr)
        return 130
    write_rig(fitted(found), path, source="python -m softgrip.rig fit")
    print(report(found))
    return 0


def _torque(words: str) -> float:
    try:
        return float(words)
    except ValueError:
        raise InvalidInputError("--weight", expected="LOG and a torque, N m", got=words) from None


def _show_stage(words: str) -> None:
    """Write how far a fit is on the standard error stream, over what stood there before."""
    if sys.stderr.isatty():
        print(f"\r{words:40}", end="", file=sys.stderr, flush=True)
