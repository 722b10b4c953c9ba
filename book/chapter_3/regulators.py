"""The regulators that Figure 3.12 runs on a rig; ``python -m book.chapter_3.regulators``.

The command identifies the rig from its logs, designs both and writes
``data/control/lqr_gains.csv``; the logs are made with what stands there.

`printed`
    The printed weights, natural frequency and damping ratio, and the robust differentiator, whose
    jerk is fitted, as none is printed. The constant c of Eq. (3.25) is "obtained by
    experimentation": here the static gain of the finger, as identified from steps to 60 deg.
`fast`
    On the identified model, with ten times p and a tenth of q_2, and an observer: fed
    by the differentiator this design swings.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from book.chapter_4.identified_model import IdentifiedModel, identified_model
from book.companion.choices import choice
from softgrip.control.differentiator import RobustDifferentiator
from softgrip.control.loop import SPEED_LIMIT, Controller
from softgrip.control.lqr import FINGER, Weights, input_gain, lqr_gain
from softgrip.control.state_feedback import ObserverFeedback, StateFeedback
from softgrip.dynamics.second_order import SecondOrder
from softgrip.errors import UnknownNameError
from softgrip.kept import Kept

FILE = "control/lqr_gains.csv"

FAST = Weights(p=1000.0, q=(1.0, 0.03, 0.0))
"""Of `fast`. A larger p swings longer on the simulated rig."""


@dataclass(frozen=True)
class Row:
    """One line of the file.

    Attributes:
        design: "printed" or "fast".
        p, q1, q2, q3, R: Weights.
        natural_frequency, damping_ratio: Of the model, rad/s and dimensionless.
        input_gain: As of `lqr.input_gain` with a set speed of 5 rev/s, rad/s^3.
        k1, k2, k3: K of Eq. (3.30).
    """

    design: str
    p: float
    q1: float
    q2: float
    q3: float
    R: float
    natural_frequency: float
    damping_ratio: float
    input_gain: float
    k1: float
    k2: float
    k3: float


def designed_on(design: str, model: IdentifiedModel) -> tuple[SecondOrder, Weights]:
    """Return the finger and the weights of a design, "printed" or "fast"."""
    if design == "printed":
        gain = model.finger.gain
        return SecondOrder(FINGER.natural_frequency, FINGER.damping_ratio, gain), Weights()
    return model.finger, FAST


def rows() -> Iterator[Row]:
    """Design the regulators, `fast` on the rig that is identified from the kept logs."""
    model = identified_model()
    for name in ("printed", "fast"):
        finger, weights = designed_on(name, model)
        yield Row(
            name,
            weights.p,
            *weights.q,
            weights.R,
            finger.natural_frequency,
            finger.damping_ratio,
            input_gain(finger, model.pump_gain, SPEED_LIMIT),
            *lqr_gain(finger, weights).tolist(),
        )


KEPT = Kept(FILE, Row, rows, "python -m book.chapter_3.regulators")


def regulator(design: str) -> Controller:
    """Return a regulator with its kept gains, from angles to motor speed.

    Raises:
        UnknownNameError: If there is no such design.
    """
    known = {row.design: row for row in KEPT.read()}
    if design not in known:
        raise UnknownNameError("regulator", design, list(known))
    row = known[design]
    gain = (row.k1, row.k2, row.k3)
    if design == "printed":
        return StateFeedback(gain, row.input_gain, RobustDifferentiator(choice("lqr_jerk")))
    finger = SecondOrder(row.natural_frequency, row.damping_ratio)
    return ObserverFeedback(gain, finger, row.input_gain)


if __name__ == "__main__":
    KEPT.main()
