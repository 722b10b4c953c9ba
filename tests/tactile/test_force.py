"""The weights of Section 2.3, and which of them its set can make."""

from itertools import product

import pytest

from softgrip.tactile.force import SET, WEIGHTS, pieces_for


def test_twenty_two_weights_and_zero_three_times_are_69_points():
    assert len(set(WEIGHTS)) == len(WEIGHTS) == 22
    assert 3 * (len(WEIGHTS) + 1) == 69


def test_five_weights_cannot_be_made_even_with_all_pieces():
    # Independent: every subset of the seven pieces.
    sums = {sum(p * use for p, use in zip(SET, chosen, strict=True))
            for chosen in product((0, 1), repeat=len(SET))}  # fmt: skip
    assert [w for w in WEIGHTS if w not in sums] == [2.5, 4, 14, 40, 45]
    assert [w for w in WEIGHTS if pieces_for(w) is None] == [2.5, 4, 14, 40, 45]


def test_a_second_2_and_a_second_20_leave_only_the_half_gram():
    assert [w for w in WEIGHTS if pieces_for(w, (*SET, 2, 20)) is None] == [2.5]


@pytest.mark.parametrize("weight", WEIGHTS)
def test_pieces_add_up(weight):
    pieces = pieces_for(weight)
    if pieces is not None:
        assert sum(pieces) == weight
        assert len(pieces) <= 3
        assert set(pieces) <= set(SET)
