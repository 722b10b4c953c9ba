"""The contacts that a pad of the twin feels are those of the kept logs."""

from dataclasses import replace

import numpy as np
import pytest

from book.chapter_2.logs import OBJECTS, TRAINING, contacts
from book.twin import pad_tests as module
from book.twin.laboratory import Laboratory
from book.twin.pad_tests import NEIGHBOURS, felt, right_by_k
from book.twin.space import values
from softgrip.simulator.fitted_rigs import fitted_pad
from softgrip.simulator.pad_tests import PAD_TESTS
from softgrip.tactile.contact_kind import nearest_neighbours
from softgrip.tactile.kind_evaluation import split_score


def test_contacts_are_those_of_the_log():
    found, kept = felt(PAD_TESTS["pad-objects"], fitted_pad()), contacts(OBJECTS)
    for name in ("kinds", "objects"):
        assert (getattr(found, name) == getattr(kept, name)).all(), name
    for name in ("responses", "layer", "times", "places", "angles", "forces"):
        # A log has at least six digits.
        assert getattr(found, name) == pytest.approx(getattr(kept, name), abs=1e-6, nan_ok=True), (
            name
        )


def test_another_pad_feels_the_same_contacts_otherwise():
    soft = felt(PAD_TESTS["pad-objects"], replace(fitted_pad(), spread=5e-4))
    kept = contacts(OBJECTS)
    # A log has places to a nanometre.
    assert soft.places == pytest.approx(kept.places, abs=1e-9)
    assert (soft.kinds == kept.kinds).all()
    assert not np.allclose(soft.responses, kept.responses, atol=0.05)


def test_the_right_answers_by_k_are_those_of_each_classifier():
    """On the kept log; neighbours that are equally far may fall otherwise, a few of 504."""
    log = contacts(TRAINING)
    found = right_by_k(log, seed=3)
    for k in (1, 3, 10):
        model = nearest_neighbours(k)
        want = split_score(model, log.responses, log.kinds, seed=3).cross_validated.share
        assert found[NEIGHBOURS.index(k)] == pytest.approx(want, abs=3 / 504)


def test_pads_that_are_alike_are_run_once():
    lab = Laboratory(values(3, {"pad.tilt": [0.0, 0.02, 0.0], "rubber.power": [1.0, 2.0, 3.0]}))
    seen = []
    found = module._columns(lab, lambda row: seen.append(row) or {"tilt": row["pad.tilt"]})
    assert found["tilt"].tolist() == [0.0, 0.02, 0.0]
    assert len(seen) == 2
