"""The table of targets counts what is near, and says what it cannot put in percent."""

import numpy as np
import pytest

from book.twin.__main__ import Met, met, table
from book.twin.laboratory import Laboratory
from book.twin.space import values
from book.twin.targets import targets

BY_ID = {one.id: one for one in targets()}


def test_deviations_are_in_percent_and_in_tolerances():
    one = Met(BY_ID["3.4-measured-angle-design-1-e1-"], 216.3)
    assert one.percent == pytest.approx(5.0)
    assert one.tolerances == pytest.approx(10.3 / 0.5)
    bound = Met(BY_ID["4.3-filter-error"], 4.0)
    assert (bound.percent, bound.tolerances) == (0.0, 0.0)
    assert np.isnan(Met(BY_ID["3.5-lqr-error"], 1.0).percent)


def test_the_last_line_counts():
    found = [
        Met(BY_ID["3.4-measured-angle-design-1-e1-"], 216.3),
        Met(BY_ID["3.4-measured-angle-design-2-e1-"], 100.5),
        Met(BY_ID["3.5-lqr-error"], 1.0),
    ]
    *_, last = table(found).splitlines()
    assert last == "median deviation 27.5 %; 1 of 2 within 10 %; 1 of 3 within their tolerance"


def test_targets_of_an_experiment_are_all_measured():
    found = met(Laboratory(values()), ["statics", "volume", "lifts"])
    assert len(found) == sum(one.experiment in ("statics", "volume", "lifts") for one in targets())
    assert all(np.isfinite(one.simulated) for one in found)
