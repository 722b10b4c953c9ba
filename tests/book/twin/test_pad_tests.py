"""The contacts that a pad of the twin feels are those of the kept logs."""

import numpy as np
import pytest

from book.chapter_2.logs import OBJECTS, contacts
from book.twin.pad_tests import felt
from softgrip.simulator.pad_parameters import PadParameters
from softgrip.simulator.pad_tests import PAD_TESTS


def test_contacts_are_those_of_the_log():
    found, kept = felt(PAD_TESTS["pad-objects"], PadParameters()), contacts(OBJECTS)
    for name in ("kinds", "objects"):
        assert (getattr(found, name) == getattr(kept, name)).all(), name
    for name in ("responses", "layer", "times", "places", "angles", "forces"):
        # A log has at least six digits.
        assert getattr(found, name) == pytest.approx(getattr(kept, name), abs=1e-6, nan_ok=True), (
            name
        )


def test_another_pad_feels_the_same_contacts_otherwise():
    soft = felt(PAD_TESTS["pad-objects"], PadParameters(spread=5e-4))
    kept = contacts(OBJECTS)
    # A log has places to a nanometre.
    assert soft.places == pytest.approx(kept.places, abs=1e-9)
    assert (soft.kinds == kept.kinds).all()
    assert not np.allclose(soft.responses, kept.responses, atol=0.05)
