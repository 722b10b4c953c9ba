"""What the page of Chapter 3 says in words is what its models have."""

import pytest
from scipy.integrate import quad

from softgrip.actuator.fem_results import BEAM, CHAMBERS, OPTIMUM, read
from softgrip.actuator.printed import table_3_1
from softgrip.units import MM


def test_second_moment_of_the_hollow_section_is_half_that_of_the_block():
    a, b, w, t = (getattr(table_3_1()[OPTIMUM], x) for x in ("top", "bottom", "width", "wall"))

    def about(middle):
        """Integrate over the height, in three parts: below, beside and above the chamber."""
        parts = ((-b, 0, w), (0, a - t, 2 * t), (a - t, a, w))
        return sum(quad(lambda y: (y - middle) ** 2, *ends)[0] * x for *ends, x in parts)

    area, moment = w * (a + b) - (w - 2 * t) * (a - t), w * (a**2 - b**2) / 2
    centroid = (moment - (w - 2 * t) * (a - t) ** 2 / 2) / area
    assert about(centroid) / (w * (a + b) ** 3 / 12) == pytest.approx(0.5, abs=0.02)


def test_with_six_chambers_the_optimum_pushes_hardest_and_two_bend_farther():
    rows = [row for row in read("table_3_1") if row.chambers == CHAMBERS]
    assert max(rows, key=lambda row: row.torque).design == OPTIMUM
    angle = {row.design: row.angle for row in rows}
    assert {x for x in angle if angle[x] > angle[OPTIMUM]} == {"Variance 3", "Variance 4"}
    bottoms = {name: section.bottom / MM for name, section in table_3_1().items()}
    assert all(bottoms[x] < bottoms[OPTIMUM] for x in ("Variance 3", "Variance 4"))


def test_a_straight_tube_hardly_bends():
    (beam,) = (x for x in read("table_3_1") if (x.design, x.chambers) == (OPTIMUM, BEAM))
    assert beam.angle < 0.1 * min(row.angle for row in read("groove_floor"))
