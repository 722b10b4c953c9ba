"""The pressure models of many pushes are those of `logs.pushes`."""

import numpy as np
import pytest

from book.chapter_4.identified_model import LOW_PRESSURE, identify_capacity
from book.twin.pressure_models import (
    Push,
    filtered_pressure,
    first_capacity,
    fitted_capacity,
    modified_pressure,
)
from softgrip.logs.pump import pump_of
from softgrip.logs.pushes import LOW, compare, reference_noise
from softgrip.logs.reader import read_log
from softgrip.provenance import data_file

NAMES = ("a", "d")


@pytest.fixture(scope="module")
def pushes():
    """Two pushes of other lengths as one batch, and what the chapter makes of each."""
    paths = [data_file(f"simulated/push-{name}.csv").path for name in NAMES]
    logs = [read_log(path) for path in paths]
    flows = np.array(
        [
            pump_of(p, log).displacement * log["command"][0]
            for p, log in zip(paths, logs, strict=True)
        ]
    )
    size = max(log["time"].size for log in logs)
    until = np.array([log["time"].size for log in logs])
    measured = np.stack(
        [np.pad(log["pressure"], (0, size - n), "edge") for log, n in zip(logs, until, strict=True)]
    )
    swept = flows[:, None] * 0.025 * np.arange(1, size + 1)
    return Push(0.025, flows, swept, measured, until), [compare(path) for path in paths], paths


def test_capacities_and_models_are_those_of_the_chapter(pushes):
    push, known, paths = pushes
    capacity = fitted_capacity(push, LOW)
    filtered = filtered_pressure(push, capacity, reference_noise())
    modified = modified_pressure(push, capacity)
    first = first_capacity(push, LOW_PRESSURE)
    for k, (one, path) in enumerate(zip(known, paths, strict=True)):
        own = slice(push.until[k])
        assert capacity[k] == pytest.approx(one.capacity, rel=1e-9)
        assert filtered[k, own] == pytest.approx(one.filtered, rel=1e-9)
        # Both fits of c end at a relative step of about 1e-8.
        assert modified[k, own] == pytest.approx(one.modified, rel=1e-4)
        assert first[k] == pytest.approx(identify_capacity(path), rel=1e-9)


def test_the_error_is_the_largest_above_the_bound_with_its_sign(pushes):
    push, known, _ = pushes
    for model in ("constant", "filtered"):
        size = push.measured.shape[1]
        made = [np.pad(getattr(one, model), (0, size - one.time.size), "edge") for one in known]
        assert push.error(np.stack(made)) == pytest.approx(
            [one.error(getattr(one, model)) for one in known]
        )


def test_a_push_that_stays_low_has_no_error():
    low = Push(0.1, np.ones(1), np.ones((1, 4)), np.full((1, 4), 5e4), np.array([4]))
    assert np.isnan(low.error(np.ones((1, 4)))).all()


def test_without_growth_the_modified_model_is_a_line():
    swept = np.linspace(0.1, 1, 10)[None]
    push = Push(0.1, np.ones(1), swept, 2e5 * swept, np.array([10]))
    assert modified_pressure(push, np.array([5e-6])) == pytest.approx(2e5 * swept, rel=1e-5)
