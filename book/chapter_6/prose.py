"""Computed numbers in the prose of Chapter 6."""

import numpy as np

from book.chapter_6 import comparison, finger_count, numbers, results, shown, speed, tasks
from book.chapter_6 import figures_model as model
from book.chapter_6 import figures_study as study
from book.chapter_6.controllers import WANTED
from book.chapter_6.figures_rig import ENDS
from book.chapter_6.filters import CROSSOVER, DAMPING_RATIO, NATURAL_FREQUENCY, author_plant
from book.chapter_6.grasps import STIFFNESS
from book.companion.choices import choice
from book.companion.claims import claim_of, printed
from book.companion.verdict import recomputed
from softgrip.control.loop import SPEED_LIMIT
from softgrip.gripper.grasp import ElasticDisc
from softgrip.gripper.gripper_batch import Trial
from softgrip.gripper.internal_model import PERIOD
from softgrip.gripper.optimal_feedforward import FeedforwardProgram
from softgrip.gripper.plant import PRINTED, FingerDynamics
from softgrip.gripper.printed_loop import FILTERS, FINE, equal_targets
from softgrip.gripper.uncertainty import DAMPING_BOUND, STIFFNESS_BOUND
from softgrip.simulator.fitted_rigs import printed_gripper
from softgrip.units import DEG, MM, REV


def _out_of_step(name: str) -> float:
    """Return the median of the largest difference between the fingers, deg."""
    return float(np.median(comparison.judged(name).synchronization)) / DEG


def _plant(finger: FingerDynamics) -> str:
    return f"{finger.damping:.4g} and {finger.stiffness:.4g}"


def _limit(which: int) -> float:
    return list(study.LIMITS.values())[which]


def _weights() -> dict[float, float]:
    """Return the largest weight by the motor speeds, rev/s, at which every run has a model."""
    found = {one: results.largest_weight(one * REV) for one in speed.speeds()}
    return {one: weight for one, weight in found.items() if weight is not None}


