"""The space holds the calibrated rig, and says what it expects of a line."""

import numpy as np
import pytest

from book.twin import rigs
from book.twin import space as module
from book.twin.pad_tests import layer_of, pad_of
from book.twin.space import rows, space, values
from softgrip.errors import DataFileError, InvalidInputError, UnknownNameError

(TODAY,) = rows(values())


def test_each_has_a_reason_and_ends_that_a_rig_can_have():
    for end in ("low", "high"):
        (row,) = rows({name: np.array([getattr(one, end)]) for name, one in space().items()})
        for make in (rigs.design_1, rigs.design_2, rigs.design_3, rigs.gripper, pad_of, layer_of):
            make(row)
        for k in (1, 2, 3, 4):
            rigs.table_3_2_row(k)(row)
    assert all(one.reason for one in space().values())


def test_a_share_runs_over_the_range():
    plain, log = space()["choice.pid_band"], space()["finger.frequency"]
    assert plain.at([0, 0.5, 1]).tolist() == [1, 5.5, 10]
    assert log.at([0, 1]) == pytest.approx([log.low, log.high])
    assert log.at(0.5) == pytest.approx((log.low * log.high) ** 0.5)


def test_values_of_some_rigs():
    found = values(3, {"rubber.power": [1.0, 2.0, 3.0], "finger.frequency": 2.0})
    assert [row["rubber.power"] for row in rows(found)] == [1.0, 2.0, 3.0]
    assert found["finger.frequency"].tolist() == [2.0] * 3
    assert set(found) == set(space())


@pytest.mark.parametrize(
    ("changed", "error"),
    [
        ({"finger.mass": 1.0}, UnknownNameError),
        ({"finger.frequency": [1.0, 2.0]}, InvalidInputError),
        ({"finger.frequency": np.nan}, InvalidInputError),
    ],
)
def test_other_values_are_refused(changed, error):
    with pytest.raises(error, match="finger"):
        values(3, changed)


@pytest.mark.parametrize(
    "bad",
    [
        {"value": "4"},
        {"name": "rubber.friction"},
        {"status": "fixed"},
        {"scale": "log", "low": "0"},
    ],
)
def test_a_bad_line_is_refused(monkeypatch, bad):
    first, *rest = module.data_rows(module.FILE)
    monkeypatch.setattr(module, "data_rows", lambda _: [first | bad, *rest])
    with pytest.raises(DataFileError, match="low <= value <= high"):
        space.__wrapped__()
