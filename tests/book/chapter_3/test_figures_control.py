"""What the sliders and tables of the regulator say."""

import numpy as np
import pytest

from book.chapter_3.figures_control import (
    PRINTED_TIME,
    RATE,
    settling_over_p,
    table_3_c,
    table_3_d,
)
from book.chapter_3.sliders import LQR_PLOT, lqr
from tests.book.explore.page_laws import title


@pytest.mark.parametrize("step", [10, 90])
def test_law_holds_beyond_the_sliders_ends(step):
    for p, q2 in ((1, 0.0), (1e5, 1.0)):
        found = lqr(p, q2, step)
        assert all(np.isfinite(values).all() for values in found.values())
        assert np.abs(found["command"]).max() <= 1


def test_title_tells_the_settling_time():
    assert title(LQR_PLOT, lqr(100, 0.3, 60)) == "within 5 % after 3.34 s"
    assert title(LQR_PLOT, lqr(1, 0.3, 60)) == "not within 5 % in 4 s"


def test_a_smaller_weight_on_the_rate_alone_passes_under_the_printed_time():
    assert settling_over_p(RATE).min() > PRINTED_TIME > settling_over_p(RATE / 10)[:, 0].min()


def test_table_of_settling_times():
    found = table_3_c()
    assert found["2 %"].iloc[:3].tolist() == ["4.28", "2.14", "above 1.01"]
    assert float(found["2 %"].iloc[3]) < 0.8


def test_table_of_largest_steps():
    found = table_3_d().set_index("within").astype(float)
    # A wider band or a stiffer finger with the same static gain allows more.
    assert found["identified"].is_monotonic_increasing
    assert (found["as printed"] > found["identified"]).all()
