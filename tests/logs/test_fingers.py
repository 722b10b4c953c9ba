"""Logs of the gripper: made again, read, identified; calibration; what Section 6.4 becomes."""

from dataclasses import replace

import numpy as np
import pytest

from book.chapter_6 import results
from book.chapter_6 import speed as gripper_speed
from book.chapter_6.comparison import ENTRIES, criteria, judged
from book.chapter_6.controllers import best_command, own_model, printed_model, target_angles
from book.chapter_6.grasps import STEP, grasp
from book.chapter_6.logs import LOGS, names_of
from book.companion.claims import printed
from book.companion.simulated_logs import make
from softgrip.control.state_feedback import SPEED_DIGITS
from softgrip.dynamics.second_order import SecondOrder, response
from softgrip.errors import DataFileError
from softgrip.gripper.plant import LEFT, RIGHT, FingerDynamics
from softgrip.gripper.synchronization import synchronization_error
from softgrip.logs.fingers import GripperLogs, identified_gripper, read_runs, run_deviation
from softgrip.logs.reader import read_log
from softgrip.provenance import data_file, data_folder
from softgrip.simulator.gripper_steps import step_identifies
from softgrip.units import DEG, MM, REV
from tests.simulator.rigs import printed_gripper


@pytest.mark.parametrize("name", [n for n in LOGS if n.endswith(("-1", "-7"))])
def test_log_is_made_again_to_the_last_digit_of_a_command(name, tmp_path):
    kept = data_file(f"simulated/{name}.csv").path
    made = make(name, tmp_path)
    assert make(name, tmp_path / "again").read_bytes() == made.read_bytes()
    found, wanted = read_log(made), read_log(kept)
    assert (found.header, found.events) == (wanted.header, wanted.events)
    assert list(found.columns) == list(wanted.columns)
    for column in wanted.columns:
        # The controller's matrices are sums of LAPACK, in another order in another numpy: a command
        # that lies between two roundings may take the other one. What is measured is the same.
        away = 1.001 * 10**-SPEED_DIGITS if column == "command" else 0.0
        np.testing.assert_allclose(found[column], wanted[column], rtol=0, atol=away)
    assert kept.stat().st_size < 20_000


def test_logs_hold_both_fingers_and_say_when_they_were_pushed():
    log = read_log(data_file(names_of("push")[0]).path)
    assert log.repairs == ()
    assert [words for _, words in log.events] == ["push on the left finger", "released"]
    runs = results.logs_of("push")
    assert runs.angles.shape == (7, 2, runs.time.size)
    np.testing.assert_array_equal(runs.angles[0, 1], log["angle_2"])
    np.testing.assert_allclose(runs.references[:, 0], target_angles(own_model()), rtol=1e-8)
    assert results.logs_of("open").references.size == 0


def test_logs_of_one_finger_or_other_times_are_refused():
    with pytest.raises(DataFileError, match="one finger"):
        read_runs([data_folder() / "simulated" / "step-60-1.csv"])
    with pytest.raises(DataFileError, match="other times"):
        read_runs([data_folder() / names_of(kind)[0] for kind in ("open", "push")])


def test_logs_of_a_single_row_are_refused(tmp_path):
    lines = data_file("simulated/gripper-open-1.csv").path.read_text().splitlines(keepends=True)
    first = next(k for k, line in enumerate(lines) if line.startswith("time"))
    (short := tmp_path / "short.csv").write_text("".join(lines[: first + 2]))
    with pytest.raises(DataFileError, match="expected two rows or more, got 1"):
        read_runs([short])


def test_linear_fingers_are_identified_exactly():
    time = 0.1 * np.arange(61)
    command = np.where(np.arange(61) == 1, 20.0, 0.0)[None]
    pair = (LEFT, RIGHT)
    angles = [
        response(
            SecondOrder(f.natural_frequency, f.damping / (2 * f.natural_frequency), 0.1),
            time,
            0.1 * np.cumsum(command[0]),
            initial_pressure=0.0,
        )
        for f in pair
    ]
    logs = GripperLogs(time, command, np.array([angles]), np.zeros(0), ())
    for found, true in zip(identified_gripper(logs).fingers, pair, strict=True):
        expected = FingerDynamics(true.damping, true.stiffness, 0.1 * true.stiffness)
        for name in ("damping", "stiffness", "gain"):
            assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-6)
    # One finger is the other but faster: equal runs deviate by nothing.
    assert run_deviation(replace(logs, angles=np.array([angles, angles])), 0)[1].max() < 1e-12


