"""The tests of the gripper in Section 6.4 on many rigs."""

import numpy as np

from book.twin import rigs
from book.twin.experiments import closed_loop
from book.twin.identification import SecondOrders
from book.twin.laboratory import Laboratory
from book.twin.least_squares import Which
from book.twin.matrix_exponential import matrix_exponential
from book.twin.step_tests import Measures
from softgrip.arrays import Flags, Floats
from softgrip.control.state_feedback import SPEED_DIGITS
from softgrip.control.step_metrics import final_value, settling_time
from softgrip.gripper.internal_model import PERIOD, ControllerMatrices
from softgrip.gripper.inversion import LeftInverse, filtered_inverse
from softgrip.gripper.plant import sampled
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.shaping_filter import filter_state_space
from softgrip.gripper.uncertainty import excited_band
from softgrip.simulator.gripper_steps import OPEN_LOOP_DURATION
from softgrip.simulator.sampled_law import SampledLaw
from softgrip.simulator.statics import volume_for
from softgrip.units import DEG, ML, REV

SIDES = ("left", "right")
END, REST = 1.0, 5.0
"""s: the end of a record that counts as rest; and the time after a slow push."""
WANTED = 45 * DEG
"""Of both fingers, rad."""
RATIO = 1.6
"""Of the lengths, in powers, in which slow pushes are run together."""


def steps(lab: Laboratory) -> Measures:
    """Return what the seven steps in open loop say: angles at rest, models, and their spread.

    deg; damping and stiffness by mass, 1/s and 1/s^2, means of the runs; the larger of the two
    fingers' largest deviations, %; and the band in which the command is excited, rad/s.
    """
    test = lab.gripper_open
    ends = final_value(test.time, test.angle.mean(axis=1), window=END) / DEG
    mean = SecondOrders(*(values[:, None] for values in vars(lab.gripper_fingers).values()))
    each = lab.identified_fingers(test.angle, mean)
    w, z = each.natural_frequency, each.damping_ratio
    elements = {"damping": 2 * z * w, "stiffness": w * w}
    found = {f"angle-{side}": ends[:, k] for k, side in enumerate(SIDES)}
    for name, values in elements.items():
        middle, off = _over_runs(values)
        found |= {f"{name}-{side}": middle[:, k] for k, side in enumerate(SIDES)}
        found[f"deviation-{name}"] = 100 * off.max(axis=1)
    whole = np.full(lab.count, lab.gripper_commands.shape[1])
    return {**found, **_excited(lab.gripper_commands, whole, lab["choice.excited_share"])}


def _over_runs(values: Floats) -> tuple[Floats, Floats]:
    """Return the mean over the runs that identify a model, and the largest deviation as a share.

    Args:
        values: Shape (rigs, runs, fingers), NaN where a run identifies none.

    Returns:
        tuple: Shape (rigs, fingers) each, NaN where no run does.
    """
    told = np.isfinite(values)
    with np.errstate(invalid="ignore"):
        mean = np.where(told, values, 0.0).sum(axis=1) / told.sum(axis=1)
    off = np.where(told, np.abs(values / mean[:, None] - 1), 0.0).max(axis=1)
    return mean, np.where(np.isnan(mean), np.nan, off)


def _excited(commands: Floats, periods: Which, share: Floats) -> Measures:
    """Return the bands in which so many periods of commands, then rest, are excited, rad/s."""
    bands = []
    for own, size, part in zip(commands, periods.tolist(), share.tolist(), strict=True):
        lasting = own[:size]
        bands.append(excited_band(np.pad(lasting, (0, size - lasting.size)), PERIOD, share=part))
    low, high = np.transpose(bands)
    return {"excited-low": low, "excited-high": high}


def speeds(lab: Laboratory) -> Measures:
    """Return the deviation of the left finger's angle at rest at two speeds, deg, as measured.

    And the band in which the slow command is excited, rad/s.
    """
    found: Measures = {}
    for name in ("gripper_speed", "low_speed"):
        commands, pushing = lab.pushed(lab[f"choice.{name}"] * REV)
        periods = pushing + round(REST / PERIOD)
        found[name] = np.empty(lab.count)
        length = np.ceil(np.log(periods) / np.log(RATIO))
        for own in np.unique(length):
            which = np.flatnonzero(length == own)
            last = periods[which]
            test = lab.gripper_steps(
                commands[which], float(last.max()) * PERIOD, lab.steps, which, keep=("angle",)
            )
            at = last[:, None] - np.arange(round(END / PERIOD))
            rest = np.take_along_axis(test.angle[:, :, 0], at[:, None], axis=-1).mean(axis=-1)
            found[name][which] = np.std(rest, axis=1, ddof=1) / DEG
    return {**found, **_excited(commands, periods, lab["choice.excited_share"])}


