"""What the curves of Chapter 6's figures show, in numbers: its prose tells them."""

import numpy as np

from book.chapter_6 import figures_model, figures_study, filters, finger_count, grasps, results
from book.chapter_6.controllers import WANTED
from book.chapter_6.figures_rig import MODELLED, model_deviation
from book.companion.claims import printed
from book.companion.verdict import recomputed
from softgrip.arrays import Floats
from softgrip.control.step_metrics import overshoot, settling_time
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.printed_loop import FINE, equal_targets, run_printed
from softgrip.gripper.reach import outside_share
from softgrip.logs.fingers import run_deviation
from softgrip.units import MM


def largest_model_deviation() -> float:
    """Return the largest deviation of the models that the open-loop runs identify, a share."""
    return float(max(model_deviation(m, MODELLED).max() for m in results.identified("open")))


def passes_one(kind: str, finger: int = 0) -> float:
    """Return the lowest frequency at which a record's deviations lie above one, rad/s."""
    frequency, found = run_deviation(results.logs_of(kind), finger)
    return float(frequency[np.argmax(found > 1)])


def passes_target() -> float:
    """Return when SPA 1 of Figure 6.6 (a) first passes its target, s."""
    found = run_printed(period=FINE)
    return float(found.time[np.argmax(found.angles[0] > equal_targets()[0])])


def back_within(angle: float) -> float:
    """Return when SPA 1 of Figure 6.6 (a) is back within an angle [rad] of its target, s."""
    found, goal = run_printed(period=FINE), equal_targets()
    return float(settling_time(found.time, found.angles, final=goal, band=angle, absolute=True)[0])


def moved_by_push() -> Floats:
    """Return how far the push of Figure 6.6 (c) moves each finger at most, rad."""
    moved = run_printed(push=figures_model.push).angles - run_printed().angles
    return np.asarray(moved[np.arange(2), np.abs(moved).argmax(axis=1)])


def outside(target: str, end: int) -> float:
    """Return the share of a target of Figure 6.A (a) that is out of reach at an end of the axis."""
    ends = figures_model.LOW_TO_HIGH[[0, -1]]
    return float(outside_share(PRINTED, figures_model.ASKED[target], ends)[end])


def missed_on_the_way() -> float:
    """Return the largest share of proj(Y_d) that is out of reach at any frequency of Figure 6.A."""
    goal = figures_model.ASKED["nearest at rest"]
    return float(outside_share(PRINTED, goal, figures_model.LOW_TO_HIGH).max())


def half_outside() -> float:
    """Return the frequency at which half as much of equal angles is out of reach as at 0, rad/s."""
    share = outside_share(PRINTED, figures_model.ASKED["equal angles"], figures_model.LOW_TO_HIGH)
    return float(figures_model.LOW_TO_HIGH[np.argmax(share < share[0] / 2)])


def farthest_apart(target: str) -> float:
    """Return how far the fingers of Figure 6.A (b) are apart at most, rad."""
    return float(figures_model.apart(target)[1].max())


def largest_deviation() -> float:
    """Return by how many percent a coefficient of either H is off at most, as in Table 6.B."""
    author, loops = filters.author_plant(), filters.CROSSOVER.items()
    found = [filters.deviations(name, filters.designed(name, c, author)) for name, c in loops]
    return float(np.abs(found).max())


def unstable_from(method: str, delay: int) -> float:
    """Return the period from which on a curve of Figure 6.C lies below zero, s, interpolated."""
    found = figures_model.margins(method, delay)
    last = np.flatnonzero(found > 0)[-1]
    return float(np.interp(0.0, -found[last : last + 2], figures_model.PERIODS[last : last + 2]))


def ripple() -> float:
    """Return the larger RMS error of Figure 6.6 (b), deg: what the ledger computes of the noise."""
    return recomputed(6, "6.4-simulated-noise-error").value


def settles_about(end: int) -> tuple[float, float]:
    """Return a band on either side of SPA 1's overshoot and the settling time in it, s.

    The bands are a tenth of a percent apart, the narrower one first.
    """
    found = run_printed(period=FINE)
    goal = equal_targets()
    band = (np.floor(1000 * float(overshoot(found.angles, target=goal)[0])) + end) / 1000
    return float(band), float(settling_time(found.time, found.angles, final=goal, band=band).max())


