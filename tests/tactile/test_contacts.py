"""Eq. (2.3): eight responses from 0 to 1; what contacts refuse, and how they are taken apart."""

import numpy as np
import pytest

from softgrip.errors import InvalidInputError
from softgrip.tactile.contacts import Contacts, check_responses

GOOD = {
    "responses": np.linspace(0, 1, 24).reshape(3, 8),
    "layer": [0.5, 1.0, 1.5],
    "times": [1.0, 2.0, 3.0],
    "kinds": ["point", "line", "surface"],
    "objects": ["egg", "hot dog", "tofu"],
    "places": np.zeros((3, 2)),
    "angles": [np.nan, 0.3, np.nan],
    "forces": [0.1, 0.2, 0.3],
}


def test_contacts_can_be_taken_by_mask_and_cannot_be_written_to():
    contacts = Contacts(**GOOD)
    lines = contacts.take(contacts.kinds == "line")
    assert (len(lines), lines.objects.tolist(), lines.angles.tolist()) == (1, ["hot dog"], [0.3])
    with pytest.raises(ValueError, match="read-only"):
        contacts.responses[0, 0] = 1


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"responses": np.zeros((3, 9))}, "8 channels"),
        ({"responses": np.full((3, 8), np.nan)}, "between 0 and 1, got nan"),
        ({"responses": np.full((3, 8), 1.1)}, "between 0 and 1, got 1.1"),
        ({"kinds": ["point", "line"]}, r"kinds: expected shape \(3,\)"),
        ({"kinds": ["point", "line", "edge"]}, "edge"),
        ({"layer": [0.5, 1.0]}, r"layer: expected shape \(3,\)"),
        ({"places": np.full((3, 2), np.inf)}, "places: expected finite"),
        ({"angles": [np.nan, np.nan, np.nan]}, "angles"),
        ({"angles": [0.1, 0.3, np.nan]}, "angles"),
        ({"angles": [np.nan, 3.0, np.nan]}, "angles"),
        ({"forces": [0.1, 0.0, 0.3]}, "forces"),
    ],
)
def test_what_is_not_as_said_is_refused(change, message):
    with pytest.raises(InvalidInputError, match=message):
        Contacts(**GOOD | change)


def test_kinds_and_truth_may_be_unknown_but_no_half_of_the_truth():
    nothing = {"places": np.full((3, 2), np.nan), "angles": [np.nan] * 3, "forces": [np.nan] * 3}
    assert len(Contacts(**GOOD | nothing | {"kinds": ["", "line", ""]})) == 3
    for name in ("places", "forces"):
        with pytest.raises(InvalidInputError, match=name):
            Contacts(**GOOD | {name: nothing[name]})


def test_one_reading_is_checked_as_many_are():
    """Eq. (2.3): eight responses, each from 0 to 1."""
    assert check_responses([0.5] * 8).shape == (8,)
    with pytest.raises(InvalidInputError, match="8 channels"):
        check_responses(0.5)