def known_fingers(lab: Laboratory) -> tuple[Floats, Flags]:
    """Return P(s) of each gripper, and which are known.

    Returns:
        tuple: Damping, 1/s, stiffness, 1/s^2, and gain, rad/s^3 per rad/s, of both fingers, shape
            (3, rigs, fingers), of ones where the steps identify none; and flags, shape (rigs,).
    """
    found = lab.gripper_fingers
    w, z, k = vars(found).values()
    known = np.all(found.usable, axis=1, keepdims=True)
    return np.where(known, np.stack([2 * z * w, w**2, k * w**2]), 1.0), known[:, 0]


def internal_model_law(elements: Floats, target_loop: str, target: Floats) -> SampledLaw:
    """Return the controllers of Figure 6.3, by the mean of the inverses, on fingers that they know.

    `gripper.internal_model.controller_matrices`, for many rigs: the filter times each power of s is
    made discrete once, and weighed by the inverse of each rig.

    Args:
        elements: Damping, stiffness and gain, shape (3, rigs, fingers).
        target_loop: A key of `FILTERS`.
        target: rad, shape (rigs, fingers).
    """
    damping, stiffness, gain = elements
    count, fingers = gain.shape
    low_pass = filter_state_space(*FILTERS[target_loop])
    powers = filtered_inverse(LeftInverse(np.eye(4)), low_pass)
    A_f, B_powers, C_f, D_powers = sampled(powers, PERIOD, "bilinear")
    zero, one = np.zeros_like(gain), np.ones_like(gain)
    inverse = np.stack([one, damping, stiffness, zero]) / (fingers * gain)
    B_f = np.einsum("np,prf->rnf", B_powers, inverse)
    D_f = np.einsum("p,prf->rf", D_powers[0], inverse)
    # The plant: the integral of the input, then angle and rate over gain of each finger.
    n_f, n_p = len(A_f), 1 + 2 * fingers
    plant = np.zeros((count, n_p + 1, n_p + 1))
    plant[:, 0, n_p] = 1
    for k in range(fingers):
        angle, rate = 1 + 2 * k, 2 + 2 * k
        plant[:, angle, rate] = plant[:, rate, 0] = 1
        plant[:, rate, angle], plant[:, rate, rate] = -stiffness[:, k], -damping[:, k]
    held = matrix_exponential(plant * PERIOD)
    A, C = np.zeros((count, n_f + n_p, n_f + n_p)), np.zeros((count, n_f + n_p))
    A[:, :n_f, :n_f], A[:, n_f:, n_f:], C[:, :n_f] = A_f, held[:, :n_p, :n_p], C_f
    A[:, :n_f, n_f + 1 :: 2], C[:, n_f + 1 :: 2] = B_f * gain[:, None], D_f * gain
    B = np.zeros((count, n_f + n_p, fingers))
    B[:, :n_f] = B_f
    B_sent = np.concatenate([np.zeros((count, n_f)), held[:, :n_p, n_p]], axis=1)
    matrices = ControllerMatrices(A, -B, B, B_sent, C, -D_f, D_f, PERIOD)
    return SampledLaw(matrices, target[:, None], digits=SPEED_DIGITS)


def loops(lab: Laboratory) -> Measures:
    """Return what the scheme of Figure 6.3 does with either filter, medians of the runs.

    Settling time of both fingers about their own ends, s; error of the worse finger at rest, and
    the largest difference of the shares of their ways, deg; all without the sensors. NaN where the
    steps identify no model.
    """
    elements, known = known_fingers(lab)
    # Eq. (6.24): what of equal angles lies along the velocity gains.
    q = elements[2] / elements[1]
    targets = WANTED * q.sum(axis=1, keepdims=True) * q / np.sum(q * q, axis=1, keepdims=True)
    band = lab["choice.gripper_band"] / 100
    found: Measures = {}
    for target_loop in FILTERS:
        made = closed_loop(
            rigs.gripper(lab.values),
            internal_model_law(elements, target_loop, targets),
            OPEN_LOOP_DURATION,
            runs=lab.loops,
            period=PERIOD,
            keep=("true_angle",),
            compiled=lab.compiled,
        )
        angle = made.true_angle
        ends = final_value(made.time, angle)
        allowed = band[:, None, None] * np.abs(ends)
        settled = settling_time(
            made.time, angle / allowed[..., None], final=ends / allowed, band=1.0, absolute=True
        )
        shares = angle / targets[:, None, :, None]
        apart = np.abs(shares[:, :, 0] - shares[:, :, 1]) * targets.mean(axis=1)[:, None, None]
        measures = {
            "settling": settled.max(axis=2),
            "error": np.abs(ends - targets[:, None]).max(axis=2) / DEG,
            "apart": apart.max(axis=2) / DEG,
        }
        found |= {
            f"{name}-{target_loop}": np.where(known, np.median(values, axis=1), np.nan)
            for name, values in measures.items()
        }
    return found


def volume(lab: Laboratory) -> Measures:
    """Return the volume that bends three fingers by a right angle, mL, Section 6.3."""
    return {"three": volume_for(rigs.gripper(lab.values), 3, np.pi / 2) / ML}


FAST = {"gripper steps": steps, "gripper speeds": speeds, "gripper loops": loops, "volume": volume}
