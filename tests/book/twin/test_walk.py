"""The walk along the ensemble: its rigs, and the misses that are kept of them."""

import numpy as np
import pytest

from book.explore.frames import render
from book.twin.fitted import ensemble
from book.twin.misfit import chosen, misfit
from book.twin.pictures import draw_walk, powers
from book.twin.problem import error_of
from book.twin.space import space
from book.twin.study import TABLES
from book.twin.walk import PLACES, places


def test_it_goes_from_the_least_power_to_the_largest():
    every = ensemble()[:, [*space()].index("rubber.power")]
    assert len(places()) == PLACES == len(set(places()))
    own = every[places()]
    assert (np.diff(own) > 0).all()
    assert (own[0], own[-1]) == (every.min(), every.max())


def test_the_kept_misses_are_those_of_the_ensemble_that_is_kept():
    """Of the rig in the middle: to the digits that are kept."""
    rows = TABLES["walk"].read()
    assert [(row.place, row.id) for row in rows] == [
        (place, target.id) for place in range(PLACES) for target in chosen()
    ]
    middle = PLACES // 2
    off = misfit(ensemble()[places()[middle]][None], jobs=1)[0]
    want = [miss / error_of(target) for miss, target in zip(off, chosen(), strict=True)]
    own = [row.errors for row in rows if row.place == middle]
    np.testing.assert_allclose(own, want, rtol=1e-4, atol=1e-6)


def test_the_slider_has_a_picture_for_each_rig():
    assert len(set(powers())) == PLACES
    assert render(draw_walk, {"power": powers()[-1]}).size > 0
    with pytest.raises(ValueError, match="not in list"):
        draw_walk(0.5)
