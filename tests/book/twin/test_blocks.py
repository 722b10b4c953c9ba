"""The blocks of the problem share no parameter, and rows are put together from them."""

import numpy as np
import pytest

from book.twin.blocks import BLOCKS, drawn, put_together
from book.twin.misfit import chosen, misfit
from book.twin.recipes import FAST, SLOW
from book.twin.space import space, values

OWN = np.array([name.startswith("pad.") for name in space()])
TODAY = np.array([column[0] for column in values().values()])
OTHER = np.array([one.at(0.4) for one in space().values()])


def test_each_fast_target_is_asked_once_and_the_kinds_with_them():
    asked = [one for block in BLOCKS.values() for one in chosen(block.experiments)]
    assert len(asked) == len(set(asked))
    assert set(asked) == set(chosen([*FAST, "kinds"]))
    assert set(chosen([*FAST, *SLOW])) - set(asked) == set(chosen(["linear range"]))


@pytest.mark.parametrize(("name", "own"), [("rig", ~OWN), ("pad", OWN)])
def test_blocks_share_no_parameter(name, own):
    """Those of the other block are moved, all at once: nothing is felt."""
    rows = np.stack([TODAY, np.where(own, TODAY, OTHER)])
    one, other = misfit(rows, experiments=BLOCKS[name].experiments, jobs=1)
    np.testing.assert_allclose(one, other, rtol=1e-6, atol=1e-6)


def test_the_pad_s_kinds_are_tied_to_all_of_the_pad_and_to_nothing_else():
    problem = BLOCKS["pad"].problem()
    assert {one.name for one in problem.free} == {
        one.name for one in space().values() if one.name.startswith("pad.") and one.status == "free"
    }
    kinds = np.array([one.experiment == "kinds" for one in problem.targets])
    assert problem.touched[:, kinds].all()
    moved = {one.name for one, own in zip(problem.free, problem.touched.T[~kinds].any(axis=0),
                                          strict=True) if own}  # fmt: skip
    assert moved == {"pad.young_modulus", "pad.cut"}


def test_a_row_has_each_parameter_of_the_block_that_looks_at_it():
    class Free:
        free = tuple(one for one in space().values() if one.name.startswith("pad."))

    made = put_together([(None, TODAY[None]), (Free, OTHER[None])])[0]
    np.testing.assert_array_equal(made, np.where(OWN, OTHER, TODAY))


def test_rigs_are_drawn_alike_often():
    found = drawn(np.arange(64.0)[:, None], 256, seed=1)[:, 0]
    assert np.bincount(found.astype(int)).tolist() == [4] * 64
    assert len(np.unique(drawn(np.arange(512.0)[:, None], 256, seed=1))) == 256