def sampled_bands() -> Floats:
    """Return the narrowest and the widest band with which the printed time comes out sampled.

    Shares of the target, in tenths of a percent: of Figure 6.6 (a) at the stated period, within the
    rounding of the printed settling time.
    """
    found, goal = run_printed(), equal_targets()
    bands = np.arange(0.02, 0.1, 0.001)
    times = np.array(
        [settling_time(found.time, found.angles, final=goal, band=band).max() for band in bands]
    )
    return bands[np.abs(times - printed("6.4-simulated-settling")) < 0.05][[0, -1]]


def first_commands() -> Floats:
    """Return the first three commands of a step to pi/3 by the filter for 4.8/s, unit of U."""
    return run_printed().commands[:3]


def all_commands() -> float:
    """Return the sum of the commands of that step, unit of U: what moves the fingers in the end."""
    return float(run_printed(duration=8.0).commands.sum())


def cut_end(limit: float) -> float:
    """Return where the fingers end over their targets if the commands of that step are cut.

    A model inside that is told of the limit moves as the fingers do, so that nothing is fed back.
    """
    free = run_printed(duration=8.0).commands
    return float(np.clip(free, -limit, limit).sum() / free.sum())


def peak(target: str, angle: float = WANTED) -> float:
    """Return the largest command of a step to an angle [rad], in the unit of U."""
    return float(np.abs(run_printed(target, angle=angle).commands).max())


def travel() -> float:
    """Return the sum of the commands of a step to pi/3, in the unit of U times s."""
    gripper, goal = PRINTED, equal_targets()
    return float(goal[0] * gripper.fingers[0].stiffness / gripper.fingers[0].gain)


def with_fingers(count: int) -> finger_count.CountPoint:
    """Return the point of Figure 6.D for so many fingers, at the largest spread."""
    points = (p for p in finger_count.KEPT.read() if p.fingers == count)
    return max(points, key=lambda point: point.spread)


def settling_of_pairs() -> Floats:
    """Return least and largest settling time that Figure 6.E (a) shows, s."""
    times = np.concatenate([figures_study.settling_times(name) for name in figures_study.CONTROLS])
    return np.array([times.min(), times.max()])


def usual_difference() -> Floats:
    """Return between what differences the three curves of Figure 6.E (b) peak, percent."""
    edges = figures_study.APART
    at = [
        np.histogram(100 * figures_study.outcome(name).synchronization, edges)[0].argmax()
        for name in figures_study.CONTROLS
    ]
    return np.array([edges[min(at)], edges[max(at) + 1]])


def largest_difference() -> float:
    """Return the least of the three largest differences of Figure 6.E (b), a share."""
    return float(
        min(figures_study.outcome(name).synchronization.max() for name in figures_study.CONTROLS)
    )


def least_times() -> list[float]:
    """Return the first point of each curve of Figure 6.F, the widest limit last, s."""
    return [float(figures_study.trade_off(x)[0][0]) for x in figures_study.LIMITS.values()]


LOOKED_AT = 2.0
"""Settling time at which the curves of Figure 6.F are compared, s."""


def least_differences() -> Floats:
    """Return the least and the largest of Figure 6.F's curves at `LOOKED_AT`, shares."""
    curves = [figures_study.trade_off(limit) for limit in figures_study.LIMITS.values()]
    found = [np.interp(LOOKED_AT, *curve) for curve in curves]
    return np.array([min(found), max(found)])


def first_touch(drive: str) -> float:
    """Return when the left finger first touches a disc of Figure 6.8 (b) or (c), s, the least."""
    held = [grasps.grasp(stiffness, drive) for stiffness in grasps.STIFFNESS.values()]
    return float(min(one.time[np.argmax(one.forces[0] > 0)] for one in held))


def pushed_aside(after: float = grasps.DURATION) -> Floats:
    """Return how far each drive of Figure 6.8 (d) has pushed the disc after a time [s], mm."""
    held = [grasps.grasp(grasps.STIFFNESS["medium"], drive) for drive in grasps.DRIVES]
    return np.array([np.interp(after, one.time, one.place) / MM for one in held])
