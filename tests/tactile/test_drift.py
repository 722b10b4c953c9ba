"""The correction of drift: exact for a line, refused without one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softgrip.errors import InvalidInputError
from softgrip.tactile.drift import DriftBetween, LinearDrift

THEN = np.array([1.0, 2.7, 3.7, 3.9])


@given(offset=st.floats(-1, 1), gain=st.floats(0.5, 2))
def test_drift_along_a_line_is_undone(offset, gain):
    now = offset + gain * THEN
    drift = LinearDrift.from_weights(THEN, now)
    np.testing.assert_allclose(drift.corrected(offset + gain * 2.0), 2.0, rtol=1e-9)


def test_line_is_that_of_the_normal_equations():
    now = THEN + np.array([0.1, -0.05, 0.02, 0.0])
    drift = LinearDrift.from_weights(THEN, now)
    design = np.column_stack([np.ones(4), now])
    expected = np.linalg.solve(design.T @ design, design.T @ THEN)
    assert (drift.offset, drift.gain) == pytest.approx(tuple(expected), rel=1e-9)


def test_lines_at_both_ends_undo_what_grows_in_time():
    # An offset that grows linearly: one line is wrong later on, two are not.
    share = np.array([0.0, 0.25, 0.5, 1.0])
    start = LinearDrift.from_weights(THEN, THEN + 0.1)
    end = LinearDrift.from_weights(THEN, THEN + 0.5)
    read = 2.0 + 0.1 + 0.4 * share
    np.testing.assert_allclose(DriftBetween(start, end).corrected(read, share), 2.0, rtol=1e-12)
    np.testing.assert_allclose(start.corrected(read) - 2.0, 0.4 * share, atol=1e-12)


@pytest.mark.parametrize("now", [[1.0, 2.0], [1.0] * 4, [[1.0], [2.0], [3.0], [4.0]]])
def test_no_line_without_different_voltages_of_the_same_weights(now):
    with pytest.raises(InvalidInputError, match="two arrays of one shape"):
        LinearDrift.from_weights(THEN, now)
