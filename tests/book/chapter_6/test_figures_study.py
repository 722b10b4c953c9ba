"""What the figures and tables on many grippers say, held against bounds of their own."""

import numpy as np
import pytest

from book.chapter_6 import figures_study as shown
from softgrip.gripper.gripper_batch import can_rest, draw_grippers
from softgrip.gripper.plant import PRINTED


def test_target_is_the_printed_projection():
    """Eq. (6.27): 0.227 pi and 0.268 pi."""
    assert np.array(shown.TARGET) / np.pi == pytest.approx([0.227, 0.268], abs=1e-3)


@pytest.mark.parametrize("name", shown.CONTROLS)
def test_none_that_settles_is_beyond_what_can_rest(name):
    found = shown.outcome(name, pairs=400)
    drawn = draw_grippers(PRINTED, 400, seed=shown.SEED)
    settled = np.isfinite(found.settling).all(axis=2)
    # A finger that still moves can be within its band at 3 s, where it could not stay.
    beyond = (settled[1] & ~can_rest(drawn, shown.TARGET, shown.BANDS[1])).mean()
    assert beyond <= 0.01
    assert settled[1].any()


def test_no_loop_is_below_the_least_difference_of_the_nominal_pair():
    """A loop that settles in time is one of the commands that the linear program looks at."""
    loop = shown.outcome("2/s", pairs=1)
    when = loop.settling[0].max()
    best = shown.FeedforwardProgram(PRINTED, shown.TARGET, limit=5.0).trade_off(2.2)
    bound = next(b.worst_sync for b in best if b.settling >= when)
    assert loop.synchronization[0] > bound


def test_table_of_least_times_falls_with_band_and_limit():
    times = shown.table_6_f().drop(columns="limit").astype(float).to_numpy()
    assert times.shape == (3, 3)
    assert (np.diff(times, axis=0) < 0).all()
    assert (np.diff(times, axis=1) < 0).all()
