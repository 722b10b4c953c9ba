"""The drawings and tables of the grasp, and that they say what the numbers say."""

import pytest

from book.chapter_2 import diagrams as chapter_2_diagrams
from book.chapter_2 import figures_grasp as chapter_2_grasp
from book.chapter_2.figures_grasp import table_2_j, table_2_k
from book.companion.style import style


@pytest.mark.parametrize(
    "make",
    [
        chapter_2_grasp.figure_2_14,
        chapter_2_grasp.figure_2_i,
        chapter_2_grasp.figure_2_j,
        chapter_2_diagrams.figure_2_4,
        chapter_2_diagrams.figure_2_6,
        chapter_2_diagrams.figure_2_12,
    ],
)
def test_figure_is_drawn(make):
    with style():
        drawn = make()
        drawn.draw_without_rendering()
    assert drawn.axes


def test_friction_table_by_hand():
    rows = table_2_j().set_index("quantity")
    assert rows.loc["friction, as the numbers stand"].tolist() == ["1.167", "1.056", "0.938"]
    assert set(rows.loc["friction, common to all"]) == {"0.974 to 1.033"}
    # 59, 18 and 14 gf by 9.80665 mN.
    assert rows.loc["weight (N), Table 2.2"].tolist() == ["0.579", "0.177", "0.137"]
    # Normal tails beyond 1/3 x 10, 5/6 and 1/2 deviations.
    assert rows.loc["probability to slip (%)"].tolist() == ["0.043", "20", "31"]


def test_grasp_table_has_what_is_desired_and_what_is_held():
    rows = table_2_k().set_index("quantity")
    assert rows.loc["desired force (N)"].tolist() == ["0.3", "0.09", "0.08"]
    held = [name for name in rows.index if name.startswith("held")]
    assert len(held) == 3
    for name in rows.columns:
        shares = [float(rows.loc[row, name]) for row in held]
        assert shares == sorted(shares)


def test_captions_say_simulated_where_it_is():
    from book.companion.exhibit import EXHIBITS
    from softgrip.provenance import Provenance

    for kind, number in (("figure", "2.14"), ("figure", "2.J"), ("table", "2.K")):
        found = EXHIBITS[kind, number]
        assert found.provenance is Provenance.SIMULATED
        assert "*simulated*" in found.caption
        assert found.caption.endswith(".")