def test_fingers_in_one_share_are_in_step():
    targets = np.array([50.0, 40.0]) * DEG
    share = np.linspace(0, 1, 5)
    assert synchronization_error(targets[:, None] * share, targets).max() == pytest.approx(
        0, abs=1e-15
    )
    ahead = targets[:, None] * np.array([share, 0.9 * share])
    assert synchronization_error(ahead, targets)[-1] == pytest.approx(0.1 * 45 * DEG)


def test_steps_without_noise_identify_fingers_near_the_printed_plant():
    # Of the example rig, which was tuned to them by hand.
    angles, found = step_identifies(printed_gripper(spread=False), 6.94 * MM)
    np.testing.assert_allclose(angles[:, 0], np.array([50, 39.5]) * DEG, rtol=2e-3)
    for (one,), finger in zip(found, (LEFT, RIGHT), strict=True):
        assert one.damping == pytest.approx(finger.damping, rel=2e-3)
        assert one.stiffness == pytest.approx(finger.stiffness, rel=2e-3)


def test_masses_of_the_two_fingers_are_almost_the_same_only_by_our_reading():
    # Equal masses ask for stiffnesses that go as torque by angle at one pressure: the softer
    # finger bends more. The other reading has the rows of (6.26) swapped.
    ratio = 50 / 39.5
    assert ratio * LEFT.stiffness / RIGHT.stiffness == pytest.approx(1.07, abs=0.01)
    assert ratio * RIGHT.stiffness / LEFT.stiffness == pytest.approx(1.49, abs=0.01)


def test_noise_of_the_sensor_makes_a_third_of_the_deviations_of_seven_runs():
    """Of the larger of the two fingers, which is what the text has."""
    noisy, quiet = (
        results.bounds(results.identified("open")),
        results.bounds(results.identified_without_noise()),
    )
    assert all(len(runs) == 7 for runs in results.identified("open"))
    assert (noisy > quiet).all()
    assert (noisy.max(axis=0) > 1.5 * quiet.max(axis=0)).all()


def test_speed_file_is_made_again_and_shows_no_effect_of_speed():
    kept = gripper_speed.kept_errors()
    again = gripper_speed.errors_at(kept[0].speed)
    # The file holds three decimals.
    np.testing.assert_allclose(again.true, kept[0].true, atol=6e-4)
    np.testing.assert_allclose(again.measured, kept[0].measured, atol=6e-4)
    deviations = [spread.true.std(ddof=1) for spread in kept]
    # The same runs at each speed: what is compared is not chance.
    assert np.ptp(deviations) < 0.05
    assert max(deviations) < printed("6.4-spread-low-speed")


def test_best_possible_command_cannot_settle_the_model_in_the_printed_time():
    # On the model that the logs identify, within 5 rev/s, whatever the controller: both fingers
    # stay within 2 % from then on. On the rig no controller is as fast in the widest band either.
    fast = printed("6.4-settling-fast")
    assert best_command(own_model()).settling > fast
    for name in ENTRIES:
        assert np.median(judged(name).settling["10 %"]) > 1.2 * fast
    assert set(judged("open loop").settling) == set(criteria())


def test_a_push_is_worked_off_but_moves_the_other_finger_too():
    time, off = results.push_response()
    assert -3 * DEG < off[0].min() < -1 * DEG
    assert 0.2 * DEG < off[1].max() < 1 * DEG
    left, right = results.recovery()
    assert right < left
    assert 0 < left < 1.5
    assert abs(off[:, -1]).max() < 0.1 * DEG
    assert time[0] == pytest.approx(0, abs=1e-9)


def test_printed_model_has_the_printed_poles_left_first():
    left, right = printed_model().fingers
    assert (left.stiffness, right.stiffness) == (3.06, 3.61)
    assert target_angles(printed_model())[0] == pytest.approx(48.38 * DEG, abs=0.01 * DEG)


def test_equal_fingers_keep_the_disc_and_unequal_ones_push_it():
    equal, own = (grasp(200.0, "fast push", equal=flag) for flag in (True, False))
    assert abs(equal.place).max() == 0
    np.testing.assert_array_equal(*equal.forces)
    assert equal.apart == 0
    assert own.place.max() > 1e-3


def test_half_the_step_changes_the_hardest_blow_by_less_than_two_percent():
    coarse, fine = (grasp(2000.0, "fast push", step=step) for step in (STEP, STEP / 2))
    assert abs(fine.forces - coarse.forces).max() < 0.02 * coarse.forces.max()
    assert abs(fine.place - coarse.place).max() < 3e-5


def test_a_slower_push_asks_for_a_larger_weight_until_it_identifies_nothing():
    fast, slow = results.largest_weight(5 * REV), results.largest_weight(0.5 * REV)
    assert 1.05 < slow / fast < 1.3
    assert results.largest_weight(0.1 * REV) is None
