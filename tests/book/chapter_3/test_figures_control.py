"""What the sliders and tables of the regulator say."""

import pytest
from matplotlib.figure import Figure

from book.chapter_3.figures_control import (
    PRINTED_TIME,
    RATE,
    settling_over_p,
    table_3_c,
    table_3_d,
)
from book.chapter_3.sliders import draw_lqr


@pytest.mark.parametrize("step", [10, 90])
def test_sliders_draw_at_their_ends(step):
    for p, q2 in ((1, 0.0), (1e5, 1.0)):
        assert isinstance(draw_lqr(p, q2, step), Figure)


def test_title_tells_the_settling_time():
    assert draw_lqr(100, 0.3, 60).axes[0].get_title(loc="left") == "within 5 % after 3.34 s"
    assert draw_lqr(1, 0.3, 60).axes[0].get_title(loc="left") == "not within 5 % in 4 s"


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
