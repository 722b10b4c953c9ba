"""The gains of the two PID controllers of Chapter 4; ``python -m book.chapter_4.pid_gains``.

The command identifies the rig from its logs, and writes ``data/control/pid_gains.csv``: the gains
of Ziegler and Nichols on what it found, and these times what "trial and error" made of them. No
gain is printed; the factors are fitted, with the rig, to the settling times and errors that are.
The logs of the controllers are made with what stands there.
"""

from collections.abc import Iterator
from dataclasses import astuple, dataclass, replace

from book.chapter_4.identified_model import IdentifiedModel, identified_model
from book.companion.choices import choice
from softgrip.control.designs import unit_step
from softgrip.control.pid import Gains
from softgrip.control.ziegler_nichols import (
    ReactionCurve,
    integrating_reaction_curve,
    reaction_curve,
    ziegler_nichols,
)
from softgrip.dynamics.second_order import full_state_space, state_space
from softgrip.errors import UnknownNameError
from softgrip.kept import Kept

FILE = "control/pid_gains.csv"
MODELS = {"actuator": "Eq. (4.14)", "full": "Eq. (4.15)"}
STAGES = ("ziegler-nichols", "tuned")


@dataclass(frozen=True)
class Row:
    """One line of the file.

    Attributes:
        design, model: Key and value of `MODELS`.
        stage: One of `STAGES`.
        command: Unit of the command: Pa or rad/s.
        kp, ki, kd, derivative_filter: As of `Gains`.
    """

    design: str
    model: str
    stage: str
    command: str
    kp: float
    ki: float
    kd: float
    derivative_filter: float


def curves(model: IdentifiedModel) -> dict[str, ReactionCurve]:
    """Return the reaction curves of both models, by the keys of `MODELS`."""
    finger, whole = state_space(model.finger), full_state_space(model.finger, model.pump_gain)
    return {
        "actuator": reaction_curve(*unit_step(finger), window=2),
        "full": integrating_reaction_curve(*unit_step(whole)),
    }


def rows() -> Iterator[Row]:
    """Design the controllers on the rig that is identified from the kept logs."""
    for name, curve in curves(identified_model()).items():
        unit = "Pa" if name == "actuator" else "rad/s"
        rule = ziegler_nichols(curve)
        own = {k: getattr(rule, k) * choice(f"{name}_{k}") for k in ("kp", "ki", "kd")}
        for stage, gains in zip(STAGES, (rule, replace(rule, **own)), strict=True):
            yield Row(name, MODELS[name], stage, unit, *astuple(gains))


def _designed_on() -> str:
    model = identified_model()
    finger = model.finger
    return (
        f"designed on: omega_n = {finger.natural_frequency:.4g} rad/s; "
        f"zeta = {finger.damping_ratio:.4g}; gain = {finger.gain:.4g} rad/Pa; "
        f"C_i = {model.capacity:.4g} m^3/Pa"
    )


KEPT = Kept(FILE, Row, rows, "python -m book.chapter_4.pid_gains", _designed_on)


def pid_gains(design: str, stage: str = "tuned") -> Gains:
    """Return kept gains.

    Raises:
        UnknownNameError: If there is no such design or stage.

    >>> pid_gains("full").kp > 0
    True
    """
    known = {
        (row.design, row.stage): Gains(row.kp, row.ki, row.kd, row.derivative_filter)
        for row in KEPT.read()
    }
    if (design, stage) not in known:
        names = [" ".join(key) for key in known]
        raise UnknownNameError("PID controller", f"{design} {stage}", names)
    return known[design, stage]


if __name__ == "__main__":
    KEPT.main()
