"""More fingers on one pump: by hand, and the kept points made again."""

import numpy as np
import pytest

from book.chapter_6 import finger_count
from book.chapter_6.finger_count import count_point, spread_gripper
from softgrip.errors import InvalidInputError
from softgrip.provenance import data_file


def test_residual_of_two_fingers_by_hand():
    """Gains v1, v2 and equal angles: outside is |v1 - v2| / sqrt(2 (v1^2 + v2^2))."""
    v = spread_gripper(2, 0.2).velocity_gains
    found = count_point(2, 0.2)
    by_hand = abs(v[0] - v[1]) / np.sqrt(2 * (v @ v))
    assert found.outside == pytest.approx(by_hand, rel=1e-9)


def test_kept_points_are_what_the_module_makes():
    kept = {(p.fingers, p.spread): p for p in finger_count.KEPT.read()}
    assert set(kept) == {(n, s) for n in finger_count.COUNTS for s in finger_count.SPREADS}
    for key in ((2, 0.2), (3, 0.1)):
        found = count_point(*key)
        for name in ("outside", "worst_residual", "worst_sync"):
            assert getattr(found, name) == pytest.approx(getattr(kept[key], name), rel=2e-3)


def test_only_the_extreme_fingers_count_on_the_way():
    """Five fingers within 2.5 % reach as far out as two within 5 %: the same least difference."""
    kept = {(p.fingers, p.spread): p.worst_sync for p in finger_count.KEPT.read()}
    assert kept[5, 0.025] == pytest.approx(kept[2, 0.05], rel=1e-3)
    assert kept[5, 0.05] == pytest.approx(kept[2, 0.1], rel=1e-3)
    for spread in finger_count.SPREADS[1:]:
        assert kept[2, spread] < kept[3, spread] < kept[4, spread] < kept[5, spread]


def test_written_file_is_the_kept_one(tmp_path, monkeypatch):
    monkeypatch.setattr(finger_count, "COUNTS", (2,))
    monkeypatch.setattr(finger_count, "SPREADS", (0.0, 0.2))
    lines = finger_count.KEPT.write(tmp_path / "deep" / "file.csv").read_text().splitlines()
    kept = data_file(finger_count.KEPT.file).path.read_text().splitlines()
    assert lines[:5] == kept[:5]
    assert len(lines) == 6


@pytest.mark.parametrize("spread", [-0.1, 1.0])
def test_impossible_spreads_are_refused(spread):
    with pytest.raises(InvalidInputError, match="spread"):
        spread_gripper(2, spread)