WORDS = {
    # Settings that many have.
    "period": lambda: f"{1000 * PERIOD:g}",
    "fine": lambda: f"{1000 * FINE:g}",
    "speed_limit": lambda: f"{SPEED_LIMIT / REV:g}",
    "wanted": lambda: f"{WANTED / DEG:g}",
    "damping_bound": lambda: f"{100 * DAMPING_BOUND:g}",
    "stiffness_bound": lambda: f"{100 * STIFFNESS_BOUND:g}",
    # Figures 6.4 and 6.5.
    "open_left": lambda: f"{numbers.angle_at_rest('left'):.0f}",
    "open_right": lambda: f"{numbers.angle_at_rest('right'):.0f}",
    "model_deviation": lambda: f"{100 * shown.largest_model_deviation():.0f}",
    "above_one": lambda: f"{max(shown.passes_one('open', k) for k in (0, 1)):.0f}",
    "slow_above_one": lambda: f"{shown.passes_one('low-speed'):.0f}",
    "sensor_noise": lambda: f"{printed_gripper().sensors.angle_noise / DEG:.1f}",
    "excited_share": lambda: f"{100 * choice('excited_share'):.2g}",
    "high_speed": lambda: f"{speed.printed_speed('high'):.2g}",
    "slow_speed": lambda: f"{speed.printed_speed('low'):.2g}",
    "speed_runs": lambda: f"{speed.RUNS}",
    "spread_at_rest": lambda: f"{numbers.spread_at_rest('high'):.1f}",
    "low_speed": lambda: f"{min(_weights()):g}",
    "weight_grows": lambda: (
        f"{100 * (_weights()[min(_weights())] / _weights()[max(_weights())] - 1):.0f}"
    ),
    # Figure 6.6.
    "noise": lambda: f"{model.NOISE / DEG:g}",
    "push": lambda: f"{model.PUSH:g}",
    "push_from": lambda: f"{model.PUSHED[0]:g}",
    "push_until": lambda: f"{model.PUSHED[1]:g}",
    "goal_1": lambda: f"{equal_targets()[0] / DEG:.0f}",
    "goal_2": lambda: f"{equal_targets()[1] / DEG:.0f}",
    "passes": lambda: f"{shown.passes_target():.1f}",
    "back": lambda: f"{shown.back_within(1 * DEG):.1f}",
    "ripple": lambda: f"{shown.ripple():.1f}",
    "moved_1": lambda: f"{shown.moved_by_push()[0] / DEG:.0f}",
    "moved_2": lambda: f"{-shown.moved_by_push()[1] / DEG:.0f}",
    # Figures 6.7 and 6.8, Tables 6.H to 6.J.
    "slow_settled": lambda: f"{numbers.settled_on_rig('2/s', '5 %'):.1f}",
    "rig_moved": lambda: f"{-results.push_response()[1][0].min() / DEG:.0f}",
    "rig_back": lambda: f"{results.recovery(1 * DEG)[0]:.1f}",
    "error_slow": lambda: f"{np.median(comparison.judged('2/s').error) / DEG:.1f}",
    "error_fast": lambda: f"{np.median(comparison.judged('4.8/s').error) / DEG:.1f}",
    "step_gain": lambda: f"{_out_of_step('4.8/s') - _out_of_step('2/s'):.1f}",
    "disc": lambda: f"{2 * ElasticDisc(1.0).radius / MM:g}",
    "soft": lambda: f"{STIFFNESS['soft']:g}",
    "medium": lambda: f"{STIFFNESS['medium']:g}",
    "stiff": lambda: f"{STIFFNESS['stiff']:g}",
    "touch": lambda: f"{shown.first_touch('scheme, 2/s'):.1f}",
    "aside": lambda: f"{shown.pushed_aside().mean():.0f}",
    "judged_runs": lambda: f"{comparison.RUNS}",
    "judged_band": lambda: f"{comparison.CRITERIA['2 deg'][0] / DEG:g}",
    "ends": lambda: "{} to {}".format(*ENDS),
    "unlimited_overshoot": lambda: (
        f"{100 * np.median(comparison.judged('4.8/s', 'no motor limit').overshoot):.0f}"
    ),
    "unlimited_settled": lambda: f"{numbers.settled_on_rig('2/s', rig='no motor limit'):.1f}",
    # Figures 6.A to 6.C, Tables 6.B and 6.D.
    "asked": lambda: f"{180 * printed('6.4-target-of-the-simulation'):.0f}",
    "equal_low": lambda: f"{100 * shown.outside('equal angles', 0):.0f}",
    "half": lambda: f"{shown.half_outside():.0f}",
    "proj_high": lambda: f"{100 * shown.outside('nearest at rest', 1):.0f}",
    "apart_fast": lambda: f"{shown.farthest_apart('4.8/s') / DEG:.0f}",
    "apart_slow": lambda: f"{shown.farthest_apart('2/s') / DEG:.1f}",
    "crossover_fast": lambda: f"{CROSSOVER['4.8/s']:g}",
    "crossover_slow": lambda: f"{CROSSOVER['2/s']:g}",
    "equal_fast": lambda: f"{recomputed(6, '6.4-target-loop-4-8-s').value:.2f}",
    "equal_slow": lambda: f"{recomputed(6, '6.4-target-loop-2-s').value:.2f}",
    "coefficients": lambda: f"{sum(len(top) + len(low) - 2 for top, low in FILTERS.values())}",
    "inside_frequency": lambda: f"{NATURAL_FREQUENCY:g}",
    "inside_damping": lambda: f"{DAMPING_RATIO:g}",
    "inverse_gap": lambda: f"{recomputed(6, '6.4-inverse-is-theorem-2').value:.0f}",
    "inverse_gap_at": lambda: f"{claim_of(6, '6.4-inverse-is-theorem-2').arguments['frequency']:g}",
    "mean_plant": lambda: _plant(PRINTED.mean),
    "author_plant": lambda: _plant(author_plant()),
    "delays": lambda: "{}, {} or {}".format(*model.DELAYS),
    "unstable_1": lambda: f"{shown.unstable_from('bilinear', 1):.2f}",
    "unstable_2": lambda: f"{shown.unstable_from('bilinear', 2):.2f}",
    "unstable_held": lambda: f"{shown.unstable_from('zoh', 0):.2f}",
    "travel": lambda: f"{shown.travel():.2f}",
    # Figure 6.D.
    "wanted_of_many": lambda: f"{finger_count.TARGET / DEG:g}",
    "count_settling": lambda: f"{finger_count.SETTLING:g}",
    "count_limit": lambda: f"{finger_count.LIMIT:g}",
    "largest_spread": lambda: f"{100 * finger_count.SPREADS[-1]:g}",
    "error_2": lambda: f"{shown.with_fingers(2).worst_residual:.0f}",
    "error_5": lambda: f"{shown.with_fingers(5).worst_residual:.0f}",
    "sync_2": lambda: f"{100 * shown.with_fingers(2).worst_sync:.0f}",
    "sync_5": lambda: f"{100 * shown.with_fingers(5).worst_sync:.0f}",
    # Figures 6.E and 6.F.
    "pairs": lambda: f"{study.PAIRS:,}",
    "study_limit": lambda: f"{study.LIMIT:g}",
    "study_end": lambda: f"{Trial(study.TARGET).duration:g}",
    "narrow_band": lambda: f"{100 * FeedforwardProgram.band:g}",
    "wide_band": lambda: f"{100 * study.BANDS[1]:g}",
    "high": lambda: f"{study.HIGH}",
    "first_settled": lambda: f"{shown.settling_of_pairs()[0]:.0f}",
    "last_settled": lambda: f"{shown.settling_of_pairs()[1]:.0f}",
    "usual_low": lambda: f"{shown.usual_difference()[0]:.0f}",
    "usual_high": lambda: f"{shown.usual_difference()[1]:.0f}",
    "largest_difference": lambda: f"{100 * shown.largest_difference():.0f}",
    "fast_peak": lambda: f"{shown.peak('4.8/s'):.0f}",
    "narrow_limit": lambda: f"{_limit(0):.3g}",
    "middle_limit": lambda: f"{_limit(1):.3g}",
    "widest_limit": lambda: f"{_limit(2):.3g}",
    "least_narrow": lambda: f"{shown.least_times()[0]:.1f}",
    "least_middle": lambda: f"{shown.least_times()[1]:.1f}",
    "least_wide": lambda: f"{shown.least_times()[2]:.1f}",
    "looked_at": lambda: f"{shown.LOOKED_AT:g}",
    "least_low": lambda: f"{100 * shown.least_differences()[0]:.1f}",
    "least_high": lambda: f"{100 * shown.least_differences()[1]:.1f}",
    "slow_time": lambda: f"{study.outcome('2/s', pairs=1).settling[0].max():.1f}",
    "slow_apart": lambda: f"{100 * study.outcome('2/s', pairs=1).synchronization[0]:.1f}",
    # Why the fingers end where they do, Table 6.D.
    "first_command": lambda: f"{shown.first_commands()[0]:.1f}",
    "second_command": lambda: f"{-shown.first_commands()[1]:.1f}",
    "third_command": lambda: f"{-shown.first_commands()[2]:.1f}",
    "later_commands": lambda: f"{shown.all_commands() - shown.first_commands().sum():.1f}",
    "all_commands": lambda: f"{shown.all_commands():.1f}",
    "short_rad": lambda: f"{shown.cut_end(SPEED_LIMIT):.2f}",
    "short_rev": lambda: f"{shown.cut_end(SPEED_LIMIT / REV):.2f}",
    # Tasks.
    "task_first": lambda: f"{tasks.FIRST:g}",
    "task_frequency": lambda: f"{tasks.SWINGING:g}",
    "task_partner": lambda: f"{tasks.partner(0.0)[0]:.1f}",
    "task_swinging": lambda: f"{tasks.partner(tasks.SWINGING)[0]:.1f}",
    "task_missed": lambda: f"{100 * tasks.partner(tasks.SWINGING)[1]:.1f}",
    "task_from": lambda: f"{tasks.FROM:g}",
    "task_to": lambda: f"{tasks.TO:g}",
    "task_grows": lambda: f"{tasks.first_command(tasks.TO) / tasks.first_command(tasks.FROM):.1f}",
    "task_grows_most": lambda: f"{(tasks.TO / tasks.FROM) ** 3:g}",
    "task_slow": lambda: f"{tasks.largest_bandwidth(_limit(1)):.1f}",
    "task_fast": lambda: f"{tasks.largest_bandwidth(_limit(2)):.1f}",
    "task_times": lambda: f"{_limit(2) / _limit(1):.1f}",
    "task_gain": lambda: (
        f"{tasks.largest_bandwidth(_limit(2)) / tasks.largest_bandwidth(_limit(1)):.1f}"
    ),
    "task_push": lambda: f"{tasks.PUSH:g}",
    "task_left": lambda: f"{tasks.kept_of_push(tasks.PUSH)[0]:.1f}",
    "task_right": lambda: f"{-tasks.kept_of_push(tasks.PUSH)[1]:.1f}",
    "task_meets": lambda: f"{tasks.MEETS:g}",
    "task_meets_at": lambda: f"{tasks.push_to_meet(tasks.MEETS):.1f}",
    # What was found.
    "found_missed": lambda: f"{100 * shown.missed_on_the_way():.0f}",
    "found_off": lambda: f"{np.ceil(10 * shown.largest_deviation()) / 10:g}",
    "found_times_rad": lambda: f"{shown.peak('4.8/s', np.pi / 3) / SPEED_LIMIT:.1f}",
    "found_times_rev": lambda: f"{shown.peak('4.8/s', np.pi / 3) * REV / SPEED_LIMIT:.1f}",
    "found_overshoot": lambda: f"{100 * shown.settles_about(1)[0]:.0f}",
    "found_late": lambda: f"{shown.settles_about(0)[1]:.2f}",
    "found_early": lambda: f"{shown.settles_about(1)[1]:.2f}",
    "sampled_bands": lambda: "{:.1f} to {:.1f}".format(*(100 * shown.sampled_bands())),
    "found_rig_fast": lambda: f"{numbers.settled_on_rig('4.8/s'):.1f}",
    "found_rig_slow": lambda: f"{numbers.settled_on_rig('2/s'):.1f}",
    "found_band": lambda: f"{100 * comparison.criteria()['fitted'][0]:.2g}",
    "found_frequency_1": lambda: f"{PRINTED.fingers[0].natural_frequency:.2f}",
    "found_frequency_2": lambda: f"{PRINTED.fingers[1].natural_frequency:.2f}",
}
