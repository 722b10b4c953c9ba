"""The lightest fingers: rows come out again, and no drawn section does as much for less."""

from dataclasses import asdict

import numpy as np
import pytest

from book.beyond.design.lighter import (
    CASES,
    KEPT,
    PRINTED,
    RUBBER,
    Asked,
    asked,
    elasticity,
    lighter,
    problem,
    saved,
)
from softgrip.actuator.limits import measures
from softgrip.actuator.limits_certificate import MASS_TOLERANCE, inside
from softgrip.actuator.printed import table_3_1
from softgrip.actuator.section import Section
from softgrip.materials.draws import DRAWS
from softgrip.materials.table import material

ROWS = KEPT.read()


def test_every_case_has_the_printed_rubber_and_all_draws_and_is_proved():
    assert [Asked(row.case, row.draw) for row in ROWS] == asked()
    assert len(ROWS) == len(CASES) * (1 + DRAWS)
    assert all(row.proven for row in ROWS)


@pytest.mark.parametrize("case", CASES)
def test_a_row_comes_out_again(case):
    kept = next(row for row in ROWS if row.case == case and row.draw == PRINTED)
    again = lighter(Asked(case, PRINTED))
    assert again.mass == pytest.approx(kept.mass, rel=2 * MASS_TOLERANCE)
    assert again.proven


@pytest.mark.parametrize("case", CASES)
def test_design_1_is_within_its_own_limits(case):
    limited, wanted, heavy = problem(Asked(case, PRINTED))
    section = table_3_1()["Opt. parameters"]
    found = measures(limited, section)
    assert inside(limited, section, 0.0)
    assert found["objective"] >= wanted
    assert found["mass"] == heavy
    assert all(row.mass <= heavy * (1 + MASS_TOLERANCE) for row in ROWS if row.case == case)


@pytest.mark.parametrize("draw", [PRINTED, 17])
@pytest.mark.parametrize("case", CASES)
def test_brute_force_finds_nothing_lighter(case, draw):
    limited, wanted, _ = problem(Asked(case, draw))
    kept = next(row for row in ROWS if row.case == case and row.draw == draw)
    bounds, rng = limited.problem.bounds, np.random.default_rng(4)
    sides = [rng.uniform(*getattr(bounds, name), 100_000) for name in asdict(_empty())]
    sides[3] = bounds.wall[0] + (sides[3] - bounds.wall[0]) * rng.random(100_000) ** 4
    some = Section(*(np.array(x) for x in sides))
    with np.errstate(invalid="ignore"):
        found = measures(limited, some)
        good = inside(limited, some, 0.0) & (found["objective"] >= wanted)
    assert (found["mass"][good] >= kept.mass * (1 - 2 * MASS_TOLERANCE)).all()


def _empty():
    return Section(0.0, 0.0, 0.0, 0.0)


def test_less_that_is_kept_saves_more():
    strict, loose = (saved(case)[1] for case in [*CASES][2:])
    assert (loose > strict).all()


def test_elasticity_is_the_tables_or_the_draws():
    rubber = material(RUBBER)
    assert elasticity(PRINTED) == (rubber.young_modulus, rubber.fractional_power)
    assert len({elasticity(draw) for draw in range(DRAWS)}) > DRAWS / 2
